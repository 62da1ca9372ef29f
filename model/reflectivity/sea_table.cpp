#include "model/reflectivity/sea_table.hpp"

#include <cmath>

namespace yars::model::reflectivity {

SeaTables::SeaTables(const SeaReturn& sea) : wind_from_(sea.wind_from) {
  const geo::Bearing across = sea.wind_from + geo::Angle::degrees(90.0);
  for (std::size_t i = 0; i < octaves_.size(); ++i) {
    const auto bits = SeaTable::kFirst + (static_cast<std::uint32_t>(i) << SeaTable::kShift);
    const auto sine = static_cast<double>(std::bit_cast<float>(bits));
    octaves_[i] = std::log2(sea_sigma0(sea, sine, across));
    upwind_[i] = std::log2(sea_sigma0(sea, sine, sea.wind_from)) - octaves_[i];
  }
}

void SeaTables::fill(geo::Bearing look, SeaTable& table) const {
  const double cosine = std::cos((look - wind_from_).radians());
  for (std::size_t i = 0; i < octaves_.size(); ++i) {
    table.sigma0[i] = static_cast<float>(std::exp2(octaves_[i] + cosine * upwind_[i]));
  }
}

}  // namespace yars::model::reflectivity
