// Elementary functions for loops that the compiler vectorizes: no library call, no branch, the same bits at every lane
// count. Coefficients: Chebyshev interpolation on the reduced interval. Errors are of the polynomial; rounding of the
// type comes on top.
#pragma once

#include <bit>
#include <cstdint>

namespace yars::model::rbm::polynomials {

// Base-2 logarithm of a positive, normal float. Error 4e-7.
inline float log2(float value) {
  // Split off the exponent so that the rest lies in [0.75, 1.5), where it is near 1.
  constexpr std::int32_t kThreeQuarters = 0x3f400000;
  const std::int32_t bits = std::bit_cast<std::int32_t>(value);
  const std::int32_t exponent = (bits - kThreeQuarters) >> 23;
  const float t = std::bit_cast<float>(bits - (exponent << 23)) - 1.0F;
  float p = -0.0938960967F;
  p = p * t + 0.202076588F;
  p = p * t - 0.250414432F;
  p = p * t + 0.290264516F;
  p = p * t - 0.360368292F;
  p = p * t + 0.480842665F;
  p = p * t - 0.72135008F;
  p = p * t + 1.44269527F;
  return static_cast<float>(exponent) + t * p;
}

// 2 to a power, which is clamped to [-126, 126]; not a number counts as -126. Error 8e-8, relative.
inline float exp2(float power) {
  const float raised = power > -126.0F ? power : -126.0F;
  const float clamped = raised < 126.0F ? raised : 126.0F;
  constexpr float kShift = 127.5F;  // makes truncation round to nearest for every input
  const std::int32_t whole = static_cast<std::int32_t>(clamped + kShift) - 127;
  const float t = clamped - static_cast<float>(whole);
  float p = 0.00133908634F;
  p = p * t + 0.00967603192F;
  p = p * t + 0.0555035711F;
  p = p * t + 0.240221075F;
  p = p * t + 0.693147188F;
  p = p * t + 1.00000008F;
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(p) + (whole << 23));
}

// Angle [rad] in [0, pi] of a direction with this sine >= 0 and this cosine; a right angle if both are zero. Error
// 8e-7.
inline float angle(float sine, float cosine) {
  constexpr float kHalfPi = 1.57079633F;
  constexpr float kPi = 3.14159265F;
  const float across = cosine < 0.0F ? -cosine : cosine;
  const float small = sine < across ? sine : across;
  const float large = sine < across ? across : sine;
  const float t = small / (large > 1e-30F ? large : 1e-30F);
  const float y = t * t;
  float p = 0.00764835393F;
  p = p * y - 0.0363604309F;
  p = p * y + 0.083126453F;
  p = p * y - 0.134478641F;
  p = p * y + 0.198720403F;
  p = p * y - 0.33325678F;
  p = p * y + 0.999999226F;
  const float reduced = p * t;
  const float acute = sine < across ? reduced : kHalfPi - reduced;
  return cosine < 0.0F ? kPi - acute : acute;
}

// Angle [rad] in (-pi, pi] of the direction (x, y), not both zero. Error 1e-12.
inline double arctangent(double y, double x) {
  constexpr double kHalfPi = 1.5707963267948966;
  constexpr double kPi = 3.141592653589793;
  constexpr double kEighthTurnHalf = 0.41421356237309503;  // tan(pi/8)
  const double ay = y < 0.0 ? -y : y;
  const double ax = x < 0.0 ? -x : x;
  const double ratio = ay < ax ? ay / ax : ax / ay;
  const bool folded = ratio > kEighthTurnHalf;
  const double t = folded ? (ratio - 1.0) / (ratio + 1.0) : ratio;
  const double s = t * t;
  double p = -0.037655320648088311;
  p = p * s + 0.069742085005920981;
  p = p * s - 0.08992554733325249;
  p = p * s + 0.1110345699688494;
  p = p * s - 0.14285386547576151;
  p = p * s + 0.19999993052852441;
  p = p * s - 0.33333333276904076;
  p = p * s + 0.99999999999924361;
  const double reduced = p * t + (folded ? 0.5 * kHalfPi : 0.0);
  const double first = ay < ax ? reduced : kHalfPi - reduced;
  const double upper = x < 0.0 ? kPi - first : first;
  return y < 0.0 ? -upper : upper;
}

}  // namespace yars::model::rbm::polynomials
