#include "databuffer/session_state.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include "databuffer/log.hpp"
#include "databuffer/records/validation.hpp"

namespace yars::databuffer {

namespace {

using failure::Expected;
using failure::fail;

constexpr std::int64_t kNameLook_ns =
    500'000'000;  // [ns] between looks at the segment's name: a role says it within 1 s
// [ns] 14 years: a base beyond it is no time that a session has come to, and sums with it at rate 10 would not fit.
constexpr std::int64_t kLatestBase_ns = std::int64_t{1} << 59;

// The system's name of a process; for one that is not in the table.
std::string program_of(std::int32_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/comm");
  std::string name;
  std::getline(file, name);
  return name.empty() ? "unknown program" : name;
}

// The clock as every process of the session may take it for granted; `found` says why not.
Expected<void> check_clock(const ClockState& clock) {
  Refusal refusal = why_refused(clock);
  if (!refusal && std::max(clock.base_sim_ns, clock.base_monotonic_ns) > kLatestBase_ns)
    refusal = "base_sim_ns, base_monotonic_ns: expected at most 2^59, found more";
  if (!refusal) return {};
  return fail("session clock", "one in range", *refusal, "set it with `yars sim reset 0`, or start the set again");
}

template <std::size_t N>
void copy_text(char (&into)[N], std::string_view text) {
  into[text.copy(into, N - 1)] = '\0';
}

}  // namespace

// Published before the segment had a name, and changed seldom: as a rule the first look finds it.
Expected<void> Session::State::find_clock() {
  for (int attempt = 0; attempt < kClockAttempts && !clock.refresh(); ++attempt)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (!clock.has_value())
    return fail("session clock", "one that can be read", "none", "end the programs of this session and start it again");
  if (auto good = check_clock(clock.value()); !good) return good;
  good_clock = clock.value();
  return {};
}

// A full table is no failure: it is for people, presence is decided by locks.
void Session::State::enter_table() {
  for (std::size_t i = 0; i < kProcesses; ++i) {
    if (!segment->try_lock(kFirstProcessByte + i)) continue;
    table_byte = kFirstProcessByte + i;
    ProcessEntry& entry = write().processes[i];
    shm::store_text(entry.name.data(), entry.name.size(), process_name);
    entry.heartbeat_ns = monotonic_ns();
    entry.progress = 0;
    entry.pid.store(getpid(), std::memory_order_release);
    return;
  }
}

void Session::State::leave_table() {
  if (table_byte == 0) return;
  write().processes[table_byte - kFirstProcessByte].pid = 0;
  segment->unlock(table_byte);
}

// "state-machine, pid 1234": by the table, else by the system.
std::string Session::State::describe_holder(std::size_t byte) const {
  const std::int32_t pid = segment->holder_pid(byte);
  if (pid == 0) return "a process that is just starting or ending";
  std::string program = program_of(pid);
  for (const ProcessEntry& entry : read().processes)
    if (entry.pid == pid) program = shm::load_text(entry.name.data(), entry.name.size());
  return program + ", pid " + std::to_string(pid);
}

std::optional<Claim> Session::State::take(std::size_t byte, int lane) {
  if (!segment->try_lock(byte)) return std::nullopt;
  Claim claim;
  claim.hold_ = std::make_unique<Claim::Hold>(segment, byte);
  claim.lane_ = lane;
  return claim;
}

// One out of range is refused, noted once, and the last good one goes on.
ClockState Session::State::clock_now() {
  std::unique_lock guard(clock_mutex);
  if (!clock.refresh()) return good_clock;
  const auto good = check_clock(clock.value());
  if (good) good_clock = clock.value();
  const ClockState now = good_clock;
  guard.unlock();
  if (!good) note(NoteKind::refusal, "clock: " + good.error().found, process_name);
  return now;
}

void Session::State::note(NoteKind kind, std::string_view text, std::string_view process) {
  if (!segment->writable()) return;
  Note line{};
  line.monotonic_ns = monotonic_ns();
  line.sim_time_ns = sim_time_at(clock_now(), line.monotonic_ns);
  line.pid = getpid();
  line.kind = static_cast<std::uint32_t>(kind);
  copy_text(line.process, process);
  copy_text(line.text, text);
  write().note_counts[line.kind].fetch_add(1, std::memory_order_relaxed);
  write().notes.append(line);
}

void Session::State::look_for_name(std::int64_t now_ns) {
  if (!had_name || now_ns < next_name_look_ns) return;
  next_name_look_ns = now_ns + kNameLook_ns;
  had_name = segment->has_name();
  if (had_name) return;
  note(NoteKind::supervision, "the segment's name was removed (RemoveIPC?); the set goes on without", process_name);
  log_error(
      "the segment's file in /dev/shm was removed by somebody else: as a rule by systemd-logind, whose RemoveIPC=yes "
      "does so when a user's last login ends. The set goes on, and what joins it finds it all the same; to keep the "
      "file: loginctl enable-linger, or RemoveIPC=no in /etc/systemd/logind.conf");
}

}  // namespace yars::databuffer
