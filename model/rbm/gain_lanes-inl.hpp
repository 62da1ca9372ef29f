// The two-way gain in elevation of each beam pattern, for groups of vectors. Included once for each target.
#if defined(YARS_MODEL_RBM_GAIN_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef YARS_MODEL_RBM_GAIN_LANES_INL
#undef YARS_MODEL_RBM_GAIN_LANES_INL
#else
#define YARS_MODEL_RBM_GAIN_LANES_INL
#endif

#include <hwy/highway.h>

#include "model/rbm/lane_groups-inl.hpp"
#include "model/rbm/polynomials-inl.hpp"
#include "model/rbm/sweep_lanes.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::rbm::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace polynomials = rbm::HWY_NAMESPACE;

// A gain as a fraction: its division joins that of the power.
template <class Group>
struct Gain {
  Group over, under;
};

// Of a sight line that leads `out_m` along and `up_m` up: no pattern asks how long it is but by its square.
template <radar::BeamPattern kBeam, class Group>
HWY_INLINE Gain<Group> gain_of(const SweepConstants& c, const Group& out_m, const Group& up_m,
                               const Group& slant_square) {
  const auto zero = constant<Group>(0.0F);
  const auto one = constant<Group>(1.0F);
  const auto sine = constant<Group>(c.sin_elevation);
  const auto cosine = constant<Group>(c.cos_elevation);
  // Sine and cosine of the angle below the antenna's centre, times the slant range.
  const auto below = mul_sub(sine, out_m, mul(cosine, up_m));
  const auto ahead = [&] { return mul_add(cosine, out_m, mul(sine, up_m)); };
  if constexpr (kBeam == radar::BeamPattern::hard_edge) {
    const auto half = constant<Group>(c.sin_half_beam * c.sin_half_beam);
    const auto narrow = less_or_equal(mul(below, below), mul(half, slant_square));
    return {or_zero(both(narrow, less(zero, ahead())), one), one};
  }
  const auto gaussian = [&] {
    return each(
        [&](Floats off, Floats on) {
          const Tag d;
          const auto angle = polynomials::angle(d, hn::Abs(off), on);
          // A gain below 2^-64 is none: it must not make powers that are too small for normal numbers, and slow.
          const auto octaves = hn::Neg(hn::Mul(hn::Mul(constant<Floats>(c.gaussian), angle), angle));
          return polynomials::exp2(d, hn::Max(octaves, constant<Floats>(-64.0F)));
        },
        below, ahead());
  };
  if constexpr (kBeam == radar::BeamPattern::gaussian) return {gaussian(), one};
  const auto spread =
      max(mul_sub(constant<Group>(c.sin_centre_tilt), out_m, mul(constant<Group>(c.cos_centre_tilt), up_m)), zero);
  const auto over = mul(constant<Group>(c.sin_centre * c.sin_centre), slant_square);
  const Gain<Group> gain{over, max(mul(spread, spread), over)};
  // Most ground lies below the centre: what is above it is worth a look before its exponential.
  const auto above = less(below, zero);
  if (none(above)) return gain;
  return {choose(above, gaussian(), gain.over), choose(above, one, gain.under)};
}

}  // namespace yars::model::rbm::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
