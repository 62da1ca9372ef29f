// Elementary functions for Highway vectors of any width. They call no mathematical library, so results are equal bit by
// bit on every target.
// Coefficients: Chebyshev interpolation on the reduced interval, except inverse_root().
// Accuracy: stated at each function, for the polynomial alone. Rounding of float adds to it.
// Included once for each vector target.
#if defined(YARS_MODEL_PHYSICS_POLYNOMIALS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef YARS_MODEL_PHYSICS_POLYNOMIALS_INL
#undef YARS_MODEL_PHYSICS_POLYNOMIALS_INL
#else
#define YARS_MODEL_PHYSICS_POLYNOMIALS_INL
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "lib/simd/fused-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::physics::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// One step of Horner's scheme: p * t + c.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V step(D d, V p, V t, float c) {
  return yars::simd::HWY_NAMESPACE::mul_add(p, t, hn::Set(d, c));
}

// Base-2 logarithm of a positive, normal float. Error 4e-7.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V log2(D d, V value) {
  const hn::RebindToSigned<D> di;
  // Splits off the exponent. The remaining factor lies in [0.75, 1.5). 0x3f400000 is 0.75 as bits.
  const auto bits = hn::BitCast(di, value);
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3f400000)));
  const auto t = hn::Sub(hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent))), hn::Set(d, 1.0F));
  auto p = hn::Set(d, -0.0938960967F);
  p = step(d, p, t, 0.202076588F);
  p = step(d, p, t, -0.250414432F);
  p = step(d, p, t, 0.290264516F);
  p = step(d, p, t, -0.360368292F);
  p = step(d, p, t, 0.480842665F);
  p = step(d, p, t, -0.72135008F);
  p = step(d, p, t, 1.44269527F);
  return yars::simd::HWY_NAMESPACE::mul_add(t, p, hn::ConvertTo(d, exponent));
}

// Base-2 logarithm for video, at half the cost of log2(). Error 1.3e-4 (4e-4 dB of power).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V rough_log2(D d, V value) {
  const hn::RebindToSigned<D> di;
  // The bits of a float, read as an integer and divided by 2^23, approximate its logarithm plus 127, the exponent's
  // bias. The approximation is linear within each octave. The polynomial in the mantissa [1, 2) corrects this and
  // subtracts the bias.
  const auto bits = hn::BitCast(di, value);
  const auto linear = hn::ConvertTo(d, bits);
  const auto mantissa = hn::BitCast(d, hn::Or(hn::And(bits, hn::Set(di, 0x7fffff)), hn::Set(di, 0x3f800000)));
  auto p = hn::Set(d, -0.0784406762F);
  p = step(d, p, mantissa, 0.626032182F);
  p = step(d, p, mantissa, -2.07833517F);
  p = step(d, p, mantissa, 3.02921139F);
  p = step(d, p, mantissa, -128.498353F);
  return yars::simd::HWY_NAMESPACE::mul_add(linear, hn::Set(d, 1.0F / 8388608.0F), p);
}

// 2 to a power; the power is clamped to [-126, 126]. Relative error 8e-8.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V exp2(D d, V power) {
  const hn::RebindToSigned<D> di;
  const auto limit = hn::Set(d, 126.0F);
  const auto clamped = hn::Min(hn::Max(power, hn::Neg(limit)), limit);
  // ConvertTo truncates toward 0. Its argument, clamped + 127.5, is positive. So `clamped` is rounded to nearest.
  const auto whole = hn::Sub(hn::ConvertTo(di, hn::Add(clamped, hn::Set(d, 127.5F))), hn::Set(di, 127));
  const auto t = hn::Sub(clamped, hn::ConvertTo(d, whole));
  auto p = hn::Set(d, 0.00133908634F);
  p = step(d, p, t, 0.00967603192F);
  p = step(d, p, t, 0.0555035711F);
  p = step(d, p, t, 0.240221075F);
  p = step(d, p, t, 0.693147188F);
  p = step(d, p, t, 1.00000008F);
  return hn::BitCast(d, hn::Add(hn::BitCast(di, p), hn::ShiftLeft<23>(whole)));
}

// Angle [rad] in [0, pi] from a sine >= 0 and a cosine; pi / 2 if both are zero. Error 8e-7.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V angle(D d, V sine, V cosine) {
  const auto half_pi = hn::Set(d, 1.57079633F);
  const auto pi = hn::Set(d, 3.14159265F);
  const auto abs_cosine = hn::Abs(cosine);
  const auto below_45 = hn::Lt(sine, abs_cosine);
  const auto small = hn::IfThenElse(below_45, sine, abs_cosine);
  const auto large = hn::IfThenElse(below_45, abs_cosine, sine);
  const auto t = hn::Div(small, hn::Max(large, hn::Set(d, 1e-30F)));
  const auto y = hn::Mul(t, t);
  auto p = hn::Set(d, 0.00764835393F);
  p = step(d, p, y, -0.0363604309F);
  p = step(d, p, y, 0.083126453F);
  p = step(d, p, y, -0.134478641F);
  p = step(d, p, y, 0.198720403F);
  p = step(d, p, y, -0.33325678F);
  p = step(d, p, y, 0.999999226F);
  const auto reduced = hn::Mul(p, t);
  const auto acute = hn::IfThenElse(below_45, reduced, hn::Sub(half_pi, reduced));
  return hn::IfThenElse(hn::Lt(cosine, hn::Zero(d)), hn::Sub(pi, acute), acute);
}

// 1 / sqrt of a positive, normal float by two Newton steps from an integer guess. The hardware's reciprocal square
// roots are not used because they differ between processors. Relative error 5e-6 (2e-5 dB).
// Constants of guess and first step: J. Kadlec. Their error is a third of that of the classic guess 0x5f3759df.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V inverse_root(D d, V value) {
  namespace fused = yars::simd::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  const auto y = hn::BitCast(d, hn::Sub(hn::Set(di, 0x5f1ffff9), hn::ShiftRight<1>(hn::BitCast(di, value))));
  const auto better =
      hn::Mul(hn::Mul(y, hn::Set(d, 0.703952253F)), fused::neg_mul_add(hn::Mul(value, y), y, hn::Set(d, 2.38924456F)));
  const auto half = hn::Mul(value, hn::Set(d, 0.5F));
  return hn::Mul(better, fused::neg_mul_add(hn::Mul(half, better), better, hn::Set(d, 1.5F)));
}

}  // namespace yars::model::physics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
