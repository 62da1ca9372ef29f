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

ScanResult::ScanResult(const radar::RadarConfiguration& configuration, const model::kernel::ScanRequest& request,
                       int threads, tools::ScanEnvironment environment, std::shared_ptr<Scene> scene)
    : configuration_(configuration), environment_(std::move(environment)), scene_(std::move(scene)) {
  model::kernel::OfflineScan work(configuration_, request, threads);
  work.run({*environment_.terrain, environment_.scene.get()});
  scan_ = work.take_result();  // without its threads
}

// Fills the labels of one sweep that need its neighbours: grazing angle and layover.
void ScanResult::label_sweep(std::size_t sweep, std::size_t samples) {
  const std::size_t first = sweep * samples;
  const auto lit = [&](std::size_t i) {
    return labels_.shadow[first + i] == 0 && !std::isnan(labels_.height_m[first + i]);
  };
  // A lit sample is laid over if a nearer one is seen at a greater slant range, or a farther one at a lesser.
  double farthest_m = 0.0;
  for (std::size_t i = 0; i < samples; ++i) {
    if (!lit(i)) continue;
    const double slant_m = labels_.slant_range_m[first + i];
    labels_.layover[first + i] = slant_m < farthest_m ? 1 : 0;
    farthest_m = std::max(farthest_m, slant_m);
  }
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = samples; i-- > 0;) {
    if (!lit(i)) continue;
    const double slant_m = labels_.slant_range_m[first + i];
    if (slant_m > nearest_m) labels_.layover[first + i] = 1;
    nearest_m = std::min(nearest_m, slant_m);
  }
}

const ScanLabels& ScanResult::labels() {
  std::call_once(labelled_, [this] {
    const auto samples = tools::trade::ray_samples(configuration_, scan_.headers, *environment_.terrain);
    const std::size_t count = samples.size();
    const std::size_t width = count / scan_.headers.size();
    ScanLabels& to = labels_;
    for (auto* flags : {&to.shadow, &to.layover, &to.material}) flags->assign(count, 0);
    to.object.assign(count, -1);
    for (auto* numbers : {&to.ground_range_m, &to.slant_range_m, &to.latitude_deg, &to.longitude_deg})
      numbers->assign(count, kNoNumber);
    for (auto* numbers : {&to.height_m, &to.grazing_deg})
      numbers->assign(count, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t sweep = 0; sweep < scan_.headers.size(); ++sweep) {
      const auto geometry = model::kernel::geometry_of(scan_.headers[sweep]);
      const auto earth = model::physics::effective_earth(configuration_.fidelity, geometry.apex, geometry.azimuth);
      double before_m = 0.0, before_height_m = kNoNumber;
      for (std::size_t i = sweep * width; i < (sweep + 1) * width; ++i) {
        const tools::trade::RaySample& sample = samples[i];
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
        if (scene_) to.object[i] = object_at(*scene_, sample.position);
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
      label_sweep(sweep, width);
    }
  });
  return labels_;
}

py::array ScanResult::array(const std::string& name) {
  const auto self = shared_from_this();
  const std::size_t sweeps = scan_.headers.size();
  const std::vector<py::ssize_t> shape{axis(sweeps), axis(scan_.power.size() / sweeps)};
  if (name == "power") return array_of<float>(self, scan_.power.data(), shape);
  if (name == "video") {
    const databuffer::Sweep& first = scan_.sweeps.front();
    auto* const kept = new std::shared_ptr<const void>(self);
    const py::capsule keeper(kept, [](void* pointer) { delete static_cast<std::shared_ptr<const void>*>(pointer); });
    return py::array_t<std::uint8_t>(shape, std::vector<py::ssize_t>{axis(sizeof(databuffer::Sweep)), 1},
                                     &first.video[0], keeper);
  }
  if (name == "azimuth") {
    std::vector<double> azimuths;
    for (const auto& header : scan_.headers) azimuths.push_back(model::kernel::geometry_of(header).azimuth.degrees());
    return array_from(std::move(azimuths), {shape[0]});
  }
  {
    const py::gil_scoped_release released;
    labels();
  }
  if (name == "shadow") return flags_of(self, labels_.shadow.data(), shape);
  if (name == "layover") return flags_of(self, labels_.layover.data(), shape);
  if (name == "material") return array_of<std::uint8_t>(self, labels_.material.data(), shape);
  if (name == "object") return array_of<std::int32_t>(self, labels_.object.data(), shape);
  if (name == "ground_range") return array_of<double>(self, labels_.ground_range_m.data(), shape);
  if (name == "slant_range") return array_of<double>(self, labels_.slant_range_m.data(), shape);
  if (name == "latitude") return array_of<double>(self, labels_.latitude_deg.data(), shape);
  if (name == "longitude") return array_of<double>(self, labels_.longitude_deg.data(), shape);
  if (name == "height") return array_of<float>(self, labels_.height_m.data(), shape);
  if (name == "grazing_angle") return array_of<float>(self, labels_.grazing_deg.data(), shape);
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

PatchResult::PatchResult(hrm::PatchFormation& formation, const hrm::PatchOrder& order, std::string fidelity)
    : geometry_(formation.geometry()),
      order_(order),
      formation_s_(formation.formation().seconds()),
      fidelity_(std::move(fidelity)),
      map_(formation.take_result()) {
  for (float& power : map_.image.power)
    if (power < 0.0F) power = std::numeric_limits<float>::quiet_NaN();  // the blind zone
  for (const float sine : map_.labels.sin_grazing)
    grazing_deg_.push_back(std::asin(sine) / static_cast<float>(geo::kRadiansPerDegree));
}

const std::vector<double>& PatchResult::geometry_of(const std::string& name) {
  const int size = map_.image.size;
  const double pixel_m = geometry_.window_m() / size;
  const auto for_pixels = [&](const auto& take) {
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column)
        take(hrm::MapPoint{(column + 0.5) * pixel_m - 0.5 * geometry_.window_m(),
                           0.5 * geometry_.window_m() - (row + 0.5) * pixel_m});
  };
  if (name == "latitude" || name == "longitude") {
    std::call_once(positions_known_, [&] {
      for_pixels([&](hrm::MapPoint point) {
        const geo::GeoPoint position = geometry_.position_of(point);
        latitude_deg_.push_back(position.latitude_deg);
        longitude_deg_.push_back(position.longitude_deg);
      });
    });
    return name == "latitude" ? latitude_deg_ : longitude_deg_;
  }
  std::call_once(ranges_known_, [&] {
    const double above_m = geometry_.altitude_m() - geometry_.plane_msl_m();
    for_pixels([&](hrm::MapPoint point) {
      ground_range_m_.push_back(std::hypot(point.right_m, point.up_m + geometry_.distance_m()));
      slant_range_m_.push_back(geometry_.earth().sight(above_m, ground_range_m_.back(), 0.0).slant_range_m);
    });
  });
  return name == "ground_range" ? ground_range_m_ : slant_range_m_;
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
  for (const char* known : {"ground_range", "slant_range", "latitude", "longitude"}) {
    if (name != known) continue;
    const double* data = nullptr;
    {
      const py::gil_scoped_release released;
      data = geometry_of(name).data();
    }
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
  py::class_<ScanResult, std::shared_ptr<ScanResult>>(module, "ScanResult")
      .def("array", &ScanResult::array)
      .def_property_readonly("hash", &ScanResult::hash)
      .def("facts", &ScanResult::facts);
  py::class_<PatchResult, std::shared_ptr<PatchResult>>(module, "PatchResult")
      .def("array", &PatchResult::array)
      .def_property_readonly("hash", &PatchResult::hash)
      .def("facts", &PatchResult::facts);
}

}  // namespace yars::python
