#include "databuffer/session/session.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "databuffer/messages/validation.hpp"
#include "lib/error/error.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

namespace {

using error::Expected;
using error::fail;

void initialize(void* memory) {
  auto& layout = *static_cast<SessionLayout*>(memory);
  layout.lockstep.end_tick = -1;
  for (auto& done : layout.lockstep.done_tick) done = -1;
  layout.clock.publish(first_clock());
}

tl::unexpected<error::Error> fail_read_only(std::string_view subject) {
  return fail(std::string(subject), "a session opened for writing", "one opened read-only", "open it for writing");
}

}  // namespace

std::optional<std::size_t> counted_role(std::string_view name) {
  if (name == name_of(Role::gateway)) return kLockstepRoles;
  const auto found = std::ranges::find(kLockstepRoleNames, name);
  if (found == kLockstepRoleNames.end()) return std::nullopt;
  return static_cast<std::size_t>(found - kLockstepRoleNames.begin());
}

Session::Session(std::unique_ptr<SessionState> state) : state_(std::move(state)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

Expected<Session> Session::open(const std::string& name, std::string_view process_name) {
  if (const auto valid = check_session_name(name); !valid) return tl::unexpected(valid.error());
  auto segment = shm::Segment::open(name, kLayoutIdentity, initialize);
  if (!segment) return tl::unexpected(segment.error());
  auto state = std::make_unique<SessionState>(std::move(*segment), process_name);
  const bool has_clock = state->await_clock();
  state->enter_table();
  Session session(std::move(state));
  if (!has_clock) session.restore_clock(WaitPolicy::some);
  return session;
}

Expected<Session> Session::open_read_only(const std::string& name) {
  if (const auto valid = check_session_name(name); !valid) return tl::unexpected(valid.error());
  auto segment = shm::Segment::open_read_only(name, kLayoutIdentity);
  if (!segment) return tl::unexpected(segment.error());
  auto state = std::make_unique<SessionState>(std::move(*segment), "reader");
  if (!state->await_clock()) state->last_valid_clock.running = 0;
  return Session(std::move(state));
}

SessionLayout& Session::layout() {
  return state_->write();
}
const SessionLayout& Session::layout() const {
  return std::as_const(*state_).read();
}
bool Session::has_name() const {
  return state_->segment->has_name();
}

Expected<Claim> Session::claim(Role role) {
  if (!state_->segment->writable()) return fail_read_only(name_of(role));
  const std::int32_t previous = state_->segment->holder_pid(static_cast<std::size_t>(role));
  auto claim = state_->claim(role);
  // A holder that releases its claim resets the pid to 0. Any other value means that the previous holder died.
  if (claim && previous != 0)
    note(NoteKind::restart, std::string(name_of(role)) + " pid " + std::to_string(previous) + " died; taken over");
  return claim;
}

Expected<Claim> Session::claim_ownship_lane(std::uint32_t priority) {
  if (!state_->segment->writable()) return fail_read_only("ownship lane");
  return state_->claim_ownship_lane(priority);
}

Expected<Claim> Session::claim_input_lane(std::string_view source) {
  if (!state_->segment->writable()) return fail_read_only("input lane");
  return state_->claim_input_lane(source);
}

bool Session::role_is_held(Role role) const {
  return state_->is_held(role);
}

std::int32_t Session::role_holder(Role role) const {
  return state_->holder_of(role);
}
bool Session::must_yield(Role role) const {
  const std::uint32_t yielding = layout().network.yielding_roles.load(std::memory_order_acquire);
  return (yielding >> static_cast<unsigned>(role) & 1U) != 0 && role_is_held(Role::gateway);
}
bool Session::is_mirrored(Role role) const {
  return (layout().network.mirrored_roles.load(std::memory_order_acquire) >> static_cast<unsigned>(role) & 1U) != 0;
}
bool Session::ownship_lane_is_held(std::size_t lane) const {
  YARS_REQUIRE(lane, <, kOwnshipLanes);
  return state_->segment->is_locked(kFirstOwnshipByte + lane);
}
bool Session::input_lane_is_held(std::size_t lane) const {
  YARS_REQUIRE(lane, <, kInputLanes);
  return state_->segment->is_locked(kFirstInputByte + lane);
}

std::vector<ProcessInfo> Session::processes() const {
  std::vector<ProcessInfo> alive;
  for (std::size_t i = 0; i < kProcesses; ++i) {
    const ProcessEntry& entry = layout().processes[i];
    if (entry.pid == 0 || !state_->segment->is_locked(kFirstProcessByte + i)) continue;
    // A damaged heartbeat in the future is shown as now, so that its age is not negative.
    const std::int64_t beat_ns = std::clamp<std::int64_t>(entry.heartbeat_ns, 0, monotonic_ns());
    alive.push_back({entry.pid, shm::load_text(entry.name.data(), entry.name.size()), beat_ns, entry.progress});
  }
  return alive;
}

void Session::heartbeat() {
  if (state_->table_byte == 0) return;
  const std::int64_t now_ns = monotonic_ns();
  state_->beat(now_ns);
  if (now_ns < state_->next_upkeep_ns) return;
  state_->next_upkeep_ns = now_ns + kUpkeepInterval_ns;
  state_->restore_entry();
  state_->check_name();
  state_->report_folded_notes(now_ns, false);
  log::report_suppressed(log::SuppressedKinds::ended);
}

void Session::publish_progress(std::uint32_t progress) {
  if (state_->table_byte == 0) return;
  state_->write().processes[state_->table_byte - kFirstProcessByte].progress.store(progress, std::memory_order_release);
}

ClockState Session::clock() const {
  return state_->clock_now();
}
std::int64_t Session::sim_time_ns() const {
  return sim_time_at(clock(), monotonic_ns());
}

std::int64_t Session::reached_sim_time_ns() const {
  const Lockstep& lockstep = layout().lockstep;
  const std::uint32_t roles = lockstep.roles.load(std::memory_order_relaxed);
  if (lockstep.enabled.load(std::memory_order_acquire) == 0) return sim_time_ns();
  std::int64_t tick = kLatestModelTick;
  for (std::size_t role = 0; role < kLockstepRoles; ++role)
    if ((roles >> role & 1U) != 0U) tick = std::min(tick, lockstep.done_tick[role].load(std::memory_order_acquire));
  return std::max<std::int64_t>(tick, 0) * radar::kTickNanoseconds;
}

Expected<void> Session::change_clock(const std::function<ClockState(const ClockState&)>& change, WaitPolicy policy) {
  constexpr auto kByte = static_cast<std::size_t>(Role::clock);
  if (!state_->segment->writable()) return fail_read_only("clock");
  const int attempts = policy == WaitPolicy::none ? 1 : kClockAttempts;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    if (const auto claim = state_->take(kByte, -1)) {
      const ClockState next = change(state_->clock_now());
      if (auto refusal = state_->inspect_clock(next))
        return fail("session clock", "a change that leaves the clock in range", std::move(*refusal),
                    "set another time, as with `yars sim reset 0`");
      layout().clock.publish(next);
      return {};
    }
    if (attempt + 1 < attempts) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return fail("clock", "to change it within " + std::to_string(attempts) + " ms",
              "held by " + state_->describe_holder(kByte), "let that process continue, or end it");
}

bool Session::has_foreign_clock() const {
  return state_->has_foreign_clock();
}

std::optional<std::string> Session::clock_problem() const {
  return state_->clock_problem();
}

void Session::restore_clock(WaitPolicy policy) {
  const auto problem = state_->clock_problem();
  if (!problem) return;
  if (change_clock([](const ClockState& good) { return good; }, policy))
    note(NoteKind::refusal, "clock restored: " + *problem);
}

void Session::note(NoteKind kind, std::string_view text) {
  note(kind, text, state_->process_name);
}
void Session::note(NoteKind kind, std::string_view text, std::string_view process) {
  state_->note(kind, text::printable(text), process);
}

void Session::count_restart(std::string_view role) {
  if (const auto index = counted_role(role); index && state_->segment->writable())
    layout().counters.restarts[*index].add(monotonic_ns());
}

}  // namespace yars::databuffer
