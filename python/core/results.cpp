#include "python/core/results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/geo/earth.hpp"
#include "lib/radar/mapping.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "tools/patch/patch_setup.hpp"
#include "tools/trade/scan_errors.hpp"

namespace yars::python {

namespace {
namespace hrm = model::hrm;
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

py::ssize_t axis(std::size_t entries) {
  return static_cast<py::ssize_t>(entries);
}

// Index of the object whose box, seen from above, contains a position; -1: none. Of several the last one.
std::int32_t object_at(const Scene& scene, geo::GeoPoint position) {
  std::int32_t found = -1;
  for (const FootprintGroup& group : scene.groups()) {
    const double north_deg = std::abs(position.latitude_deg - group.origin.latitude_deg);
    if (north_deg * geo::kMetresPerDegree > 1.1 * group.reach_m) continue;
    const geo::PlanePoint at = geo::AzimuthalEquidistant(group.origin).plane_from_geodetic(position);
    if (std::hypot(at.x_m, at.y_m) > group.reach_m) continue;
    for (const Footprint& footprint : group.footprints) {
      const double east_m = at.x_m - footprint.east_m, north_m = at.y_m - footprint.north_m;
      if (std::abs(east_m * footprint.sine + north_m * footprint.cosine) <= footprint.half_length_m &&
          std::abs(east_m * footprint.cosine - north_m * footprint.sine) <= footprint.half_width_m)
        found = footprint.object;
    }
  }
  return found;
}
}  // namespace

ScanResult::ScanResult(const radar::RadarConfiguration& configuration, Parts parts, std::shared_ptr<Scene> scene)
    : configuration_(configuration),
      scan_(std::move(parts.scan)),
      environment_(std::move(parts.environment)),
      scene_(std::move(scene)) {}

namespace {

ScanLabels empty_labels(std::size_t count) {
  ScanLabels labels;
  for (auto* flags : {&labels.shadow, &labels.layover, &labels.material}) *flags = std::vector<std::uint8_t>(count);
  labels.object.assign(count, -1);
  for (auto* numbers : {&labels.ground_range_m, &labels.slant_range_m, &labels.latitude_deg, &labels.longitude_deg})
    numbers->assign(count, kNoNumber);
  for (auto* numbers : {&labels.height_m, &labels.grazing_deg})
    numbers->assign(count, std::numeric_limits<float>::quiet_NaN());
  return labels;
}

// Fills in layover. A lit sample is laid over if a nearer one is seen at a greater slant range, or a farther one at a
// lesser. `first`: of the sweep's samples.
void label_layover(ScanLabels& labels, std::size_t first, std::size_t samples) {
  const auto lit = [&](std::size_t i) { return labels.shadow[i] == 0 && !std::isnan(labels.height_m[i]); };
  double farthest_m = 0.0;
  for (std::size_t i = first; i < first + samples; ++i) {
    if (!lit(i)) continue;
    labels.layover[i] = labels.slant_range_m[i] < farthest_m ? 1 : 0;
    farthest_m = std::max(farthest_m, labels.slant_range_m[i]);
  }
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = first + samples; i-- > first;) {
    if (!lit(i)) continue;
    if (labels.slant_range_m[i] > nearest_m) labels.layover[i] = 1;
    nearest_m = std::min(nearest_m, labels.slant_range_m[i]);
  }
}

// Fills in all labels of a sweep but the layover. `first`: of the sweep's samples.
void label_samples(ScanLabels& to, std::size_t first, std::span<const tools::trade::RaySample> samples,
                   const model::physics::SweepGeometry& geometry, const model::physics::EffectiveEarth& earth,
                   const Scene* scene) {
  double before_m = 0.0, before_height_m = kNoNumber;
  for (std::size_t i = first; i < first + samples.size(); ++i) {
    const tools::trade::RaySample& sample = samples[i - first];
    to.latitude_deg[i] = sample.position.latitude_deg;
    to.longitude_deg[i] = sample.position.longitude_deg;
    if (std::isnan(sample.distance_m)) continue;
    to.ground_range_m[i] = sample.distance_m;
    const double height_m = sample.ground.elevation_m;
    if (std::isnan(height_m)) continue;
    const model::physics::Sight sight = earth.sight(geometry.altitude.metres(), sample.distance_m, height_m);
    to.slant_range_m[i] = sight.slant_range_m;
    to.height_m[i] = static_cast<float>(height_m);
    to.shadow[i] = sample.lit ? 0 : 1;
    to.material[i] = sample.ground.material == 0 && sample.ground.water > 0.5
                         ? static_cast<std::uint8_t>(radar::kWaterMaterial)
                         : sample.ground.material;
    if (scene != nullptr) to.object[i] = object_at(*scene, sample.position);
    // Grazing angle on the profile: that on the level, plus the slope from the sample before.
    const double slope_rad =
        std::isnan(before_height_m) ? 0.0 : std::atan2(height_m - before_height_m, sample.distance_m - before_m);
    if (sample.lit) {
      const double grazing_deg =
          (std::asin(std::clamp(sight.sin_grazing, -1.0, 1.0)) + slope_rad) / geo::kRadiansPerDegree;
      // Below the aircraft a slope that faces it may be seen from beyond its perpendicular.
      to.grazing_deg[i] = static_cast<float>(std::max(std::min(grazing_deg, 180.0 - grazing_deg), 0.0));
    }
    before_m = sample.distance_m;
    before_height_m = height_m;
  }
}

}  // namespace

void ScanResult::compute_labels(const parallel::GoesOn& goes_on) {
  const auto taken = lock_.take(goes_on);
  if (labels_) return;
  const auto samples = tools::trade::ray_samples(configuration_, scan_.headers, *environment_.terrain, goes_on);
  auto labels = std::make_unique<ScanLabels>(empty_labels(samples.size()));
  const std::size_t width = samples.size() / scan_.headers.size();
  for (std::size_t sweep = 0; sweep < scan_.headers.size(); ++sweep) {
    const auto geometry = model::kernel::geometry_of(scan_.headers[sweep]);
    const auto earth = model::physics::effective_earth(configuration_.fidelity, geometry.apex, geometry.azimuth);
    label_samples(*labels, sweep * width, std::span(samples).subspan(sweep * width, width), geometry, earth,
                  scene_.get());
    label_layover(*labels, sweep * width, width);
  }
  labels_ = std::move(labels);
}

namespace {
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
  const std::size_t sweeps = scan_.headers.size();
  const std::vector<py::ssize_t> shape{axis(sweeps), axis(scan_.power.size() / sweeps)};
  if (name == "power") return array_of<float>(self, scan_.power.data(), shape);
  if (name == "video") {
    const databuffer::Sweep& first = scan_.sweeps.front();
    auto* const kept = new std::shared_ptr<const void>(self);
    const py::capsule keeper(kept, [](void* pointer) { delete static_cast<std::shared_ptr<const void>*>(pointer); });
    return read_only(py::array_t<std::uint8_t>(shape, std::vector<py::ssize_t>{axis(sizeof(databuffer::Sweep)), 1},
                                               &first.video[0], keeper));
  }
  if (name == "azimuth") {
    std::vector<double> azimuths;
    for (const auto& header : scan_.headers) azimuths.push_back(model::kernel::geometry_of(header).azimuth.degrees());
    make_continuous(azimuths);
    return array_from(std::move(azimuths), {shape[0]});
  }
  without_interpreter([this](const parallel::GoesOn& goes_on) { compute_labels(goes_on); });
  const ScanLabels& labels = *labels_;
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

std::uint64_t ScanResult::hash() const {
  return model::kernel::scan_hash(scan_.sweeps);
}

py::dict ScanResult::facts() const {
  const model::kernel::SweepHeader& header = scan_.headers.front();
  py::dict facts;
  facts["latitude"] = header.apex.latitude_deg;
  facts["longitude"] = header.apex.longitude_deg;
  facts["altitude_m"] = header.altitude.metres();
  facts["ground_track"] = header.ground_track.degrees();
  facts["elevation"] = header.elevation.degrees();
  facts["range_m"] = header.range.metres();
  facts["slant_range_samples"] = configuration_.fidelity.slant_range;
  facts["fidelity"] = configuration_.fidelity.name;
  return facts;
}

PatchResult::Parts PatchResult::parts_of(hrm::PatchFormation& formation) {
  return {formation.geometry(), formation.take_result(), formation.formation().seconds()};
}

PatchResult::PatchResult(Parts parts, const hrm::PatchOrder& order, std::string fidelity)
    : geometry_(parts.geometry),
      order_(order),
      formation_s_(parts.formation_s),
      fidelity_(std::move(fidelity)),
      map_(std::move(parts.map)) {
  for (float& power : map_.image.power)
    if (power < 0.0F) power = std::numeric_limits<float>::quiet_NaN();  // the blind zone
  for (const float sine : map_.labels.sin_grazing)
    grazing_deg_.push_back(std::asin(sine) / static_cast<float>(geo::kRadiansPerDegree));
}

namespace {
// Calls take() for the centre of each pixel, row after row.
template <class Take>
void for_pixels(int size, double window_m, const Take& take) {
  const double pixel_m = window_m / size;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      take(hrm::MapPoint{(column + 0.5) * pixel_m - 0.5 * window_m, 0.5 * window_m - (row + 0.5) * pixel_m});
}
}  // namespace

PatchResult::Places PatchResult::positions() const {
  std::vector<double> latitude_deg, longitude_deg;
  for_pixels(map_.image.size, geometry_.window_m(), [&](hrm::MapPoint point) {
    const geo::GeoPoint position = geometry_.position_of(point);
    latitude_deg.push_back(position.latitude_deg);
    longitude_deg.push_back(position.longitude_deg);
  });
  return {{"latitude", std::move(latitude_deg)}, {"longitude", std::move(longitude_deg)}};
}

PatchResult::Places PatchResult::ranges() const {
  const double above_m = geometry_.altitude_m() - geometry_.plane_msl_m();
  std::vector<double> ground_range_m, slant_range_m;
  for_pixels(map_.image.size, geometry_.window_m(), [&](hrm::MapPoint point) {
    ground_range_m.push_back(std::hypot(point.right_m, point.up_m + geometry_.distance_m()));
    slant_range_m.push_back(geometry_.earth().sight(above_m, ground_range_m.back(), 0.0).slant_range_m);
  });
  return {{"ground_range", std::move(ground_range_m)}, {"slant_range", std::move(slant_range_m)}};
}

py::array PatchResult::array(const std::string& name) {
  const auto self = shared_from_this();
  const auto size = static_cast<std::size_t>(map_.image.size);
  const std::vector<py::ssize_t> shape{axis(size), axis(size)};
  const hrm::PixelLabels& labels = map_.labels;
  if (name == "power") return array_of<float>(self, map_.image.power.data(), shape);
  if (name == "video") return array_of<std::uint8_t>(self, map_.picture.data(), shape);
  if (name == "shadow") return flags_of(self, labels.shadow.data(), shape);
  if (name == "layover") return flags_of(self, labels.layover.data(), shape);
  if (name == "object") return array_of<std::int32_t>(self, labels.object.data(), shape);
  if (name == "material") return array_of<std::uint8_t>(self, labels.material.data(), shape);
  if (name == "height") return array_of<float>(self, labels.height_m.data(), shape);
  if (name == "grazing_angle") return array_of<float>(self, grazing_deg_.data(), shape);
  if (name == "x" || name == "y") {
    const double pixel_m = geometry_.window_m() / static_cast<double>(size);
    std::vector<double> centres(size);
    for (std::size_t i = 0; i < size; ++i) {
      const double along_m = (static_cast<double>(i) + 0.5) * pixel_m - 0.5 * geometry_.window_m();
      centres[i] = name == "x" ? along_m : -along_m;
    }
    return array_from(std::move(centres), {axis(size)});
  }
  const bool is_range = name == "ground_range" || name == "slant_range";
  if (is_range || name == "latitude" || name == "longitude") {
    const double* data = nullptr;
    without_interpreter([&](const parallel::GoesOn& goes_on) {
      const auto taken = lock_.take(goes_on);
      if (!places_.contains(name)) places_.merge(is_range ? ranges() : positions());
      data = places_.at(name).data();
    });
    return array_of<double>(self, data, shape);
  }
  throw py::key_error(name);
}

std::uint64_t PatchResult::hash() const {
  return tools::picture_hash(map_.picture);
}

py::dict PatchResult::facts() const {
  py::dict facts;
  facts["latitude"] = order_.apex.latitude_deg;
  facts["longitude"] = order_.apex.longitude_deg;
  facts["altitude_m"] = order_.altitude.metres();
  facts["ground_track"] = order_.ground_track.degrees();
  facts["target_latitude"] = order_.centre.latitude_deg;
  facts["target_longitude"] = order_.centre.longitude_deg;
  facts["target_height_m"] = geometry_.plane_msl_m();
  facts["window_m"] = geometry_.window_m();
  facts["up"] = geometry_.up().degrees();
  facts["ground_range_m"] = geometry_.distance_m();
  facts["slant_range_m"] = geometry_.slant_range_m();
  facts["grazing_angle"] = std::asin(geometry_.sin_grazing()) / geo::kRadiansPerDegree;
  facts["resolution_m"] = radar::map_resolution(order_.window).metres();
  facts["formation_s"] = formation_s_;
  facts["looks"] = order_.looks;
  facts["fidelity"] = fidelity_;
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
