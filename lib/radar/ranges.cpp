#include "lib/radar/ranges.hpp"

#include <algorithm>

#include "lib/failure/require.hpp"

namespace yars::radar {

geo::Length range_by_height(geo::Length height) {
  if (height <= geo::Length::feet(500.0)) return geo::Length::nautical_miles(10.0);
  if (height <= geo::Length::feet(1000.0)) return geo::Length::nautical_miles(20.0);
  return geo::Length::nautical_miles(40.0);
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
