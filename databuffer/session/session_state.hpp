// Roles, lock bytes and claims of a session; then the private state of a Session (segment, entry in the process table,
// last valid clock).
// Units: times [ns]; monotonic times are CLOCK_MONOTONIC.
// Threads: mutexes protect the clock and the note filters from simultaneous use by threads of this process.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "databuffer/session/session_layout.hpp"
#include "lib/log/log.hpp"

namespace yars::databuffer {

// Roles that at most one process of a session holds. The value is the role's lock byte in the segment file.
enum class Role : std::uint8_t {
  radar_model = 1,
  state_machine = 2,
  recorder = 3,
  clock = 4,
  traffic = 5,
  glass_frames = 6,
  tour = 7,
  gateway = 12,
  instructor = 13  // changes the world; held during a change only
};
std::string_view name_of(Role role);

// First lock byte of the ownship lanes, the input lanes and the process table.
inline constexpr std::size_t kFirstOwnshipByte = 8;
inline constexpr std::size_t kFirstInputByte = 16;
inline constexpr std::size_t kFirstProcessByte = 32;
static_assert(kFirstOwnshipByte + kOwnshipLanes <= static_cast<std::size_t>(Role::gateway));
static_assert(static_cast<std::size_t>(Role::instructor) < kFirstInputByte);
static_assert(kFirstInputByte + kInputLanes <= kFirstProcessByte);
static_assert(kFirstProcessByte + kProcesses <= shm::kLockBytes);

std::int64_t monotonic_ns();  // [ns] CLOCK_MONOTONIC
// Sim time [ns] at a CLOCK_MONOTONIC time: base sim time + rate x time elapsed since the base time. While the clock is
// frozen, and before the base time, the result is the base sim time.
std::int64_t sim_time_at(const ClockState& clock, std::int64_t monotonic_ns);

// RAII owner of the file lock on one byte. The operating system releases the lock when the process dies.
class Claim {
 public:
  Claim();
  Claim(Claim&& other) noexcept;
  Claim& operator=(Claim&& other) noexcept;
  ~Claim();
  int lane() const { return lane_; }  // index of the ownship or input lane; -1 for a role

 private:
  friend class Session;
  friend struct SessionState;
  struct Hold;
  std::unique_ptr<Hold> hold_;
  int lane_ = -1;
};

// The declarations below are for session.cpp and session_state.cpp only.

// Maximum number of attempts to read or lock the clock, 1 ms apart. `yars sim` holds the lock for much less than 0.2 s.
inline constexpr int kClockAttempts = 200;
// [ns] A greater difference between the CLOCK_MONOTONIC of two processes means that they are in two time namespaces.
inline constexpr std::int64_t kClockTolerance_ns = 1'000'000'000;

// [ns] Interval of the checks in Session::heartbeat(): name of the segment file, entry in the process table.
inline constexpr std::int64_t kUpkeepInterval_ns = 500'000'000;

// Clock that starts now at sim time 0 and rate 1.
ClockState first_clock();

inline SessionLayout& layout_of(shm::Segment& segment) {
  return *static_cast<SessionLayout*>(segment.memory());
}

// Clears the records of a writer that has ended. Readers would otherwise take them for records of the next writer.
inline void clear_ownship_lane(SessionLayout& layout, std::size_t lane) {
  layout.ownship[lane].clear();
  layout.nav[lane].clear();
}

// Bit of an input lane in Counters::input_sources. Only the holder of the lane's lock byte sets or clears the bit.
inline std::uint64_t input_source_bit(std::size_t lane) {
  return std::uint64_t{1} << lane;
}
static_assert(kInputLanes <= 64);

struct Claim::Hold {
  std::shared_ptr<shm::Segment> segment;
  std::size_t byte;
  bool feeds_input = false;  // true if this claim set the lane's bit in Counters::input_sources

  Hold(std::shared_ptr<shm::Segment> in, std::size_t locked) : segment(std::move(in)), byte(locked) {}
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;
  ~Hold() {
    if (const auto lane = byte - kFirstOwnshipByte; lane < kOwnshipLanes) clear_ownship_lane(layout_of(*segment), lane);
    // The bit is cleared before the lock is released, because afterwards the next holder of the lane may set it.
    if (feeds_input) layout_of(*segment).counters.input_sources.fetch_and(~input_source_bit(byte - kFirstInputByte));
    segment->unlock(byte);
  }
};

struct SessionState {
  SessionState(shm::Segment opened, std::string_view process)
      : segment(std::make_shared<shm::Segment>(std::move(opened))), process_name(process), clock(read().clock) {}
  SessionState(const SessionState&) = delete;
  SessionState& operator=(const SessionState&) = delete;
  ~SessionState() {
    report_folded_notes(monotonic_ns(), true);
    leave_table();
  }
  static std::array<log::RepeatFilter, kNoteKinds> filters();

  SessionLayout& write() { return layout_of(*segment); }
  const SessionLayout& read() const { return *static_cast<const SessionLayout*>(std::as_const(*segment).memory()); }

  bool await_clock();  // sets last_valid_clock. False: no valid clock found; last_valid_clock then has sim time 0 in a
                       // new epoch
  std::optional<std::string> clock_problem() const;
  // Reason why a clock is refused: validate(), or a base time more than 1 s in the future. nullopt: the clock is valid.
  std::optional<std::string> inspect_clock(const ClockState& state) const;
  // Entry of state-machine, else of radar-model, in the process table. nullptr: no other process holds one of these
  // roles and has an entry.
  const ProcessEntry* leading_entry() const;
  bool has_foreign_clock() const;
  void enter_table();
  void leave_table();
  std::string describe_holder(std::size_t byte) const;
  std::optional<Claim> take(std::size_t byte, int lane);
  ClockState clock_now();
  void note(NoteKind kind, std::string_view text, std::string_view process);
  void write_note(NoteKind kind, std::string_view text, std::string_view process);
  void report_folded_notes(std::int64_t now_ns, bool all);  // writes the counts of suppressed notes
  bool mark_input_source(std::size_t lane);                 // false: this process is a command such as `yars inject`
  void restore_entry();
  void check_name();

  std::shared_ptr<shm::Segment> segment;
  std::string process_name;
  std::size_t table_byte = 0;       // lock byte of the entry in the process table; 0: no entry
  std::int64_t next_upkeep_ns = 0;  // CLOCK_MONOTONIC
  bool had_name = true;             // true if the segment file had its name in /dev/shm at the last check
  std::mutex notes_mutex;           // protects note_filters
  std::array<log::RepeatFilter, kNoteKinds> note_filters = filters();
  std::mutex clock_mutex;  // protects clock and last_valid_clock
  shm::LatestReader<ClockState> clock;
  ClockState last_valid_clock{};
};

}  // namespace yars::databuffer
