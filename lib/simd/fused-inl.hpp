// Fused multiply-add (FMA) for vectors of the library Highway, of float or double and of any width.
// Inputs: three vectors of the same type.
// Outputs: a * b + c, c - a * b or a * b - c, rounded once. All targets (instruction sets) give equal bits, whether or
// not they have an FMA instruction.
// Reason: Highway's MulAdd rounds twice on targets without FMA, so sweeps would differ between targets.
// Use: include this file after highway.h, in a source that foreach_target.h compiles once for each target.
// Source: docs/decisions/0009-vectors-by-highway.md; Boldo and Melquiond 2008, "Emulation of a FMA and correctly
// rounded sums", IEEE Trans. Computers 57.
#if defined(YARS_LIB_SIMD_FUSED_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef YARS_LIB_SIMD_FUSED_INL
#undef YARS_LIB_SIMD_FUSED_INL
#else
#define YARS_LIB_SIMD_FUSED_INL
#endif

#include <hwy/highway.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace yars::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if !HWY_NATIVE_FMA
// a * b + c, rounded once to float. The sum in double is rounded to odd (an inexact sum gets an odd last bit). Its
// rounding to float then gives the correct result (Boldo and Melquiond 2008).
HWY_INLINE float rounded_once(float a, float b, float c) {
  const double product = static_cast<double>(a) * static_cast<double>(b);  // exact
  const auto addend = static_cast<double>(c);
  const double sum = product + addend;
  const double part = sum - product;
  const double lost = (product - (sum - part)) + (addend - part);
  const auto bits = std::bit_cast<std::uint64_t>(sum);
  const bool inexact = lost > 0.0 || lost < 0.0;  // false for infinities and NaN
  if (!inexact || (bits & 1U) != 0) return static_cast<float>(sum);
  const bool outwards = (lost > 0.0) == (sum > 0.0);
  return static_cast<float>(std::bit_cast<double>(outwards ? bits + 1U : bits - 1U));
}
HWY_INLINE double rounded_once(double a, double b, double c) {
  return std::fma(a, b, c);
}
#endif

// a * b + c
template <class V>
HWY_INLINE V mul_add(V a, V b, V c) {
#if HWY_NATIVE_FMA
  return hn::MulAdd(a, b, c);
#else
  const hn::DFromV<V> d;
  using Number = hn::TFromV<V>;
  HWY_ALIGN Number first[HWY_MAX_BYTES / sizeof(Number)];
  HWY_ALIGN Number second[HWY_MAX_BYTES / sizeof(Number)];
  HWY_ALIGN Number third[HWY_MAX_BYTES / sizeof(Number)];
  hn::Store(a, d, first);
  hn::Store(b, d, second);
  hn::Store(c, d, third);
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
    third[lane] = rounded_once(first[lane], second[lane], third[lane]);
  return hn::Load(d, third);
#endif
}

// c - a * b
template <class V>
HWY_INLINE V neg_mul_add(V a, V b, V c) {
#if HWY_NATIVE_FMA
  return hn::NegMulAdd(a, b, c);
#else
  return mul_add(hn::Neg(a), b, c);
#endif
}

// a * b - c
template <class V>
HWY_INLINE V mul_sub(V a, V b, V c) {
#if HWY_NATIVE_FMA
  return hn::MulSub(a, b, c);
#else
  return mul_add(a, b, hn::Neg(c));
#endif
}

}  // namespace yars::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
