#include "python/core/patch_boxes.hpp"

#include <algorithm>
#include <cmath>

#include "lib/geo/earth.hpp"

namespace yars::python {

namespace hrm = model::hrm;

Geo geo_of(const PatchFacts& facts) {
  Geo geo{};
  geo.origin_latitude = facts.latitude_deg;
  geo.origin_longitude = facts.longitude_deg;
  std::ranges::copy(facts.plane_from_pixel, &geo.plane_from_pixel[0]);
  geo.up_deg = facts.up_deg;
  geo.distance_m = facts.ground_range_m;
  geo.slant_range_m = facts.slant_range_m;
  geo.grazing_deg = facts.grazing_deg;
  geo.plane_msl_m = facts.target_height_m;
  geo.window_m = facts.window_m;
  geo.resolution_m = facts.resolution_m;
  return geo;
}

struct GroupOnMap {
  GroupOnMap(const hrm::PatchGeometry& geometry, geo::GeoPoint origin) : at(geometry.point_of(origin)) {
    constexpr double kStep_m = 200.0;
    const geo::AzimuthalEquidistant plane(origin);
    const hrm::MapPoint to_east = geometry.point_of(plane.geodetic_from_plane({kStep_m, 0.0}));
    const hrm::MapPoint to_north = geometry.point_of(plane.geodetic_from_plane({0.0, kStep_m}));
    east = {(to_east.right_m - at.right_m) / kStep_m, (to_east.up_m - at.up_m) / kStep_m};
    north = {(to_north.right_m - at.right_m) / kStep_m, (to_north.up_m - at.up_m) / kStep_m};
  }
  hrm::MapPoint of(double east_m, double north_m) const {
    return {at.right_m + east.right_m * east_m + north.right_m * north_m,
            at.up_m + east.up_m * east_m + north.up_m * north_m};
  }
  hrm::MapPoint at, east, north;
};

namespace {
// Factor on the distance over ground of a point that is `height_m` above the map plane: it appears at its bearing and
// slant range.
double layover_factor(const hrm::PatchGeometry& geometry, hrm::MapPoint point, double height_m) {
  const double ahead_m = point.up_m + geometry.distance_m();
  const double distance_m = std::sqrt(point.right_m * point.right_m + ahead_m * ahead_m);
  if (!(distance_m > 0.0)) return 1.0;
  return hrm::laid_over_m(distance_m, height_m, geometry.above_level_m(distance_m)) / distance_m;
}
}  // namespace

void Boxes::add(std::int64_t order, const hrm::PatchGeometry& geometry, std::span<const std::int32_t> labels) {
  for (const std::int32_t object : labels)
    if (object >= 0) ++pixels_[static_cast<std::size_t>(object)];
  const geo::GeoPoint centre = geometry.position_of({});
  for (const radar::FootprintGroup& group : scene_.parts().groups) {
    const double north_m = (group.origin.latitude_deg - centre.latitude_deg) * geo::kMetresPerDegree;
    if (std::abs(north_m) > 1.1 * (group.reach_m + geometry.window_m())) continue;
    const GroupOnMap transform(geometry, group.origin);
    const double reach_m = 0.5 * geometry.window_m() + group.reach_m;
    if (std::abs(transform.at.right_m) > reach_m || std::abs(transform.at.up_m) > 1.5 * reach_m) continue;
    for (const radar::Footprint& footprint : group.footprints) add_box(order, geometry, transform, footprint);
  }
  for (const std::int32_t object : labels)
    if (object >= 0) pixels_[static_cast<std::size_t>(object)] = 0;
}

void Boxes::add_box(std::int64_t order, const hrm::PatchGeometry& geometry, const GroupOnMap& transform,
                    const radar::Footprint& footprint) {
  const double pixels_per_m = size_ / geometry.window_m();
  const hrm::MapPoint middle = transform.of(footprint.east_m, footprint.north_m);
  // One factor serves the whole footprint, because it changes little over an object.
  const double factor = layover_factor(geometry, middle, footprint.base_msl_m - geometry.plane_msl_m());
  Box box{};
  box.pixels = pixels_[static_cast<std::size_t>(footprint.object)];
  if (box.pixels < min_pixels_) return;
  float left = 1e9F, right = -1e9F, top = 1e9F, bottom = -1e9F;
  constexpr int kSigns[4][2] = {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  for (int k = 0; k < 4; ++k) {
    const double along_m = kSigns[k][0] * footprint.half_length_m, across_m = kSigns[k][1] * footprint.half_width_m;
    const hrm::MapPoint point =
        transform.of(footprint.east_m + along_m * footprint.sine + across_m * footprint.cosine,
                     footprint.north_m + along_m * footprint.cosine - across_m * footprint.sine);
    const double up_m = (point.up_m + geometry.distance_m()) * factor - geometry.distance_m();
    box.corners[k][0] = static_cast<float>((point.right_m * factor + 0.5 * geometry.window_m()) * pixels_per_m);
    box.corners[k][1] = static_cast<float>((0.5 * geometry.window_m() - up_m) * pixels_per_m);
    left = std::min(left, box.corners[k][0]);
    right = std::max(right, box.corners[k][0]);
    top = std::min(top, box.corners[k][1]);
    bottom = std::max(bottom, box.corners[k][1]);
  }
  const auto edge = static_cast<float>(size_);
  const bool overlaps = right > 0.0F && left < edge && bottom > 0.0F && top < edge;
  if (!overlaps && box.pixels == 0) return;
  box.order = order;
  box.object = footprint.object;
  const double off_deg = std::atan(middle.right_m / (middle.up_m + geometry.distance_m())) / geo::kRadiansPerDegree;
  const double aspect_deg = geometry.up().degrees() + off_deg - footprint.heading_deg + 720.0;
  box.aspect_deg = static_cast<float>(aspect_deg - 180.0 * std::floor(aspect_deg / 180.0));
  boxes_.push_back(box);
}

}  // namespace yars::python
