#include "lib/radar/fidelity.hpp"

#include <algorithm>

#include "lib/values/presets.hpp"

namespace yars::radar {

namespace {

// The algorithm of the 1996 report: flat earth, no refraction, constant gain within the beam. The smear covers three
// sweeps and three samples.
Fidelity of_1996() {
  Fidelity fidelity;
  fidelity.algorithm = Algorithm::report_1996;
  fidelity.earth = EarthModel::flat;
  fidelity.earth_radius_factor = 1.0;
  fidelity.sub_beams = 1;
  fidelity.azimuth_smear = true;
  fidelity.noise = false;
  fidelity.beam = BeamPattern::hard_edge;
  fidelity.map_layover = false;
  fidelity.map_response = false;
  fidelity.map_detail = false;
  fidelity.map_smooth_ground = false;
  return fidelity;
}

// Preset for a slow machine or many radars: half the rays of `standard` with half the samples, no pulse smear,
// spherical earth. The azimuth smear softens the steps between its rays.
Fidelity draft() {
  Fidelity fidelity;
  fidelity.earth = EarthModel::sphere;
  fidelity.posts_per_sample = 20.0;
  fidelity.samples = 240;
  fidelity.sub_beams = 2;
  fidelity.azimuth_smear = true;
  fidelity.pulse_smear = false;
  fidelity.map_response = false;
  fidelity.map_detail = false;
  return fidelity;
}

// All effects of the model at the finest terrain level, and three times the rays of `standard`.
Fidelity fine() {
  Fidelity fidelity;
  fidelity.posts_per_sample = 0.0;
  fidelity.samples = 1024;
  fidelity.cross_track_slope = true;
  fidelity.sub_beams = 13;
  fidelity.map_oversampling = 2;
  fidelity.map_double_bounce = true;
  return fidelity;
}

// Like fine(), but with the reference algorithm in double precision and exact geodesics.
Fidelity reference() {
  Fidelity fidelity = fine();
  fidelity.algorithm = Algorithm::reference;
  fidelity.geodesic_knots = 0;
  return fidelity;
}

}  // namespace

std::span<const std::string_view> fidelity_names() {
  return values::kPresets;
}

std::optional<Fidelity> fidelity_preset(std::string_view name) {
  if (std::ranges::find(values::kPresets, name) == values::kPresets.end()) return std::nullopt;
  Fidelity fidelity;
  if (name == "1996") fidelity = of_1996();
  if (name == "draft") fidelity = draft();
  if (name == "fine") fidelity = fine();
  if (name == "reference") fidelity = reference();
  fidelity.name = name;
  return fidelity;
}

}  // namespace yars::radar
