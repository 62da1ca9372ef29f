#include "python/core/results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/geo/earth.hpp"

namespace yars::python {

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
