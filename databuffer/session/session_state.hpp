// Private state of a Session: participant, last valid clock, filters of notes.
// Threads: mutexes protect the clock and the note filters from simultaneous use by threads of this process.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "databuffer/session/participant.hpp"
#include "lib/log/log.hpp"

namespace yars::databuffer {

// Maximum number of attempts to read or lock the clock, 1 ms apart. `yars sim` holds the lock for much less than 0.2 s.
inline constexpr int kClockAttempts = 200;
// [ns] A greater difference between the CLOCK_MONOTONIC of two processes means that they are in two time namespaces.
inline constexpr std::int64_t kClockTolerance_ns = 1'000'000'000;

// [ns] Interval of the checks in Session::heartbeat(): name of the segment file, entry in the process table.
inline constexpr std::int64_t kUpkeepInterval_ns = 500'000'000;

// Clock that starts now at sim time 0 and rate 1.
ClockState first_clock();

// Only session.cpp and session_state.cpp use it.
struct SessionState : Participant {
  SessionState(shm::Segment opened, std::string_view process)
      : Participant(std::move(opened), process), clock(read().clock) {}
  SessionState(const SessionState&) = delete;
  SessionState& operator=(const SessionState&) = delete;
  ~SessionState() {
    report_folded_notes(monotonic_ns(), true);
    leave_table();
  }
  static std::array<log::RepeatFilter, kNoteKinds> filters();

  bool await_clock();  // sets last_valid_clock. False: no valid clock found; last_valid_clock then has sim time 0 in a
                       // new epoch
  std::optional<std::string> clock_problem() const;
  // Reason why a clock is refused: validate(), or a base time more than 1 s in the future. nullopt: the clock is valid.
  std::optional<std::string> inspect_clock(const ClockState& state) const;
  // Entry of state-machine, else of radar-model, in the process table. nullptr: no other process holds one of these
  // roles and has an entry.
  const ProcessEntry* leading_entry() const;
  bool has_foreign_clock() const;
  ClockState clock_now();
  void note(NoteKind kind, std::string_view text, std::string_view process);
  void write_note(NoteKind kind, std::string_view text, std::string_view process);
  void report_folded_notes(std::int64_t now_ns, bool all);  // writes the counts of suppressed notes
  void check_name();

  std::int64_t next_upkeep_ns = 0;  // CLOCK_MONOTONIC
  bool had_name = true;             // true if the segment file had its name in /dev/shm at the last check
  std::mutex notes_mutex;           // protects note_filters
  std::array<log::RepeatFilter, kNoteKinds> note_filters = filters();
  std::mutex clock_mutex;  // protects clock and last_valid_clock
  shm::LatestReader<ClockState> clock;
  ClockState last_valid_clock{};
};

}  // namespace yars::databuffer
