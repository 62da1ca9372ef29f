#include "model/rbm/standard_loops.hpp"

#include <cmath>

#include "model/rbm/lanes.hpp"
#include "model/rbm/polynomials.hpp"

namespace yars::model::rbm::loops {

namespace {
constexpr std::size_t kBlock = 16;                 // samples that four doubling steps of the running maximum cover
constexpr float kDecibelsPerOctave = 3.01029996F;  // 10 log10(2)
constexpr float kLn2 = 0.693147181F;

inline float larger(float a, float b) {
  return a > b ? a : b;
}
inline float smaller(float a, float b) {
  return a < b ? a : b;
}

// Restrict holds for parameters only: without it eight arrays need more overlap checks than the compiler makes.
YARS_LANES void sight_loop(std::size_t count, float altitude_m, float curvature, const float* __restrict distance_m,
                           const float* __restrict elevation_m, float* __restrict tangent,
                           float* __restrict range_inverse, float* __restrict sin_grazing,
                           float* __restrict cos_grazing, float* __restrict sin_sight, float* __restrict cos_sight) {
  for (std::size_t i = 0; i < count; ++i) {
    const float elevation = elevation_m[i];
    const bool known = elevation == elevation;
    const float height = known ? elevation : 0.0F;
    const float distance = distance_m[i];
    // Sine and cosine of the angle at the earth's centre, as the lengths that they stand for; their series end at
    // the seventh power of an angle below 0.04.
    const float angle = distance * curvature;
    const float square = angle * angle;
    const float drop = distance * angle * (0.5F - square * (0.0416666667F - square * 0.00138888889F));
    const float chord = distance * (1.0F - square * (0.166666667F - square * 0.00833333333F));
    const float sine = chord * curvature;
    const float cosine = 1.0F - drop * curvature;
    const float out_m = chord + height * sine;
    const float up_m = height * cosine - drop - altitude_m;
    // Nothing is nearer than a metre: a sample without ground may lie at the aircraft itself.
    const float inverse = 1.0F / std::sqrt(larger(out_m * out_m + up_m * up_m, 1.0F));
    tangent[i] = known ? up_m / out_m : kNoHorizon;
    range_inverse[i] = inverse;
    sin_grazing[i] = (altitude_m * cosine - height - drop) * inverse;
    cos_grazing[i] = (chord + altitude_m * sine) * inverse;
    sin_sight[i] = up_m * inverse;
    cos_sight[i] = out_m * inverse;
  }
}

}  // namespace

void sight(std::size_t count, const SweepConstants& constants, const float* distance_m, const float* elevation_m,
           const SightArrays& out) {
  sight_loop(count, constants.altitude_m, constants.curvature, distance_m, elevation_m, out.tangent, out.range_inverse,
             out.sin_grazing, out.cos_grazing, out.sin_sight, out.cos_sight);
}

YARS_LANES void running_maximum(std::size_t count, const float* __restrict tangent, float* __restrict spare,
                                float* __restrict horizon) {
  // Doubling: after four steps each entry holds the maximum of the sixteen up to itself.
  for (std::size_t i = 0; i < count; ++i) horizon[i] = larger(tangent[i], *(tangent + i - 1));
  for (std::size_t i = 0; i < count; ++i) spare[i] = larger(horizon[i], *(horizon + i - 2));
  for (std::size_t i = 0; i < count; ++i) horizon[i] = larger(spare[i], *(spare + i - 4));
  for (std::size_t i = 0; i < count; ++i) spare[i] = larger(horizon[i], *(horizon + i - 8));
  // Then the maximum of all whole blocks before is carried into the next.
  float carry = kNoHorizon;
  for (std::size_t start = 0; start < count; start += kBlock) {
    for (std::size_t lane = 0; lane < kBlock; ++lane) horizon[start + lane] = larger(spare[start + lane], carry);
    carry = larger(carry, spare[start + kBlock - 1]);
  }
}

YARS_LANES void incidence(std::size_t count, const float* __restrict distance_m, const float* __restrict elevation_m,
                          const float* __restrict cross_slope, const float* __restrict tangent,
                          const float* __restrict horizon, const SightArrays& sights, float* __restrict sin_local) {
  const float* __restrict sin_grazing = sights.sin_grazing;
  const float* __restrict cos_grazing = sights.cos_grazing;
  for (std::size_t i = 0; i < count; ++i) {
    const float here = elevation_m[i];
    const float near_height = *(elevation_m + i - 1);
    const float far_height = elevation_m[i + 1];
    const bool near_known = near_height == near_height;
    const bool far_known = far_height == far_height;
    const float rise = (far_known ? far_height : here) - (near_known ? near_height : here);
    const float run =
        (far_known ? distance_m[i + 1] : distance_m[i]) - (near_known ? *(distance_m + i - 1) : distance_m[i]);
    const float slope = run > 0.0F ? rise / run : 0.0F;
    const float across = cross_slope[i];
    const float normal = std::sqrt(1.0F + slope * slope + across * across);
    const float sine = (slope * cos_grazing[i] + sin_grazing[i]) / normal;
    const float clamped = smaller(larger(sine, 0.0F), 1.0F);
    const bool lit = tangent[i] > *(horizon + i - 1);
    sin_local[i] = lit ? clamped : 0.0F;
  }
}

YARS_LANES void gain_hard_edge(std::size_t count, const SweepConstants& constants, const SightArrays& sights,
                               float* __restrict gain) {
  const float sine = constants.sin_elevation;
  const float cosine = constants.cos_elevation;
  const float edge = constants.sin_half_beam;
  const float* __restrict sin_sight = sights.sin_sight;
  const float* __restrict cos_sight = sights.cos_sight;
  for (std::size_t i = 0; i < count; ++i) {
    const float below = sine * cos_sight[i] - cosine * sin_sight[i];
    const float ahead = cosine * cos_sight[i] + sine * sin_sight[i];
    const float inside = (below < 0.0F ? -below : below) <= edge ? 1.0F : 0.0F;
    gain[i] = ahead > 0.0F ? inside : 0.0F;
  }
}

YARS_LANES void gain_gaussian(std::size_t count, const SweepConstants& constants, const SightArrays& sights,
                              float* __restrict gain) {
  const float sine = constants.sin_elevation;
  const float cosine = constants.cos_elevation;
  const float exponent = constants.gaussian;
  const float* __restrict sin_sight = sights.sin_sight;
  const float* __restrict cos_sight = sights.cos_sight;
  for (std::size_t i = 0; i < count; ++i) {
    const float below = sine * cos_sight[i] - cosine * sin_sight[i];
    const float ahead = cosine * cos_sight[i] + sine * sin_sight[i];
    const float angle = polynomials::angle(below < 0.0F ? -below : below, ahead);
    gain[i] = polynomials::exp2(-exponent * angle * angle);
  }
}

YARS_LANES void gain_cosecant_squared(std::size_t count, const SweepConstants& constants, const SightArrays& sights,
                                      float* __restrict gain) {
  const float sine = constants.sin_elevation;
  const float cosine = constants.cos_elevation;
  const float exponent = constants.gaussian;
  const float centre = constants.sin_centre;
  const float tilt_sine = constants.sin_centre_tilt;
  const float tilt_cosine = constants.cos_centre_tilt;
  const float* __restrict sin_sight = sights.sin_sight;
  const float* __restrict cos_sight = sights.cos_sight;
  for (std::size_t i = 0; i < count; ++i) {
    const float below = sine * cos_sight[i] - cosine * sin_sight[i];
    const float ahead = cosine * cos_sight[i] + sine * sin_sight[i];
    const float angle = polynomials::angle(below < 0.0F ? -below : below, ahead);
    const float above_gain = polynomials::exp2(-exponent * angle * angle);
    const float share = centre / larger(tilt_sine * cos_sight[i] - tilt_cosine * sin_sight[i], centre);
    gain[i] = below < 0.0F ? above_gain : share * share;
  }
}

YARS_LANES void power(std::size_t count, const SweepConstants& constants, const float* __restrict water,
                      const float* __restrict sin_local, const float* __restrict gain, const SightArrays& sights,
                      float* __restrict result) {
  const SweepConstants c = constants;
  const float* __restrict range_inverse = sights.range_inverse;
  for (std::size_t i = 0; i < count; ++i) {
    const float sine = sin_local[i];
    const float cosine = std::sqrt(1.0F - sine * sine);
    // The larger inverse of pulse and beam limit: the smaller area.
    const float inverse = larger(cosine * c.pulse_inverse, sine * range_inverse[i] * c.beam_inverse);
    const float gamma = c.land_gamma + c.sea_less_land_gamma * water[i];
    result[i] = gamma * sine * gain[i] * c.scale / inverse;
  }
  if (c.range_power == 0.0F) return;
  for (std::size_t i = 0; i < count; ++i) {
    const float octaves = polynomials::log2(range_inverse[i]) - polynomials::log2(c.range_inverse);
    result[i] *= polynomials::exp2(-c.range_power * octaves);
  }
}

YARS_LANES void add_weighted(std::size_t count, const float* __restrict power, float weight, float* __restrict sum) {
  for (std::size_t i = 0; i < count; ++i) sum[i] += weight * power[i];
}

YARS_LANES void join_sweeps(std::size_t count, const float* __restrict before, const float* __restrict centre,
                            const float* __restrict after, const float* weights, float noise, float* __restrict power) {
  const float first = weights[0];
  const float second = weights[1];
  const float third = weights[2];
  for (std::size_t i = 0; i < count; ++i) {
    power[i] = first * before[i] + second * centre[i] + third * after[i] + noise;
  }
}

YARS_LANES void speckle(std::size_t count, NoiseState state, float cells, int looks, float* __restrict spare,
                        float* __restrict power) {
  constexpr float kStep = 1.0F / 65536.0F;
  for (std::size_t i = 0; i < count; ++i) spare[i] = 0.0F;
  for (int first = 0; first < looks; first += kLooksPerGroup) {
    // The logarithm of a product of up to four uniform variates; a variate beyond the looks counts as 1.
    const auto draw = static_cast<std::uint32_t>(first / 2);
    const float second_step = looks - first > 1 ? kStep : 0.0F;
    const float third_step = looks - first > 2 ? kStep : 0.0F;
    const float fourth_step = looks - first > 3 ? kStep : 0.0F;
    const float second_base = looks - first > 1 ? 0.5F * kStep : 1.0F;
    const float third_base = looks - first > 2 ? 0.5F * kStep : 1.0F;
    const float fourth_base = looks - first > 3 ? 0.5F * kStep : 1.0F;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t cell = resolution_cell(static_cast<std::uint32_t>(i), cells);
      const std::uint32_t one = noise_bits(state, cell, draw);
      const std::uint32_t two = noise_bits(state, cell, draw + 1U);
      const float a = static_cast<float>(static_cast<std::int32_t>(one >> 16U)) * kStep + 0.5F * kStep;
      const float b = static_cast<float>(static_cast<std::int32_t>(one & 0xffffU)) * second_step + second_base;
      const float c = static_cast<float>(static_cast<std::int32_t>(two >> 16U)) * third_step + third_base;
      const float d = static_cast<float>(static_cast<std::int32_t>(two & 0xffffU)) * fourth_step + fourth_base;
      spare[i] -= polynomials::log2(a * b * (c * d));
    }
  }
  const float scale = kLn2 / static_cast<float>(looks);
  for (std::size_t i = 0; i < count; ++i) power[i] *= spare[i] * scale;
}

YARS_LANES void quantize(std::size_t count, const float* __restrict power, float gain_db, float decibels_per_scale,
                         std::uint8_t* __restrict video) {
  constexpr float kLeastPower = 1.0e-30F;  // keeps the logarithm's argument normal
  const float slope = 255.0F * kDecibelsPerOctave / decibels_per_scale;
  const float base = 255.0F * (1.0F + gain_db / decibels_per_scale) + 0.5F;
  for (std::size_t i = 0; i < count; ++i) {
    const float level = base + slope * polynomials::log2(larger(power[i], kLeastPower));
    video[i] = static_cast<std::uint8_t>(static_cast<std::int32_t>(smaller(larger(level, 0.5F), 255.5F)));
  }
}

}  // namespace yars::model::rbm::loops
