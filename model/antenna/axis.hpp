// One axis of the dish's servo: position, rate, limits, in degrees against the nose (azimuth) or the horizon
// (elevation). Modes: freeze holds, rate turns at a commanded rate, position goes to a commanded place at full
// rate. A step is one tick of 5 ms; no lag and no overshoot is modelled. Inputs that are not finite are ignored.
#pragma once

#include <cstdint>

namespace yars::model::antenna {

enum class AxisMode : std::uint8_t { freeze, rate, position };

struct AxisLimits {
  double rate_dps = 110.0;     // [deg/s] greatest, either way
  double position_deg = 60.0;  // [deg] either side of zero
  double tolerance_deg = 0.1;  // [deg] a commanded position counts as reached within this
};

class Axis {
 public:
  explicit Axis(const AxisLimits& limits) : limits_(limits) {}

  void freeze() { mode_ = AxisMode::freeze; }
  void command_rate(double rate_dps);
  void command_position(double position_deg);  // clamped to the limits
  void place(double position_deg);             // sets the position: a pattern drives the axis, or a restart resumes it

  // Advances by one tick.
  void step();

  double position_deg() const { return position_deg_; }
  AxisMode mode() const { return mode_; }
  bool reached() const;  // in position mode, within the tolerance

 private:
  void move(double rate_dps);

  AxisLimits limits_;
  AxisMode mode_ = AxisMode::freeze;
  double position_deg_ = 0.0;
  double commanded_ = 0.0;  // [deg/s] or [deg], by mode
};

}  // namespace yars::model::antenna
