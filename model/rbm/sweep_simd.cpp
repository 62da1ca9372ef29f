#include "model/rbm/sweep_simd.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/rbm/sweep_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Included after highway.h, which defines the vector target (instruction set).
#include "model/physics/clutter_simd-inl.hpp"
#include "model/physics/polynomials-inl.hpp"
#include "model/rbm/gain_simd-inl.hpp"
#include "model/rbm/horizon_simd-inl.hpp"
#include "model/rbm/sample_groups-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::rbm::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace clutter = physics::simd::HWY_NAMESPACE;
namespace polynomials = physics::HWY_NAMESPACE;

constexpr std::size_t kMaxLanes = 16;  // limit of lanes in Tag (sample_groups-inl.hpp)

// Position of the ground in the vertical plane of the ray. R is the radius of the effective earth, a the angle at the
// earth's centre between aircraft and ground.
template <class Group>
struct Geometry {
  Group out_m, up_m;    // horizontal distance from the aircraft, height above it with the lift by refraction
  Group chord_m, sine;  // R sin a, sin a
  Group square;         // a^2
};

// Chord, drop and tilt are series in a, truncated before the fifth power (terrain::SightSeries). At 160 NM, a is below
// 0.05 rad. Accuracy at 0.1 rad (340 NM): drop 0.01 m, chord 1e-6 relative.
template <class Group>
HWY_INLINE Geometry<Group> geometry(const SweepConstants& c, const Group& distance, const Group& height) {
  const auto& series = c.lift.sight;
  const auto curvature = constant<Group>(c.curvature);
  const auto angle = mul(distance, curvature);
  Geometry<Group> g{};
  g.square = mul(angle, angle);
  const auto fall = mul_add(g.square, constant<Group>(series.fall_square), constant<Group>(series.fall));
  const auto drop = mul(mul(distance, angle), fall);
  const auto lean = mul_add(g.square, constant<Group>(series.tilt_square), constant<Group>(series.tilt));
  const auto tilt = neg_mul_add(g.square, lean, constant<Group>(series.upright));
  g.chord_m = neg_mul_add(mul(distance, g.square), constant<Group>(0.166666667F), distance);
  g.sine = mul(g.chord_m, curvature);
  g.out_m = mul_add(height, g.sine, g.chord_m);
  g.up_m = mul_sub(height, tilt, add(drop, constant<Group>(series.altitude_m)));
  return g;
}

template <class Group, class GroupMask>
HWY_INLINE Group tangent_of(const Geometry<Group>& g, const GroupMask& known) {
  return choose(known, div(g.up_m, g.out_m), constant<Group>(kNoHorizon));
}

template <class Group>
HWY_INLINE Group peak_tangent(const SweepConstants& c, const Group& distance, const Group& peak) {
  const auto known = is_number(peak);
  return tangent_of(geometry(c, distance, or_zero(known, peak)), known);
}

template <class Group>
HWY_INLINE Group inverse_root(const Group& value) {
  return each([](Floats x) { return polynomials::inverse_root(Tag(), x); }, value);
}

// Reflectivity of the ground of a group of samples (sample_groups-inl.hpp): gamma of land, sigma0 of sea. Both are 0 in
// a vector of the group that is entirely in shadow.
template <class Group>
struct Reflected {
  Group land, sea;
  bool wet;  // false: `sea` is 0
};

template <class Group, class GroupMask>
HWY_INLINE Reflected<Group> reflected(const physics::simd::GroundInputs& ground, clutter::GroundCache& cache,
                                      std::size_t i, const Group& level_sine, const Group& slant_square,
                                      const GroupMask& lit) {
  if constexpr (kIsPair<Group>) {
    const auto step = lanes_of<decltype(Group::near)>();
    const auto near = reflected(ground, cache, i, level_sine.near, slant_square.near, lit.near);
    const auto far = reflected(ground, cache, i + step, level_sine.far, slant_square.far, lit.far);
    return {{near.land, far.land}, {near.sea, far.sea}, near.wet || far.wet};
  } else {
    if (none(lit)) return {hn::Zero(Tag()), hn::Zero(Tag()), false};
    const clutter::GroundReturn found = clutter::ground_return(
        ground, cache, i, level_sine, [&] { return mul(level_sine, inverse_root(slant_square)); });
    return {found.land, found.sea, found.wet};
  }
}

// Inverse of the illuminated length in range [1/m]: the larger of the pulse-limited and the beam-limited value.
// `sine` and `cosine` of the grazing angle may have a common factor; the result has the same factor.
// `range_inverse` returns 1 / slant range. It is called only if the beam limits the length of some sample.
template <class Group, class RangeInverse>
HWY_INLINE Group area_inverse(const SweepConstants& c, const Group& sine, const Group& cosine,
                              const Group& slant_square, const RangeInverse& range_inverse) {
  const auto by_pulse = mul(cosine, constant<Group>(c.pulse_inverse));
  const auto by_beam = mul(sine, constant<Group>(c.beam_inverse));
  if (none(less(mul(mul(by_pulse, by_pulse), slant_square), mul(by_beam, by_beam)))) return by_pulse;
  return max(by_pulse, mul(by_beam, range_inverse()));
}

// Power of a group of samples with sensitivity time control of exponent 3, and the same of land with gamma 1.
// store_power() applies the rest of the exponent.
template <class Group>
struct Power {
  Group of_ground, per_gamma;
};

constexpr float kAlone = -1.0F;  // mark in the place of a rise

// `rise`: increase of the tangent over the visible ground of each cell; 0 where there is none; kAlone for level ground.
template <class Group, class GroupMask>
HWY_INLINE Power<Group> seen_power(const SweepConstants& c, radar::BeamPattern beam, const SweepInputs& in,
                                   clutter::GroundCache& cache, std::size_t i, const Geometry<Group>& g,
                                   const Group& height, const Group& slant_square, const Group& rise,
                                   const GroupMask& seen) {
  const auto one = constant<Group>(1.0F);
  const auto altitude = constant<Group>(c.altitude_m);
  const auto range_inverse = [&] { return inverse_root(slant_square); };
  // Sine and cosine of the grazing angle on level ground, times the slant range.
  const auto level = mul_add(
      g.square, mul_add(g.square, constant<Group>(c.lift.level_square), constant<Group>(c.lift.level)), altitude);
  const auto level_sine = sub(level, neg_mul_add(mul(height, g.square), constant<Group>(c.lift.level_height), height));
  const auto level_cosine = mul_add(altitude, g.sine, g.chord_m);
  const auto gain = ElevationGain<Group>(c, g.out_m, g.up_m, slant_square).of(beam);
  // The angle of elevation is the rise times (out / slant range)^2. One factor of the slant range is in the inverse
  // area.
  const auto risen = mul(mul(rise, load<Group>(in.cell_inverse + i)), mul(g.out_m, g.out_m));
  const auto angle = choose(less(rise, constant<Group>(0.0F)), max(level_sine, constant<Group>(0.0F)), risen);
  const auto inverse =
      mul(area_inverse(c, level_sine, abs(level_cosine), slant_square, range_inverse), gain.denominator);
  const auto per_gamma =
      or_zero(seen, div(mul(mul(angle, gain.numerator), constant<Group>(c.scale)), choose(seen, inverse, one)));
  if (in.ground == nullptr) return {mul(constant<Group>(c.land_gamma), per_gamma), per_gamma};
  const auto ground = reflected(*in.ground, cache, i, level_sine, slant_square, seen);
  const auto land = mul(ground.land, per_gamma);
  if (!ground.wet) return {land, per_gamma};
  // The sea is level, so its area is the area normal to the ray, divided by the sine. It does not exceed the cell where
  // the ground of a coast is steeper.
  const auto wet = both(seen, less(constant<Group>(0.0F), ground.sea));
  const auto slant = mul(slant_square, range_inverse());
  const auto per_normal = div(slant, choose(wet, max(level_sine, angle), one));
  return {add(land, or_zero(wet, mul(mul(ground.sea, per_gamma), per_normal))), per_gamma};
}

class SweepPass {
 public:
  HWY_INLINE SweepPass(const SweepConstants& constants, radar::BeamPattern beam, const SweepInputs& in,
                       const SweepOutputs& out)
      : c_(constants),
        beam_(beam),
        in_(in),
        out_(out),
        ground_(in.ground != nullptr ? *in.ground : none_),
        range_octaves_(polynomials::log2(Tag(), constant<Floats>(constants.range_m))) {}

  template <class Group>
  HWY_INLINE void measure(std::size_t i) {
    const auto tangent = load<Group>(out_.tangent + i);
    const auto [upto, before] = raise_horizon<Group>(i);
    const auto rise = visible_rise(i, tangent, upto, before);
    const auto seen = both(less(constant<Group>(0.0F), abs(rise)), less(constant<Group>(kNoHorizon), tangent));
    if (none(seen)) {
      store(constant<Group>(0.0F), out_.power + i);
      if (out_.power_per_gamma != nullptr) store(constant<Group>(0.0F), out_.power_per_gamma + i);
      return;
    }
    const auto elevation = load<Group>(in_.elevation_m + i);
    const auto height = or_zero(is_number(elevation), elevation);
    store_power(i, geometry(c_, load<Group>(in_.distance_m + i), height), height, rise, seen);
  }

 private:
  // Highest ground between the samples before and at `i`.
  template <class Group>
  HWY_INLINE Group crest(std::size_t i) const {
    const auto near = load<Group>(out_.near + i);
    return in_.crest == nullptr ? near : max(near, load<Group>(in_.crest + i));
  }

  // Raises the horizon to the crests and the ground before the samples.
  template <class Group>
  HWY_INLINE Horizon<Group> raise_horizon(std::size_t i) {
    const auto between = crest<Group>(i);
    const auto horizon = horizon_.after(max(load<Group>(out_.horizon + i), between));
    store(horizon.upto, out_.horizon + i);
    store(max(horizon.before, between), out_.before + i);
    return horizon;
  }

  // Rise of the horizon over the cell of each sample. The ground midway between two samples divides the rise between
  // them; it is taken as straight there. Next to a void the other half of the cell stands for both. kAlone: a sample
  // without neighbours that is lit.
  template <class Group>
  HWY_INLINE Group visible_rise(std::size_t i, const Group& tangent, const Group& upto, const Group& before) const {
    const auto no_ground = constant<Group>(kNoHorizon);
    const auto nearer = load<Group>(out_.tangent + i - 1);
    const auto farther = load<Group>(out_.tangent + i + 1);
    const auto horizon_after = max(upto, max(farther, crest<Group>(i + 1)));
    const auto near_edge = mul_add(load<Group>(in_.midway_weight + i), sub(nearer, tangent), tangent);
    const auto far_edge = mul_add(load<Group>(in_.midway_weight + i + 1), sub(tangent, farther), farther);
    const auto near = sub(upto, min(max(near_edge, before), upto));
    const auto far = sub(min(max(far_edge, upto), horizon_after), upto);
    const auto has_near = less(no_ground, nearer);
    const auto has_far = less(no_ground, farther);
    const auto rise = add(choose(has_near, near, far), choose(has_far, far, or_zero(has_near, near)));
    const auto neighbour = max(nearer, farther);
    if (none(less_or_equal(neighbour, no_ground))) return rise;
    const auto lit = less(max(before, crest<Group>(i)), tangent);
    return choose(less(no_ground, neighbour), rise, or_zero(lit, constant<Group>(kAlone)));
  }

  template <class Group, class GroupMask>
  HWY_INLINE void store_power(std::size_t i, const Geometry<Group>& g, const Group& height, const Group& rise,
                              const GroupMask& seen) {
    // A void counts as ground of height 0, and the aircraft may be at that ground. The slant range is at least 1 m.
    const auto slant_square = max(mul_add(g.out_m, g.out_m, mul(g.up_m, g.up_m)), constant<Group>(1.0F));
    auto power = seen_power(c_, beam_, in_, ground_, i, g, height, slant_square, rise, seen);
    const auto scale = [&](const Group& factor) {
      power.of_ground = mul(power.of_ground, factor);
      power.per_gamma = mul(power.per_gamma, factor);
    };
    if (c_.range_power != 0.0F) scale(time_control(slant_square));
    if (in_.gas.constant != nullptr) scale(gas(i, height));
    store(power.of_ground, out_.power + i);
    if (out_.power_per_gamma != nullptr) store(power.per_gamma, out_.power_per_gamma + i);
  }
  // Sensitivity time control beyond its exponent 3. Those of the beams (even_exponent() in receiver.cpp) are products.
  template <class Group>
  HWY_INLINE Group time_control(const Group& slant_square) const {
    if (c_.range_power == -3.0F || c_.range_power == -1.0F) {
      const auto ratio = mul(inverse_root(slant_square), constant<Group>(c_.range_m));
      return c_.range_power == -1.0F ? ratio : mul(mul(ratio, ratio), ratio);
    }
    return each(
        [&](Floats square) {
          const auto octaves =
              hn::Sub(hn::Mul(polynomials::log2(Tag(), square), constant<Floats>(0.5F)), range_octaves_);
          return polynomials::exp2(Tag(), hn::Mul(constant<Floats>(c_.range_power), octaves));
        },
        slant_square);
  }
  template <class Group>
  HWY_INLINE Group gas(std::size_t i, const Group& height) const {
    const auto lowest = constant<Group>(physics::GasSamples::kLowest_m);
    const auto up = min(max(height, lowest), constant<Group>(physics::GasSamples::kHighest_m));
    const auto slope = add(load<Group>(in_.gas.slope + i), mul(up, load<Group>(in_.gas.bend + i)));
    return add(load<Group>(in_.gas.constant + i), mul(up, slope));
  }

  const SweepConstants c_;
  const radar::BeamPattern beam_;
  const SweepInputs in_;
  const SweepOutputs out_;
  const physics::simd::GroundInputs none_;  // for ground_ if in.ground is null
  clutter::GroundCache ground_;
  RunningMaximum horizon_;
  const Floats range_octaves_;  // log2 of c_.range_m
};

// Tangents of the ground shortly before the samples where it reaches the horizon, else kNoHorizon.
template <class Group>
HWY_INLINE Group near_tangent(const SweepConstants& c, const SweepInputs& in, std::size_t i, const Group& horizon) {
  const auto height = load<Group>(in.near_m + i);
  const auto g = geometry(c, sub(load<Group>(in.distance_m + i), load<Group>(in.near_back_m + i)), height);
  // Compared by a product, which needs no division. False for NaN.
  const auto reaching = less_or_equal(mul(horizon, g.out_m), g.up_m);
  const auto none_here = constant<Group>(kNoHorizon);
  return none(reaching) ? none_here : choose(reaching, div(g.up_m, g.out_m), none_here);
}

void profile(std::size_t count, const SweepConstants& constants, const SweepInputs& in, const SweepOutputs& out) {
  using Group = Pair<Floats>;
  RunningMaximum horizon;
  for (std::size_t i = 0; i < count; i += lanes_of<Group>()) {
    const auto distance = load<Group>(in.distance_m + i);
    const auto elevation = load<Group>(in.elevation_m + i);
    const auto known = is_number(elevation);
    const auto tangent = in.peak_m == nullptr
                             ? tangent_of(geometry(constants, distance, or_zero(known, elevation)), known)
                             : peak_tangent(constants, distance, load<Group>(in.peak_m + i));
    const auto upto = horizon.after(tangent).upto;
    store(upto, out.horizon + i);
    store(near_tangent(constants, in, i, upto), out.near + i);
    // Beside a void, peak_m may be known where elevation_m is NaN. This ground casts a shadow but returns no power.
    store(choose(known, tangent, constant<Group>(kNoHorizon)), out.tangent + i);
  }
}

void sweep(std::size_t count, const SweepConstants& constants, radar::BeamPattern beam, const SweepInputs& inputs,
           const SweepOutputs& outputs) {
  using VectorPair = Pair<Floats>;
  SweepPass pass(constants, beam, inputs, outputs);
  for (std::size_t i = 0; i < count; i += lanes_of<VectorPair>()) pass.measure<VectorPair>(i);
}

// Stores the sums of the samples from `i` on, but none after the last sample.
template <class Sum>
HWY_INLINE void store_sums(std::size_t count, std::size_t i, const Sum& sum, float* result) {
  const Tag d;
  if (count - i >= hn::Lanes(d)) {
    hn::StoreU(sum, d, result + i);
  } else {
    HWY_ALIGN float last[kMaxLanes];
    hn::Store(sum, d, last);
    std::copy_n(last, count - i, result + i);
  }
}

// Smear over `kReach` samples on either side. A negative kReach selects `runtime_reach` instead.
template <std::ptrdiff_t kReach>
HWY_INLINE void smear_by(std::size_t count, const float* power, const float* weights, std::ptrdiff_t runtime_reach,
                         float* result) {
  const Tag d;
  const std::ptrdiff_t reach = kReach < 0 ? runtime_reach : kReach;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    auto sum = hn::Zero(d);
    for (std::ptrdiff_t k = -reach; k <= reach; ++k)
      sum = fused::mul_add(hn::Set(d, weights[reach + k]), hn::LoadU(d, power + i + k), sum);
    store_sums(count, i, sum, result);
  }
}

void weighted_sum(std::size_t count, std::span<const WeightedRay> rays, float* result) {
  const Tag d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    auto sum = hn::Zero(d);
    for (const WeightedRay& ray : rays)
      sum = hn::Add(sum, hn::Mul(hn::Set(d, ray.weight), hn::LoadU(d, ray.power + i)));
    store_sums(count, i, sum, result);
  }
}

void smear(std::size_t count, const float* power, const float* weights, std::ptrdiff_t reach, float* result) {
  switch (reach) {
    case 0:
      return smear_by<0>(count, power, weights, reach, result);
    case 1:
      return smear_by<1>(count, power, weights, reach, result);
    case 2:
      return smear_by<2>(count, power, weights, reach, result);
    default:
      return smear_by<-1>(count, power, weights, reach, result);
  }
}

}  // namespace yars::model::rbm::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::rbm::simd {

HWY_EXPORT(profile);
HWY_EXPORT(sweep);
HWY_EXPORT(smear);
HWY_EXPORT(weighted_sum);

void profile(std::size_t count, const SweepConstants& constants, const SweepInputs& inputs,
             const SweepOutputs& outputs) {
  HWY_DYNAMIC_DISPATCH(profile)(count, constants, inputs, outputs);
}
void sweep(std::size_t count, const SweepConstants& constants, radar::BeamPattern beam, const SweepInputs& inputs,
           const SweepOutputs& outputs) {
  HWY_DYNAMIC_DISPATCH(sweep)(count, constants, beam, inputs, outputs);
}
void smear(std::size_t count, const float* power, const float* weights, std::ptrdiff_t reach, float* result) {
  HWY_DYNAMIC_DISPATCH(smear)(count, power, weights, reach, result);
}
void weighted_sum(std::size_t count, std::span<const WeightedRay> rays, float* result) {
  HWY_DYNAMIC_DISPATCH(weighted_sum)(count, rays, result);
}

}  // namespace yars::model::rbm::simd
#endif  // HWY_ONCE
