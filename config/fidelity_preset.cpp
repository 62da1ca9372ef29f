#include "config/fidelity_preset.hpp"

#include <algorithm>
#include <array>

namespace yars::config {
namespace {

constexpr std::array<std::string_view, 5> kNames{"1996", "draft", "standard", "fine", "reference"};

// What the report computes: flat earth, no refraction, hard edges of the beam, three-sweep and three-post smear.
radar::Fidelity of_1996() {
  radar::Fidelity fidelity;
  fidelity.algorithm = radar::Algorithm::report_1996;
  fidelity.earth = radar::EarthModel::flat;
  fidelity.earth_radius_factor = 1.0;
  fidelity.noise = false;
  fidelity.beam = radar::BeamPattern::hard_edge;
  return fidelity;
}

// Half the samples and no smear, on a sphere: for a slow machine or many radars.
radar::Fidelity draft() {
  radar::Fidelity fidelity;
  fidelity.earth = radar::EarthModel::sphere;
  fidelity.samples = 240;
  fidelity.azimuth_smear = false;
  fidelity.pulse_smear = false;
  return fidelity;
}

radar::Fidelity fine() {
  radar::Fidelity fidelity;
  fidelity.samples = 1024;
  fidelity.cross_track_slope = true;
  return fidelity;
}

radar::Fidelity reference() {
  radar::Fidelity fidelity = fine();
  fidelity.algorithm = radar::Algorithm::reference;
  return fidelity;
}

}  // namespace

std::span<const std::string_view> fidelity_names() {
  return kNames;
}

std::optional<radar::Fidelity> fidelity_preset(std::string_view name) {
  if (std::find(kNames.begin(), kNames.end(), name) == kNames.end()) return std::nullopt;
  radar::Fidelity fidelity;
  if (name == "1996") fidelity = of_1996();
  if (name == "draft") fidelity = draft();
  if (name == "fine") fidelity = fine();
  if (name == "reference") fidelity = reference();
  fidelity.name = name;
  return fidelity;
}

}  // namespace yars::config
