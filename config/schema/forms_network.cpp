// Form Network of the configuration language GUF with its slots (schema.hpp): how this computer joins others.
#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "config/guf/parser.hpp"
#include "config/schema/schema.hpp"
#include "lib/radar/network.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::config {

namespace {

constexpr std::size_t kMaxInterfaceName = 15;  // [bytes] of Linux: IFNAMSIZ without the zero
constexpr std::size_t kMaxAddress = 253;       // [bytes] of a host name, RFC 1035 section 2.3.4

// True for 1 to `max` ASCII letters, digits and characters of `others`. Names and addresses become XML for Cyclone DDS.
bool is_plain(std::string_view text, std::size_t max, std::string_view others) {
  return !text.empty() && text.size() <= max && std::ranges::all_of(text, [&](char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') ||
           others.find(letter) != std::string_view::npos;
  });
}

using Words = std::vector<std::string>;

// Rule: all words of a slot fulfil `is_valid`.
std::optional<ConstraintViolation> check_words(std::string_view slot, const Words& words, const char* expected,
                                               bool (*is_valid)(std::string_view)) {
  const auto wrong = std::ranges::find_if_not(words, is_valid);
  if (wrong == words.end()) return std::nullopt;
  return ConstraintViolation{slot, expected, quoted_text(*wrong)};
}

// Rule: all words are names of topics.
std::optional<ConstraintViolation> check_topics(std::string_view slot, const Words& words) {
  const auto& names = radar::kTopicNames;
  const auto wrong =
      std::ranges::find_if(words, [&](std::string_view word) { return std::ranges::find(names, word) == names.end(); });
  if (wrong == words.end()) return std::nullopt;
  const std::string meant = text::did_you_mean(*wrong, Words(names.begin(), names.end()));
  std::string expected = "topics, which are";
  for (const std::string_view name : names) expected.append(name == names.front() ? " " : ", ").append(name);
  return ConstraintViolation{slot, expected, quoted_text(*wrong) + (meant.empty() ? "" : "; " + meant)};
}

// Rule: `lo` is alone. Beside it Cyclone DDS sends to other computers from the loopback address, which fails.
std::optional<ConstraintViolation> check_loopback(const Words& interfaces) {
  const auto other = std::ranges::find_if(interfaces, [](const std::string& name) { return name != "lo"; });
  if (other == interfaces.end() || std::ranges::find(interfaces, "lo") == interfaces.end()) return std::nullopt;
  return ConstraintViolation{"interfaces", "\"lo\" alone, or interfaces without it",
                             "\"lo\" beside " + quoted_text(*other)};
}

// The four bytes of an IPv4 address, with or without `:PORT` behind it; nullopt: the word is none.
std::optional<std::array<unsigned, 4>> ipv4_address(std::string_view word) {
  std::array<unsigned, 4> bytes{};
  word = word.substr(0, word.find(':'));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), bytes[i]);
    if (fault != std::errc() || bytes[i] > 255) return std::nullopt;
    word.remove_prefix(static_cast<std::size_t>(end - word.data()));
    if (i + 1 == bytes.size()) continue;
    if (!word.starts_with('.')) return std::nullopt;
    word.remove_prefix(1);
  }
  return word.empty() ? std::optional(bytes) : std::nullopt;
}

// Rule: each peer is a host name or an IPv4 address of one computer. Cyclone DDS is used over IPv4, without multicast.
std::optional<ConstraintViolation> check_peers(const Words& peers) {
  if (auto wrong = check_words("peers", peers, "IPv4 addresses or host names",
                               [](std::string_view word) { return is_plain(word, kMaxAddress, "-_.:"); }))
    return wrong;
  for (const std::string& peer : peers) {
    if (std::ranges::count(peer, ':') > 1)
      return ConstraintViolation{"peers", "IPv4 addresses or host names", quoted_text(peer) + ", an IPv6 address"};
    const auto address = ipv4_address(peer);
    const bool is_number = peer.find_first_not_of("0123456789.:") == std::string::npos;
    if (is_number && !address)
      return ConstraintViolation{"peers", "IPv4 addresses, such as 192.168.10.2, or host names", quoted_text(peer)};
    if (!address) continue;
    const unsigned first = address->front();
    if (first >= 224 || *address == std::array<unsigned, 4>{})
      return ConstraintViolation{"peers", "the address of each computer",
                                 quoted_text(peer) + (first < 224   ? ", the address of none"
                                                      : first < 240 ? ", a multicast address"
                                                                    : ", a broadcast or reserved address")};
  }
  return std::nullopt;
}

std::optional<ConstraintViolation> check_network(const ConfigurationBuilder& builder) {
  const radar::NetworkSettings& network = builder.network;
  if (!network.name.empty() && !is_plain(network.name, radar::kMaxHostName, "-_"))
    return ConstraintViolation{"name", "1 to 31 letters, digits, - or _", quoted_text(network.name)};
  if (auto wrong = check_words("interfaces", network.interfaces, "names of network interfaces, as `ip link` lists them",
                               [](std::string_view word) { return is_plain(word, kMaxInterfaceName, "-_.:@"); }))
    return wrong;
  if (auto wrong = check_loopback(network.interfaces)) return wrong;
  if (auto wrong = check_peers(network.peers)) return wrong;
  if (auto wrong = check_topics("topicsIn", network.topics_in)) return wrong;
  return check_topics("topicsOut", network.topics_out);
}

SlotSchema whole_slot(std::string_view name, std::string_view unit, int lowest, int highest, IntegerSlot binding,
                      std::string_view purpose) {
  return {.name = name,
          .unit = unit,
          .lowest = double(lowest),
          .highest = double(highest),
          .binding = binding,
          .purpose = purpose};
}

SlotSchema words_slot(std::string_view name, WordsSlot binding, std::string_view purpose) {
  return {.name = name, .binding = binding, .purpose = purpose};
}

std::vector<SlotSchema> network_slots() {
  return {{.name = "name",
           .binding = TextSlot{YARS_FIELD(network.name)},
           .purpose = "name of this computer: 1 to 31 letters, digits, - or _; left out: its host name"},
          whole_slot("priority", "", 0, 1000, {YARS_FIELD(network.priority)},
                     "when two computers hold one role, that with the higher priority keeps it"),
          whole_slot("domain", "", 0, 230, {YARS_FIELD(network.domain)},
                     "DDS domain, the same on all computers; it sets the UDP ports, from 7400 + 250 domain"),
          words_slot("interfaces", {YARS_FIELD(network.interfaces), 1, radar::kMaxInterfaces},
                     "network interfaces of this computer; or lo alone: nothing leaves the computer"),
          words_slot("peers", {YARS_FIELD(network.peers), 0, radar::kMaxPeers},
                     "IPv4 addresses or host names of the session's computers, or ADDRESS:PORT; multicast is off"),
          words_slot("topicsIn", {YARS_FIELD(network.topics_in), 0, radar::kTopicNames.size()},
                     "topics that are read from other computers; none named: all"),
          words_slot("topicsOut", {YARS_FIELD(network.topics_out), 0, radar::kTopicNames.size()},
                     "topics that are written for other computers; none named: all"),
          whole_slot("participants", "", 1, 32, {YARS_FIELD(network.participants)},
                     "maximum number of DDS participants on one computer, programs of others included"),
          whole_slot("mapRowsPerSecond", "1/s", 10, 20'000, {YARS_FIELD(network.map_rows_per_s)},
                     "rate at which the rows of a patch map are written"),
          whole_slot("maxMessageBytes", "bytes", 512, 65'000, {YARS_FIELD(network.max_message_bytes)},
                     "maximum size of a datagram; one that exceeds the network's MTU is lost as a whole with any part"),
          {.name = "security",
           .binding = PathSlot{YARS_FIELD(network.security)},
           .purpose = "folder with the identity of this computer for DDS Security; left out: none, anybody may join"}};
}

}  // namespace

std::vector<FormSchema> network_forms() {
  return {{.name = "Network",
           .purpose = "how this computer joins others in a session; read by the gateway, from a file of its own or "
                      "from the configuration",
           .slots = network_slots(),
           .check = check_network,
           .end = [](ConfigurationBuilder& builder) { builder.has_network = true; }}};
}

}  // namespace yars::config
