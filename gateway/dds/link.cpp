#include "gateway/dds/link.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <mutex>

#include "lib/text/plain_text.hpp"

namespace yars::gateway::dds {

namespace {

// Messages of Cyclone DDS, which arrive on its own threads. One object for the process, as Cyclone has one sink.
// Whoever reaches the ports can make Cyclone write many, so they are limited. Their time is that of the last take().
struct {
  std::mutex mutex;
  MessageLimit limit;
  std::int64_t now_ns = 0;
} messages;

void add_message(const std::string& text) {
  const std::lock_guard guard(messages.mutex);
  messages.limit.add(text, messages.now_ns);
}
std::vector<std::string> taken_messages(std::int64_t now_ns) {
  const std::lock_guard guard(messages.mutex);
  messages.now_ns = std::max(messages.now_ns, now_ns);
  return messages.limit.take("Cyclone DDS", messages.now_ns);
}

// Repairs of lost packets start after a few ms, so that sweeps arrive within 0.15 s on a line that loses 1 %. The
// watermarks hold what a host that is cut off for 1 s has missed. With the default, 30 kB, they throttle the sweeps.
constexpr const char* kInternal =
    "<Internal><Watermarks><WhcAdaptive>false</WhcAdaptive><WhcHighInit>8MB</WhcHighInit><WhcHigh>8MB</WhcHigh>"
    "<WhcLow>1MB</WhcLow></Watermarks>"
    "<HeartbeatInterval min=\"5ms\" minsched=\"10ms\" max=\"1s\">20ms</HeartbeatInterval>"
    "<NackDelay>10ms</NackDelay><AckDelay>5ms</AckDelay></Internal>";

std::string plugin(const std::string& element, const std::string& name, const std::string& function) {
  return "<" + element + "><Library initFunction=\"init_" + function + "\" finalizeFunction=\"finalize_" + function +
         "\" path=\"dds_security_" + name + "\"/>";
}

std::string security(const std::filesystem::path& folder) {
  std::string place;  // the folder, with the characters that have a meaning in XML replaced
  for (const char letter : folder.string())
    place += letter == '&' ? "&amp;" : letter == '<' ? "&lt;" : std::string(1, letter);
  const auto file = [&place](const std::string& element, const std::string& name) {
    return "<" + element + ">file:" + place + "/" + name + "</" + element + ">";
  };
  return "<Security>" + plugin("Authentication", "auth", "authentication") + file("IdentityCA", "identity_ca.pem") +
         file("IdentityCertificate", "certificate.pem") + file("PrivateKey", "key.pem") + "</Authentication>" +
         plugin("AccessControl", "ac", "access_control") + file("PermissionsCA", "permissions_ca.pem") +
         file("Governance", "governance.p7s") + file("Permissions", "permissions.p7s") + "</AccessControl>" +
         plugin("Cryptographic", "crypto", "crypto") + "</Cryptographic></Security>";
}

// XML text for dds_create_domain(). Multicast and shared memory are off; hosts find each other by the listed addresses.
// The form's texts are checked (config/schema), so that none can break the XML.
// Source: Eclipse Cyclone DDS 0.10, "Configuration guide"; docs/network.md has the reason of each value.
std::string domain_configuration(const radar::NetworkSettings& settings) {
  constexpr int kFragmentHeaders_bytes = 100;
  std::string text = "<CycloneDDS><Domain Id=\"any\"><General><Interfaces>";
  for (const std::string& name : settings.interfaces)
    text += "<NetworkInterface name=\"" + name + "\" multicast=\"false\"/>";
  text += "</Interfaces><AllowMulticast>false</AllowMulticast><MaxMessageSize>" +
          std::to_string(settings.max_message_bytes) + "B</MaxMessageSize><FragmentSize>" +
          std::to_string(settings.max_message_bytes - kFragmentHeaders_bytes) +
          "B</FragmentSize></General><Discovery>" +
          "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>" + std::to_string(settings.participants) +
          "</MaxAutoParticipantIndex><Peers>";
  for (const std::string& peer : settings.peers) text += "<Peer Address=\"" + peer + "\"/>";
  text += "</Peers><LeaseDuration>1000ms</LeaseDuration><SPDPInterval>200ms</SPDPInterval></Discovery>";
  text += kInternal;
  text += "<SharedMemory><Enable>false</Enable></SharedMemory>";
  if (!settings.security.empty()) text += security(settings.security);
  return text + "</Domain></CycloneDDS>";
}

using Qos = std::unique_ptr<dds_qos_t, decltype([](dds_qos_t* qos) { dds_delete_qos(qos); })>;

// Quality of service of a topic, the same for its writers and its readers. KEEP_LAST everywhere: with KEEP_ALL a lost
// host would block the writer. No liveliness leases: Cyclone DDS 0.10.2 ends with a segmentation fault when many of
// them expire (docs/decisions/0033).
Qos qos_of(Topic topic) {
  constexpr dds_duration_t kMaxBlocking_ns = DDS_MSECS(100);
  const int depth = settings_of(topic).depth;
  Qos qos(dds_create_qos());
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
  const bool is_repeated = topic == Topic::probes;  // by the sender
  dds_qset_reliability(qos.get(), is_repeated ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE,
                       kMaxBlocking_ns);
  if (topic == Topic::ownship) {
    dds_qset_ownership(qos.get(), DDS_OWNERSHIP_EXCLUSIVE);  // of the writer with the greatest strength
  } else if (!is_repeated) {
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);  // a host that joins later gets the last samples
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, depth, -1, -1, -1);
  }
  return qos;
}

// Binds the UDP sockets of the domain to the only interface. Cyclone DDS sends there alone, but receives on all
// interfaces (its sockets have the address 0.0.0.0).
void bind_sockets(const radar::NetworkSettings& settings) {
  if (settings.interfaces.size() != 1) return;
  const std::string& name = settings.interfaces.front();
  const int end = static_cast<int>(std::min(sysconf(_SC_OPEN_MAX), 1024L));
  for (int descriptor = 3; descriptor < end; ++descriptor) {
    sockaddr_in address{};
    socklen_t length = sizeof address;
    if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &length) != 0) continue;
    if (address.sin_family != AF_INET && address.sin_family != AF_INET6) continue;
    const int port = ntohs(address.sin_port);  // at the same position in sockaddr_in6
    const int first = first_port(settings.domain);
    if (port >= first && port < first_port(settings.domain + 1))
      setsockopt(descriptor, SOL_SOCKET, SO_BINDTODEVICE, name.c_str(), static_cast<socklen_t>(name.size() + 1));
  }
}

bool is_listed(const std::vector<std::string>& names, Topic topic) {
  // Without these four no host would know of another.
  if (topic <= Topic::clock_requests || names.empty()) return true;
  return std::ranges::find(names, settings_of(topic).name) != names.end();
}

// What Cyclone DDS has said last, else what `code` means. It takes a port for its participant with the domain already.
tl::unexpected<error::Error> fail_link(const radar::NetworkSettings& settings, const std::string& expected,
                                       dds_return_t code) {
  const auto said = taken_messages(0);
  const std::string found = said.empty() ? dds_strretcode(-code) : said.front();
  if (found.find("free participant index") == std::string::npos)
    return error::fail("network", expected, found, "check interfaces, peers, domain and security of the form Network");
  return error::fail(
      "Network: participants",
      "a free one of the " + std::to_string(settings.participants) + " places for DDS programs on this computer",
      "all taken in domain " + std::to_string(settings.domain),
      "end one of these programs, or give `participants` a greater number on all computers");
}

}  // namespace

Link::TopicState::TopicState(Topic topic)
    : quota(settings_of(topic).instances,
            topic == Topic::patch_rows ? 65536 : settings_of(topic).instances * databuffer::kMaxHosts) {
  text::put_text(counts.name, settings_of(topic).name);
}

error::Expected<void> Link::State::open_topics(const std::string& session) {
  const char* partition = session.c_str();
  const Qos qos(dds_create_qos());
  dds_qset_partition(qos.get(), 1, &partition);
  dds_qset_groupdata(qos.get(), settings.name.data(), settings.name.size());
  publisher = dds_create_publisher(participant, qos.get(), nullptr);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  subscriber = dds_create_subscriber(participant, qos.get(), nullptr);
  waitset = dds_create_waitset(participant);
  for (std::size_t i = 0; i < kTopicCount; ++i) {
    const auto topic = static_cast<Topic>(i);
    TopicState& state = topics[i];
    const std::string name = "yars/" + std::string(settings_of(topic).name);
    state.topic = dds_create_topic(participant, settings_of(topic).structure, name.c_str(), nullptr, nullptr);
    if (state.topic < 0) return fail_link(settings, "topic " + name, state.topic);
    const dds_topic_filter filter{DDS_TOPIC_FILTER_SAMPLEINFO_ARG, {.sampleinfo_arg = &Link::admits}, &state};
    dds_set_topic_filter_extended(state.topic, &filter);
    if (is_listed(settings.topics_out, topic) && topic != Topic::ownship)
      state.writer = dds_create_writer(publisher, state.topic, qos_of(topic).get(), nullptr);
    if (is_listed(settings.topics_in, topic)) state.reader = open_reader(topic);
    for (const dds_entity_t entity : {state.writer, state.reader})
      if (entity < 0 && entity != DDS_RETCODE_NOT_ALLOWED_BY_SECURITY)
        return fail_link(settings, "a writer and a reader of topic " + name, entity);
  }
  return {};
}

dds_entity_t Link::State::open_reader(Topic topic) {
  const Qos qos = qos_of(topic);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  // Who poses as a host writes to its instance. With one sample for both, a loaded gateway would lose that host.
  constexpr int kAnnouncements = 64;
  if (topic == Topic::hosts) dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kAnnouncements);
  const dds_entity_t reader = dds_create_reader(subscriber, at(topic).topic, qos.get(), nullptr);
  const bool is_awaited = topic == Topic::probes || topic == Topic::input_events;
  if (reader > 0 && is_awaited) {
    const dds_entity_t condition = dds_create_readcondition(reader, DDS_NOT_READ_SAMPLE_STATE);
    dds_waitset_attach(waitset, condition, condition);
  }
  return reader;
}

bool Link::State::is_from(Topic topic, dds_instance_handle_t writer, std::uint64_t host) {
  if (!is_secured() || (host != 0 && senders.host_of(at(topic).reader, writer) == host)) return true;
  if (at(topic).posed++ == 0)
    add_message("topic " + std::string(settings_of(topic).name) +
                ": expected samples of the host that the writer's certificate names, found one of another; such "
                "samples are left out");
  return false;
}

error::Expected<Link> Link::open(const radar::NetworkSettings& settings, const std::string& session) {
  auto state = std::make_unique<State>(settings);
  dds_set_log_sink(
      [](void*, const dds_log_data_t* data) { add_message(std::string(text::trimmed({data->message, data->size}))); },
      nullptr);
  const auto id = static_cast<dds_domainid_t>(settings.domain);
  state->domain = dds_create_domain(id, domain_configuration(settings).c_str());
  if (state->domain < 0) return fail_link(settings, "a configuration that Cyclone DDS accepts", state->domain);
  state->participant = dds_create_participant(id, nullptr, nullptr);
  if (state->participant < 0)
    return fail_link(settings, "a DDS participant on interface " + settings.interfaces.front(), state->participant);
  bind_sockets(settings);
  if (auto opened = state->open_topics(session); !opened) return tl::unexpected(opened.error());
  state->others.open(state->participant, session, state->is_secured());
  return Link(std::move(state));
}

bool Link::writes(Topic topic) const {
  if (topic == Topic::ownship) return is_listed(state_->settings.topics_out, topic);  // has a writer for each lane
  return state_->at(topic).writer > 0;
}

bool Link::write_ownship(std::uint32_t lane, const yars_net_OwnshipSample& sample) {
  if (!writes(Topic::ownship) || lane >= kMaxLanes) return false;
  dds_entity_t& writer = state_->ownship_writers[lane];
  if (writer > 0 && state_->ownship_strengths[lane] != sample.priority) end_ownship(lane);
  if (writer <= 0) {
    constexpr std::uint32_t kMaxStrength = 0x7FFFFFFF;
    const Qos qos = qos_of(Topic::ownship);
    dds_qset_ownership_strength(qos.get(), static_cast<int>(std::min(sample.priority, kMaxStrength)));
    writer = dds_create_writer(state_->publisher, state_->at(Topic::ownship).topic, qos.get(), nullptr);
    state_->ownship_strengths[lane] = sample.priority;
  }
  return state_->write(writer, sample);
}

void Link::end_ownship(std::uint32_t lane) {
  if (lane >= kMaxLanes || state_->ownship_writers[lane] <= 0) return;
  dds_delete(state_->ownship_writers[lane]);
  state_->ownship_writers[lane] = 0;
}

bool Link::is_acknowledged() const {
  const auto has_all = [](dds_entity_t writer) {
    return writer <= 0 || dds_wait_for_acks(writer, 0) != DDS_RETCODE_TIMEOUT;
  };
  return std::ranges::all_of(state_->topics, has_all, &TopicState::writer) &&
         std::ranges::all_of(state_->ownship_writers, has_all);
}

std::vector<std::string> Link::take_messages(std::int64_t now_ns) {
  // A message for the first sample, the 10th, the 100th, ...
  for (TopicState& topic : state_->topics) {
    const std::uint64_t refused = topic.quota.refused();
    if (refused < topic.next_report) continue;
    while (topic.next_report <= refused) topic.next_report *= 10;
    add_message("topic " + std::string(text::text_of(topic.counts.name)) + ": expected at most " +
                std::to_string(topic.quota.of_writer()) + " instances of a writer, found more; " +
                std::to_string(refused) + " samples left out so far; another program writes there");
  }
  return taken_messages(now_ns);
}

}  // namespace yars::gateway::dds
