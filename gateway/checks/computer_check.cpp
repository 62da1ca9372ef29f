#include "gateway/checks/computer_check.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>

namespace yars::gateway::checks {

namespace {

using Address = std::uint32_t;  // IPv4, in the order of the host

struct Interface {
  std::string name;
  bool is_up = false;
  std::optional<Address> address, broadcast;
};

Address address_in(const sockaddr* socket) {
  return ntohl(reinterpret_cast<const sockaddr_in*>(socket)->sin_addr.s_addr);
}

std::string text_of(Address address) {
  const in_addr number{htonl(address)};
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &number, text.data(), text.size());
  return text.data();
}

// The last address of a network of four addresses or more. The system's own is 0 or the host's address where none is
// set.
std::optional<Address> broadcast_of(Address address, Address netmask) {
  return ~netmask >= 3 ? std::optional(address | ~netmask) : std::nullopt;
}

// One entry for each address, and one for an interface without any.
std::vector<Interface> interfaces_here() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, freeifaddrs);
  std::vector<Interface> with_address, others;
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    Interface found{entry->ifa_name, (entry->ifa_flags & IFF_UP) != 0, std::nullopt, std::nullopt};
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) {
      if (std::ranges::find(others, found.name, &Interface::name) == others.end()) others.push_back(std::move(found));
      continue;
    }
    found.address = address_in(entry->ifa_addr);
    if ((entry->ifa_flags & IFF_BROADCAST) != 0 && entry->ifa_netmask != nullptr)
      found.broadcast = broadcast_of(*found.address, address_in(entry->ifa_netmask));
    with_address.push_back(std::move(found));
  }
  for (Interface& other : others)
    if (std::ranges::find(with_address, other.name, &Interface::name) == with_address.end())
      with_address.push_back(std::move(other));
  return with_address;
}

// "eth0 (192.168.10.1), lo (127.0.0.1)": those that a gateway can use.
std::string list_of(const std::vector<Interface>& interfaces) {
  std::string list;
  for (const Interface& one : interfaces)
    if (one.is_up && one.address) list += (list.empty() ? "" : ", ") + one.name + " (" + text_of(*one.address) + ')';
  return list.empty() ? "none" : list;
}

error::Expected<void> check_interface(const std::string& name, const std::vector<Interface>& here) {
  const auto found = std::ranges::find(here, name, &Interface::name);
  if (found != here.end() && found->is_up && found->address) return {};
  std::string what = '"' + name + '"';
  if (found != here.end())
    what += !found->is_up ? ", which is down (ip link set " + name + " up)" : ", which has no IPv4 address";
  const auto addressed = std::ranges::find_if(
      here, [&name](const Interface& one) { return one.address && text_of(*one.address) == name; });
  return error::fail("Network: interfaces", "names of interfaces of this computer, which are " + list_of(here), what,
                     addressed != here.end() ? "did you mean \"" + addressed->name + "\"?" : "name one of them");
}

// IPv4 address of a peer, which is an address, or a name, or one of them with `:PORT`; nullopt: the name has none.
std::optional<Address> address_of(const std::string& peer) {
  const std::string host = peer.substr(0, peer.find(':'));
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), nullptr, &hints, &found) != 0 || found == nullptr) return std::nullopt;
  const Address address = address_in(found->ai_addr);
  freeaddrinfo(found);
  return address;
}

bool is_loopback(Address address) {
  return address >> 24U == 127;
}

void add_warnings(ComputerCheck& check, const radar::NetworkSettings& settings) {
  const bool reaches_others = std::ranges::any_of(settings.interfaces, [](const auto& name) { return name != "lo"; });
  if (!reaches_others && !check.other_peers.empty())
    check.warnings.emplace_back(
        "Network: interfaces: expected an interface that reaches the peers, found `lo` alone; name one that `ip link` "
        "lists");
  if (reaches_others && check.other_peers.empty() && check.known_peers.size() == settings.peers.size())
    check.warnings.emplace_back(
        "Network: peers: expected the addresses of the other computers, found none; this computer asks nobody, and "
        "joins those alone that name it: list them in `peers`");
}

}  // namespace

std::string host_name() {
  std::array<char, 64> name{};
  gethostname(name.data(), name.size() - 1);
  std::string text(name.data());
  return text.substr(0, std::min(text.find('.'), radar::kMaxHostName));
}

error::Expected<ComputerCheck> check_computer(const radar::NetworkSettings& settings) {
  const std::vector<Interface> here = interfaces_here();
  for (const std::string& name : settings.interfaces)
    if (auto checked = check_interface(name, here); !checked) return tl::unexpected(checked.error());
  ComputerCheck check;
  for (const std::string& peer : settings.peers) {
    const auto address = address_of(peer);
    if (!address) {
      check.warnings.push_back("Network: peers: expected names that have an IPv4 address, found \"" + peer +
                               "\", which has none here; it is not asked: correct it, or write its address, and start "
                               "the gateway again");
      continue;
    }
    if (std::ranges::find(here, address, &Interface::broadcast) != here.end())
      return error::fail("Network: peers", "the address of each computer", peer + ", a broadcast address",
                         "list the computers one by one");
    check.known_peers.push_back(peer);
    if (!is_loopback(*address) && std::ranges::find(here, address, &Interface::address) == here.end())
      check.other_peers.push_back(peer);
  }
  add_warnings(check, settings);
  return check;
}

}  // namespace yars::gateway::checks
