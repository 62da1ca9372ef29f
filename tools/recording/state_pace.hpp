// Which radar states are worth recording: each one in which something was switched, and of those that only move (the
// cursor, its readouts, what the aircraft carries along) ten a second.
#pragma once

#include <cstdint>
#include <optional>

#include "databuffer/records/radar_state.hpp"

namespace yars::tools::recording {

inline constexpr std::int64_t kPaceTicks = 20;  // 0.1 s of sim time

// Whether as much time has passed since the last one, or time has begun anew.
class Pace {
 public:
  bool is_due(std::int64_t tick) const { return !last_ || tick < *last_ || tick - *last_ >= kPaceTicks; }
  void taken(std::int64_t tick) { last_ = tick; }

 private:
  std::optional<std::int64_t> last_;
};

class StatePace {
 public:
  // The newest state at `tick`; true: record it. One that is not recorded is offered again until it is, or is another.
  bool takes(const databuffer::RadarState& state, std::int64_t tick);

 private:
  Pace pace_;
  std::optional<databuffer::RadarState> last_;
};

// Whether the two differ in anything but what moves by itself.
bool switched(const databuffer::RadarState& before, const databuffer::RadarState& after);

}  // namespace yars::tools::recording
