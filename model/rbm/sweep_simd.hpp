// SIMD loops of the real beam map algorithm `standard`, from terrain to power, written with the Highway library. All
// values are float, in one array per quantity.
// Inputs: ground elevation, distance and crest of each sample; constants of the sweep; ground reflectivity.
// Outputs: horizon and other tangents of elevation angles at the aircraft, positive above the horizontal; power (full
// scale = 1).
// Sensitivity time control multiplies power by (slant range / R0)^n. R0 is physics::kFullScaleRange.
// The cosecant patterns are elevation patterns of the antenna, see model/physics/receiver.hpp.
// Threads: pure functions. The instruction set is chosen at run time. All instruction sets give results equal bit by
// bit. All arrays of samples have kPad readable and writable entries before the first and after the last sample.
// Exceptions: the results of smear() and weighted_sum(); the arrays of SweepInputs::ground (clutter_simd.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lib/radar/modes.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::rbm::simd {

inline constexpr std::size_t kPad = 64;  // [entries] 32 for the longest pulse smear, 32 for a pair of vectors
// Tangent below that of any ground.
inline constexpr float kNoHorizon = terrain::kNoTangent;

struct SweepConstants {
  float altitude_m = 0.0F;     // [m MSL] of the aircraft
  float curvature = 0.0F;      // [1/m] physics::EffectiveEarth::curvature(); 0 = flat
  physics::simd::Lift lift;    // by refraction
  float land_gamma = 0.0F;     // sigma0 / sine of the grazing angle, for land without culture
  float pulse_inverse = 0.0F;  // [1/m] 1 / (c tau / 2); tau is the pulse duration
  float beam_inverse = 0.0F;   // [1/rad] 1 / theta_el; theta_el is the elevation beamwidth
  float scale = 0.0F;          // theta / (full scale R0^3); theta is the width of the clutter cell in azimuth
  float range_m = 0.0F;        // slant range at which sensitivity time control is 1
  float range_power = 0.0F;    // exponent of the sensitivity time control, minus 3
  float sin_elevation = 0.0F;  // sine of the antenna elevation, positive above the horizontal
  float cos_elevation = 1.0F;
  float sin_centre = 0.0F;       // sin b, of the cosecant patterns; b is the antenna depression, at least theta_el / 2
  float sin_centre_tilt = 0.0F;  // sin(b + antenna elevation)
  float cos_centre_tilt = 1.0F;  // cos(b + antenna elevation)
  float gaussian = 0.0F;         // [1/rad^2] 8 / theta_el^2; two-way gain 2^(-gaussian x^2), x: elevation off the axis
  float sin_half_beam = 0.0F;    // sin(theta_el / 2)
};

// Inputs of one sweep: one entry per sample.
struct SweepInputs {
  const float* distance_m;   // ground distance from the apex
  const float* elevation_m;  // [m MSL] ground that returns power; NaN: void
  const float* peak_m;       // [m MSL] highest ground around the sample, which casts the shadow; null: elevation_m
  const float* near_m;       // [m MSL] terrain::NearGround; NaN: none
  const float* near_back_m;  // [m] its distance before the sample
  const float* crest;        // maximum tangent of ground between the previous sample and this one; null: no crests
  // Weight of the tangent of the sample before this one, in the tangent of straight ground midway between both. The
  // rest is the weight of this one's tangent.
  const float* midway_weight;
  const float* cell_inverse;  // [1/m] converts the rise of the tangent over the sample's cell to that per metre
  physics::GasSamples::Coefficients gas;      // two-way loss by the gases of the air
  const physics::simd::GroundInputs* ground;  // null: all samples are land without culture and texture
};
struct SweepOutputs {
  float* near;     // tangent of the ground near_m where it reaches the sample's horizon, else kNoHorizon
  float* tangent;  // tangent of the elevation angle of the ground that casts the shadow; kNoHorizon over a void
  float* before;   // maximum tangent of all ground nearer than the sample
  float* horizon;  // maximum tangent of all ground up to and including the sample
  float* power;    // full scale = 1, after sensitivity time control, before pulse smear; 0 in shadow and over a void
  float* power_per_gamma;  // what the power would be if the ground were land with gamma 1; null: not computed
};

// Computes the tangent of each sample, the horizon that the samples alone make, and `near`. Crests below this horizon
// hide nothing. Does not read weights, crests and `ground`.
void profile(std::size_t count, const SweepConstants& constants, const SweepInputs& inputs,
             const SweepOutputs& outputs);

// Computes power from terrain in one pass: shadow, angle of elevation over which the ground of each cell is seen,
// two-way gain, illuminated area, reflectivity. A cell extends halfway to the neighbouring samples. Requires the
// outputs of profile(). Raises the horizon to the crests.
void sweep(std::size_t count, const SweepConstants& constants, radar::BeamPattern beam, const SweepInputs& inputs,
           const SweepOutputs& outputs);

// Applies the pulse smear, which spreads power over the length of a pulse: result[i] = sum of
// weights[reach + k] * power[i + k] over k = -reach..reach. Writes exactly `count` entries.
void smear(std::size_t count, const float* power, const float* weights, std::ptrdiff_t reach, float* result);

// Weighted sum of the powers of several rays: result[i] = sum of rays[k].weight * rays[k].power[i]. Writes exactly
// `count` entries.
struct WeightedRay {
  const float* power;
  float weight;
};
void weighted_sum(std::size_t count, std::span<const WeightedRay> rays, float* result);

}  // namespace yars::model::rbm::simd
