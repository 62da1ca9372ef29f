#include "inputmonitor/axis_shape.hpp"

#include <algorithm>
#include <cmath>

namespace yars::inputmonitor {

double shaped(std::int32_t raw, const AxisShape& shape) {
  const double offset = static_cast<double>(raw) - shape.centre;
  const double travel = offset >= 0.0 ? shape.high - shape.centre : shape.centre - shape.low;
  const double plain = std::clamp(offset / travel, -1.0, 1.0) * (shape.inverted ? -1.0 : 1.0);
  const double beyond = (std::abs(plain) - shape.dead_zone) / (1.0 - shape.dead_zone);
  if (beyond <= 0.0) return 0.0;
  return std::copysign((1.0 - shape.curve) * beyond + shape.curve * beyond * beyond * beyond, plain);
}

}  // namespace yars::inputmonitor
