#include "databuffer/session/session_state.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include "databuffer/messages/validation.hpp"
#include "lib/log/log.hpp"

namespace yars::databuffer {

namespace {

template <std::size_t N>
void copy_text(char (&into)[N], std::string_view text) {
  into[text.copy(into, N - 1)] = '\0';
}

}  // namespace

ClockState first_clock() {
  ClockState clock{};
  clock.base_monotonic_ns = monotonic_ns();
  clock.rate = 1.0;
  clock.running = 1;
  clock.reposition_latitude_deg = clock.reposition_longitude_deg = std::numeric_limits<double>::quiet_NaN();
  clock.reposition_altitude_m = clock.reposition_heading_deg = std::numeric_limits<double>::quiet_NaN();
  return clock;
}

// Waits for a valid clock. Normally the first attempt succeeds, because the clock is written before the segment gets
// its name. state-machine replaces an invalid clock within a tick.
bool SessionState::await_clock() {
  for (int attempt = 0; attempt < kClockAttempts; ++attempt) {
    if (clock.refresh() && !inspect_clock(clock.value())) {
      last_valid_clock = clock.value();
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  last_valid_clock = first_clock();
  last_valid_clock.epoch = clock.value().epoch + 1;
  return false;
}

std::optional<std::string> SessionState::clock_problem() const {
  ClockState present{};
  if (!read().clock.read(present)) return "expected a readable clock, found none";
  return inspect_clock(present);
}

// In a time namespace, CLOCK_MONOTONIC of this process may show an earlier time than in the session's other programs.
// So the later of this process's CLOCK_MONOTONIC and the heartbeat of leading_entry() counts as the present time.
std::optional<std::string> SessionState::inspect_clock(const ClockState& state) const {
  if (auto refusal = validate(state)) return refusal;
  const std::int64_t base_ns = state.base_monotonic_ns;
  std::int64_t now_ns = monotonic_ns();
  if (base_ns <= now_ns + kClockTolerance_ns) return std::nullopt;
  if (const ProcessEntry* leader = leading_entry()) now_ns = std::max(now_ns, leader->heartbeat_ns.load());
  if (base_ns - kClockTolerance_ns <= now_ns) return std::nullopt;
  return "base_monotonic_ns: expected a time that has passed, found " + std::to_string(base_ns) + ", " +
         std::to_string((base_ns - now_ns) / 1'000'000'000) + " s in the future";
}

const ProcessEntry* SessionState::leading_entry() const {
  for (const Role role : {Role::state_machine, Role::radar_model}) {
    const auto byte = static_cast<std::size_t>(role);
    const std::int32_t pid = segment->holder_pid(byte);
    if (pid == 0 || pid == getpid() || !segment->is_locked(byte)) continue;
    for (const ProcessEntry& entry : read().processes)
      if (entry.pid == pid) return &entry;
  }
  return nullptr;
}

// True if the heartbeat of leading_entry() changes, and differs from the CLOCK_MONOTONIC of this process by more than
// kClockTolerance_ns.
bool SessionState::has_foreign_clock() const {
  constexpr int kAttempts = 200;  // 1 ms apart; a role updates its heartbeat every 5 ms
  const ProcessEntry* leader = leading_entry();
  if (leader == nullptr) return false;
  const std::int64_t first_beat_ns = leader->heartbeat_ns;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::int64_t now_ns = monotonic_ns();
    const std::int64_t beat_ns = leader->heartbeat_ns;
    if (beat_ns >= now_ns - kClockTolerance_ns && beat_ns <= now_ns + kClockTolerance_ns) return false;
    if (beat_ns != first_beat_ns) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

// Latest valid clock. An invalid clock is refused and noted; the last valid one stays in use.
ClockState SessionState::clock_now() {
  std::unique_lock guard(clock_mutex);
  if (!clock.refresh()) return last_valid_clock;
  const auto refusal = inspect_clock(clock.value());
  if (!refusal) last_valid_clock = clock.value();
  const ClockState now = last_valid_clock;
  guard.unlock();
  if (refusal) note(NoteKind::refusal, "clock: " + *refusal, process_name);
  return now;
}

std::array<log::RepeatFilter, kNoteKinds> SessionState::filters() {
  // Each process has one filter for each note kind. In a window of 10 s a filter passes at most 3 similar lines, and 20
  // lines in all. Six programs then write at most 120 lines of a note kind per window, besides the lines of
  // report_folded_notes(). The flight recorder has kNotes (1,000) lines.
  constexpr int kMaxOfAKind = 3;
  constexpr int kMaxOfAll = 20;
  const log::RepeatFilter filter(kMaxOfAKind, kMaxOfAll);
  return {filter, filter, filter, filter, filter};
}

void SessionState::note(NoteKind kind, std::string_view text, std::string_view process) {
  if (!segment->writable()) return;
  const std::int64_t now_ns = monotonic_ns();
  const auto index = static_cast<std::size_t>(kind);
  write().note_counts[index].fetch_add(1, std::memory_order_relaxed);
  if (kind == NoteKind::refusal) write().counters.refusals.add(now_ns);
  std::unique_lock guard(notes_mutex);
  const bool passes = note_filters[index].passes(text, now_ns);
  guard.unlock();
  if (passes)
    write_note(kind, text, process);
  else
    write().counters.notes_folded.fetch_add(1, std::memory_order_relaxed);
}

void SessionState::write_note(NoteKind kind, std::string_view text, std::string_view process) {
  Note line{};
  line.monotonic_ns = monotonic_ns();
  line.sim_time_ns = sim_time_at(clock_now(), line.monotonic_ns);
  line.pid = getpid();
  line.kind = static_cast<std::uint32_t>(kind);
  copy_text(line.process, process);
  copy_text(line.text, text);
  write().notes.append(line);
}

// Writes one line for each group of suppressed similar lines whose 10 s have ended; with `all`, for every group. The
// number of lines precedes the text, because a long text is cut.
void SessionState::report_folded_notes(std::int64_t now_ns, bool all) {
  if (!segment->writable()) return;
  for (std::size_t kind = 0; kind < note_filters.size(); ++kind) {
    std::unique_lock guard(notes_mutex);
    const auto suppressed = note_filters[kind].take_suppressed(now_ns, all);
    guard.unlock();
    for (const auto& lines : suppressed)
      write_note(static_cast<NoteKind>(kind), std::to_string(lines.count) + " more: " + lines.line, process_name);
  }
}

void SessionState::check_name() {
  if (!had_name) return;
  had_name = segment->has_name();
  if (had_name) return;
  note(NoteKind::supervision, "the segment's name was removed (RemoveIPC?); the session continues", process_name);
  log::error(
      "the segment's file in /dev/shm was removed by another program, usually by systemd-logind: with RemoveIPC=yes it "
      "removes such files when a user's last login ends. The session continues, and programs can still join it. To "
      "keep the file: loginctl enable-linger, or RemoveIPC=no in /etc/systemd/logind.conf");
}

}  // namespace yars::databuffer
