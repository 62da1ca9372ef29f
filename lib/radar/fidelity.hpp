// Fidelity: the parameters that trade speed against accuracy, and named presets of them.
// config/schema reads the values from GUF files.
// Units: as the suffix of each name says.
// Source: docs/spec/physics.md#sampling.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lib/radar/modes.hpp"

namespace yars::radar {

// Number of the radar model. It increases when equal inputs give another picture. Recordings, data sets and hosts of
// one session compare it: sweeps of different models are not comparable. 1: releases up to 0.4. 2: power of all visible
// ground, mapping beam of csc^4, noise by range and pulse, movers that fluctuate.
inline constexpr unsigned kModelNumber = 2;

inline constexpr int kMaxSubBeams = 15;  // maximum of Fidelity::sub_beams; bounds the work of one sweep

// Parameters that trade speed against accuracy. A configuration selects a preset and can then set single parameters.
struct Fidelity {
  std::string name = "standard";
  // True: the live radar-model moves, scan by scan, towards the finest preset with a processor load within core_share.
  // The parameters below apply until the first change of the preset.
  bool automatic = false;
  double core_share = 0.25;  // maximum processor load as a fraction of one core, (0, 1]
  Algorithm algorithm = Algorithm::standard;
  EarthModel earth = EarthModel::ellipsoid;
  // Effective earth radius factor k; 1 = no refraction. kNotGiven: rays bend by the refractivity of the atmosphere.
  double earth_radius_factor = kNotGiven;
  int samples = 480;  // range samples of a sweep
  // Number of exact geodesic positions of a sweep, 2 to 9. The other positions are interpolated. With 5 or more, a
  // Taylor series (GeodesicSeries) replaces the interpolation where the error of the series is at most 1 mm. 0: every
  // position is exact.
  int geodesic_knots = 5;
  Interpolation interpolation = Interpolation::bilinear;
  // Maximum number of terrain posts between two samples. Where the finest grid has more, a coarser grid of the cell is
  // used. 0: always the finest grid.
  double posts_per_sample = 16.0;
  // Rays across the beam in azimuth, weighted by the beam pattern, which successive sweeps share. 1: a ray for each
  // sweep, in the middle of its beam.
  int sub_beams = 4;
  bool slant_range = false;    // true: samples at equal steps of slant range; false: of ground range
  bool noise = true;           // random fluctuation: speckle, texture of sweeps, echoes of movers
  bool azimuth_smear = false;  // smear over three sweeps
  bool pulse_smear = true;     // smear over the pulse length
  BeamPattern beam = BeamPattern::mapping;
  bool diffraction = false;  // algorithm reference only: edges of shadows are soft
  bool sea_lobes = false;    // movers and scenes over the sea: direct and reflected ray interfere
  // Parameters of patch maps.
  int map_size = 480;             // [pixels] edge of the map; in a session at most 1024
  int map_oversampling = 1;       // cells of the polar grid (range, azimuth) per pixel, in each direction, 1 to 4
  bool map_layover = true;        // slant range geometry with layover; false: orthographic
  bool map_response = true;       // impulse response with sidelobes
  bool map_detail = true;         // synthetic texture finer than the posts
  bool map_smooth_ground = true;  // smooth ground between posts if pixels are finer than posts; false: facets
  bool map_double_bounce = true;  // reflection between walls and ground
  double map_noise = 0.10;        // algorithm of preset 1996 only: random fraction of the brightness, [0, 1]
};

// Names of the presets of lib/values/presets.idl, in ascending order of work.
std::span<const std::string_view> fidelity_names();

// The preset of a name, as in the GUF slot `preset` and the option `--fidelity`. nullopt: no such preset.
std::optional<Fidelity> fidelity_preset(std::string_view name);

}  // namespace yars::radar
