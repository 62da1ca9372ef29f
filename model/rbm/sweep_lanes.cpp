#include "model/rbm/sweep_lanes.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/rbm/sweep_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind highway.h, or it would have no target yet.
#include "model/rbm/polynomials-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::rbm::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace polynomials = rbm::HWY_NAMESPACE;

constexpr std::size_t kMostLanes = 16;
using Tag = hn::CappedTag<float, kMostLanes>;
using Floats = hn::Vec<Tag>;

HWY_INLINE Floats constant(float value) {
  return hn::Set(Tag(), value);
}

// Where a point is in the vertical plane of the ray, and the aircraft as seen from it.
struct Geometry {
  Floats out_m, up_m;
  Floats inverse;  // [1/m] 1 / slant range
  Floats drop_m, chord_m, sine, cosine;
};

// Sine and cosine of the angle at the earth's centre, as the lengths that they stand for. Their series end at the fifth
// power of an angle below 0.04 (0.1 at 320 NM and k = 1: drop within 0.01 m, chord within 1e-6 of itself).
HWY_INLINE Geometry geometry(const SweepConstants& c, Floats distance, Floats height) {
  const Tag d;
  const auto curvature = constant(c.curvature);
  const auto one = constant(1.0F);
  const auto angle = hn::Mul(distance, curvature);
  const auto square = hn::Mul(angle, angle);
  Geometry g{};
  const auto fall = hn::Sub(constant(0.5F), hn::Mul(square, constant(0.0416666667F)));
  g.drop_m = hn::Mul(hn::Mul(distance, angle), fall);
  g.chord_m = hn::Sub(distance, hn::Mul(hn::Mul(distance, square), constant(0.166666667F)));
  g.sine = hn::Mul(g.chord_m, curvature);
  g.cosine = hn::Sub(one, hn::Mul(g.drop_m, curvature));
  g.out_m = hn::Add(g.chord_m, hn::Mul(height, g.sine));
  g.up_m = hn::Sub(hn::Sub(hn::Mul(height, g.cosine), g.drop_m), constant(c.altitude_m));
  // Nothing is nearer than a metre: a sample without ground may lie at the aircraft itself.
  const auto slant = hn::Add(hn::Mul(g.out_m, g.out_m), hn::Mul(g.up_m, g.up_m));
  g.inverse = polynomials::inverse_root(d, hn::Max(slant, one));
  return g;
}

HWY_INLINE Floats tangent_of(const Geometry& g, hn::Mask<Tag> known) {
  return hn::IfThenElse(known, hn::Div(g.up_m, g.out_m), constant(kNoHorizon));
}

void sight(std::size_t count, const SweepConstants& constants, const float* distance_m, const float* elevation_m,
           const SightArrays& out) {
  const Tag d;
  const SweepConstants c = constants;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto elevation = hn::LoadU(d, elevation_m + i);
    const auto known = hn::Eq(elevation, elevation);
    const auto height = hn::IfThenElseZero(known, elevation);
    const Geometry g = geometry(c, hn::LoadU(d, distance_m + i), height);
    const auto altitude = constant(c.altitude_m);
    hn::StoreU(tangent_of(g, known), d, out.tangent + i);
    hn::StoreU(g.inverse, d, out.range_inverse + i);
    hn::StoreU(hn::Mul(hn::Sub(hn::Sub(hn::Mul(altitude, g.cosine), height), g.drop_m), g.inverse), d,
               out.sin_grazing + i);
    hn::StoreU(hn::Mul(hn::Add(g.chord_m, hn::Mul(altitude, g.sine)), g.inverse), d, out.cos_grazing + i);
    hn::StoreU(hn::Mul(g.up_m, g.inverse), d, out.sin_sight + i);
    hn::StoreU(hn::Mul(g.out_m, g.inverse), d, out.cos_sight + i);
  }
}

void sight_tangent(std::size_t count, const SweepConstants& constants, const float* distance_m,
                   const float* elevation_m, float* tangent) {
  const Tag d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto elevation = hn::LoadU(d, elevation_m + i);
    const auto known = hn::Eq(elevation, elevation);
    const Geometry g = geometry(constants, hn::LoadU(d, distance_m + i), hn::IfThenElseZero(known, elevation));
    hn::StoreU(tangent_of(g, known), d, tangent + i);
  }
}

// Each lane's index less `back`, at least the first's: what is taken twice changes no maximum.
HWY_INLINE auto lanes_before(std::size_t back) {
  const hn::RebindToSigned<Tag> di;
  const auto lane = hn::Sub(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(back)));
  return hn::IndicesFromVec(Tag(), hn::Max(lane, hn::Zero(di)));
}

void running_maximum(std::size_t count, const float* tangent, float* horizon) {
  const Tag d;
  constexpr std::size_t kSteps = 4;
  static_assert(std::size_t{1} << kSteps == kMostLanes);
  const std::size_t lanes = hn::Lanes(d);
  const decltype(lanes_before(0)) before[kSteps] = {lanes_before(1), lanes_before(2), lanes_before(4), lanes_before(8)};
  const hn::RebindToSigned<Tag> di;
  const auto last = hn::IndicesFromVec(d, hn::Set(di, static_cast<std::int32_t>(lanes - 1)));
  auto carry = constant(kNoHorizon);
  for (std::size_t i = 0; i < count; i += lanes) {
    auto most = hn::LoadU(d, tangent + i);
    // Doubling: after each step a lane holds the maximum of twice as many up to itself.
    for (std::size_t step = 0; std::size_t{1} << step < lanes; ++step)
      most = hn::Max(most, hn::TableLookupLanes(most, before[step]));
    const auto all = hn::Max(most, carry);
    hn::StoreU(all, d, horizon + i);
    carry = hn::Max(carry, hn::TableLookupLanes(most, last));
  }
}

// A gain as a fraction: its division joins that of the power.
struct Gain {
  Floats over, under;
};

template <radar::BeamPattern kBeam>
HWY_INLINE Gain gain_of(const SweepConstants& c, Floats sin_sight, Floats cos_sight) {
  const Tag d;
  const auto one = constant(1.0F);
  const auto zero = hn::Zero(d);
  const auto sine = constant(c.sin_elevation);
  const auto cosine = constant(c.cos_elevation);
  // Sine and cosine of the angle below the antenna's centre.
  const auto below = hn::Sub(hn::Mul(sine, cos_sight), hn::Mul(cosine, sin_sight));
  const auto ahead = hn::Add(hn::Mul(cosine, cos_sight), hn::Mul(sine, sin_sight));
  if constexpr (kBeam == radar::BeamPattern::hard_edge) {
    const auto inside = hn::And(hn::Le(hn::Abs(below), constant(c.sin_half_beam)), hn::Gt(ahead, zero));
    return {hn::IfThenElseZero(inside, one), one};
  }
  const auto gaussian = [&] {
    const auto angle = polynomials::angle(d, hn::Abs(below), ahead);
    // A gain below 2^-64 is none: it must not make powers that are too small for normal numbers, and slow.
    return polynomials::exp2(d,
                             hn::Max(hn::Neg(hn::Mul(hn::Mul(constant(c.gaussian), angle), angle)), constant(-64.0F)));
  };
  if constexpr (kBeam == radar::BeamPattern::gaussian) return {gaussian(), one};
  const auto centre = constant(c.sin_centre);
  const auto spread =
      hn::Max(hn::Sub(hn::Mul(constant(c.sin_centre_tilt), cos_sight), hn::Mul(constant(c.cos_centre_tilt), sin_sight)),
              centre);
  Gain gain{hn::Mul(centre, centre), hn::Mul(spread, spread)};
  // Most ground lies below the centre: what is above it is worth a look before its exponential.
  const auto above = hn::Lt(below, zero);
  if (hn::AllFalse(d, above)) return gain;
  return {hn::IfThenElse(above, gaussian(), gain.over), hn::IfThenElse(above, one, gain.under)};
}

// Slope along the sweep: the central difference; towards a void or an end, the difference to the other side alone.
HWY_INLINE Floats along_slope(const PowerInputs& in, std::size_t i) {
  const Tag d;
  const auto here = hn::LoadU(d, in.elevation_m + i);
  const auto near = hn::LoadU(d, in.elevation_m + i - 1);
  const auto far = hn::LoadU(d, in.elevation_m + i + 1);
  const auto near_known = hn::Eq(near, near);
  const auto far_known = hn::Eq(far, far);
  const auto rise = hn::Sub(hn::IfThenElse(far_known, far, here), hn::IfThenElse(near_known, near, here));
  const auto both = hn::LoadU(d, in.two_step_inverse + i);
  const auto to_far = hn::LoadU(d, in.one_step_inverse + i);
  const auto to_near = hn::LoadU(d, in.one_step_inverse + i - 1);
  return hn::Mul(rise, hn::IfThenElse(near_known, hn::IfThenElse(far_known, both, to_near), to_far));
}

// The larger inverse of pulse and beam limit: the smaller area lit.
HWY_INLINE Floats smaller_area_inverse(const SweepConstants& c, Floats sine, Floats cosine, Floats range_inverse) {
  return hn::Max(hn::Mul(cosine, constant(c.pulse_inverse)),
                 hn::Mul(hn::Mul(sine, range_inverse), constant(c.beam_inverse)));
}

template <radar::BeamPattern kBeam>
HWY_INLINE void power_by(std::size_t count, const SweepConstants& constants, const PowerInputs& in, float* result) {
  const Tag d;
  const SweepConstants c = constants;
  const auto zero = hn::Zero(d);
  const auto one = constant(1.0F);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto lit = hn::Gt(hn::LoadU(d, in.tangent + i), hn::LoadU(d, in.horizon + i - 1));
    if (hn::AllFalse(d, lit)) {
      hn::StoreU(zero, d, result + i);
      continue;
    }
    // Sine and cosine of the local grazing angle, both times the length of the facet's normal: it cancels in the power.
    const auto slope = along_slope(in, i);
    auto square = hn::Add(one, hn::Mul(slope, slope));
    if (in.cross_slope != nullptr) {
      const auto across = hn::LoadU(d, in.cross_slope + i);
      square = hn::Add(square, hn::Mul(across, across));
    }
    const auto range_inverse = hn::LoadU(d, in.sights.range_inverse + i);
    const auto towards =
        hn::Add(hn::Mul(slope, hn::LoadU(d, in.sights.cos_grazing + i)), hn::LoadU(d, in.sights.sin_grazing + i));
    const auto sine = hn::Max(towards, zero);
    const auto cosine = hn::Sqrt(hn::Max(hn::Sub(square, hn::Mul(sine, sine)), zero));
    const auto area_inverse = smaller_area_inverse(c, sine, cosine, range_inverse);
    const auto gamma = in.land == nullptr ? constant(c.land_gamma) : hn::LoadU(d, in.land + i);
    const Gain gain = gain_of<kBeam>(c, hn::LoadU(d, in.sights.sin_sight + i), hn::LoadU(d, in.sights.cos_sight + i));
    const auto raised = hn::Mul(gain.over, constant(c.scale));
    // Where the sine is zero so is the power; the area's inverse may be zero there too.
    const auto returns = hn::And(lit, hn::Gt(sine, zero));
    const auto under = hn::IfThenElse(returns, hn::Mul(area_inverse, gain.under), one);
    auto sum = hn::IfThenElseZero(returns, hn::Div(hn::Mul(hn::Mul(gamma, sine), raised), under));
    if (in.sea != nullptr) {
      const auto sea = hn::LoadU(d, in.sea + i);
      const auto wet = hn::And(lit, hn::Gt(sea, zero));
      if (!hn::AllFalse(d, wet)) {
        // The sea lies level: its area goes by the ray's own grazing angle.
        const auto level_inverse = smaller_area_inverse(c, hn::LoadU(d, in.sights.sin_grazing + i),
                                                        hn::LoadU(d, in.sights.cos_grazing + i), range_inverse);
        const auto below = hn::IfThenElse(wet, hn::Mul(level_inverse, gain.under), one);
        sum = hn::Add(sum, hn::IfThenElseZero(wet, hn::Div(hn::Mul(sea, raised), below)));
      }
    }
    hn::StoreU(sum, d, result + i);
  }
  if (c.range_power == 0.0F) return;
  const auto at_reference = polynomials::log2(d, constant(c.range_inverse));
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto octaves = hn::Sub(polynomials::log2(d, hn::LoadU(d, in.sights.range_inverse + i)), at_reference);
    const auto control = polynomials::exp2(d, hn::Mul(constant(-c.range_power), octaves));
    hn::StoreU(hn::Mul(hn::LoadU(d, result + i), control), d, result + i);
  }
}

void power(std::size_t count, const SweepConstants& constants, radar::BeamPattern beam, const PowerInputs& inputs,
           float* result) {
  switch (beam) {
    case radar::BeamPattern::hard_edge:
      return power_by<radar::BeamPattern::hard_edge>(count, constants, inputs, result);
    case radar::BeamPattern::gaussian:
      return power_by<radar::BeamPattern::gaussian>(count, constants, inputs, result);
    case radar::BeamPattern::cosecant_squared:
      return power_by<radar::BeamPattern::cosecant_squared>(count, constants, inputs, result);
  }
}

void smear(std::size_t count, const float* power, const float* weights, std::ptrdiff_t reach, float* result) {
  const Tag d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    auto sum = hn::Zero(d);
    for (std::ptrdiff_t k = -reach; k <= reach; ++k)
      sum = hn::Add(sum, hn::Mul(hn::Set(d, weights[reach + k]), hn::LoadU(d, power + i + k)));
    if (count - i >= hn::Lanes(d)) {
      hn::StoreU(sum, d, result + i);
    } else {
      HWY_ALIGN float last[kMostLanes];
      hn::Store(sum, d, last);
      std::copy_n(last, count - i, result + i);
    }
  }
}

}  // namespace yars::model::rbm::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::rbm::lanes {

HWY_EXPORT(sight);
HWY_EXPORT(sight_tangent);
HWY_EXPORT(running_maximum);
HWY_EXPORT(power);
HWY_EXPORT(smear);

void sight(std::size_t count, const SweepConstants& constants, const float* distance_m, const float* elevation_m,
           const SightArrays& out) {
  HWY_DYNAMIC_DISPATCH(sight)(count, constants, distance_m, elevation_m, out);
}
void sight_tangent(std::size_t count, const SweepConstants& constants, const float* distance_m,
                   const float* elevation_m, float* tangent) {
  HWY_DYNAMIC_DISPATCH(sight_tangent)(count, constants, distance_m, elevation_m, tangent);
}
void running_maximum(std::size_t count, const float* tangent, float* horizon) {
  HWY_DYNAMIC_DISPATCH(running_maximum)(count, tangent, horizon);
}
void power(std::size_t count, const SweepConstants& constants, radar::BeamPattern beam, const PowerInputs& inputs,
           float* result) {
  HWY_DYNAMIC_DISPATCH(power)(count, constants, beam, inputs, result);
}
void smear(std::size_t count, const float* power, const float* weights, std::ptrdiff_t reach, float* result) {
  HWY_DYNAMIC_DISPATCH(smear)(count, power, weights, reach, result);
}

}  // namespace yars::model::rbm::lanes
#endif  // HWY_ONCE
