#include "model/scene/placement/plan_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

}  // namespace yars::model::scene
