// The loops of the standard algorithm from terrain to power, over the samples of a sweep: structure of arrays, float,
// by vectors (Highway, chosen at run time; equal bits on every target). All arrays have kPad readable and writable
// entries before the first and behind the last sample.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lib/radar/configuration.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::rbm::simd {

inline constexpr std::size_t kPad = 64;  // entries; the longest pulse smear reaches 32
inline constexpr float kNoHorizon = terrain::kNoTangent;

// One sweep, unwrapped. Lengths [m], angles as sine and cosine.
struct SweepConstants {
  float altitude_m = 0.0F;
  float curvature = 0.0F;  // [1/m] of the effective earth, 0 = flat
  float land_gamma = 0.0F;
  float pulse_inverse = 0.0F;  // [1/m] 1 / (c tau / 2)
  float beam_inverse = 0.0F;   // 1 / theta_el
  float scale = 0.0F;          // theta_az / (full scale R0^3)
  float range_inverse = 0.0F;  // [1/m] 1 / R0
  float range_power = 0.0F;    // of the sensitivity time control: exponent - 3
  float sin_elevation = 0.0F;  // of the antenna
  float cos_elevation = 1.0F;
  float sin_centre = 0.0F;       // of the csc^2 pattern's depression b
  float sin_centre_tilt = 0.0F;  // sin and cos of b + antenna elevation
  float cos_centre_tilt = 1.0F;
  float gaussian = 0.0F;  // 5.545 log2(e) / theta_el^2
  float sin_half_beam = 0.0F;
};

// What one sweep reads, an array a sample each.
struct SweepInputs {
  const float* distance_m;
  const float* elevation_m;       // of the ground that returns; NaN = void
  const float* peak_m;            // highest ground, which casts the shadow; null: the same as elevation_m
  const float* crest;             // tangent of the highest ground since the sample before; null: none stands there
  const float* cross_slope;       // null: none
  const float* one_step_inverse;  // [1/m] 1 / (distance[i + 1] - distance[i])
  const float* two_step_inverse;  // [1/m] 1 / (distance[i + 1] - distance[i - 1])
  const physics::simd::GroundInputs* ground;  // null: plain dry land everywhere
};
// And what it gives.
struct SweepOutputs {
  float* tangent;  // of the elevation angle of what casts the shadow; kNoHorizon where nothing returns
  float* before;   // the greatest tangent of all ground nearer than the sample. Exact: only comparisons.
  float* horizon;  // the same with the sample
  float* power;    // after sensitivity time control, full scale = 1, before the pulse smear; 0 in shadow and void
};

// From terrain to power in one pass: sight, shadow, slopes along and across, local incidence, two-way gain, area and
// reflectivity.
void sweep(std::size_t count, const SweepConstants& constants, radar::BeamPattern beam, const SweepInputs& inputs,
           const SweepOutputs& outputs);

// result[i] = sum of weights[reach + k] * power[i + k] over k = -reach..reach; `result` has exactly `count` entries.
void smear(std::size_t count, const float* power, const float* weights, std::ptrdiff_t reach, float* result);

}  // namespace yars::model::rbm::simd
