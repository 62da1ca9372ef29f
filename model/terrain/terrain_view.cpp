#include "model/terrain/terrain_view.hpp"

#include <cmath>

namespace yars::model::terrain {

int detail_for(double spacing_m) {
  constexpr double kLeast_m = 2.0;
  if (!std::isfinite(spacing_m) || spacing_m < kLeast_m) return 0;
  return static_cast<int>(std::floor(std::log2(spacing_m)));
}

}  // namespace yars::model::terrain
