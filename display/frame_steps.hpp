// When a picture of the glass is due: once for each step of sim time. The number of a step is the sim time in steps,
// so that a restarted glass goes on where it was.
#pragma once

#include <cmath>
#include <cstdint>

namespace yars::display {

class FrameSteps {
 public:
  explicit FrameSteps(double every_s) : every_ns_(std::llround(every_s * 1e9)) {}  // > 0

  // True once for each step that has been reached; a step back in time (a new epoch) is a new one.
  bool is_due(std::int64_t sim_time_ns) {
    const std::int64_t step = sim_time_ns / every_ns_;
    if (step == step_) return false;
    step_ = step;
    return true;
  }
  std::int64_t number() const { return step_; }
  // Of a last picture at a time between two steps: that of the step to come.
  std::int64_t last_number(std::int64_t sim_time_ns) const { return (sim_time_ns + every_ns_ - 1) / every_ns_; }

 private:
  std::int64_t every_ns_;
  std::int64_t step_ = -1;
};

}  // namespace yars::display
