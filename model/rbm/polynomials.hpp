// Elementary functions in double without a library call: the same bits whatever the machine's library picks.
// Coefficients: Chebyshev interpolation on the reduced interval.
#pragma once

namespace yars::model::rbm::polynomials {

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
