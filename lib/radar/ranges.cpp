#include "lib/radar/ranges.hpp"

#include <algorithm>

#include "lib/failure/require.hpp"

namespace yars::radar {

geo::Length range_by_height(geo::Length height, const HeightRanges& table) {
  YARS_REQUIRE(table.ranges_nm.size(), ==, table.heights_ft.size() + 1);
  const auto found = std::find_if(table.heights_ft.begin(), table.heights_ft.end(),
                                  [height](double height_ft) { return height <= geo::Length::feet(height_ft); });
  return geo::Length::nautical_miles(table.ranges_nm[static_cast<std::size_t>(found - table.heights_ft.begin())]);
}

std::size_t range_index_for(geo::Length wanted, std::span<const double> ranges_nm) {
  YARS_REQUIRE(ranges_nm.size(), >, std::size_t{0});
  const auto found = std::find_if(ranges_nm.begin(), ranges_nm.end(), [wanted](double range_nm) {
    return geo::Length::nautical_miles(range_nm) >= wanted;
  });
  if (found == ranges_nm.end()) return ranges_nm.size() - 1;
  return static_cast<std::size_t>(found - ranges_nm.begin());
}

}  // namespace yars::radar
