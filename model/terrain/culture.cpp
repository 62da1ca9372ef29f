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
  codes_.resize(codes_.size() + kSpareBytes);
}

Culture Culture::reduced(int reduction) const {
  const auto step_of = [reduction](int intervals) {
    int step = 1;
    for (int halving = 0; halving < reduction && intervals % (2 * step) == 0 && intervals > 2 * step; ++halving)
      step *= 2;
    return step;
  };
  const int up = step_of(rows_ - 1);
  const int right = step_of(columns_ - 1);
  std::vector<std::uint8_t> codes;
  for (int row = 0; row < rows_; row += up)
    for (int column = 0; column < columns_; column += right) codes.push_back(code(row, column));
  return {place_, (rows_ - 1) / up + 1, (columns_ - 1) / right + 1, std::move(codes)};
}

std::uint8_t Culture::nearest(double north_deg, double east_deg) const {
  const auto row = static_cast<int>(std::lround(std::clamp(north_deg, 0.0, 1.0) * (rows_ - 1)));
  const auto column = static_cast<int>(std::lround(std::clamp(east_deg, 0.0, 1.0) * (columns_ - 1)));
  return code(row, column);
}

}  // namespace yars::model::terrain
