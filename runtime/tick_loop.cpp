#include "runtime/tick_loop.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <ctime>
#include <string>

#include "databuffer/session/receivers.hpp"
#include "lib/error/error.hpp"
#include "lib/text/plain_text.hpp"
#include "runtime/process.hpp"

namespace yars::runtime {

namespace {

// [ns] Maximum delay until a change of the clock is seen. At the maximum clock rate of 10 the delay is 10 ticks, below
// kMaxTicksBehind, so that no tick is skipped.
constexpr std::int64_t kMaxSleep_ns = 5'000'000;
constexpr std::int64_t kMaxTick = std::int64_t{1} << 40;  // [ticks] 174 years of sim time; its nanoseconds fit 63 bits
constexpr double kMaxAhead_ns = 1e15;  // [ns] limit of the time to the next tick, against integer overflow
constexpr std::int64_t kPartnerTimeout_ns = 60'000'000'000;  // [ns] maximum time for which another role may be awaited
constexpr std::int64_t kStopCheckInterval_ns = 100'000'000;  // [ns] interval of checks of the stop flag while waiting

void sleep_until(std::int64_t deadline_ns) {
  const timespec deadline{static_cast<time_t>(deadline_ns / 1'000'000'000),
                          static_cast<long>(deadline_ns % 1'000'000'000)};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr);
}

// Sleeps while `word` equals `seen`, for `timeout_ns` at most. A futex is a word in memory on which Linux lets threads
// wait. This wait works between processes; std::atomic::wait works only within one process.
void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t seen, std::int64_t timeout_ns) {
  const timespec timeout{static_cast<time_t>(timeout_ns / 1'000'000'000),
                         static_cast<long>(timeout_ns % 1'000'000'000)};
  syscall(SYS_futex, &word, FUTEX_WAIT, seen, &timeout, nullptr, 0);
}

void futex_wake_all(std::atomic<std::uint32_t>& word) {
  syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

struct LockstepPlan {
  std::uint32_t roles = 0;
  std::int64_t end_tick = -1;
};

error::Expected<LockstepPlan> parse_plan(const std::string& text) {
  const auto bad = [&text] {
    return tl::unexpected(error::usage_error("--lockstep",
                                             "ROLE,ROLE,...[@END_TICK] of flight-model, input-monitor, "
                                             "state-machine, radar-model, radar-display, recorder",
                                             "'" + text + "'"));
  };
  LockstepPlan plan;
  std::string_view rest = text;
  if (const auto at = rest.find('@'); at != std::string_view::npos) {
    const auto number = text::whole_number<std::int64_t>(rest.substr(at + 1));
    if (!number || *number < 0) return bad();
    plan.end_tick = *number;
    rest = rest.substr(0, at);
  }
  while (!rest.empty()) {
    const auto comma = std::min(rest.find(','), rest.size());
    const auto found =
        std::find(databuffer::kLockstepRoleNames.begin(), databuffer::kLockstepRoleNames.end(), rest.substr(0, comma));
    if (found == databuffer::kLockstepRoleNames.end()) return bad();
    plan.roles |= 1U << (found - databuffer::kLockstepRoleNames.begin());
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return plan;
}

}  // namespace

error::Expected<TickLoop> TickLoop::create(databuffer::Session& session, databuffer::LockstepRole role,
                                           const std::string& lockstep) {
  TickLoop loop(session, role);
  auto& shared = session.layout().lockstep;
  if (lockstep.empty()) {
    if (shared.enabled.load(std::memory_order_acquire) != 0)
      return error::fail("session", "a role with --lockstep, as the session runs in lockstep", "a live role",
                         "start the role with the --lockstep of the other roles, or use another session");
    return loop;
  }
  auto plan = parse_plan(lockstep);
  if (!plan) return tl::unexpected(plan.error());
  if ((plan->roles & (1U << loop.role_)) == 0U)
    return tl::unexpected(error::usage_error(
        "--lockstep", "a list with this role, " + std::string(databuffer::kLockstepRoleNames[loop.role_]), lockstep));
  if (shared.enabled.load(std::memory_order_acquire) != 0 &&
      (shared.roles.load(std::memory_order_relaxed) != plan->roles ||
       shared.end_tick.load(std::memory_order_relaxed) != plan->end_tick))
    return error::fail("--lockstep", "the plan of the session", "another plan, " + lockstep,
                       "give every role the same --lockstep, or use another session");
  // All roles of a lockstep run store the same plan. The order of their stores therefore does not matter.
  shared.roles.store(plan->roles, std::memory_order_relaxed);
  shared.end_tick.store(plan->end_tick, std::memory_order_relaxed);
  shared.enabled.store(1, std::memory_order_release);
  loop.lockstep_ = true;
  // The predecessor is the nearest participating role before this one in the cyclic order of the roles.
  std::size_t before = loop.role_;
  do {
    before = (before + databuffer::kLockstepRoles - 1) % databuffer::kLockstepRoles;
  } while ((plan->roles & (1U << before)) == 0U);
  loop.predecessor_ = before;
  loop.first_in_chain_ = before >= loop.role_;
  const std::int64_t done = shared.done_tick[loop.role_].load(std::memory_order_acquire);
  if (done < -1 || done > kMaxTick)
    return error::fail("--lockstep", "a last tick of -1 to " + std::to_string(kMaxTick), std::to_string(done),
                       "the session is damaged: end its programs and start it again");
  loop.next_tick_ = done + 1;
  return loop;
}

std::optional<TickLoop::Due> TickLoop::wait() {
  session_->heartbeat();
  return lockstep_ ? wait_lockstep() : wait_live();
}

TickLoop::Due TickLoop::due_at(const databuffer::ClockState& clock, std::int64_t newest) {
  Due due;
  due.clock = clock;
  due.new_epoch = started_ && clock.epoch != epoch_;
  if (!started_ || due.new_epoch) next_tick_ = newest;
  started_ = true;
  epoch_ = clock.epoch;
  if (newest - next_tick_ >= kMaxTicksBehind) {
    due.skipped = static_cast<std::uint64_t>(newest - next_tick_ - kMaxTicksBehind + 1);
    late_ticks_ += due.skipped;
    session_->layout().skipped_ticks[role_].add(due.skipped, databuffer::monotonic_ns());
    next_tick_ = newest - kMaxTicksBehind + 1;
  }
  due.tick = next_tick_++;
  due.sim_time_ns = due.tick * radar::kTickNanoseconds;
  return due;
}

std::optional<TickLoop::Due> TickLoop::wait_live() {
  while (!stop_requested()) {
    const databuffer::ClockState clock = session_->clock();
    const std::int64_t now_ns = databuffer::monotonic_ns();
    const std::int64_t newest = databuffer::sim_time_at(clock, now_ns) / radar::kTickNanoseconds;
    if (!started_ || clock.epoch != epoch_ || newest >= next_tick_) return due_at(clock, newest);
    std::int64_t wake_ns = now_ns + kMaxSleep_ns;
    if (clock.running != 0 && clock.rate > 0.0) {
      const double ahead_ns =
          static_cast<double>(next_tick_ * radar::kTickNanoseconds - clock.base_sim_ns) / clock.rate;
      wake_ns =
          std::min(wake_ns, clock.base_monotonic_ns + static_cast<std::int64_t>(std::min(ahead_ns, kMaxAhead_ns)) + 1);
    }
    sleep_until(std::max(wake_ns, now_ns + 1));
    session_->heartbeat();
  }
  return std::nullopt;
}

bool TickLoop::wait_for(std::size_t role, std::int64_t tick) {
  auto& shared = session_->layout().lockstep;
  auto& word = shared.wake[role];
  const std::int64_t deadline_ns = databuffer::monotonic_ns() + kPartnerTimeout_ns;
  awaited_role_ = role;
  awaited_tick_ = tick;
  while (!stop_requested()) {
    const std::uint32_t seen = word.load(std::memory_order_acquire);
    if (shared.done_tick[role].load(std::memory_order_acquire) >= tick) return true;
    if (finds_lost_role() || databuffer::monotonic_ns() > deadline_ns) {
      failed_ = true;
      return false;
    }
    futex_wait(word, seen, kStopCheckInterval_ns);
    session_->heartbeat();
  }
  return false;
}

bool TickLoop::finds_lost_role() {
  const databuffer::SessionLayout& layout = session_->layout();
  const std::uint32_t lost = layout.network.lost_role.load(std::memory_order_acquire);
  const std::size_t role = (lost & 0xFFU) - 1;
  if ((lost & 0xFFU) == 0 || role >= databuffer::kLockstepRoles) return false;
  const auto& shared = layout.lockstep;
  const std::int64_t done = shared.done_tick[role].load(std::memory_order_acquire);
  const std::int64_t end_tick = shared.end_tick.load(std::memory_order_relaxed);
  if ((shared.roles.load(std::memory_order_relaxed) >> role & 1U) == 0U || (end_tick >= 0 && done >= end_tick))
    return false;
  awaited_role_ = role;
  awaited_tick_ = done + 1;
  lost_host_ = "another host";
  const std::size_t host = lost >> 8 & 0xFFU;
  if (const auto status = databuffer::read_valid(layout.network_status);
      status && host > 0 && host < status->host_count)
    lost_host_ = "host " + std::string(text::text_of(status->hosts[host].name));
  return true;
}

// Waits until all roles have done the last tick. Without this wait, a role that ends first would clear records that
// other roles still read.
void TickLoop::wait_for_all(std::int64_t tick) {
  const std::uint32_t roles = session_->layout().lockstep.roles.load(std::memory_order_relaxed);
  for (std::size_t role = 0; role < databuffer::kLockstepRoles; ++role)
    if ((roles >> role & 1U) != 0U && !wait_for(role, tick)) return;
}

std::optional<TickLoop::Due> TickLoop::wait_lockstep() {
  const std::int64_t end_tick = session_->layout().lockstep.end_tick.load(std::memory_order_relaxed);
  if (end_tick >= 0 && next_tick_ > end_tick) {
    wait_for_all(end_tick);
    return std::nullopt;
  }
  if (!wait_for(predecessor_, first_in_chain_ ? next_tick_ - 1 : next_tick_)) return std::nullopt;
  Due due;
  due.clock = session_->clock();
  due.new_epoch = started_ && due.clock.epoch != epoch_;
  started_ = true;
  epoch_ = due.clock.epoch;
  due.tick = next_tick_++;
  due.sim_time_ns = due.tick * radar::kTickNanoseconds;
  return due;
}

error::Expected<void> TickLoop::outcome() const {
  if (!failed_) return {};
  const std::string role(databuffer::kLockstepRoleNames[awaited_role_]);
  const std::string tick = " to do tick " + std::to_string(awaited_tick_);
  if (!lost_host_.empty())
    return error::fail("lockstep", role + " of " + lost_host_ + tick, "that host gone for 10 s",
                       "start all roles again, on every host and with the same end");
  return error::fail("lockstep", role + tick, "60 s of silence",
                     "start that role with the same --lockstep, or end all roles");
}

void TickLoop::done(const Due& due) {
  if (lockstep_) complete_tick(session_->layout().lockstep, role_, due.tick);
}

void complete_tick(databuffer::Lockstep& lockstep, std::size_t role, std::int64_t tick) {
  lockstep.done_tick[role].store(tick, std::memory_order_release);
  lockstep.wake[role].fetch_add(1, std::memory_order_release);
  futex_wake_all(lockstep.wake[role]);
}

}  // namespace yars::runtime
