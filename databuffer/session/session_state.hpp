// Private state of a Session: segment, process table entry, last valid clock; and the types of roles and claims.
// Units: times [ns]; monotonic times are CLOCK_MONOTONIC.
// Threads: mutexes protect the clock and the note filters between threads of this process.
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

// Writers of which a session has at most one. The number is the lock byte of the role in the segment file.
enum class Role : std::uint8_t {
  radar_model = 1,
  state_machine = 2,
  recorder = 3,
  clock = 4,
  traffic = 5,
  glass_frames = 6
};
std::string_view name_of(Role role);

// First lock bytes of each kind of claim; roles use their own number.
inline constexpr std::size_t kFirstOwnshipByte = 8;
inline constexpr std::size_t kFirstInputByte = 16;
inline constexpr std::size_t kFirstProcessByte = 32;
static_assert(kFirstOwnshipByte + kOwnshipLanes <= kFirstInputByte);
static_assert(kFirstInputByte + kInputLanes <= kFirstProcessByte);
static_assert(kFirstProcessByte + kProcesses <= shm::kLockBytes);

std::int64_t monotonic_ns();  // [ns] CLOCK_MONOTONIC
// Sim time [ns] at a CLOCK_MONOTONIC time: base + rate x elapsed while running, and the base before it.
std::int64_t sim_time_at(const ClockState& clock, std::int64_t monotonic_ns);

// Held byte lock. The kernel releases it when the process dies. A move transfers it.
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

inline constexpr int kClockAttempts = 200;  // attempts 1 ms apart: `yars sim` holds the clock for far less than 0.2 s

// [ns] Interval of the checks in heartbeat(); a lost name or entry is reported within 1 s.
inline constexpr std::int64_t kUpkeepInterval_ns = 500'000'000;

// Clock that starts now at sim time 0 and rate 1.
ClockState first_clock();

inline SessionLayout& layout_of(shm::Segment& segment) {
  return *static_cast<SessionLayout*>(segment.memory());
}

// Clears the values of a departed writer, which a new reader would take for fresh.
inline void empty_ownship_lane(SessionLayout& layout, std::size_t lane) {
  layout.ownship[lane].clear();
  layout.nav[lane].clear();
}

// Removes one source from the count of input sources, at its orderly end. The count never goes below 0.
inline void forget_input_source(SessionLayout& layout) {
  auto& sources = layout.counters.input_sources;
  if (std::uint64_t seen = sources.load(); seen > 0) sources.compare_exchange_strong(seen, seen - 1);
}

struct Claim::Hold {
  std::shared_ptr<shm::Segment> segment;
  std::size_t byte;
  bool feeds_input = false;  // counted in Counters::input_sources

  Hold(std::shared_ptr<shm::Segment> in, std::size_t locked) : segment(std::move(in)), byte(locked) {}
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;
  ~Hold() {
    if (const auto lane = byte - kFirstOwnshipByte; lane < kOwnshipLanes) empty_ownship_lane(layout_of(*segment), lane);
    segment->unlock(byte);
    if (feeds_input) forget_input_source(layout_of(*segment));
  }
};

// Used by session.cpp and session_state.cpp only.
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

  bool find_clock();  // false: no valid clock; good_clock then starts at 0 in a new epoch
  std::optional<std::string> clock_problem() const;
  void enter_table();
  void leave_table();
  std::string describe_holder(std::size_t byte) const;
  std::optional<Claim> take(std::size_t byte, int lane);
  ClockState clock_now();
  void note(NoteKind kind, std::string_view text, std::string_view process);
  void write_note(NoteKind kind, std::string_view text, std::string_view process);
  void report_folded_notes(std::int64_t now_ns, bool all);
  bool count_input_sources();  // false: this process does not count as an input source
  void restore_entry();
  void check_name();

  std::shared_ptr<shm::Segment> segment;
  std::string process_name;
  std::size_t table_byte = 0;       // 0: not in the table
  std::int64_t next_upkeep_ns = 0;  // CLOCK_MONOTONIC
  bool had_name = true;
  std::mutex notes_mutex;  // of this process's threads only
  std::array<log::RepeatFilter, kNoteKinds> note_filters = filters();
  std::mutex clock_mutex;  // of this process's threads only
  shm::LatestReader<ClockState> clock;
  ClockState good_clock{};  // last valid clock
};

}  // namespace yars::databuffer
