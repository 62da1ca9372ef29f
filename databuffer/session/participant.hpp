// Roles, lock bytes and claims of a session; then a Participant, one process that has attached to the segment.
// Used by Session for programs of YARS, and by databuffer/client for programs of others. Needs neither log nor
// validation.
// Units: times [ns]; monotonic times are CLOCK_MONOTONIC.
// Errors: a role or lane that another process has claimed; the error names the holder.
// Threads: one at a time for each Participant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "databuffer/session/session_layout.hpp"
#include "lib/error/error.hpp"

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
  friend struct Participant;
  struct Hold;
  std::unique_ptr<Hold> hold_;
  int lane_ = -1;
};

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

// A process in a session: its segment, and its entry in the process table from enter_table() to leave_table().
// Functions that claim or write require a segment opened for writing.
struct Participant {
  Participant(shm::Segment opened, std::string_view process)
      : segment(std::make_shared<shm::Segment>(std::move(opened))), process_name(process) {}

  SessionLayout& write() { return layout_of(*segment); }
  const SessionLayout& read() const { return *static_cast<const SessionLayout*>(std::as_const(*segment).memory()); }

  // A full table is no error: the process then runs without an entry and a heartbeat.
  void enter_table();
  void leave_table();
  void restore_entry();               // writes name and process id again, which another process may have overwritten
  void beat(std::int64_t monotonic);  // stores the heartbeat

  bool is_held(Role role) const { return segment->is_locked(static_cast<std::size_t>(role)); }  // by any process
  std::int32_t holder_of(Role role) const;                                                      // pid; 0: none
  std::string describe_holder(std::size_t byte) const;

  std::optional<Claim> take(std::size_t byte, int lane);
  error::Expected<Claim> claim(Role role);  // waits at most 0.2 s, for a gateway that holds the role for another host
  error::Expected<Claim> claim_ownship_lane(std::uint32_t priority);
  error::Expected<Claim> claim_input_lane(std::string_view source);

  std::shared_ptr<shm::Segment> segment;
  std::string process_name;
  std::size_t table_byte = 0;  // lock byte of the entry in the process table; 0: no entry

 private:
  bool is_lent_to_gateway(Role role) const;
  std::optional<Claim> take_back(Role role);
  bool mark_input_source(std::size_t lane);  // false: this process is a command such as `yars inject`
};

// Checks a session name, which is part of a path: 1 to 40 letters, digits, `-` or `_`, no `-` at the front. An error is
// a usage error.
error::Expected<void> check_session_name(const std::string& name);

}  // namespace yars::databuffer
