// Vector loops of the standard algorithm from terrain to power (Highway): structure of arrays, float.
// Inputs: elevations, distances, slopes and crests of the samples; constants of the sweep; ground reflectivity.
// Outputs: tangents, horizon, power (full scale = 1).
// Threads: pure functions. The target is chosen at run time; bits are equal on every target.
// All arrays have kPad readable and writable entries before the first and behind the last sample.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lib/radar/modes.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::rbm::simd {

inline constexpr std::size_t kPad = 64;  // [entries] the longest pulse smear reaches 32 samples
inline constexpr float kNoHorizon = terrain::kNoTangent;

// Constants of one sweep.
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
  float sin_centre = 0.0F;       // sin b; b is the depression of the csc^2 pattern's centre
  float sin_centre_tilt = 0.0F;  // sin, cos of b + antenna elevation
  float cos_centre_tilt = 1.0F;
  float gaussian = 0.0F;  // 5.545 log2(e) / theta_el^2
  float sin_half_beam = 0.0F;
};

// Inputs of one sweep: one entry per sample.
struct SweepInputs {
  const float* distance_m;
  const float* elevation_m;       // of the ground that returns; NaN: void
  const float* peak_m;            // of the highest ground, which casts shadow; null: elevation_m
  const float* crest;             // maximum tangent of the ground between this sample and the one before; null: none
  const float* cross_slope;       // slope across the sweep; null: 0
  const float* one_step_inverse;  // [1/m] 1 / (distance[i + 1] - distance[i])
  const float* two_step_inverse;  // [1/m] 1 / (distance[i + 1] - distance[i - 1])
  const physics::simd::GroundInputs* ground;  // null: land without culture, texture or water everywhere
};
// Outputs of one sweep.
struct SweepOutputs {
  float* tangent;  // of the ground that casts shadow; kNoHorizon over a void
  float* before;   // maximum tangent of all ground nearer than the sample
  float* horizon;  // maximum of `before` and the sample's own ground
  float* power;    // after sensitivity time control, full scale = 1, before the pulse smear; 0 in shadow and void
};

// Computes power from terrain in one pass: tangents, shadow, slopes, local grazing angle, two-way gain, illuminated
// area, reflectivity.
void sweep(std::size_t count, const SweepConstants& constants, radar::BeamPattern beam, const SweepInputs& inputs,
           const SweepOutputs& outputs);

// result[i] = sum of weights[reach + k] * power[i + k] over k = -reach..reach. Exactly `count` entries are written.
void smear(std::size_t count, const float* power, const float* weights, std::ptrdiff_t reach, float* result);

}  // namespace yars::model::rbm::simd
