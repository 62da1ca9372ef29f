// Roles and claims of a session, its clock, and what a Session holds: the segment, the place in the process table, the
// clock as it was last believed.
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

// Writers of which a session has one; the number is the byte of the segment file that its holder locks.
enum class Role : std::uint8_t {
  radar_model = 1,
  state_machine = 2,
  recorder = 3,
  clock = 4,
  traffic = 5,
  glass_frames = 6
};
std::string_view name_of(Role role);

// Lock bytes of the segment file: roles at their number, then a block for each kind of lane and for the table.
inline constexpr std::size_t kFirstOwnshipByte = 8;
inline constexpr std::size_t kFirstInputByte = 16;
inline constexpr std::size_t kFirstProcessByte = 32;
static_assert(kFirstOwnshipByte + kOwnshipLanes <= kFirstInputByte);
static_assert(kFirstInputByte + kInputLanes <= kFirstProcessByte);
static_assert(kFirstProcessByte + kProcesses <= shm::kLockBytes);

std::int64_t monotonic_ns();  // [ns] CLOCK_MONOTONIC
// Sim time [ns] at a moment of CLOCK_MONOTONIC: base + rate x elapsed while running; before the base, the base.
std::int64_t sim_time_at(const ClockState& clock, std::int64_t monotonic_ns);

// A byte lock held; the kernel frees it when the process dies. Moving it moves the lock.
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

inline constexpr int kClockAttempts = 200;  // of 1 ms: another `yars sim` holds the clock for far less

// [ns] between looks at the segment's name and at the entry in the process table: a role says it within 1 s
inline constexpr std::int64_t kLook_ns = 500'000'000;

// Sim time 0 from this moment on, at rate 1.
ClockState first_clock();

inline SessionLayout& layout_of(shm::Segment& segment) {
  return *static_cast<SessionLayout*>(segment.memory());
}

// What a departed writer left must not pass for fresh with a reader that sees it for the first time.
inline void empty_ownship_lane(SessionLayout& layout, std::size_t lane) {
  layout.ownship[lane].clear();
  layout.nav[lane].clear();
}

// A source that goes in order is not missed. Never below none, whatever others have written there.
inline void forget_input_source(SessionLayout& layout) {
  auto& sources = layout.counters.input_sources;
  if (std::uint64_t seen = sources.load(); seen > 0) sources.compare_exchange_strong(seen, seen - 1);
}

struct Claim::Hold {
  std::shared_ptr<shm::Segment> segment;
  std::size_t byte;
  bool feeds_input = false;  // and is counted among Counters::input_sources

  Hold(std::shared_ptr<shm::Segment> in, std::size_t locked) : segment(std::move(in)), byte(locked) {}
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;
  ~Hold() {
    if (const auto lane = byte - kFirstOwnshipByte; lane < kOwnshipLanes) empty_ownship_lane(layout_of(*segment), lane);
    segment->unlock(byte);
    if (feeds_input) forget_input_source(layout_of(*segment));
  }
};

// For session.cpp and session_state.cpp alone.
struct SessionState {
  SessionState(shm::Segment opened, std::string_view process)
      : segment(std::make_shared<shm::Segment>(std::move(opened))), process_name(process), clock(read().clock) {}
  SessionState(const SessionState&) = delete;
  SessionState& operator=(const SessionState&) = delete;
  ~SessionState() {
    tell_left_out(monotonic_ns(), true);
    leave_table();
  }
  static std::array<log::RepeatFilter, kNoteKinds> filters();

  SessionLayout& write() { return layout_of(*segment); }
  const SessionLayout& read() const { return *static_cast<const SessionLayout*>(std::as_const(*segment).memory()); }

  bool find_clock();  // false: there is no good one, and good_clock begins at 0 in a new epoch
  std::optional<std::string> clock_problem() const;
  void enter_table();
  void leave_table();
  std::string describe_holder(std::size_t byte) const;
  std::optional<Claim> take(std::size_t byte, int lane);
  ClockState clock_now();
  void note(NoteKind kind, std::string_view text, std::string_view process);
  void write_note(NoteKind kind, std::string_view text, std::string_view process);
  void tell_left_out(std::int64_t now_ns, bool all);
  bool count_input_sources();  // false: this process is none
  void keep_entry();
  void look_for_name();

  std::shared_ptr<shm::Segment> segment;
  std::string process_name;
  std::size_t table_byte = 0;     // 0: not in the table
  std::int64_t next_look_ns = 0;  // CLOCK_MONOTONIC
  bool had_name = true;
  std::mutex notes_mutex;  // of this process's threads only
  std::array<log::RepeatFilter, kNoteKinds> note_filters = filters();
  std::mutex clock_mutex;  // of this process's threads only
  shm::LatestReader<ClockState> clock;
  ClockState good_clock{};  // the last one that is in range
};

}  // namespace yars::databuffer
