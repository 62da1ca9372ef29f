#include "model/scene/placement/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"

namespace yars::model::scene {

LocalMap::LocalMap(const geo::AzimuthalEquidistant& from, geo::PlanePoint middle)
    : middle_(middle), to_(from.geodetic_from_plane(middle)) {
  constexpr double kStep_m = 256.0;  // offset to either side of `middle`, for central differences along the axes
  const auto slope = [&](double east, double north, geo::PlanePoint& moved, double& latitude, double& longitude) {
    const geo::GeoPoint ahead = from.geodetic_from_plane({middle.x_m + kStep_m * east, middle.y_m + kStep_m * north});
    const geo::GeoPoint behind = from.geodetic_from_plane({middle.x_m - kStep_m * east, middle.y_m - kStep_m * north});
    const geo::PlanePoint a = to_.plane_from_geodetic(ahead), b = to_.plane_from_geodetic(behind);
    moved = {(a.x_m - b.x_m) / (2 * kStep_m), (a.y_m - b.y_m) / (2 * kStep_m)};
    latitude = (ahead.latitude_deg - behind.latitude_deg) / (2 * kStep_m);
    longitude = geo::wrapped_degrees(ahead.longitude_deg - behind.longitude_deg) / (2 * kStep_m);
  };
  slope(1.0, 0.0, east_, latitude_.x_m, longitude_.x_m);
  slope(0.0, 1.0, north_, latitude_.y_m, longitude_.y_m);
}

namespace {

// Twice the signed area of the triangle (a, b, c); positive for a left turn at b.
double turn(geo::PlanePoint a, geo::PlanePoint b, geo::PlanePoint c) {
  return (b.x_m - a.x_m) * (c.y_m - a.y_m) - (b.y_m - a.y_m) * (c.x_m - a.x_m);
}

// Convex hull, counter-clockwise, without repeating the first point (Andrew's monotone chain).
std::vector<geo::PlanePoint> hull_of(std::vector<geo::PlanePoint>& points) {
  std::sort(points.begin(), points.end(),
            [](geo::PlanePoint a, geo::PlanePoint b) { return a.x_m != b.x_m ? a.x_m < b.x_m : a.y_m < b.y_m; });
  const auto same = [](geo::PlanePoint a, geo::PlanePoint b) { return a.x_m == b.x_m && a.y_m == b.y_m; };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
  if (points.size() < 3) return points;
  std::vector<geo::PlanePoint> hull;
  const auto add = [&hull](geo::PlanePoint point, std::size_t fixed) {
    while (hull.size() >= fixed + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0.0) hull.pop_back();
    hull.push_back(point);
  };
  for (const geo::PlanePoint& point : points) add(point, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
  hull.pop_back();
  return hull;
}

// Bounding box of the hull with sides along a direction.
Footprint box_along(const std::vector<geo::PlanePoint>& hull, double direction_rad) {
  const double c = std::cos(direction_rad), s = std::sin(direction_rad);
  double along_min = std::numeric_limits<double>::infinity(), along_max = -along_min;
  double across_min = along_min, across_max = -along_min;
  for (const geo::PlanePoint& point : hull) {
    const double along = point.x_m * c + point.y_m * s;
    const double across = point.y_m * c - point.x_m * s;
    along_min = std::min(along_min, along);
    along_max = std::max(along_max, along);
    across_min = std::min(across_min, across);
    across_max = std::max(across_max, across);
  }
  const double along = (along_min + along_max) / 2, across = (across_min + across_max) / 2;
  return {
      {along * c - across * s, along * s + across * c}, along_max - along_min, across_max - across_min, direction_rad};
}

}  // namespace

Footprint footprint_of(std::vector<geo::PlanePoint>& points) {
  if (points.empty()) return {};
  const std::vector<geo::PlanePoint> hull = hull_of(points);
  Footprint smallest = box_along(hull, 0.0);
  for (std::size_t i = 0; i < hull.size() && hull.size() > 1; ++i) {
    const geo::PlanePoint a = hull[i], b = hull[(i + 1) % hull.size()];
    const Footprint box = box_along(hull, std::atan2(b.y_m - a.y_m, b.x_m - a.x_m));
    if (box.length_m * box.width_m < smallest.length_m * smallest.width_m * (1.0 - 1e-9)) smallest = box;
  }
  if (smallest.width_m > smallest.length_m) {
    std::swap(smallest.length_m, smallest.width_m);
    smallest.direction_rad += std::numbers::pi / 2;
  }
  smallest.direction_rad = std::fmod(smallest.direction_rad + 4 * std::numbers::pi, std::numbers::pi);
  return smallest;
}

namespace {

constexpr double kMaxCellsAcross = 512;  // [cells] searches with a larger diameter test every disc

geo::Vector3 on_earth(geo::GeoPoint position) {
  return geo::ecef_from_geodetic(position, geo::HeightAboveEllipsoid::metres(0.0));
}

// [m] Length of the arc between two points, from their chord, to third order. `a`, `b`: ECEF coordinates [m].
double arc_m(geo::Vector3 a, geo::Vector3 b) {
  const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  const double square = x * x + y * y + z * z;
  return std::sqrt(square) * (1.0 + square / (24.0 * geo::kMeanEarthRadius_m * geo::kMeanEarthRadius_m));
}

std::uint64_t key_of(std::int64_t row, std::int64_t column) {
  return static_cast<std::uint64_t>(row) << 32U | static_cast<std::uint64_t>(column);
}

}  // namespace

GridIndex::GridIndex(const std::vector<Disc>& discs, double cell_deg) : cell_deg_(cell_deg) {
  const double large_m = 2.0 * cell_deg * geo::kMinMetresPerDegree;  // discs with a larger radius get no cell
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
  for (const Disc& disc : discs) {
    const auto number = static_cast<std::uint32_t>(middles_.size());
    middles_.push_back(on_earth(disc.middle));
    radii_m_.push_back(disc.radius_m);
    if (disc.radius_m > large_m) {
      large_.push_back(number);
      continue;
    }
    max_radius_m_ = std::max(max_radius_m_, disc.radius_m);
    const Row row = row_of(disc.middle.latitude_deg);
    keyed.emplace_back(key_of(row.number, column_of(row, disc.middle.longitude_deg)), number);
  }
  std::sort(keyed.begin(), keyed.end());
  for (const auto& [key, number] : keyed) {
    const auto at = static_cast<std::uint32_t>(ordered_.size());
    cells_.try_emplace(key, at, at).first->second.second = at + 1;
    ordered_.push_back(number);
  }
}

GridIndex::Row GridIndex::row_of(double latitude_deg) const {
  Row row;
  row.number = static_cast<std::int64_t>(std::floor((std::clamp(latitude_deg, -90.0, 90.0) + 90.0) / cell_deg_));
  const double middle_deg = std::min(90.0, (static_cast<double>(row.number) + 0.5) * cell_deg_ - 90.0);
  row.columns = std::max<std::int64_t>(
      1, static_cast<std::int64_t>(360.0 * std::cos(middle_deg * geo::kRadiansPerDegree) / cell_deg_));
  return row;
}

std::int64_t GridIndex::column_of(const Row& row, double longitude_deg) const {
  const double fraction = (geo::wrapped_degrees(longitude_deg) + 180.0) / 360.0;
  return std::clamp<std::int64_t>(static_cast<std::int64_t>(fraction * static_cast<double>(row.columns)), 0,
                                  row.columns - 1);
}

void GridIndex::test(std::uint32_t disc, geo::Vector3 position, double radius_m, std::vector<Hit>& hits) const {
  const double distance_m = arc_m(middles_[disc], position);
  if (distance_m <= radius_m + radii_m_[disc]) hits.push_back({disc, distance_m});
}

namespace {
// Greatest difference of longitude [deg] between the centre of a circle and a point in it. `half_deg`: radius of the
// circle [deg]. 360 if the circle contains a pole. Where a meridian touches the circle, sin(difference) = sin(radius) /
// cos(latitude).
double longitude_reach_deg(double latitude_deg, double half_deg) {
  constexpr double kMargin = 1.02;  // for the earth's flattening
  if (std::abs(latitude_deg) + kMargin * half_deg >= 90.0) return 360.0;
  const double sine =
      std::sin(kMargin * half_deg * geo::kRadiansPerDegree) / std::cos(latitude_deg * geo::kRadiansPerDegree);
  return std::asin(std::min(sine, 1.0)) / geo::kRadiansPerDegree;
}
}  // namespace

void GridIndex::find_in_row(std::int64_t number, geo::GeoPoint position, double half_deg, geo::Vector3 at,
                            double radius_m, std::vector<Hit>& hits) const {
  const Row row = row_of((static_cast<double>(number) + 0.5) * cell_deg_ - 90.0);
  const double half_width_deg = longitude_reach_deg(position.latitude_deg, half_deg);
  const double column_deg = 360.0 / static_cast<double>(row.columns);
  const auto half = static_cast<std::int64_t>(std::min(half_width_deg / column_deg, 1e9)) + 1;
  const std::int64_t middle = column_of(row, position.longitude_deg);
  const bool all = 2 * half + 1 >= row.columns;
  const std::int64_t first = all ? 0 : middle - half;
  const std::int64_t last = all ? row.columns - 1 : middle + half;
  for (std::int64_t column = first; column <= last; ++column) {
    const auto cell = cells_.find(key_of(number, (column + row.columns) % row.columns));
    if (cell == cells_.end()) continue;
    for (std::uint32_t i = cell->second.first; i < cell->second.second; ++i) test(ordered_[i], at, radius_m, hits);
  }
}

void GridIndex::find(geo::GeoPoint position, double radius_m, std::vector<Hit>& hits) const {
  const geo::Vector3 at = on_earth(position);
  for (const std::uint32_t disc : large_) test(disc, at, radius_m, hits);
  if (ordered_.empty()) return;
  const double half_deg = (radius_m + max_radius_m_) / geo::kMinMetresPerDegree;
  const double across = 2.0 * half_deg / cell_deg_;
  // With few discs, testing every disc costs less than visiting all cells of the search.
  if (across > kMaxCellsAcross || across * across > static_cast<double>(ordered_.size()) + 64.0) {
    for (const std::uint32_t disc : ordered_) test(disc, at, radius_m, hits);
    return;
  }
  const std::int64_t first = row_of(position.latitude_deg - half_deg).number;
  const std::int64_t last = row_of(position.latitude_deg + half_deg).number;
  for (std::int64_t row = first; row <= last; ++row) find_in_row(row, position, half_deg, at, radius_m, hits);
}

std::uint64_t GridIndex::bytes() const {
  return middles_.capacity() * sizeof(geo::Vector3) + radii_m_.capacity() * sizeof(double) +
         (large_.capacity() + ordered_.capacity()) * sizeof(std::uint32_t) + cells_.size() * 64;
}

namespace {
constexpr std::uint32_t kLeaf = 16;       // largest number of balls in a leaf
constexpr double kRounding = 1.0 + 1e-6;  // factor on a node's radius, larger than the rounding to float
constexpr double kRounding_m = 0.01;      // [m] covers the rounding of centres up to 80 km from the origin
}  // namespace

SphereTree::SphereTree(const std::vector<Ball>& balls, std::vector<std::uint32_t>& order) {
  order.resize(balls.size());
  std::iota(order.begin(), order.end(), 0U);
  if (!balls.empty()) build(balls, order, 0, static_cast<std::uint32_t>(balls.size()));
}

void SphereTree::build(const std::vector<Ball>& balls, std::vector<std::uint32_t>& order, std::uint32_t first,
                       std::uint32_t end) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  geo::Vector3 min{kFar, kFar, kFar}, max{-kFar, -kFar, -kFar};
  for (std::uint32_t i = first; i < end; ++i) {
    const geo::Vector3 at = balls[order[i]].middle;
    min = {std::min(min.x, at.x), std::min(min.y, at.y), std::min(min.z, at.z)};
    max = {std::max(max.x, at.x), std::max(max.y, at.y), std::max(max.z, at.z)};
  }
  const geo::Vector3 middle = 0.5 * (min + max);
  double radius_m = 0.0;
  for (std::uint32_t i = first; i < end; ++i)
    radius_m = std::max(radius_m, length(balls[order[i]].middle - middle) + balls[order[i]].radius_m);
  const std::size_t own = nodes_.size();
  nodes_.push_back({static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z),
                    static_cast<float>(radius_m * kRounding + kRounding_m), first, end, 0});
  if (end - first > kLeaf) {
    const bool by_x = max.x - min.x >= max.y - min.y;
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      const double at_a = by_x ? balls[a].middle.x : balls[a].middle.y;
      const double at_b = by_x ? balls[b].middle.x : balls[b].middle.y;
      return at_a != at_b ? at_a < at_b : a < b;
    };
    const std::uint32_t half = first + (end - first) / 2;
    std::nth_element(order.begin() + first, order.begin() + half, order.begin() + end, before);
    build(balls, order, first, half);
    build(balls, order, half, end);
  }
  nodes_[own].skip_to = static_cast<std::uint32_t>(nodes_.size());
}

}  // namespace yars::model::scene
