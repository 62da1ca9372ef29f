// From an axis's raw value to what the hand means, in [-1, 1].
//   v = (raw - centre) / (the end on its side - centre), cut to [-1, 1]; negated when inverted
//   t = (|v| - dead) / (1 - dead), 0 within the dead zone
//   result = sign(v) ((1 - curve) t + curve t^3): continuous, odd, 1 at the end
#pragma once

#include <cstdint>

namespace yars::inputmonitor {

struct AxisShape {
  double low = -1.0;  // raw values; low < centre < high
  double high = 1.0;
  double centre = 0.0;
  double dead_zone = 0.0;  // [0, 0.9]
  double curve = 0.0;      // [0, 1]
  bool inverted = false;
};

double shaped(std::int32_t raw, const AxisShape& shape);

}  // namespace yars::inputmonitor
