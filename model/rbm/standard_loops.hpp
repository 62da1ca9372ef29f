// The loops of the standard algorithm over the samples of a sweep: structure of arrays, float, one simple loop each.
// Arrays of elevations and powers have kPad readable entries before the first and behind the last sample.
#pragma once

#include <cstddef>
#include <cstdint>

#include "model/rbm/noise.hpp"

namespace yars::model::rbm::loops {

inline constexpr std::size_t kPad = 64;        // entries; the longest pulse smear reaches 32, the horizon looks 16 back
inline constexpr float kNoHorizon = -1.0e30F;  // tangent below every terrain

// One sweep, unwrapped. Lengths [m], angles as sine and cosine.
struct SweepConstants {
  float altitude_m = 0.0F;
  float curvature = 0.0F;  // [1/m] of the effective earth, 0 = flat
  float land_gamma = 0.0F;
  float sea_less_land_gamma = 0.0F;
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

// What sight() finds, one array each.
struct SightArrays {
  float* tangent;        // of the elevation angle; kNoHorizon where void
  float* range_inverse;  // [1/m] 1 / slant range
  float* sin_grazing;
  float* cos_grazing;
  float* sin_sight;  // of the elevation angle
  float* cos_sight;
};

void sight(std::size_t count, const SweepConstants& constants, const float* distance_m, const float* elevation_m,
           const SightArrays& out);

// horizon[i] = the greatest tangent of samples 0..i. Both arrays have kPad entries of kNoHorizon in front; `spare` is
// as long. Exact: only comparisons.
void running_maximum(std::size_t count, const float* tangent, float* spare, float* horizon);

// Sine of the local grazing angle from the slopes along and across the sweep, 0 where in shadow or void.
void incidence(std::size_t count, const float* distance_m, const float* elevation_m, const float* cross_slope,
               const float* tangent, const float* horizon, const SightArrays& sights, float* sin_local);

// Two-way gain, by pattern.
void gain_hard_edge(std::size_t count, const SweepConstants& constants, const SightArrays& sights, float* gain);
void gain_gaussian(std::size_t count, const SweepConstants& constants, const SightArrays& sights, float* gain);
void gain_cosecant_squared(std::size_t count, const SweepConstants& constants, const SightArrays& sights, float* gain);

// Power after sensitivity time control, full scale = 1.
void power(std::size_t count, const SweepConstants& constants, const float* water, const float* sin_local,
           const float* gain, const SightArrays& sights, float* power);

// sum[i] += weight * power[i + offset].
void add_weighted(std::size_t count, const float* power, float weight, float* sum);

// power = weighted sum of three sweeps + noise.
void join_sweeps(std::size_t count, const float* before, const float* centre, const float* after, const float* weights,
                 float noise, float* power);

// power *= gamma-distributed variate of mean 1 and `looks` looks, per resolution cell.
void speckle(std::size_t count, NoiseState state, float cells, int looks, float* spare, float* power);

// Log receiver: video = 255 (1 + (10 log10 power + gain_db) / decibels_per_scale), clipped.
void quantize(std::size_t count, const float* power, float gain_db, float decibels_per_scale, std::uint8_t* video);

}  // namespace yars::model::rbm::loops
