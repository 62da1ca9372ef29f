// Jumps in place. Where an aircraft is follows from where it was; what does not (another source elsewhere, a simulator
// set back) is believed with a new epoch only, which restarts scan and filters: the record is the first
// one of the session's epoch, or the epoch has changed since the place was first seen. Until then the place before
// stands. Pure. Whoever may set the clock raises the epoch when is_proven(); where nobody does, the jump is taken after
// kLongestHold all the same.
#pragma once

#include <cstdint>
#include <optional>

#include "databuffer/records/ownship.hpp"

namespace yars::databuffer {

// [m] that a place may be off from where twice its speed could have brought it: noise of a navigator, not a jump.
inline constexpr double kPlaceTolerance_m = 50.0;
// [ns] of sim time that a new place must stand; one bad record does not move the radar.
inline constexpr std::int64_t kJumpProof = 100'000'000;
inline constexpr std::int64_t kLongestHold = 1'000'000'000;

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

}  // namespace yars::databuffer
