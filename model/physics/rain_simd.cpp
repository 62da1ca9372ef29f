#include "model/physics/rain_simd.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lib/geo/geodesy.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

#ifndef YARS_MODEL_PHYSICS_RAIN_RUN
#define YARS_MODEL_PHYSICS_RAIN_RUN
namespace yars::model::physics::simd {
// Samples of a sweep, the showers on its ray, and the results.
struct RainRun {
  std::size_t count;
  std::span<const RainCrossing> crossings;
  float* power;
  float* transmission;
};
}  // namespace yars::model::physics::simd
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/physics/rain_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Included after highway.h, which defines the vector target.
#include "lib/simd/fused-inl.hpp"
#include "model/physics/polynomials-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::physics::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace fused = yars::simd::HWY_NAMESPACE;
namespace polynomials = physics::HWY_NAMESPACE;

using RainTag = hn::CappedTag<float, terrain::kRunSlack>;
using RainFloats = hn::Vec<RainTag>;
using RainMask = hn::Mask<RainTag>;

HWY_INLINE RainFloats set(float value) {
  return hn::Set(RainTag(), value);
}

// Error function of a number >= 0. Error 3e-7. Source: Abramowitz and Stegun 1964, 7.1.26.
HWY_INLINE RainFloats error_function(RainFloats x) {
  const RainTag d;
  const auto t = hn::Div(set(1.0F), fused::mul_add(set(0.3275911F), x, set(1.0F)));
  auto p = set(1.061405429F);
  p = fused::mul_add(p, t, set(-1.453152027F));
  p = fused::mul_add(p, t, set(1.421413741F));
  p = fused::mul_add(p, t, set(-0.284496736F));
  p = fused::mul_add(p, t, set(0.254829592F));
  // log2(e) x^2. Limited to 64, where the result is 1 already: with smaller powers of 2 the products may be subnormal,
  // which is slow.
  const auto octaves = hn::Min(hn::Mul(hn::Mul(x, x), set(1.44269504F)), set(64.0F));
  return fused::neg_mul_add(hn::Mul(p, t), polynomials::exp2(d, hn::Neg(octaves)), set(1.0F));
}

// Direction from the antenna: horizontal component > 0 and vertical component, with any common factor.
struct Direction {
  RainFloats out, up;
};

// Edge of an interval of elevations. Integrals of the cosecant patterns below their centre are differences of functions
// of the cotangent, which would cancel in single precision if they were computed from the centre.
struct Edge {
  RainFloats integral;  // [rad] of the two-way pattern, from its centre down to the edge; negative above the centre
  RainFloats
      cotangent;  // of the angle x of the cosecant patterns; their `integral` has the part above the centre alone
};

HWY_INLINE bool is_cosecant(radar::BeamPattern beam) {
  return beam == radar::BeamPattern::cosecant_squared || beam == radar::BeamPattern::mapping;
}

HWY_INLINE Edge edge_at(const RainConstants& c, radar::BeamPattern beam, Direction to) {
  const RainTag d;
  const auto zero = hn::Zero(d);
  const auto above = fused::mul_sub(set(c.cos_elevation), to.up, hn::Mul(set(c.sin_elevation), to.out));
  const auto off_axis = [&] {
    const auto ahead = fused::mul_add(set(c.cos_elevation), to.out, hn::Mul(set(c.sin_elevation), to.up));
    return polynomials::angle(d, hn::Abs(above), ahead);
  };
  const auto signed_below = [&](RainFloats value) {
    return hn::IfThenElse(hn::Gt(above, zero), hn::Neg(value), value);
  };
  if (beam == radar::BeamPattern::hard_edge) return {signed_below(hn::Min(off_axis(), set(c.half_beam_rad))), zero};
  const auto gaussian = [&] {
    return signed_below(hn::Mul(set(c.gaussian_rad), error_function(hn::Mul(set(c.erf_per_rad), off_axis()))));
  };
  if (beam == radar::BeamPattern::gaussian) return {gaussian(), zero};
  // The depression b of the centre is at least half a beamwidth. x is b plus the angle from the centre down to the
  // edge.
  const auto sine = fused::mul_sub(set(c.sin_axis), to.out, hn::Mul(set(c.cos_axis), to.up));
  const auto cosine = fused::mul_add(set(c.cos_axis), to.out, hn::Mul(set(c.sin_axis), to.up));
  const auto within = hn::Gt(sine, zero);
  const auto min_cotangent = hn::Neg(set(c.centre_cotangent));
  const auto cotangent = hn::Div(cosine, hn::IfThenElse(within, sine, set(1.0F)));
  const auto limited = hn::Max(hn::IfThenElse(within, cotangent, min_cotangent), min_cotangent);
  const auto upper = hn::Gt(above, zero);
  if (hn::AllFalse(d, upper)) return {zero, limited};
  return {hn::IfThenElseZero(upper, gaussian()), hn::IfThenElse(upper, set(c.centre_cotangent), limited)};
}

// Integral [rad] of the two-way pattern between two edges. Below the centre: csc^2 has sin^2 b (cot x - cot y), csc^4
// has sin^4 b (cot x + cot^3 x / 3 - cot y - cot^3 y / 3). The difference of the cubes has that of the cotangents as a
// factor.
HWY_INLINE RainFloats integral_between(const RainConstants& c, radar::BeamPattern beam, const Edge& upper,
                                       const Edge& lower) {
  const auto integral = hn::Sub(lower.integral, upper.integral);
  if (!is_cosecant(beam)) return integral;
  const auto sine2 = set(c.sin_centre2);
  const auto below = hn::Mul(sine2, hn::Sub(upper.cotangent, lower.cotangent));
  if (beam == radar::BeamPattern::cosecant_squared) return hn::Add(integral, below);
  const auto both = fused::mul_add(upper.cotangent, lower.cotangent, hn::Mul(lower.cotangent, lower.cotangent));
  const auto squares = fused::mul_add(upper.cotangent, upper.cotangent, both);
  const auto factor = hn::Mul(sine2, fused::mul_add(squares, set(1.0F / 3.0F), set(1.0F)));
  return fused::mul_add(below, factor, integral);
}

// Samples of one vector: quantities that all showers share.
class RainVector {
 public:
  HWY_INLINE RainVector(const RainConstants& c, radar::BeamPattern beam, const RainGround& ground, std::size_t i)
      : c_(c), beam_(beam), horizon_(hn::LoadU(RainTag(), ground.horizon + i)) {
    const RainTag d;
    distance_m_ = hn::LoadU(d, ground.distance_m + i);
    const auto elevation_m = hn::LoadU(d, ground.elevation_m + i);
    const auto height_m = hn::IfThenElseZero(hn::Eq(elevation_m, elevation_m), elevation_m);
    const auto curvature = set(c.curvature);
    const auto angle = hn::Mul(distance_m_, curvature);
    const auto square = hn::Mul(angle, angle);
    // terrain::SightSeries.
    const auto& series = c.lift.sight;
    drop_m_ = hn::Mul(hn::Mul(distance_m_, angle), fused::mul_add(square, set(series.fall_square), set(series.fall)));
    chord_m_ = fused::neg_mul_add(hn::Mul(distance_m_, square), set(0.166666667F), distance_m_);
    sine_ = hn::Mul(chord_m_, curvature);
    tilt_ = fused::neg_mul_add(square, fused::mul_add(square, set(series.tilt_square), set(series.tilt)),
                               set(series.upright));
    const Direction ground_point = to_height(height_m);
    slant_square_ = hn::Max(square_of(ground_point), set(1.0F));
    distance_inverse_ = hn::Div(set(1.0F), hn::Max(distance_m_, set(1e-3F)));
    const auto sag = fused::mul_add(square, set(c.lift.sag_square), set(c.lift.sag));
    sag_m_ = hn::Mul(hn::Mul(distance_m_, angle), fused::mul_add(height_m, set(c.lift.sag_height), sag));
    const auto fall_m = hn::Sub(hn::Sub(height_m, set(c.altitude_m)), sag_m_);
    // A ray that is level within a millimetre is taken to fall by a millimetre, because stretch() divides by its fall.
    fall_m_ = hn::IfThenElse(hn::Lt(hn::Abs(fall_m), set(1e-3F)), set(-1e-3F), fall_m);
  }

  HWY_INLINE void cross(const RainCrossing& crossing) {
    const RainTag d;
    const auto offset_m = hn::Sub(distance_m_, set(crossing.middle_m));
    const auto inside = hn::Lt(hn::Abs(offset_m), set(crossing.half_m));
    if (!hn::AllFalse(d, inside)) echo_ = hn::Add(echo_, hn::IfThenElseZero(inside, echo(crossing, offset_m)));
    octaves_ = fused::mul_add(set(crossing.octaves_per_m), integral_m(crossing, offset_m), octaves_);
  }

  HWY_INLINE void store(float* power, float* transmission) const {
    const RainTag d;
    auto received = hn::Zero(d);
    if (!hn::AllFalse(d, hn::Gt(echo_, hn::Zero(d)))) {
      const auto octaves = fused::mul_sub(set(c_.half_stc), polynomials::log2(d, slant_square_), set(c_.stc_octaves));
      received = hn::Mul(echo_, polynomials::exp2(d, octaves));
    }
    hn::StoreU(received, d, power);
    // Length of the ray divided by its distance over ground.
    const auto slope = hn::Mul(hn::Sqrt(slant_square_), distance_inverse_);
    const auto loss = polynomials::exp2(d, hn::Neg(hn::Mul(octaves_, slope)));
    hn::StoreU(hn::IfThenElse(hn::Gt(octaves_, hn::Zero(d)), loss, set(1.0F)), d, transmission);
  }

 private:
  HWY_INLINE Direction to_height(RainFloats height_m) const {
    return {fused::mul_add(height_m, sine_, chord_m_),
            fused::mul_sub(height_m, tilt_, hn::Add(drop_m_, set(c_.lift.sight.altitude_m)))};
  }
  static HWY_INLINE RainFloats square_of(Direction to) { return fused::mul_add(to.out, to.out, hn::Mul(to.up, to.up)); }

  // Echo of a shower before sensitivity time control: reflectivity times profile times beam integral / R^2.
  HWY_INLINE RainFloats echo(const RainCrossing& crossing, RainFloats offset_m) {
    const RainTag d;
    const auto zero = hn::Zero(d);
    if (!has_lower_) {
      lower_ = edge_at(c_, beam_, {set(1.0F), horizon_});
      has_lower_ = true;
    }
    const auto off = hn::Mul(offset_m, set(crossing.radius_inverse));
    const auto root = hn::Max(fused::neg_mul_add(off, off, set(crossing.depth)), zero);
    const Direction top = to_height(set(crossing.top_m));
    const auto lit = hn::Gt(top.up, hn::Mul(horizon_, top.out));
    const auto beam = hn::Max(integral_between(c_, beam_, edge_at(c_, beam_, top), lower_), zero);
    const auto strength = hn::Mul(hn::Mul(set(crossing.reflectivity), hn::Mul(root, root)), beam);
    return hn::IfThenElseZero(lit, hn::Div(strength, hn::Max(square_of(top), set(1.0F))));
  }

  // Height above the earth of the ray to the sample's ground, at a fraction of its length.
  HWY_INLINE RainFloats height_at(RainFloats fraction) const {
    return fused::mul_add(fraction, fused::mul_add(fraction, sag_m_, fall_m_), set(c_.altitude_m));
  }

  // Part of the ray below the shower's top, as distances from the chord's middle. Vector form of stretch_below().
  struct Interval {
    RainFloats from_m, to_m;
  };
  HWY_INLINE Interval stretch(const RainCrossing& crossing) const {
    const RainTag d;
    const auto zero = hn::Zero(d);
    const auto above_m = hn::Sub(set(c_.altitude_m), set(crossing.top_m));
    const auto square = fused::mul_sub(fall_m_, fall_m_, hn::Mul(hn::Mul(set(4.0F), sag_m_), above_m));
    const auto root = hn::Sqrt(hn::Max(square, zero));
    const auto falling = hn::Lt(fall_m_, zero);
    const auto q = hn::Mul(set(-0.5F), hn::Add(fall_m_, hn::IfThenElse(falling, hn::Neg(root), root)));
    const auto one = hn::Div(above_m, q);
    const auto other = hn::Div(q, hn::Max(sag_m_, set(1e-30F)));
    const auto part = [&](RainFloats fraction) {
      const auto clamped = hn::Min(hn::Max(fraction, zero), set(1.0F));
      return hn::Sub(hn::Mul(clamped, distance_m_), set(crossing.middle_m));
    };
    const auto below = hn::Gt(square, zero);
    const auto from_m = part(hn::Min(one, other));
    return {from_m, hn::IfThenElse(below, part(hn::Max(one, other)), from_m)};
  }

  // Antiderivative of the profile.
  static HWY_INLINE RainFloats antiderivative(const RainCrossing& crossing, RainFloats offset_m) {
    const auto off = hn::Mul(offset_m, set(crossing.radius_inverse));
    const auto square = hn::Mul(off, off);
    const auto depth = set(crossing.depth);
    const auto slope = fused::neg_mul_add(square, set(0.2F), hn::Mul(depth, set(0.666666667F)));
    return hn::Mul(offset_m, fused::neg_mul_add(square, slope, hn::Mul(depth, depth)));
  }

  // Integral of the profile over the part of the ray below the shower's top.
  HWY_INLINE RainFloats integral_m(const RainCrossing& crossing, RainFloats offset_m) const {
    const RainTag d;
    const auto half = set(crossing.half_m);
    const auto begin = hn::Max(hn::Neg(half), hn::Neg(set(crossing.middle_m)));
    const auto end = hn::Min(offset_m, half);
    const auto fraction = [&](RainFloats offset) {
      return hn::Mul(hn::Add(offset, set(crossing.middle_m)), distance_inverse_);
    };
    // The height along the ray is convex. So a chord with both ends below the top is wholly below it.
    const auto top_m = set(crossing.top_m);
    const auto near_m = height_at(fraction(begin)), far_m = height_at(fraction(end));
    const auto under = hn::Lt(hn::Max(near_m, far_m), top_m);
    // The parabola is at most a quarter of its sag below the lower end.
    const auto over = hn::Gt(fused::neg_mul_add(sag_m_, set(0.25F), hn::Min(near_m, far_m)), top_m);
    const auto empty = hn::Or(over, hn::Le(end, begin));
    Interval wet{begin, hn::IfThenElse(empty, begin, end)};
    if (!hn::AllTrue(d, hn::Or(under, empty))) {
      const Interval crossed = stretch(crossing);
      const auto mixed = hn::Not(hn::Or(under, empty));
      wet.from_m = hn::IfThenElse(mixed, hn::Max(crossed.from_m, begin), wet.from_m);
      wet.to_m = hn::IfThenElse(mixed, hn::Min(crossed.to_m, end), wet.to_m);
    }
    const auto integral = hn::Sub(antiderivative(crossing, wet.to_m), antiderivative(crossing, wet.from_m));
    return hn::IfThenElseZero(hn::Gt(wet.to_m, wet.from_m), hn::Max(integral, hn::Zero(d)));
  }

  const RainConstants& c_;
  const radar::BeamPattern beam_;
  const RainFloats horizon_;
  RainFloats distance_m_, drop_m_, chord_m_, sine_, tilt_;  // as in terrain::SightSeries
  RainFloats slant_square_;                                 // of the ground
  RainFloats distance_inverse_;
  RainFloats sag_m_, fall_m_;  // coefficients of height_at()
  Edge lower_{hn::Zero(RainTag()), hn::Zero(RainTag())};
  bool has_lower_ = false;  // true: lower_ is the horizon
  RainFloats echo_ = hn::Zero(RainTag()), octaves_ = hn::Zero(RainTag());
};

void rain(const RainConstants& input, radar::BeamPattern beam, const RainRun& run, const RainGround& ground) {
  const std::size_t lanes = hn::Lanes(RainTag());
  const RainConstants constants = input;
  for (std::size_t i = 0; i < run.count; i += lanes) {
    RainVector samples(constants, beam, ground, i);
    const float farthest_m = ground.distance_m[std::min(i + lanes, run.count) - 1];
    for (const RainCrossing& crossing : run.crossings)
      if (farthest_m - crossing.middle_m > -crossing.half_m) samples.cross(crossing);
    samples.store(run.power + i, run.transmission + i);
  }
}

}  // namespace yars::model::physics::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::physics {

namespace simd {
HWY_EXPORT(rain);
static void measure_rain(const RainConstants& constants, radar::BeamPattern beam, const RainRun& run,
                         const RainGround& ground) {
  HWY_DYNAMIC_DISPATCH(rain)(constants, beam, run, ground);
}
}  // namespace simd

RainChord rain_chord_in_plane(double ahead_m, double right_m, double radius_of_curvature_m, double radius_m) {
  constexpr double kInverse = 1.0 / geo::kMeanEarthRadius_m;
  const double plane2 = ahead_m * ahead_m + right_m * right_m;
  const double arc = arc_per_plane(plane2, radius_of_curvature_m);
  const double w = plane2 * arc * arc * kInverse * kInverse;  // squared arc on the mean sphere [rad^2]
  const double sine = arc * (1.0 - w / 6.0 * (1.0 - w / 20.0 * (1.0 - w / 42.0)));
  const double cosine = 1.0 - 0.5 * w * (1.0 - w / 12.0 * (1.0 - w / 30.0));
  const double across = right_m * sine * kInverse;
  const double p = across * across;
  const double miss_m = right_m * sine * (1.0 + p * (1.0 / 6.0 + p * (3.0 / 40.0)));
  const double t = ahead_m * sine * kInverse / cosine;
  const double t2 = t * t;
  RainChord chord;
  chord.radius_m = radius_m;
  chord.middle_m =
      geo::kMeanEarthRadius_m * t * (1.0 - t2 * (1.0 / 3.0 - t2 * (1.0 / 5.0 - t2 * (1.0 / 7.0 - t2 / 9.0))));
  chord.depth = 1.0 - miss_m * miss_m / (radius_m * radius_m);
  chord.half_m = chord.depth > 0.0 ? radius_m * std::sqrt(chord.depth) : 0.0;
  return chord;
}

RainSamples::RainSamples(const RadarParameters& parameters, std::size_t samples)
    : beam_(parameters.beam), samples_(samples), power_(samples + terrain::kRunSlack), transmission_(power_) {
  use_showers(parameters);
}

void RainSamples::use_showers(const RadarParameters& parameters) {
  showers_ = configured_showers(parameters);
  centres_.clear();
  crossed_.clear();
  for (const Shower& shower : showers_)
    centres_.push_back(geo::ecef_from_geodetic(shower.position, geo::HeightAboveEllipsoid::metres(0.0)));
  crossed_.reserve(showers_.size());
  crossings_.reserve(showers_.size());
}

void RainSamples::enter(const SweepGeometry& geometry) {
  constexpr double kMargin = 1.02;  // distances in the tangent plane and over ground differ by less than 2 %
  crossed_.clear();
  if (centres_.empty()) return;
  const auto sea_level = geo::HeightAboveEllipsoid::metres(0.0);
  const geo::LocalTangentFrame level(geometry.apex, sea_level);
  const double azimuth_rad = geometry.azimuth.degrees() * geo::kRadiansPerDegree;
  const double sine = std::sin(azimuth_rad), cosine = std::cos(azimuth_rad);
  const geo::Vector3 apex = geo::ecef_from_geodetic(geometry.apex, sea_level);
  const geo::Vector3 ahead = level.ecef_from_enu_direction({sine, cosine, 0.0});
  const geo::Vector3 right = level.ecef_from_enu_direction({cosine, -sine, 0.0});
  const double curvature_m = geo::radius_of_curvature(geometry.apex.latitude_deg, geometry.azimuth).metres();
  const double range_m = geometry.range.metres();
  for (std::size_t i = 0; i < centres_.size(); ++i) {
    const geo::Vector3 to_centre = centres_[i] - apex;
    const double right_m = dot(to_centre, right), ahead_m = dot(to_centre, ahead);
    const double radius_m = showers_[i].radius_m;
    const double reach_m = kMargin * radius_m, farthest_m = range_m + radius_m;
    if (std::abs(right_m) > reach_m || ahead_m < -reach_m || dot(to_centre, to_centre) > farthest_m * farthest_m)
      continue;
    const RainChord chord = rain_chord_in_plane(ahead_m, right_m, curvature_m, radius_m);
    const bool crosses = chord.middle_m + chord.half_m > 0.0 && chord.middle_m - chord.half_m < range_m;
    if (chord.half_m > 0.0 && crosses) crossed_.push_back({chord, &showers_[i]});
  }
}

simd::RainConstants RainSamples::constants(const SweepGeometry& geometry, const EffectiveEarth& earth,
                                           const Receiver& receiver) const {
  const std::array<float, 1> reach_m{static_cast<float>(geometry.range.metres())};
  const double elevation_rad = geometry.elevation.radians();
  const double beam_rad = receiver.elevation_beamwidth_rad;
  const double centre_rad = std::max(-elevation_rad, 0.5 * beam_rad);
  const double erf_per_rad = std::sqrt(kTwoWayExponent) / beam_rad;
  simd::RainConstants c;
  c.altitude_m = static_cast<float>(geometry.altitude.metres());
  c.curvature = static_cast<float>(earth.curvature());
  c.lift = in_float(earth.lift(), {geometry.altitude.metres(), earth.curvature(), {}, reach_m});
  c.half_stc = static_cast<float>(0.5 * receiver.stc_exponent);
  c.stc_octaves = static_cast<float>(receiver.stc_exponent * std::log2(kFullScaleRange.metres()));
  c.sin_elevation = static_cast<float>(std::sin(elevation_rad));
  c.cos_elevation = static_cast<float>(std::cos(elevation_rad));
  c.half_beam_rad = static_cast<float>(0.5 * beam_rad);
  c.erf_per_rad = static_cast<float>(erf_per_rad);
  c.gaussian_rad = static_cast<float>(0.5 * std::sqrt(std::numbers::pi) / erf_per_rad);
  c.sin_centre2 = static_cast<float>(std::pow(std::sin(centre_rad), 2.0));
  c.centre_cotangent = static_cast<float>(1.0 / std::tan(centre_rad));
  c.sin_axis = static_cast<float>(std::sin(centre_rad + elevation_rad));
  c.cos_axis = static_cast<float>(std::cos(centre_rad + elevation_rad));
  return c;
}

void RainSamples::measure(const SweepGeometry& geometry, const EffectiveEarth& earth, const Receiver& receiver,
                          const simd::RainGround& ground) {
  const double octaves_per_db = std::log2(10.0) / 10.0;
  const double scale = receiver.azimuth_cell_rad * receiver.pulse_length_m / receiver.full_scale;
  crossings_.clear();
  for (const Crossed& crossed : crossed_) {
    const RainChord& chord = crossed.chord;
    crossings_.push_back({static_cast<float>(chord.middle_m), static_cast<float>(chord.half_m),
                          static_cast<float>(chord.depth), static_cast<float>(1.0 / chord.radius_m),
                          static_cast<float>(crossed.shower->top_m),
                          static_cast<float>(scale * crossed.shower->reflectivity),
                          static_cast<float>(2.0 * octaves_per_db * crossed.shower->attenuation_db_per_m)});
  }
  simd::measure_rain(constants(geometry, earth, receiver), beam_,
                     {samples_, crossings_, power_.data(), transmission_.data()}, ground);
}

}  // namespace yars::model::physics
#endif  // HWY_ONCE
