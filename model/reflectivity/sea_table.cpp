#include "model/reflectivity/sea_table.hpp"

#include <bit>
#include <cmath>

namespace yars::model::reflectivity {

SeaTable make_sea_table(const SeaReturn& sea) {
  SeaTable table;
  const geo::Bearing across = sea.wind_from + geo::Angle::degrees(90.0);
  for (std::size_t i = 0; i < table.across.size(); ++i) {
    const auto bits = SeaTable::kFirst + (static_cast<std::uint32_t>(i) << SeaTable::kShift);
    const auto sine = static_cast<double>(std::bit_cast<float>(bits));
    const double octaves = std::log2(sea_sigma0(sea, sine, across));
    table.across[i] = static_cast<float>(octaves);
    table.upwind[i] = static_cast<float>(std::log2(sea_sigma0(sea, sine, sea.wind_from)) - octaves);
  }
  return table;
}

}  // namespace yars::model::reflectivity
