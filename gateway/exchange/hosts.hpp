// The hosts of a session: who is heard, what they say about themselves, and the offsets of their clocks.
// Inputs: samples of the topics hosts and probes.
// Outputs: this host's announcements and probes; the hosts that are heard; whether a sample is new.
// Units: times [ns], CLOCK_MONOTONIC of this host unless stated.
// Errors: a damaged announcement is refused. Differences between hosts are said in one line each, by both hosts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "databuffer/session/session.hpp"
#include "gateway/dds/link.hpp"
#include "gateway/host_agreement.hpp"
#include "gateway/sample_reception.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::gateway {

// What is sent after a change, and else at a fixed interval.
class Pace {
 public:
  explicit Pace(std::int64_t interval_ns) : interval_ns_(interval_ns) {}
  // True: it is to be sent now. A change waits until `least_ns` have passed since the last time.
  bool is_due(bool changed, std::int64_t now_ns, std::int64_t least_ns = 0) {
    pending_ = pending_ || changed;
    if (now_ns - sent_ns_ < (pending_ ? least_ns : interval_ns_)) return false;
    pending_ = false;
    sent_ns_ = now_ns;
    return true;
  }

 private:
  std::int64_t interval_ns_, sent_ns_ = 0;
  bool pending_ = false;
};

// What this host says about itself.
struct Identity {
  std::string name;
  std::uint32_t priority = 0;
  std::uint64_t start = 0;                                 // random number of this process
  std::uint64_t segment = 0;                               // random number of the session's segment
  std::uint64_t configuration_hash = 0, terrain_hash = 0;  // 0: unknown
};

using databuffer::Role;

template <class Enum>
constexpr std::uint32_t bit_of(Enum value) {
  return 1U << static_cast<unsigned>(value);
}

// [ns] Silence after which a host is lost: five announcements. With a shorter time a loaded machine would lose hosts.
inline constexpr std::int64_t kLease_ns = 500'000'000;

// Roles all topics of which may be written, as writes(topic) says. Bit n: role n. A host has no other roles.
template <class Writes>
std::uint32_t writable_roles(const Writes& writes) {
  using enum dds::Topic;
  const auto bit = [&writes](Role role, auto... topics) { return (writes(topics) && ...) ? bit_of(role) : 0U; };
  return bit(Role::radar_model, model_status, model_ticks, sweeps) |
         bit(Role::state_machine, radar_state, outputs, applied_events, event_receipts) | bit(Role::traffic, traffic) |
         bit(Role::recorder, recorder_status) | bit(Role::tour, captions);
}

// Processes without a lock byte that `yars status` shows on all hosts. Bit n: that with the name kLockstepRoleNames[n].
constexpr std::uint32_t shown_processes() {
  using enum databuffer::LockstepRole;
  return bit_of(flight_model) | bit_of(input_monitor) | bit_of(radar_display);
}

class Hosts {
 public:
  // `session` receives notes. `link`: null only in tests that hand samples to receive().
  Hosts(databuffer::Session& session, dds::Link* link, Identity identity);

  // One pass: takes announcements, announces this host (10 Hz, and at once after a change), asks for clock offsets.
  void exchange(std::int64_t now_ns);
  // Answers probes and takes answers. Call as soon as possible after their arrival, because the delay is an error.
  void exchange_probes() {
    link_->take<yars_net_ProbeSample>(
        [this](const yars_net_ProbeSample& sample) { receive(sample, databuffer::monotonic_ns()); });
  }
  void set_claims(std::uint32_t held_roles, bool owns_clock, std::uint32_t epoch) {
    views_.front().held_roles = held_roles;
    views_.front().owns_clock = owns_clock;
    changed_ |= std::exchange(own_.held_roles, held_roles) != held_roles;
    changed_ |= (std::exchange(own_.owns_clock, owns_clock ? 1 : 0) != 0) != owns_clock;
    changed_ |= std::exchange(own_.epoch, epoch) != epoch;
  }
  // Those of shown_processes() that take part on this host.
  void set_processes(std::uint32_t processes) { own_.processes = processes; }
  // While two hosts hold one role, the number of hosts that this host heard before stays as it is.
  void set_conflict(bool in_conflict) { in_conflict_ = in_conflict; }
  // Events for the state machine of this host carry this number. 0: it runs elsewhere.
  void set_machine_term(std::uint64_t term) { changed_ |= std::exchange(own_.machine_term, term) != term; }
  std::uint64_t machine_term() const { return own_.machine_term; }

  void receive(const yars_net_HostSample& sample, bool alive, std::int64_t now_ns);
  void receive(const yars_net_ProbeSample& sample, std::int64_t now_ns) {
    if (sample.stage == 0 && sample.to == self().id && link_ != nullptr) {
      yars_net_ProbeSample answer = sample;
      answer.stage = 1;
      answer.received_ns = now_ns;
      answer.answered_ns = databuffer::monotonic_ns();
      link_->write(answer);
    } else if (sample.stage == 1 && sample.from == self().id) {
      if (Host* host = host_of(sample.to, false); host != nullptr)
        host->offset.add({sample.asked_ns, sample.received_ns, sample.answered_ns, now_ns});
    }
  }

  // This host, first, and every host that is heard and has the same layout.
  std::span<const HostView> views() const { return views_; }
  const HostView& self() const { return views_.front(); }
  const Identity& identity() const { return identity_; }
  std::int64_t age_ns(std::int64_t now_ns) const { return now_ns - began_ns_; }  // time since this gateway began
  // Among views(); nullptr: none.
  const HostView* find(std::uint64_t id) const {
    const auto found = std::ranges::find(views_, id, &HostView::id);
    return found == views_.end() ? nullptr : &*found;
  }
  bool hears(std::string_view name) const {
    return std::ranges::any_of(hosts_, [&](const Host& host) { return host.alive && host.view.name == name; });
  }
  // True for another host with the same layout, also one that is silent now.
  bool has_announced(std::uint64_t id) const {
    const Host* host = host_of(id);
    return host != nullptr && !host->view.name.empty() && !host->other_layout;
  }

  // Offset of a host's clock; nullopt: not measured yet. 0 for this host.
  std::optional<std::int64_t> offset_ns(std::uint64_t id) const {
    if (id == self().id) return 0;
    const Host* host = host_of(id);
    if (host == nullptr || host->offset.count() < kEnoughAnswers) return std::nullopt;
    return host->offset.best()->offset_ns;
  }
  // The last announcement of another host; all 0: unknown.
  const yars_net_HostSample& said_by(std::uint64_t id) const {
    static constexpr yars_net_HostSample kNothing{};
    const Host* host = host_of(id);
    return host == nullptr ? kNothing : host->said;
  }
  std::uint64_t start_of(std::uint64_t id) const { return said_by(id).start; }

  // Writes host, start and number into a sample of this host. Numbers count up by topic.
  template <class Sample>
  void stamp(Sample& sample) {
    sample.host = self().id;
    sample.start = identity_.start;
    sample.number = written_[dds::index_of(dds::kTopicOf<Sample>)]++;
  }
  // Numbers of the next samples that this host writes, by topic. Histories are numbered by their rings.
  void set_written(dds::Topic topic, std::uint64_t next) { written_[dds::index_of(topic)] = next; }
  std::span<const std::uint64_t> written() const { return written_; }

  // True if the sample has not arrived before. Also counts it for its host.
  template <class Sample>
  bool is_new(const Sample& sample) {
    return is_new(dds::kTopicOf<Sample>, sample.host, sample.start, sample.number);
  }
  bool is_new(dds::Topic topic, std::uint64_t id, std::uint64_t start, std::uint64_t number) {
    Host* host = host_of(id, true);
    return host != nullptr && host->numbers[dds::index_of(topic)].is_new(start, number, max_repeats(topic));
  }
  // Where a predecessor of this gateway stopped: as SampleNumbers::resume().
  void resume(dds::Topic topic, std::uint64_t id, std::uint64_t start, std::uint64_t next) {
    if (Host* host = host_of(id, true); host != nullptr) host->numbers[dds::index_of(topic)].resume(start, next);
  }
  // Numbers of the samples that have arrived from a host.
  const SampleNumbers& numbers(dds::Topic topic, std::uint64_t id) const {
    static const SampleNumbers kNone;
    const Host* host = host_of(id);
    return host == nullptr ? kNone : host->numbers[dds::index_of(topic)];
  }
  // Counts and notes an invalid sample of a host.
  template <class Sample>
  void refuse(const Sample& sample, const std::string& reason) {
    refuse(sample.host, dds::kTopicOf<Sample>, reason);
  }
  void refuse(std::uint64_t id, dds::Topic topic, const std::string& reason) {
    Host* host = host_of(id, false);
    if (host != nullptr) ++host->refused;
    session_->note(databuffer::NoteKind::refusal, (host == nullptr ? "unknown host" : "host " + host->view.name) +
                                                      ", " + std::string(settings_of(topic).name) + ": " + reason);
  }
  // Writes a line to the log, by log::info or another level, and to the flight recorder.
  void say(void (*log)(std::string_view), databuffer::NoteKind kind, const std::string& line) const {
    log(line);
    session_->note(kind, line);
  }

  void describe(databuffer::NetworkStatus& status, std::int64_t now_ns) const;

 private:
  static constexpr std::int64_t kProbeInterval_ns = 250'000'000;
  static constexpr std::int64_t kFirstProbeInterval_ns = 25'000'000;  // of the first kFirstProbes: to join quickly
  static constexpr std::size_t kFirstProbes = 12;
  static constexpr std::int64_t kGroupDelay_ns = 1'000'000'000;
  // Of a few answers one was on the way without a queue. A first offset by one answer was wrong by 50 ms on a bad line.
  static constexpr std::size_t kEnoughAnswers = 6;
  struct Host {
    HostView view;
    yars_net_HostSample said{};
    bool alive = false;
    bool left = false;  // its gateway has ended in order
    bool other_layout = false;
    std::uint32_t differences = 0;  // HostFlags that have been reported
    std::int64_t began_ns = 0, heard_ns = 0, next_probe_ns = 0;
    OffsetEstimator offset;
    std::array<SampleNumbers, dds::kTopicCount> numbers;
    std::uint64_t refused = 0;
    SharedName name;
  };
  // Number of samples that DDS may deliver again when two hosts meet: the stored history of all instances of a host.
  // Half of the instances of a topic are room for others.
  static std::uint64_t max_repeats(dds::Topic topic) {
    constexpr std::uint64_t kMin = 64;
    const dds::TopicSettings& settings = settings_of(topic);
    return std::max(settings.instances / 2 * static_cast<std::uint64_t>(settings.depth), kMin);
  }
  Host* host_of(std::uint64_t id, bool add) {
    if (const Host* known = std::as_const(*this).host_of(id)) return const_cast<Host*>(known);
    if (!add || id == self().id) return nullptr;
    Host host;
    host.view.id = id;
    if (hosts_.size() + 1 < databuffer::kMaxHosts) return &hosts_.emplace_back(std::move(host));
    // A host that has left makes room, one that never announced itself first.
    const auto oldest =
        std::ranges::min_element(hosts_, {}, [](const Host& other) { return std::pair(other.alive, other.heard_ns); });
    if (oldest->alive) {
      log::warning("expected at most " + std::to_string(databuffer::kMaxHosts) + " hosts, found another");
      return nullptr;
    }
    *oldest = std::move(host);
    return &*oldest;
  }
  const Host* host_of(std::uint64_t id) const {
    const auto found = std::ranges::find(hosts_, id, [](const Host& host) { return host.view.id; });
    return found == hosts_.end() ? nullptr : &*found;
  }
  void lose(Host& host) {
    host.alive = false;
    if (host.left) host.differences = 0;
    say(host.left ? log::info : log::warning, host.left ? databuffer::NoteKind::restart : databuffer::NoteKind::loss,
        "host " + host.view.name + (host.left ? " has left" : " is no longer heard"));
    update_views();
  }
  // A host that is heard for the first time, again after silence, or with a new gateway.
  void begin(Host& host, const yars_net_HostSample& sample, std::int64_t now_ns) {
    const bool was_alive = std::exchange(host.alive, true);
    host.left = false;
    host.view.name = text::text_of(sample.name);
    host.offset = {};
    host.differences = 0;
    host.began_ns = host.next_probe_ns = now_ns;
    readmit(host, sample.start);
    if (was_alive && host.name.is_shared(now_ns)) return;  // each of those with the name would be said again and again
    say(log::info, databuffer::NoteKind::restart, "hears host " + host.view.name);
  }
  // A process that another one with its name seemed to have replaced is the one that goes on.
  static void readmit(Host& host, std::uint64_t start) {
    for (SampleNumbers& numbers : host.numbers) numbers.readmit(start);
  }
  void report_differences(Host& host, std::int64_t now_ns);
  // Says a difference once while it lasts.
  void report(Host& host, std::uint32_t flag, bool differs, const std::string& line) {
    const bool was_said = (host.differences & flag) != 0;
    host.differences = differs ? host.differences | flag : host.differences & ~flag;
    if (differs && !was_said) say(log::warning, databuffer::NoteKind::refusal, line);
  }
  // Another process announces itself with the name of this host.
  void hear_own_name(std::uint64_t start, std::int64_t now_ns) {
    if (start == identity_.start) return;
    own_name_.hear(identity_.start, now_ns);
    own_name_.hear(start, now_ns);
    if (own_name_.is_news(now_ns))
      say(log::error, databuffer::NoteKind::refusal,
          "another host is also called " + identity_.name + "; give each host a `name` of its own");
  }
  void announce(std::int64_t now_ns) {
    if (!announcements_.is_due(std::exchange(changed_, false), now_ns)) return;
    stamp(own_);
    own_.monotonic_ns = now_ns;
    own_.group = self().group;
    if (link_ != nullptr) link_->write(own_);
  }
  void ask(std::int64_t now_ns) {
    for (Host& host : hosts_) {
      if (!host.alive || now_ns < host.next_probe_ns) continue;
      host.next_probe_ns = now_ns + (host.offset.count() < kFirstProbes ? kFirstProbeInterval_ns : kProbeInterval_ns);
      yars_net_ProbeSample question{};
      question.from = self().id;
      question.to = host.view.id;
      question.asked_ns = databuffer::monotonic_ns();
      if (link_ != nullptr) link_->write(question);
    }
  }
  void update_views() {
    views_.resize(1);
    for (const Host& host : hosts_)
      if (host.alive && !host.other_layout) views_.push_back(host.view);
  }
  // Number of hosts that were heard kGroupDelay_ns ago, so that two hosts that meet again say how many each had with
  // it. A process that was stopped for longer than the lease was alone.
  void update_group(std::int64_t now_ns) {
    if (now_ns - std::exchange(last_pass_ns_, now_ns) > kLease_ns) group_sizes_ = {{now_ns - kGroupDelay_ns, 1}};
    const auto heard = static_cast<std::uint32_t>(views_.size());
    if (group_sizes_.empty() || group_sizes_.back().second != heard) group_sizes_.emplace_back(now_ns, heard);
    while (group_sizes_.size() > 1 && group_sizes_[1].first <= now_ns - kGroupDelay_ns) group_sizes_.pop_front();
    if (in_conflict_) return;
    const bool is_old = group_sizes_.front().first <= now_ns - kGroupDelay_ns;
    views_.front().group = is_old ? group_sizes_.front().second : 1;
  }

  databuffer::Session* session_;
  dds::Link* link_;
  Identity identity_;
  std::deque<Host> hosts_;  // without this one
  std::vector<HostView> views_;
  std::array<std::uint64_t, dds::kTopicCount> written_{};
  yars_net_HostSample own_{};  // the announcement of this host
  SharedName own_name_;
  bool changed_ = true;
  bool in_conflict_ = false;
  Pace announcements_{kLease_ns / 5};  // four may be lost
  std::int64_t began_ns_ = databuffer::monotonic_ns(), last_pass_ns_ = 0;
  std::int64_t paused_until_ns_ = 0;  // ends of hosts that DDS reports until then follow from a pause of this process
  std::deque<std::pair<std::int64_t, std::uint32_t>> group_sizes_;  // time of each change, number of hosts from then on
};

}  // namespace yars::gateway
