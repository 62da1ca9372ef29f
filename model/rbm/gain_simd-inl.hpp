// Two-way gain in elevation of the beam patterns of physics::two_way_gain(). Groups (sample_groups-inl.hpp) of float
// vectors are computed together.
// Included once for each target (instruction set) of the library Highway.
#if defined(YARS_MODEL_RBM_GAIN_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef YARS_MODEL_RBM_GAIN_SIMD_INL
#undef YARS_MODEL_RBM_GAIN_SIMD_INL
#else
#define YARS_MODEL_RBM_GAIN_SIMD_INL
#endif

#include <hwy/highway.h>

#include "model/physics/polynomials-inl.hpp"
#include "model/rbm/sample_groups-inl.hpp"
#include "model/rbm/sweep_simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::rbm::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace polynomials = physics::HWY_NAMESPACE;

// Gain as numerator and denominator, so that the caller divides only once for gain and power.
template <class Group>
struct Gain {
  Group numerator, denominator;
};

// Gain along lines of sight from the antenna with the components `out_m` (horizontal) and `up_m` (vertical, positive
// up). `slant_square` is the squared slant range [m^2].
template <class Group>
class ElevationGain {
 public:
  HWY_INLINE ElevationGain(const SweepConstants& c, const Group& out_m, const Group& up_m, const Group& slant_square)
      : c_(c),
        out_m_(out_m),
        up_m_(up_m),
        slant_square_(slant_square),
        below_(mul_sub(constant<Group>(c.sin_elevation), out_m, mul(constant<Group>(c.cos_elevation), up_m))) {}

  HWY_INLINE Gain<Group> of(radar::BeamPattern beam) const {
    switch (beam) {
      case radar::BeamPattern::hard_edge:
        return {hard_edge(), one()};
      case radar::BeamPattern::gaussian:
        return {gaussian(), one()};
      case radar::BeamPattern::cosecant_squared:
      case radar::BeamPattern::mapping:
        break;
    }
    return cosecant(beam == radar::BeamPattern::mapping);
  }

 private:
  static HWY_INLINE Group one() { return constant<Group>(1.0F); }
  static HWY_INLINE Group zero() { return constant<Group>(0.0F); }
  // Cosine of the elevation angle off the antenna axis, times the slant range.
  HWY_INLINE Group ahead() const {
    return mul_add(constant<Group>(c_.cos_elevation), out_m_, mul(constant<Group>(c_.sin_elevation), up_m_));
  }

  HWY_INLINE Group hard_edge() const {
    const auto half = constant<Group>(c_.sin_half_beam * c_.sin_half_beam);
    const auto narrow = less_or_equal(mul(below_, below_), mul(half, slant_square_));
    return or_zero(both(narrow, less(zero(), ahead())), one());
  }

  HWY_INLINE Group gaussian() const {
    return each(
        [&](Floats off, Floats on) {
          const Tag d;
          const auto angle = polynomials::angle(d, hn::Abs(off), on);
          // The gain is limited to at least 2^-64. Without this limit powers could be subnormal, which is slow.
          const auto octaves = hn::Neg(hn::Mul(hn::Mul(constant<Floats>(c_.gaussian), angle), angle));
          return polynomials::exp2(d, hn::Max(octaves, constant<Floats>(-64.0F)));
        },
        below_, ahead());
  }

  // sin^2 b / sin^2(b + angle below the axis), where b is the depression of the antenna axis, but at least half a
  // beamwidth (SweepConstants). Both sines are multiplied by the slant range. `twice`: the square of this ratio.
  HWY_INLINE Gain<Group> cosecant(bool twice) const {
    const auto rise = mul(constant<Group>(c_.cos_centre_tilt), up_m_);
    const auto spread = max(mul_sub(constant<Group>(c_.sin_centre_tilt), out_m_, rise), zero());
    const auto numerator = mul(constant<Group>(c_.sin_centre * c_.sin_centre), slant_square_);
    Gain<Group> gain{numerator, max(mul(spread, spread), numerator)};
    if (twice) gain = {mul(gain.numerator, gain.numerator), mul(gain.denominator, gain.denominator)};
    // Most ground is below the antenna axis. The Gaussian is computed only if a lane is above the axis.
    const auto above = less(below_, zero());
    if (none(above)) return gain;
    return {choose(above, gaussian(), gain.numerator), choose(above, one(), gain.denominator)};
  }

  const SweepConstants& c_;
  const Group& out_m_;
  const Group& up_m_;
  const Group& slant_square_;
  const Group below_;  // sine of the angle below the antenna axis, times the slant range
};

}  // namespace yars::model::rbm::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
