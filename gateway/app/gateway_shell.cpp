#include "gateway/app/gateway_shell.hpp"

#include <algorithm>
#include <cstring>
#include <ctime>
#include <utility>

#include "gateway/exchange/role_topics.hpp"
#include "lib/log/log.hpp"

namespace yars::gateway {

using databuffer::Role;

namespace {

constexpr std::int64_t kPass_ns = 5'000'000;        // a tick at rate 1
constexpr std::int64_t kLockstepPass_ns = 250'000;  // the roles of a lockstep run wait for each pass
constexpr std::int64_t kReportInterval_ns = 500'000'000;
constexpr std::int64_t kMaxEnd_ns = 1'000'000'000;
constexpr std::int64_t kLockstepEnd_ns = 20'000'000;  // until the other hosts have taken what they have acknowledged
constexpr std::int64_t kSilence_ns = 10'000'000'000;  // hosts that can hear each other do so within 0.3 s

// Processor time of this process, with the threads of Cyclone DDS.
double process_time_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string list_of(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
  return list;
}

}  // namespace

GatewayShell::GatewayShell(databuffer::Session& session, const std::string& session_name, dds::Link link,
                           const radar::NetworkSettings& settings, Identity identity)
    : link_(std::move(link)),
      session_(&session),
      hosts_(session, &link_, std::move(identity)),
      roles_(session, session_name),
      context_{session, &link_, hosts_, roles_},
      maps_(settings.map_rows_per_s),
      domain_(settings.domain),
      participants_(settings.participants),
      secured_(!settings.security.empty()) {
  if (!link_.writes(dds::Topic::clock))
    log::info("this host does not set the session clock: it may not write the topic clock");
  for (const Role role : {Role::radar_model, Role::state_machine}) {
    const auto found = std::ranges::find(kRoleTopics, role, &RoleTopics::role);
    if (!std::ranges::all_of(found->topics, [this](dds::Topic topic) { return link_.writes(topic); })) roles_.bar(role);
  }
}

void GatewayShell::step() {
  link_.wait(next_pass_ns_ - databuffer::monotonic_ns());
  hosts_.exchange_probes();
  context_.now_ns = databuffer::monotonic_ns();
  events_.receive_inputs(context_);
  if (context_.now_ns < next_pass_ns_) return;
  pass();
  const std::int64_t interval_ns = context_.lockstep ? kLockstepPass_ns : kPass_ns;
  next_pass_ns_ = std::max(next_pass_ns_ + interval_ns, context_.now_ns);
}

void GatewayShell::finish() {
  const std::int64_t begin_ns = databuffer::monotonic_ns();
  std::int64_t unacknowledged_ns = begin_ns;  // the last time at which something was on its way
  while (hosts_.views().size() > 1 && context_.now_ns - begin_ns < kMaxEnd_ns) {
    step();
    if (!link_.is_acknowledged()) unacknowledged_ns = context_.now_ns;
    if (context_.now_ns - unacknowledged_ns > (context_.lockstep ? kLockstepEnd_ns : 0)) return;
  }
}

void GatewayShell::pass() {
  session_->heartbeat();
  context_.lockstep = std::as_const(*session_).layout().lockstep.enabled.load(std::memory_order_acquire) != 0;
  hosts_.set_claims(roles_.held_roles(), clock_.owns(), session_->clock().epoch);
  hosts_.set_conflict(roles_.in_conflict());
  hosts_.exchange(context_.now_ns);
  roles_.update(hosts_, context_.now_ns);
  roles_.heartbeat();
  clock_.exchange(context_);
  context_.joined = clock_.joined();
  lockstep_.begin_pass(context_);
  receive();
  send();
  const bool has_joined = context_.joined && !std::exchange(reported_joined_, true);
  if (has_joined) report_joined();
  if (has_joined || context_.now_ns >= next_report_ns_) report();
}

void GatewayShell::receive() {
  states_.receive(context_);
  states_.keep_lane(context_);
  events_.receive(context_);
  world_.receive(context_);
  world_.publish(context_);
  history_.receive(context_);
  history_.publish(context_);
  maps_.receive(context_);
  maps_.publish(context_);
  if (!context_.lockstep) return;
  lockstep_.receive(context_);
  lockstep_.apply(context_, history_.is_empty());
}

void GatewayShell::send() {
  states_.send(context_);
  events_.send(context_);
  world_.send(context_);
  history_.send(context_);
  maps_.send(context_);
  if (context_.lockstep) lockstep_.send(context_);
}

// Finds the processes of this host that hold no role with a lock byte, so that `yars status` shows them on all hosts.
void GatewayShell::look_at_processes() {
  std::uint32_t processes = 0;
  for (const databuffer::ProcessInfo& process : session_->processes())
    if (const auto index = databuffer::counted_role(process.name)) processes |= 1U << *index;
  hosts_.set_processes(processes & shown_processes());
}

void GatewayShell::report_joined() const {
  if (hosts_.views().size() > 1) return log::info("joined the session clock");
  if (asked_.empty()) return log::info("joined the session clock, alone: the form Network names no other computer");
  log::info("joined the session clock, alone: asked " + list_of(asked_) +
            ": none has answered yet; this computer goes on alone and joins them when they come");
}

void GatewayShell::report_messages() {
  for (const std::string& message : link_.take_messages(context_.now_ns)) log::warning("Cyclone DDS: " + message);
  for (const dds::Remark& remark : link_.take_remarks(context_.now_ns)) {
    if (!remark.is_fault) {
      log::info(remark.text);
      continue;
    }
    reported_silence_ = true;
    log::warning(remark.text);
    session_->note(databuffer::NoteKind::loss, remark.note);
  }
  lost_handshake_ = link_.take_lost_handshake(context_.now_ns);
  report_silence();
}

// Says once that no host has been heard since the start, and what to look at.
void GatewayShell::report_silence() {
  if (first_pass_ns_ == 0) first_pass_ns_ = context_.now_ns;
  if (reported_silence_ || asked_.empty() || context_.now_ns - first_pass_ns_ < kSilence_ns) return;
  reported_silence_ = true;
  if (link_.counts(dds::Topic::hosts).received > 0) return;
  const int first_port = 7400 + 250 * domain_ + 10;
  log::warning("no other host has been heard in 10 s, asked " + list_of(asked_) +
               "; the usual reasons: no gateway runs there, it has another session or domain, `security` is on one "
               "side only, or a firewall closes UDP ports " +
               std::to_string(first_port) + " to " + std::to_string(first_port + 2 * participants_ - 1));
}

void GatewayShell::report() {
  next_report_ns_ = context_.now_ns + kReportInterval_ns;
  look_at_processes();
  report_messages();
  const double cpu_s = process_time_s();
  const double elapsed_s = 1e-9 * static_cast<double>(context_.now_ns - last_report_ns_);
  if (last_report_ns_ != 0 && elapsed_s > 0.1) load_ = (cpu_s - last_cpu_s_) / elapsed_s;
  last_cpu_s_ = cpu_s;
  last_report_ns_ = context_.now_ns;
  databuffer::NetworkStatus status{};
  status.monotonic_ns = context_.now_ns;
  status.joined = context_.joined ? 1 : 0;
  status.domain = static_cast<std::uint32_t>(domain_);
  status.secured = secured_ ? 1 : 0;
  status.takeovers = roles_.takeovers();
  status.conflicts = roles_.conflicts();
  status.load = load_;
  hosts_.describe(status, context_.now_ns);
  status.topic_count = dds::kTopicCount;
  for (std::size_t i = 0; i < dds::kTopicCount; ++i) {
    const auto topic = static_cast<dds::Topic>(i);
    const dds::TopicCounts& counts = link_.counts(topic);
    auto& to = status.topics[i];
    dds::settings_of(topic).name.copy(to.name, sizeof to.name - 1);
    to.sent = counts.sent;
    to.sent_bytes = counts.sent_bytes;
    to.received = counts.received;
    to.received_bytes = counts.received_bytes;
  }
  session_->layout().network_status.publish(status);
}

}  // namespace yars::gateway
