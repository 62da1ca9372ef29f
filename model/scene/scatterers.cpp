#include "model/scene/scatterers.hpp"

#include <cmath>

namespace yars::model::scene {

std::uint64_t square_key(double east_m, double north_m, double side_m) {
  const auto column = static_cast<std::int32_t>(std::floor(east_m / side_m));
  const auto row = static_cast<std::int32_t>(std::floor(north_m / side_m));
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32U | static_cast<std::uint32_t>(column);
}

std::size_t Scatterers::level_for(double resolved_m) const {
  std::size_t level = finest;
  while (level + 1 < kScattererSides_m.size() && kScattererSides_m[level + 1] <= resolved_m) ++level;
  return level;
}

std::uint64_t Scatterers::bytes() const {
  constexpr std::uint64_t kHashNode = 64;  // of an unordered_map, about
  std::uint64_t sum = sizeof(Scatterers);
  for (const ScattererLevel& level : levels)
    sum += level.scatterers.capacity() * sizeof(Scatterer) + level.facings.capacity() * sizeof(Facing) +
           level.covers.size() * kHashNode + level.tree.bytes();
  return sum;
}

}  // namespace yars::model::scene
