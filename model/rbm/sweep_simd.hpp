// SIMD loops of the algorithm `standard` from terrain to power, written with the Highway library. All values are float,
// in one array per quantity.
// Inputs: elevations, distances, slopes and crests of the samples; constants of the sweep; ground reflectivity.
// Outputs: tangents of elevation angles, horizon, power (full scale = 1).
// Sensitivity time control multiplies power by (slant range / R0)^n. R0 is the selected range.
// The csc^2 pattern (cosecant squared) is an elevation pattern of the antenna, see two_way_gain() in receiver.hpp.
// Threads: pure functions. The instruction set is chosen at run time. All instruction sets give results equal bit by
// bit. All arrays of samples have kPad readable and writable entries before the first and after the last sample.
// Exception: `result` of smear().
#pragma once

#include <cstddef>
#include <cstdint>

#include "lib/radar/modes.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::rbm::simd {

inline constexpr std::size_t kPad = 64;  // [entries] 32 for the longest pulse smear, 32 for a pair of vectors
inline constexpr float kNoHorizon = terrain::kNoTangent;

struct SweepConstants {
  float altitude_m = 0.0F;     // aircraft, MSL
  float curvature = 0.0F;      // [1/m] 1 / radius of the effective earth; 0 = flat
  float land_gamma = 0.0F;     // sigma0 / sine of the grazing angle, for land
  float pulse_inverse = 0.0F;  // [1/m] 1 / (c tau / 2); tau is the pulse duration
  float beam_inverse = 0.0F;   // [1/rad] 1 / theta_el; theta_el is the elevation beamwidth
  float scale = 0.0F;          // theta_az / (full scale R0^3); theta_az is the azimuth beamwidth
  float range_inverse = 0.0F;  // [1/m] 1 / R0; sensitivity time control is 1 at slant range R0
  float range_power = 0.0F;    // exponent of the sensitivity time control, minus 3
  float sin_elevation = 0.0F;  // sine of the antenna elevation, positive upward
  float cos_elevation = 1.0F;
  float sin_centre = 0.0F;       // sin b; b is the depression of the csc^2 pattern's centre
  float sin_centre_tilt = 0.0F;  // sin(b + antenna elevation)
  float cos_centre_tilt = 1.0F;  // cos(b + antenna elevation)
  float gaussian = 0.0F;         // [1/rad^2] 8 ln 2 log2(e) / theta_el^2: exponent of the Gaussian pattern to base 2
  float sin_half_beam = 0.0F;    // sin(theta_el / 2)
};

// Inputs of one sweep: one entry per sample.
struct SweepInputs {
  const float* distance_m;
  const float* elevation_m;       // [m MSL] ground that returns power; NaN: void
  const float* peak_m;            // [m MSL] highest ground, which casts the shadow; null: equal to elevation_m
  const float* crest;             // maximum tangent between the previous sample and this sample; null: no crests
  const float* cross_slope;       // slope across the sweep; null: 0
  const float* one_step_inverse;  // [1/m] 1 / (distance[i + 1] - distance[i])
  const float* two_step_inverse;  // [1/m] 1 / (distance[i + 1] - distance[i - 1])
  const physics::simd::GroundInputs* ground;  // null: all samples are land without culture and texture
};
struct SweepOutputs {
  float* tangent;  // tangent of the elevation angle of the ground that casts the shadow; kNoHorizon over a void
  float* before;   // maximum tangent of all ground nearer than the sample
  float* horizon;  // maximum tangent of all ground up to and including the sample
  float* power;    // full scale = 1, after sensitivity time control, before pulse smear; 0 in shadow and over a void
};

// Computes power from terrain in one pass: tangents, shadow, slopes, local grazing angle, two-way gain, illuminated
// area, reflectivity.
void sweep(std::size_t count, const SweepConstants& constants, radar::BeamPattern beam, const SweepInputs& inputs,
           const SweepOutputs& outputs);

// Applies the pulse smear: result[i] = sum of weights[reach + k] * power[i + k] over k = -reach..reach. Writes exactly
// `count` entries.
void smear(std::size_t count, const float* power, const float* weights, std::ptrdiff_t reach, float* result);

}  // namespace yars::model::rbm::simd
