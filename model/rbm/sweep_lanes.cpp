#include "model/rbm/sweep_lanes.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/rbm/sweep_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind highway.h, or it would have no target yet.
#include "model/rbm/ground_lanes-inl.hpp"
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
  Floats drop_m, chord_m, sine, cosine;
};

// Sine and cosine of the angle at the earth's centre, as the lengths that they stand for. Their series end at the fifth
// power of an angle below 0.04 (0.1 at 320 NM and k = 1: drop within 0.01 m, chord within 1e-6 of itself).
HWY_INLINE Geometry geometry(const SweepConstants& c, Floats distance, Floats height) {
  const auto curvature = constant(c.curvature);
  const auto angle = hn::Mul(distance, curvature);
  const auto square = hn::Mul(angle, angle);
  Geometry g{};
  const auto fall = hn::Sub(constant(0.5F), hn::Mul(square, constant(0.0416666667F)));
  g.drop_m = hn::Mul(hn::Mul(distance, angle), fall);
  g.chord_m = hn::Sub(distance, hn::Mul(hn::Mul(distance, square), constant(0.166666667F)));
  g.sine = hn::Mul(g.chord_m, curvature);
  g.cosine = hn::Sub(constant(1.0F), hn::Mul(g.drop_m, curvature));
  g.out_m = hn::Add(g.chord_m, hn::Mul(height, g.sine));
  g.up_m = hn::Sub(hn::Sub(hn::Mul(height, g.cosine), g.drop_m), constant(c.altitude_m));
  return g;
}

HWY_INLINE Floats tangent_of(const Geometry& g, hn::Mask<Tag> known) {
  return hn::IfThenElse(known, hn::Div(g.up_m, g.out_m), constant(kNoHorizon));
}

// Of the highest ground.
HWY_INLINE Floats peak_tangent(const SweepConstants& c, Floats distance, Floats peak) {
  const auto known = hn::Eq(peak, peak);
  return tangent_of(geometry(c, distance, hn::IfThenElseZero(known, peak)), known);
}

// Each lane's index less `back`, at least the first's: what is taken twice changes no maximum.
HWY_INLINE auto lanes_before(std::size_t back) {
  const hn::RebindToSigned<Tag> di;
  const auto lane = hn::Sub(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(back)));
  return hn::IndicesFromVec(Tag(), hn::Max(lane, hn::Zero(di)));
}

HWY_INLINE auto last_lane() {
  const hn::RebindToSigned<Tag> di;
  return hn::IndicesFromVec(Tag(), hn::Set(di, static_cast<std::int32_t>(hn::Lanes(Tag())) - 1));
}

// The greatest tangent up to each sample, a vector after the other.
class RunningMaximum {
 public:
  HWY_INLINE RunningMaximum()
      : back_{lanes_before(1), lanes_before(2), lanes_before(4), lanes_before(8)},
        last_(last_lane()),
        carry_(constant(kNoHorizon)) {}

  struct Horizon {
    Floats upto;    // with the sample itself
    Floats before;  // without
  };
  HWY_INLINE Horizon after(Floats tangent) {
    const Tag d;
    auto most = tangent;
    // Doubling: after each step a lane holds the maximum of twice as many up to itself.
    for (std::size_t step = 0; std::size_t{1} << step < hn::Lanes(d); ++step)
      most = hn::Max(most, hn::TableLookupLanes(most, back_[step]));
    const auto upto = hn::Max(most, carry_);
    const auto before = hn::IfThenElse(hn::FirstN(d, 1), carry_, hn::TableLookupLanes(upto, back_[0]));
    carry_ = hn::TableLookupLanes(upto, last_);
    return {upto, before};
  }

 private:
  static_assert(kMostLanes == 16);
  using Indices = decltype(last_lane());
  Indices back_[4];
  Indices last_;
  Floats carry_;
};

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
HWY_INLINE Floats along_slope(const SweepInputs& in, Floats here, std::size_t i) {
  const Tag d;
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

// The power of samples of which some are lit, before sensitivity time control but for its third power of range.
template <radar::BeamPattern kBeam>
HWY_INLINE Floats lit_power(const SweepConstants& c, const SweepInputs& in, TextureLanes& texture, std::size_t i,
                            const Geometry& g, Floats height, Floats range_inverse, hn::Mask<Tag> lit) {
  const Tag d;
  const auto zero = hn::Zero(d);
  const auto one = constant(1.0F);
  const auto altitude = constant(c.altitude_m);
  const auto sin_grazing = hn::Mul(hn::Sub(hn::Sub(hn::Mul(altitude, g.cosine), height), g.drop_m), range_inverse);
  const auto cos_grazing = hn::Mul(hn::Add(g.chord_m, hn::Mul(altitude, g.sine)), range_inverse);
  // Sine and cosine of the local grazing angle, both times the length of the facet's normal: it cancels in the power.
  const auto slope = along_slope(in, height, i);
  auto square = hn::Add(one, hn::Mul(slope, slope));
  if (in.cross_slope != nullptr) {
    const auto across = hn::LoadU(d, in.cross_slope + i);
    square = hn::Add(square, hn::Mul(across, across));
  }
  const auto sine = hn::Max(hn::Add(hn::Mul(slope, cos_grazing), sin_grazing), zero);
  const auto cosine = hn::Sqrt(hn::Max(hn::Sub(square, hn::Mul(sine, sine)), zero));
  const auto area_inverse = smaller_area_inverse(c, sine, cosine, range_inverse);
  const Gain gain = gain_of<kBeam>(c, hn::Mul(g.up_m, range_inverse), hn::Mul(g.out_m, range_inverse));
  const auto raised = hn::Mul(gain.over, constant(c.scale));
  // Where the sine is zero so is the power; the area's inverse may be zero there too.
  const auto returns = hn::And(lit, hn::Gt(sine, zero));
  const auto under = hn::IfThenElse(returns, hn::Mul(area_inverse, gain.under), one);
  const auto by_land = hn::Div(hn::Mul(sine, raised), under);
  if (in.ground == nullptr) return hn::IfThenElseZero(returns, hn::Mul(constant(c.land_gamma), by_land));
  const GroundReturn ground = ground_return(*in.ground, texture, i, sin_grazing);
  const auto land = hn::IfThenElseZero(returns, hn::Mul(ground.land, by_land));
  if (!ground.wet) return land;
  const auto wet = hn::And(lit, hn::Gt(ground.sea, zero));
  // The sea lies level: its area goes by the ray's own grazing angle.
  const auto level_inverse = smaller_area_inverse(c, sin_grazing, cos_grazing, range_inverse);
  const auto below = hn::IfThenElse(wet, hn::Mul(level_inverse, gain.under), one);
  return hn::Add(land, hn::IfThenElseZero(wet, hn::Div(hn::Mul(ground.sea, raised), below)));
}

template <radar::BeamPattern kBeam>
HWY_INLINE void sweep_by(std::size_t count, const SweepConstants& constants, const SweepInputs& in,
                         const SweepOutputs& out) {
  const Tag d;
  const SweepConstants c = constants;
  const GroundInputs none;
  TextureLanes texture(in.ground != nullptr ? *in.ground : none);
  RunningMaximum horizon;
  const auto reference_octaves = polynomials::log2(d, constant(c.range_inverse));
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto distance = hn::LoadU(d, in.distance_m + i);
    const auto elevation = hn::LoadU(d, in.elevation_m + i);
    const auto known = hn::Eq(elevation, elevation);
    const auto height = hn::IfThenElseZero(known, elevation);
    const Geometry g = geometry(c, distance, height);
    auto tangent = in.peak_m == nullptr ? tangent_of(g, known) : peak_tangent(c, distance, hn::LoadU(d, in.peak_m + i));
    const auto [upto, before] = horizon.after(tangent);
    // Beside a void the peak may be known where the mean is not: it hides what is behind it and returns nothing.
    tangent = hn::IfThenElse(known, tangent, constant(kNoHorizon));
    hn::StoreU(tangent, d, out.tangent + i);
    hn::StoreU(upto, d, out.horizon + i);
    const auto lit = hn::Gt(tangent, before);
    if (hn::AllFalse(d, lit)) {
      hn::StoreU(hn::Zero(d), d, out.power + i);
      continue;
    }
    // Nothing is nearer than a metre: a sample without ground may lie at the aircraft itself.
    const auto slant_square = hn::Add(hn::Mul(g.out_m, g.out_m), hn::Mul(g.up_m, g.up_m));
    const auto range_inverse = polynomials::inverse_root(d, hn::Max(slant_square, constant(1.0F)));
    auto power = lit_power<kBeam>(c, in, texture, i, g, height, range_inverse, lit);
    if (c.range_power != 0.0F) {
      const auto octaves = hn::Sub(polynomials::log2(d, range_inverse), reference_octaves);
      power = hn::Mul(power, polynomials::exp2(d, hn::Mul(constant(-c.range_power), octaves)));
    }
    hn::StoreU(power, d, out.power + i);
  }
}

void sweep(std::size_t count, const SweepConstants& constants, radar::BeamPattern beam, const SweepInputs& inputs,
           const SweepOutputs& outputs) {
  switch (beam) {
    case radar::BeamPattern::hard_edge:
      return sweep_by<radar::BeamPattern::hard_edge>(count, constants, inputs, outputs);
    case radar::BeamPattern::gaussian:
      return sweep_by<radar::BeamPattern::gaussian>(count, constants, inputs, outputs);
    case radar::BeamPattern::cosecant_squared:
      return sweep_by<radar::BeamPattern::cosecant_squared>(count, constants, inputs, outputs);
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

HWY_EXPORT(sweep);
HWY_EXPORT(smear);

void sweep(std::size_t count, const SweepConstants& constants, radar::BeamPattern beam, const SweepInputs& inputs,
           const SweepOutputs& outputs) {
  HWY_DYNAMIC_DISPATCH(sweep)(count, constants, beam, inputs, outputs);
}
void smear(std::size_t count, const float* power, const float* weights, std::ptrdiff_t reach, float* result) {
  HWY_DYNAMIC_DISPATCH(smear)(count, power, weights, reach, result);
}

}  // namespace yars::model::rbm::lanes
#endif  // HWY_ONCE
