// Where a short step along a ray crosses a row and a column of posts. Crests of bilinear ground lie on these lines.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/geo/geodesy.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::test {

// Distances [m] along the ray of the crossings between two distances, ascending; `to_m` where there is none. The step
// crosses at most one line of each kind.
inline std::array<double, 2> lines_of_posts_m(const model::terrain::TerrainView& view, const geo::GeodesicRay& ray,
                                              double from_m, double to_m) {
  const geo::GeoPoint from = ray.position(geo::Length::metres(from_m)), to = ray.position(geo::Length::metres(to_m));
  const model::terrain::PostSpacing posts = view.post_spacing_at(to);
  if (!(posts.rows_deg > 0.0)) return {to_m, to_m};
  const auto crossing_m = [&](double from_deg, double to_deg, double spacing_deg) {
    const double line_deg = std::floor(std::max(from_deg, to_deg) / spacing_deg) * spacing_deg;
    const double fraction = (line_deg - from_deg) / (to_deg - from_deg);
    return fraction > 0.0 && fraction < 1.0 ? from_m + fraction * (to_m - from_m) : to_m;
  };
  const double row_m = crossing_m(from.latitude_deg, to.latitude_deg, posts.rows_deg);
  const double column_m = crossing_m(from.longitude_deg, to.longitude_deg, posts.columns_deg);
  return {std::min(row_m, column_m), std::max(row_m, column_m)};
}

}  // namespace yars::test
