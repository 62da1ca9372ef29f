#include "model/terrain/culture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/failure/require.hpp"

namespace yars::model::terrain {

Culture::Culture(CellPlace place, int rows, int columns, std::vector<std::uint8_t> codes)
    : place_(place), rows_(rows), columns_(columns), codes_(std::move(codes)) {
  YARS_REQUIRE(rows, >=, 2);
  YARS_REQUIRE(columns, >=, 2);
  YARS_REQUIRE(codes_.size(), ==, static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  YARS_REQUIRE(static_cast<int>(*std::max_element(codes_.begin(), codes_.end())), <=,
               static_cast<int>(kLargestMaterial));
}

std::uint8_t Culture::nearest(double north_deg, double east_deg) const {
  const auto row = static_cast<int>(std::lround(std::clamp(north_deg, 0.0, 1.0) * (rows_ - 1)));
  const auto column = static_cast<int>(std::lround(std::clamp(east_deg, 0.0, 1.0) * (columns_ - 1)));
  return code(row, column);
}

}  // namespace yars::model::terrain
