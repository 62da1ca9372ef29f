#include "model/terrain/sampling/terrain_view.hpp"

#include <algorithm>
#include <cmath>

namespace yars::model::terrain {

// The largest detail for which 2^detail m is at most the spacing; 0 below 2 m, for infinity and for NaN.
int detail_for(double spacing_m) {
  constexpr double kMinSpacing_m = 2.0;
  if (!std::isfinite(spacing_m) || spacing_m < kMinSpacing_m) return 0;
  return static_cast<int>(std::floor(std::log2(spacing_m)));
}

SightSeries::Line SightSeries::at(double curvature, double distance_m) const {
  const double angle = distance_m * curvature, square = angle * angle;
  const double f = static_cast<double>(fall) + square * static_cast<double>(fall_square);
  const double t = static_cast<double>(tilt) + square * static_cast<double>(tilt_square);
  return {static_cast<double>(altitude_m) + distance_m * angle * f,
          angle > 0.0 ? std::sin(angle) / curvature : distance_m, std::sin(angle),
          static_cast<double>(upright) - square * t};
}

// The squared slant range is that over ground plus that in height, (h - altitude - drop)^2. In it h h is taken as p h.
// It is exact for ground at sea level and, up to 9 km, for ground at the altitude of the observer.
SightSeries sight_series(const RaySight& sight) {
  const double altitude_m = sight.altitude_m, p_m = std::min(altitude_m, 9000.0);
  SightSeries series;
  series.altitude_m = static_cast<float>(altitude_m);
  if (!(sight.curvature > 0.0)) return series;
  RayLift lift = sight.lift;
  const double reach_m = static_cast<double>(sight.distance_m.empty() ? 0.0F : sight.distance_m.back());
  // Beyond max_square_m2 the quotient of the lift is taken to be constant.
  if (reach_m * reach_m > lift.max_square_m2) {
    lift.level += 0.5 * lift.max_square_m2 * lift.per_square;
    lift.per_height += 0.5 * lift.max_square_m2 * lift.per_both;
    lift.per_square = lift.per_both = 0.0;
  }
  // Squared distances are squared angles times the squared radius.
  const double radius_m = 1.0 / sight.curvature, square_m2 = radius_m * radius_m;
  const double steep = lift.level;
  series.fall = static_cast<float>(0.5 * (1.0 - 2.0 * altitude_m * steep) - lift.level * radius_m);
  series.fall_square =
      static_cast<float>(-1.0 / 24.0 - 0.25 * steep * radius_m - lift.per_square * square_m2 * radius_m);
  series.upright = static_cast<float>(1.0 + steep * (p_m - 2.0 * altitude_m));
  series.tilt = static_cast<float>(0.5 + steep * radius_m - lift.per_height * square_m2);
  series.tilt_square = static_cast<float>(-1.0 / 24.0 - lift.per_both * square_m2 * square_m2);
  series.altitude_m = static_cast<float>(altitude_m - steep * altitude_m * altitude_m);
  return series;
}

namespace {

// [m] Lower bound of the radii of curvature of WGS84. The smallest radius is the meridian's at the equator, 6335.4 km.
// Distance / kMinRadius_m is never less than the angle of the distance at the earth's centre. A larger radius would
// miss cells at a region's edge.
constexpr double kMinRadius_m = 6.33e6;

// Great-circle angle by the haversine formula.
double angle_between_deg(geo::GeoPoint a, geo::GeoPoint b) {
  const double half_latitude = (b.latitude_deg - a.latitude_deg) * geo::kRadiansPerDegree / 2;
  const double half_longitude = (b.longitude_deg - a.longitude_deg) * geo::kRadiansPerDegree / 2;
  const double haversine =
      std::pow(std::sin(half_latitude), 2) + std::cos(a.latitude_deg * geo::kRadiansPerDegree) *
                                                 std::cos(b.latitude_deg * geo::kRadiansPerDegree) *
                                                 std::pow(std::sin(half_longitude), 2);
  return 2 * std::asin(std::min(1.0, std::sqrt(haversine))) / geo::kRadiansPerDegree;
}

// [rad] Upper bound of the angle at the earth's centre over a distance on the ground; at most pi.
double angle_of(double radius_m) {
  return std::clamp(radius_m / kMinRadius_m, 0.0, geo::kRadiansPerDegree * 180.0);
}

}  // namespace

double angle_to_centre_deg(geo::GeoPoint point, CellCorner corner) {
  return angle_between_deg(point, {corner.south_deg + 0.5, corner.west_deg + 0.5});
}

// Conservative bound: a cell counts as touched if the circle through its corners meets the region's.
double touched_within_deg(double radius_m) {
  constexpr double kHalfDiagonal_deg = 0.7072;  // half the diagonal of a cell at the equator, the widest cell
  return angle_of(radius_m) / geo::kRadiansPerDegree + kHalfDiagonal_deg;
}

std::vector<CellCorner> cells_within(const TerrainRegion& region) {
  const double radius_rad = angle_of(region.radius_m);
  const double radius_deg = radius_rad / geo::kRadiansPerDegree;
  const geo::GeoPoint centre = region.centre;
  // A cell has its four edges: a circle that ends on a whole degree touches the cells on both sides.
  const auto last_below = [](double degrees) { return static_cast<int>(std::ceil(degrees)) - 1; };
  const int south = std::max(last_below(centre.latitude_deg - radius_deg), -90);
  const int north = cell_containing({centre.latitude_deg + radius_deg, 0}).south_deg;
  // In longitude the circle extends asin(sin(radius_rad) / cos(latitude of the centre)) to each side. If the circle
  // contains a pole, it meets all meridians.
  const bool over_pole = std::abs(centre.latitude_deg) + radius_deg >= 90.0;
  const double sine = over_pole ? 1.0 : std::sin(radius_rad) / std::cos(centre.latitude_deg * geo::kRadiansPerDegree);
  const double side_deg = over_pole || sine >= 1.0 ? 180.0 : std::asin(sine) / geo::kRadiansPerDegree;
  const int first = last_below(centre.longitude_deg - side_deg);
  const int last = std::min(static_cast<int>(std::floor(centre.longitude_deg + side_deg)), first + kCellColumns - 1);
  const double touched_deg = touched_within_deg(region.radius_m);
  std::vector<CellCorner> cells;
  for (int row = south; row <= north; ++row)
    for (int column = first; column <= last; ++column) {
      const CellCorner corner{row, cell_containing({0, column + 0.5}).west_deg};
      if (angle_to_centre_deg(centre, corner) <= touched_deg) cells.push_back(corner);
    }
  std::sort(cells.begin(), cells.end(), [](CellCorner a, CellCorner b) { return slot_of(a) < slot_of(b); });
  return cells;
}

}  // namespace yars::model::terrain
