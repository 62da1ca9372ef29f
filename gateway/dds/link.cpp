#include "gateway/dds/link.hpp"

#include <dds/dds.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>
#include <utility>

#include "gateway/dds/domain_configuration.hpp"
#include "gateway/message_limit.hpp"

namespace yars::gateway::dds {

namespace {

constexpr std::uint32_t kMaxLanes = 16;         // ownship lanes with writers of their own
constexpr std::size_t kMaxSample_bytes = 8192;  // the greatest structure of a topic

// Messages of Cyclone DDS, which arrive on its own threads. One object for the process, as Cyclone has one sink.
// Whoever reaches the ports can make Cyclone write many, so they are limited. Their time is that of the last take().
class Messages {
 public:
  static Messages& instance() {
    static Messages messages;
    return messages;
  }
  static void receive(void* self, const dds_log_data_t* data) {
    std::string text(data->message, data->size);
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    static_cast<Messages*>(self)->add(text);
  }
  std::vector<std::string> take(std::int64_t now_ns) {
    const std::lock_guard guard(mutex_);
    now_ns_ = std::max(now_ns_, now_ns);
    return limit_.take("Cyclone DDS", now_ns_);
  }

 private:
  void add(const std::string& text) {
    const std::lock_guard guard(mutex_);
    limit_.add(text, now_ns_);
  }
  std::mutex mutex_;
  MessageLimit limit_;
  std::int64_t now_ns_ = 0;
};

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

// Quality of service of a topic, the same for its writers and its readers.
Qos qos_of(const TopicSettings& settings) {
  constexpr dds_duration_t kMaxBlocking_ns = DDS_MSECS(100);
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), settings.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       kMaxBlocking_ns);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, settings.depth);
  if (settings.transient_local) {
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, settings.depth, -1, -1, -1);
  }
  if (settings.exclusive) dds_qset_ownership(qos.get(), DDS_OWNERSHIP_EXCLUSIVE);
  return qos;
}

// Binds the UDP sockets of the domain to the only interface. Cyclone DDS sends there alone, but receives on all
// interfaces (its sockets have the address 0.0.0.0).
void bind_sockets(const radar::NetworkSettings& settings) {
  constexpr int kFirstPort = 7400, kPortsOfDomain = 250;
  if (settings.interfaces.size() != 1) return;
  const std::string& name = settings.interfaces.front();
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  const int end = static_cast<int>(std::min<rlim_t>(limit.rlim_cur, 1024));
  for (int descriptor = 3; descriptor < end; ++descriptor) {
    sockaddr_in address{};
    socklen_t length = sizeof address;
    if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &length) != 0) continue;
    if (address.sin_family != AF_INET && address.sin_family != AF_INET6) continue;
    const int port = ntohs(address.sin_port);  // at the same position in sockaddr_in6
    const int first = kFirstPort + kPortsOfDomain * settings.domain;
    if (port >= first && port < first + kPortsOfDomain)
      setsockopt(descriptor, SOL_SOCKET, SO_BINDTODEVICE, name.c_str(), static_cast<socklen_t>(name.size() + 1));
  }
}

bool is_listed(const std::vector<std::string>& names, Topic topic) {
  // Without these four no host would know of another.
  if (topic <= Topic::clock_requests || names.empty()) return true;
  return std::ranges::find(names, settings_of(topic).name) != names.end();
}

// `found`: what is said if Cyclone DDS has said nothing.
tl::unexpected<error::Error> fail_link(const std::string& expected, const std::string& found) {
  const auto messages = Messages::instance().take(0);
  return error::fail("network", expected, messages.empty() ? found : messages.front(),
                     "check interfaces, peers, domain and security of the form Network");
}

// The domain could not be opened. Cyclone DDS then takes a port for its participant already.
tl::unexpected<error::Error> fail_domain(const radar::NetworkSettings& settings, const std::string& found) {
  const auto messages = Messages::instance().take(0);
  const std::string message = messages.empty() ? found : messages.front();
  if (message.find("free participant index") == std::string::npos)
    return error::fail("network", "a configuration that Cyclone DDS accepts", message,
                       "check interfaces, peers, domain and security of the form Network");
  return error::fail(
      "Network: participants",
      "a free one of the " + std::to_string(settings.participants) + " places for DDS programs on this computer",
      "all taken in domain " + std::to_string(settings.domain),
      "end one of these programs, or give `participants` a greater number on all computers");
}

}  // namespace

struct Link::State {
  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (sweep.video._release) dds_free(sweep.video._buffer);
    if (domain > 0) dds_delete(domain);
    dds_set_log_sink(nullptr, nullptr);
  }
  error::Expected<void> open_topics(const std::string& session);

  radar::NetworkSettings settings;
  dds_entity_t domain = 0, participant = 0, publisher = 0, subscriber = 0, waitset = 0;
  std::array<dds_entity_t, kTopicCount> topics{}, readers{}, writers{};
  std::array<dds_entity_t, kMaxLanes> ownship_writers{};
  std::array<std::uint32_t, kMaxLanes> ownship_strengths{};
  std::array<TopicCounts, kTopicCount> counts;
  Participants others;
  alignas(16) std::array<std::byte, kMaxSample_bytes> taken{};
  yars_net_SweepSample sweep{};  // Cyclone DDS allocates its video
};

Link::Link(std::unique_ptr<State> state) : state_(std::move(state)) {}
Link::Link(Link&&) noexcept = default;
Link& Link::operator=(Link&&) noexcept = default;
Link::~Link() = default;

error::Expected<Link> Link::open(const radar::NetworkSettings& settings, const std::string& session) {
  auto state = std::make_unique<State>();
  state->settings = settings;
  dds_set_log_sink(&Messages::receive, &Messages::instance());
  const auto id = static_cast<dds_domainid_t>(settings.domain);
  state->domain = dds_create_domain(id, domain_configuration(settings).c_str());
  if (state->domain < 0) return fail_domain(settings, dds_strretcode(-state->domain));
  state->participant = dds_create_participant(id, nullptr, nullptr);
  if (state->participant < 0)
    return fail_link("a DDS participant on interface " + settings.interfaces.front(),
                     dds_strretcode(-state->participant));
  bind_sockets(settings);
  if (auto opened = state->open_topics(session); !opened) return tl::unexpected(opened.error());
  state->others.open(state->participant, session, !settings.security.empty());
  return Link(std::move(state));
}

error::Expected<void> Link::State::open_topics(const std::string& session) {
  const char* partition = session.c_str();
  const Qos qos(dds_create_qos());
  dds_qset_partition(qos.get(), 1, &partition);
  publisher = dds_create_publisher(participant, qos.get(), nullptr);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  subscriber = dds_create_subscriber(participant, qos.get(), nullptr);
  waitset = dds_create_waitset(participant);
  for (std::size_t i = 0; i < kTopicCount; ++i) {
    const auto topic = static_cast<Topic>(i);
    const TopicSettings& topic_settings = settings_of(topic);
    const std::string name = "yars/" + std::string(topic_settings.name);
    const Qos topic_qos = qos_of(topic_settings);
    topics[i] = dds_create_topic(participant, topic_settings.structure, name.c_str(), nullptr, nullptr);
    if (topics[i] < 0) return fail_link("topic " + name, dds_strretcode(-topics[i]));
    if (is_listed(settings.topics_out, topic) && topic != Topic::ownship) {
      writers[i] = dds_create_writer(publisher, topics[i], topic_qos.get(), nullptr);
      if (writers[i] < 0 && writers[i] != DDS_RETCODE_NOT_ALLOWED_BY_SECURITY)
        return fail_link("a writer of topic " + name, dds_strretcode(-writers[i]));
    }
    if (!is_listed(settings.topics_in, topic)) continue;
    dds_qset_ignorelocal(topic_qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
    readers[i] = dds_create_reader(subscriber, topics[i], topic_qos.get(), nullptr);
    if (readers[i] < 0 && readers[i] != DDS_RETCODE_NOT_ALLOWED_BY_SECURITY)
      return fail_link("a reader of topic " + name, dds_strretcode(-readers[i]));
  }
  for (const Topic topic : {Topic::probes, Topic::input_events}) {
    const dds_entity_t reader = readers[index_of(topic)];
    if (reader <= 0) continue;
    const dds_entity_t condition = dds_create_readcondition(reader, DDS_NOT_READ_SAMPLE_STATE);
    dds_waitset_attach(waitset, condition, condition);
  }
  return {};
}

bool Link::writes(Topic topic) const {
  if (topic == Topic::ownship) return is_listed(state_->settings.topics_out, topic);  // has a writer for each lane
  return state_->writers[index_of(topic)] > 0;
}

bool Link::reads(Topic topic) const {
  return state_->readers[index_of(topic)] > 0;
}

bool Link::write_bytes(Topic topic, const void* sample, std::size_t bytes) {
  const dds_entity_t writer = state_->writers[index_of(topic)];
  if (writer <= 0) return false;
  TopicCounts& counted = state_->counts[index_of(topic)];
  if (dds_write(writer, sample) < 0) {
    ++counted.failed;
    return false;
  }
  ++counted.sent;
  counted.sent_bytes += bytes;
  return true;
}

void Link::dispose_bytes(Topic topic, const void* sample) {
  const dds_entity_t writer = state_->writers[index_of(topic)];
  if (writer <= 0) return;
  dds_dispose(writer, sample);
  dds_unregister_instance(writer, sample);
}

bool Link::write_ownship(std::uint32_t lane, const yars_net_OwnshipSample& sample) {
  if (!writes(Topic::ownship) || lane >= kMaxLanes) return false;
  dds_entity_t& writer = state_->ownship_writers[lane];
  if (writer > 0 && state_->ownship_strengths[lane] != sample.priority) end_ownship(lane);
  if (writer <= 0) {
    constexpr std::uint32_t kMaxStrength = 0x7FFFFFFF;
    const Qos qos = qos_of(settings_of(Topic::ownship));
    dds_qset_ownership_strength(qos.get(), static_cast<int>(std::min(sample.priority, kMaxStrength)));
    writer = dds_create_writer(state_->publisher, state_->topics[index_of(Topic::ownship)], qos.get(), nullptr);
    state_->ownship_strengths[lane] = sample.priority;
  }
  TopicCounts& counted = state_->counts[index_of(Topic::ownship)];
  if (writer <= 0 || dds_write(writer, &sample) < 0) {
    ++counted.failed;
    return false;
  }
  ++counted.sent;
  counted.sent_bytes += sizeof sample;
  return true;
}

void Link::end_ownship(std::uint32_t lane) {
  if (lane >= kMaxLanes || state_->ownship_writers[lane] <= 0) return;
  dds_delete(state_->ownship_writers[lane]);
  state_->ownship_writers[lane] = 0;
}

const void* Link::take_next(Topic topic, bool* alive) {
  const dds_entity_t reader = state_->readers[index_of(topic)];
  if (reader <= 0) return nullptr;
  void* sample = topic == Topic::sweeps ? static_cast<void*>(&state_->sweep) : state_->taken.data();
  dds_sample_info_t info{};
  while (dds_take(reader, &sample, &info, 1, 1) > 0) {
    if (alive != nullptr) {
      *alive = info.valid_data;
      // A sample that the reader held before its writer's lease ended comes with the end.
      if (info.instance_state != DDS_IST_ALIVE && !info.valid_data) return sample;
    }
    if (info.valid_data) return sample;
  }
  return nullptr;
}

void Link::count_received(Topic topic, std::size_t bytes) {
  ++state_->counts[index_of(topic)].received;
  state_->counts[index_of(topic)].received_bytes += bytes;
}

void Link::wait(std::int64_t time_ns) {
  if (time_ns > 0) dds_waitset_wait(state_->waitset, nullptr, 0, time_ns);
}

const TopicCounts& Link::counts(Topic topic) const {
  return state_->counts[index_of(topic)];
}

std::vector<std::string> Link::take_messages(std::int64_t now_ns) {
  return Messages::instance().take(now_ns);
}

std::vector<Remark> Link::take_remarks(std::int64_t now_ns) {
  return state_->others.take_remarks(now_ns);
}

}  // namespace yars::gateway::dds
