// Inputs that a consumer latches once a tick: the lane chosen, jumps held back, traffic.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "databuffer/messages/world_state.hpp"
#include "databuffer/session/session_layout.hpp"

namespace yars::databuffer {

inline constexpr std::size_t kMaxOwnshipLanes = 4;
// [ns] 25 records of a 50 Hz source; shorter and a loaded machine loses its source, longer and a dead one flies on.
inline constexpr std::int64_t kStaleAfter = 500'000'000;
// [ns] a lane must have delivered this long before it displaces a good one; a source that flaps faster never does.
inline constexpr std::int64_t kTakeoverAfter = 250'000'000;

struct OwnshipLane {
  bool present = false;        // a value has ever been published and the lane has a priority
  std::uint32_t priority = 0;  // higher wins
  std::uint64_t version = 0;   // of the LatestValue: changes with each record
};

// The choice and what the next call needs to know; begin with a default one.
struct OwnshipSelection {
  struct Memory {
    bool seen = false;
    std::uint64_t version = 0;
    std::optional<std::int64_t> received_ns;  // the newest version's arrival
    std::int64_t delivering_since_ns = 0;     // first arrival after the last gap
  };
  std::optional<std::size_t> lane;
  std::array<Memory, kMaxOwnshipLanes> memory;
};

// Which of the ownship lanes the radar believes: the highest fresh priority, with hysteresis. Pure; called once a tick.
// A lane is fresh while its version has changed within kStaleAfter by the caller's clock (stamps from outside are not
// believed). A version met for the first time is no news: it may be what a dead writer left.
// A higher lane takes over after delivering without a gap for kTakeoverAfter; the chosen lane is left only when it is
// stale or such a lane is there. Equal priorities: the chosen one stays; none chosen: the lower index.
// `lanes` has at most kMaxOwnshipLanes entries, always in the same order. `now_ns` is CLOCK_MONOTONIC, or sim time in
// lockstep; when it goes back, each lane counts as received at that moment.
OwnshipSelection select_ownship(std::span<const OwnshipLane> lanes, std::int64_t now_ns,
                                const OwnshipSelection& previous);

// [m] that a place may be off from where twice its speed could have brought it: noise of a navigator, not a jump.
inline constexpr double kPlaceTolerance_m = 50.0;
// [ns] of sim time that a new place must stand; one bad record does not move the radar.
inline constexpr std::int64_t kJumpProof = 100'000'000;
inline constexpr std::int64_t kLongestHold = 1'000'000'000;

// Jumps in place. Where an aircraft is follows from where it was; what does not (another source elsewhere, a simulator
// set back) is believed with a new epoch only, which restarts scan and filters: the record is the first
// one of the session's epoch, or the epoch has changed since the place was first seen. Until then the place before
// stands. Pure. Whoever may set the clock raises the epoch when is_proven(); where nobody does, the jump is taken after
// kLongestHold all the same.
class JumpGuard {
 public:
  // Whether `next`, met at `received_ns`, is to be believed at the tick of `now_ns` [ns of sim time]. Ask once a tick.
  bool believes(const Ownship& next, std::int64_t received_ns, std::int64_t now_ns, std::uint32_t epoch);
  // The place that is not believed has stood for kJumpProof.
  bool is_proven() const { return proven_; }
  std::uint64_t passed() const { return passed_; }  // jumps that were gone before they were proven

 private:
  bool is_jump(const Ownship& next, std::int64_t received_ns) const;
  void take(const Ownship& next, std::int64_t received_ns);

  std::optional<Ownship> last_;  // the last one believed
  std::int64_t last_received_ns_ = 0;
  std::optional<std::int64_t> held_since_ns_;
  std::uint32_t held_epoch_ = 0;
  bool proven_ = false;
  std::uint64_t passed_ = 0;
};

inline constexpr std::uint32_t kNoLane = 0xffffffffU;

// What messages call the source of a lane: by the name that it gives itself, or by its place when it gives none.
std::string name_of_source(const Ownship& ownship, std::uint32_t lane);

// What a consumer latches once a tick: the ownship and nav of the lane that select_ownship picks. Records that do
// not validate are refused and counted; the last good value of their lane stands. So does it when the place jumps
// within an epoch (JumpGuard), but in lockstep, where nobody can set the clock.
class OwnshipReceiver {
 public:
  struct Selected {
    bool valid = false;  // a fresh lane was found
    std::uint32_t lane = kNoLane;
    Ownship ownship{};  // of the lane; the last one used when none is fresh
    Nav nav{};
    std::int64_t received_ns = 0;  // [ns] sim time of the tick that met it first
    // Where the source says that the aircraft is now, far from where it was: it takes a new epoch.
    std::optional<Ownship> jump;
    std::uint32_t jump_lane = kNoLane;  // of that source
  };
  // `sim_time_ns` is the time of the tick: receipt is judged by it, so that lockstep and live agree.
  const Selected& refresh(const SessionLayout& layout, std::int64_t sim_time_ns, std::uint32_t epoch);

  std::uint64_t refused() const { return refused_ + guard_.passed(); }
  // Why, a sentence for each record that the last refresh() refused.
  const std::vector<std::string>& refusals() const { return refusals_; }

 private:
  void receive(const SessionLayout& layout, std::size_t lane);

  struct Lane {
    std::uint64_t version = 0;  // newest one looked at
    std::uint64_t nav_version = 0;
    std::uint64_t accepted = 0;  // counts good ownships: what select_ownship sees as the version
    Ownship ownship{};
    Nav nav{};
    bool has_nav = false;
  };
  std::array<Lane, kOwnshipLanes> lanes_;
  OwnshipSelection selection_;
  JumpGuard guard_;
  Selected selected_;
  std::uint64_t refused_ = 0;
  std::vector<std::string> refusals_;
};

// The surface traffic as a consumer latches it once a tick. A record that does not validate, or is of another epoch, is
// refused and counted; what was latched before goes on, for kTrafficStaleAfter.
class TrafficReceiver {
 public:
  // True when latched() is another than before: a new record, or nothing any more.
  bool refresh(const SessionLayout& layout, std::int64_t tick, std::int64_t sim_time_ns, std::uint32_t epoch);
  const Traffic& latched() const { return latched_; }

  std::uint64_t refused() const { return refused_; }
  const std::optional<std::string>& refusal() const { return refusal_; }  // of the last refresh()

 private:
  bool take(const SessionLayout& layout, std::uint32_t epoch);

  Traffic latched_{};
  std::uint64_t version_ = 0;  // the newest looked at
  std::int64_t received_ns_ = 0;
  std::uint64_t refused_ = 0;
  std::optional<std::string> refusal_;
};

}  // namespace yars::databuffer
