// Size of the Earth, for spherical approximations. Geodesics on the ellipsoid: lib/geo/geodesy.hpp.
// Source: NIMA TR8350.2, WGS84 (a = 6,378,137 m, 1/f = 298.257223563).
#pragma once

namespace yars::geo {

// [m] Mean radius (2a + b) / 3. Within 0.6 % of every radius of curvature of the ellipsoid.
// Another value changes every picture with Earth curvature.
inline constexpr double kMeanEarthRadius_m = 6'371'008.8;

// [m] Arc of one degree on the mean sphere, to 1 m. Within 0.7 % of a degree of latitude anywhere.
inline constexpr double kMetresPerDegree = 111'195.0;

// [m] Bounds of one degree of latitude on the ellipsoid: 110,574 m at the equator, 111,693.98 m at a pole.
// Metres divided by the lower bound are never too few degrees: a search radius covers its whole circle.
// Degrees multiplied by the upper bound are never too few metres.
inline constexpr double kMinMetresPerDegree = 110'500.0;
inline constexpr double kMaxMetresPerDegree = 111'694.0;

}  // namespace yars::geo
