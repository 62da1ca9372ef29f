#include "model/antenna/axis.hpp"

#include <algorithm>
#include <cmath>

#include "lib/radar/limits.hpp"

namespace yars::model::antenna {

void Axis::command_rate(double rate_dps) {
  if (!std::isfinite(rate_dps)) return;
  mode_ = AxisMode::rate;
  commanded_ = rate_dps;
}

void Axis::command_position(double position_deg) {
  if (!std::isfinite(position_deg)) return;
  mode_ = AxisMode::position;
  commanded_ = std::clamp(position_deg, -limits_.position_deg, limits_.position_deg);
}

void Axis::place(double position_deg) {
  if (!std::isfinite(position_deg)) return;
  position_deg_ = std::clamp(position_deg, -limits_.position_deg, limits_.position_deg);
}

void Axis::step() {
  switch (mode_) {
    case AxisMode::freeze:
      return;
    case AxisMode::rate:
      return move(commanded_);
    case AxisMode::position: {
      const double distance_deg = commanded_ - position_deg_;
      // The last stretch lands on the commanded value itself, so that no rounding is left to add up.
      if (std::abs(distance_deg) <= limits_.rate_dps * radar::kTickSeconds) {
        position_deg_ = commanded_;
        return;
      }
      return move(std::copysign(limits_.rate_dps, distance_deg));
    }
  }
}

bool Axis::reached() const {
  return mode_ == AxisMode::position && std::abs(commanded_ - position_deg_) <= limits_.tolerance_deg;
}

void Axis::move(double rate_dps) {
  const double limited_dps = std::clamp(rate_dps, -limits_.rate_dps, limits_.rate_dps);
  place(position_deg_ + limited_dps * radar::kTickSeconds);
}

}  // namespace yars::model::antenna
