// What the fan knows of its points before profiles are cast, by FanGrid::at(). What is read together lies together: who
// draws small triangles meets one line of the cache a point.
#pragma once

#include <cstdint>

namespace yars::model::hrm {

struct SurfacePoint {
  float gain = 0.0F;      // gamma: cross section [m^2] a square metre seen square on; negative where a thing stands
  float height_m = 0.0F;  // above the map plane, of what is highest
};

// Facing walls that stand before this point's ground: the sum of gamma times height, and how tall they are together, in
// steps of kWallStep_m. Whole numbers, so that the order in which walls are drawn is of no account.
struct WallPoint {
  std::uint32_t returned = 0;
  std::uint32_t height = 0;
};
inline constexpr float kWallStep_m = 1.0F / 4096.0F;

}  // namespace yars::model::hrm
