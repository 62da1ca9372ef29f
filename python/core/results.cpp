#include "python/core/results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/geo/geodesy.hpp"

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

namespace {

py::ssize_t axis(std::size_t entries) {
  return static_cast<py::ssize_t>(entries);
}

// Turns azimuths [deg] of successive sweeps by whole turns, so that they ascend and the middle one is in [0, 360).
void make_continuous(std::vector<double>& azimuths) {
  for (std::size_t i = 1; i < azimuths.size(); ++i)
    azimuths[i] += 360.0 * std::round((azimuths[i - 1] - azimuths[i]) / 360.0);
  const double turns = std::floor(azimuths[azimuths.size() / 2] / 360.0);
  for (double& azimuth : azimuths) azimuth -= 360.0 * turns;
}

}  // namespace

py::array ScanResult::array(const std::string& name) {
  const auto self = shared_from_this();
  const std::vector<py::ssize_t> shape{axis(scan_.sweeps()), axis(scan_.samples())};
  if (name == "power") return array_of<float>(self, scan_.power().data(), shape);
  if (name == "video") {
    // The video of each sweep lies in its record.
    const std::uint8_t* const first = scan_.sweep(0)->video.data();
    const py::ssize_t stride = scan_.sweeps() > 1 ? scan_.sweep(1)->video.data() - first : shape[1];
    auto* const kept = new std::shared_ptr<const void>(self);
    const py::capsule keeper(kept, [](void* pointer) { delete static_cast<std::shared_ptr<const void>*>(pointer); });
    return read_only(py::array_t<std::uint8_t>(shape, std::vector<py::ssize_t>{stride, 1}, first, keeper));
  }
  if (name == "azimuth") {
    std::vector<double> azimuths;
    for (std::size_t i = 0; i < scan_.sweeps(); ++i) azimuths.push_back(scan_.sweep(i)->azimuth_deg);
    make_continuous(azimuths);
    return array_from(std::move(azimuths), {shape[0]});
  }
  const ScanLabels* computed = nullptr;
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    const auto taken = lock_.take(goes_on);
    computed = value_of(scan_.labels({.goes_on = goes_on}));
  });
  const ScanLabels& labels = *computed;
  if (name == "shadow") return flags_of(self, labels.shadow.data(), shape);
  if (name == "layover") return flags_of(self, labels.layover.data(), shape);
  if (name == "material") return array_of<std::uint8_t>(self, labels.material.data(), shape);
  if (name == "object") return array_of<std::int32_t>(self, labels.object.data(), shape);
  if (name == "ground_range") return array_of<double>(self, labels.ground_range_m.data(), shape);
  if (name == "slant_range") return array_of<double>(self, labels.slant_range_m.data(), shape);
  if (name == "latitude") return array_of<double>(self, labels.latitude_deg.data(), shape);
  if (name == "longitude") return array_of<double>(self, labels.longitude_deg.data(), shape);
  if (name == "height") return array_of<float>(self, labels.height_m.data(), shape);
  if (name == "grazing_angle") return array_of<float>(self, labels.grazing_deg.data(), shape);
  throw py::key_error(name);
}

py::dict ScanResult::facts() const {
  const ScanFacts found = scan_.facts();
  py::dict facts;
  facts["latitude"] = found.latitude_deg;
  facts["longitude"] = found.longitude_deg;
  facts["altitude_m"] = found.altitude_m;
  facts["ground_track"] = found.ground_track_deg;
  facts["elevation"] = found.elevation_deg;
  facts["range_m"] = found.range_m;
  facts["slant_range_samples"] = found.slant_range_samples;
  facts["fidelity"] = found.preset;
  return facts;
}

PatchResult::PatchResult(Patch patch) : patch_(std::move(patch)) {
  for (const float power : patch_.power())
    power_.push_back(power < 0.0F ? std::numeric_limits<float>::quiet_NaN() : power);
  for (const float sine : patch_.labels().sin_grazing)
    grazing_deg_.push_back(std::asin(sine) / static_cast<float>(geo::kRadiansPerDegree));
}

py::array PatchResult::centres(bool columns) const {
  const auto size = static_cast<std::size_t>(patch_.size());
  const double window_m = patch_.facts().window_m;
  const double pixel_m = window_m / static_cast<double>(size);
  std::vector<double> centres(size);
  for (std::size_t i = 0; i < size; ++i) {
    const double along_m = (static_cast<double>(i) + 0.5) * pixel_m - 0.5 * window_m;
    centres[i] = columns ? along_m : -along_m;
  }
  return array_from(std::move(centres), {axis(size)});
}

py::array PatchResult::array(const std::string& name) {
  const auto self = shared_from_this();
  const std::vector<py::ssize_t> shape{patch_.size(), patch_.size()};
  const PatchLabels labels = patch_.labels();
  if (name == "power") return array_of<float>(self, power_.data(), shape);
  if (name == "video") return array_of<std::uint8_t>(self, patch_.video().data(), shape);
  if (name == "shadow") return flags_of(self, labels.shadow.data(), shape);
  if (name == "layover") return flags_of(self, labels.layover.data(), shape);
  if (name == "object") return array_of<std::int32_t>(self, labels.object.data(), shape);
  if (name == "material") return array_of<std::uint8_t>(self, labels.material.data(), shape);
  if (name == "height") return array_of<float>(self, labels.height_m.data(), shape);
  if (name == "grazing_angle") return array_of<float>(self, grazing_deg_.data(), shape);
  if (name == "x" || name == "y") return centres(name == "x");
  const std::vector<double> PatchPositions::* numbers = name == "latitude"       ? &PatchPositions::latitude_deg
                                                        : name == "longitude"    ? &PatchPositions::longitude_deg
                                                        : name == "ground_range" ? &PatchPositions::ground_range_m
                                                        : name == "slant_range"  ? &PatchPositions::slant_range_m
                                                                                 : nullptr;
  if (numbers == nullptr) throw py::key_error(name);
  without_interpreter([&](const parallel::GoesOn& goes_on) {
    const auto taken = lock_.take(goes_on);
    if (!positions_) positions_ = patch_.positions();
  });
  return array_of<double>(self, (*positions_.*numbers).data(), shape);
}

py::dict PatchResult::facts() const {
  const PatchFacts found = patch_.facts();
  py::dict facts;
  facts["latitude"] = found.latitude_deg;
  facts["longitude"] = found.longitude_deg;
  facts["altitude_m"] = found.altitude_m;
  facts["ground_track"] = found.ground_track_deg;
  facts["target_latitude"] = found.target_latitude_deg;
  facts["target_longitude"] = found.target_longitude_deg;
  facts["target_height_m"] = found.target_height_m;
  facts["window_m"] = found.window_m;
  facts["up"] = found.up_deg;
  facts["ground_range_m"] = found.ground_range_m;
  facts["slant_range_m"] = found.slant_range_m;
  facts["grazing_angle"] = found.grazing_deg;
  facts["resolution_m"] = found.resolution_m;
  facts["formation_s"] = found.formation_s;
  facts["looks"] = found.looks;
  facts["fidelity"] = found.preset;
  return facts;
}

void add_results(py::module_& module) {
  py::class_<ScanResult, std::shared_ptr<ScanResult>> scan(module, "ScanResult");
  scan.def("array", &ScanResult::array)
      .def_property_readonly("hash", &ScanResult::hash)
      .def("facts", &ScanResult::facts);
  seal(scan);
  py::class_<PatchResult, std::shared_ptr<PatchResult>> patch(module, "PatchResult");
  patch.def("array", &PatchResult::array)
      .def_property_readonly("hash", &PatchResult::hash)
      .def("facts", &PatchResult::facts);
  seal(patch);
}

}  // namespace yars::python
