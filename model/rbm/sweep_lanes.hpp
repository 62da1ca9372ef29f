// The loops of the standard algorithm from terrain to power, over the samples of a sweep: structure of arrays, float,
// by vectors (Highway, chosen at run time; equal bits on every target). All arrays have kPad readable and writable
// entries before the first and behind the last sample.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lib/radar/configuration.hpp"

namespace yars::model::rbm::lanes {

inline constexpr std::size_t kPad = 64;        // entries; the longest pulse smear reaches 32
inline constexpr float kNoHorizon = -1.0e30F;  // tangent below every terrain

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

// How the aircraft sees each sample, one array each.
struct SightArrays {
  float* tangent;        // tangent of the elevation angle; void: kNoHorizon
  float* range_inverse;  // [1/m] 1 / slant range
  float* sin_grazing;
  float* cos_grazing;
  float* sin_sight;  // of the elevation angle
  float* cos_sight;
};

// Elevation [m] NaN = void.
void sight(std::size_t count, const SweepConstants& constants, const float* distance_m, const float* elevation_m,
           const SightArrays& out);

// The tangent alone, as sight() makes it: of the highest ground where that is not the mean.
void sight_tangent(std::size_t count, const SweepConstants& constants, const float* distance_m,
                   const float* elevation_m, float* tangent);

// horizon[i] = the greatest tangent of samples 0..i. Exact: only comparisons.
void running_maximum(std::size_t count, const float* tangent, float* horizon);

// Power after sensitivity time control, full scale = 1, before the pulse smear: slopes along and across, local
// incidence, two-way gain, area and reflectivity in one. 0 in shadow and void.
struct PowerInputs {
  const float* elevation_m;
  const float* cross_slope;       // null: none
  const float* land;              // gamma of each sample, its share of land in it; null: the constants' everywhere
  const float* sea;               // sigma0 of each sample, its share of water in it; null: none
  const float* tangent;           // of the ground that returns
  const float* horizon;           // of all ground before
  const float* one_step_inverse;  // [1/m] 1 / (distance[i + 1] - distance[i])
  const float* two_step_inverse;  // [1/m] 1 / (distance[i + 1] - distance[i - 1])
  SightArrays sights;
};
void power(std::size_t count, const SweepConstants& constants, radar::BeamPattern beam, const PowerInputs& inputs,
           float* result);

// result[i] = sum of weights[reach + k] * power[i + k] over k = -reach..reach; `result` has exactly `count` entries.
void smear(std::size_t count, const float* power, const float* weights, std::ptrdiff_t reach, float* result);

}  // namespace yars::model::rbm::lanes
