// Size of the Earth, for approximations on a sphere. Exact distances come from lib/geo/geodesy.hpp.
// Source: NIMA TR8350.2, WGS84 (semi-major axis a = 6,378,137 m, flattening f: 1/f = 298.257223563).
#pragma once

namespace yars::geo {

// [m] Mean radius (2a + b) / 3; b is the semi-minor axis. It differs by less than 0.6 % from every radius of curvature
// of the ellipsoid.
// A change of this value changes every picture that uses the spherical approximation.
inline constexpr double kMeanEarthRadius_m = 6'371'008.8;

// [m] Arc of one degree on the sphere of mean radius, rounded to 1 m. One degree of latitude on the ellipsoid differs
// from this length by less than 0.6 %, at every latitude.
inline constexpr double kMetresPerDegree = 111'195.0;

// [m] Bounds, rounded outwards, of the length of one degree of latitude on the ellipsoid. This length is 110,574 m at
// the equator and 111,693.98 m at a pole.
// The distance of two points [m] / kMinMetresPerDegree is an upper bound of their difference in latitude [deg].
// A difference in latitude [deg] x kMaxMetresPerDegree is an upper bound of the distance along a meridian [m].
inline constexpr double kMinMetresPerDegree = 110'500.0;
inline constexpr double kMaxMetresPerDegree = 111'694.0;

}  // namespace yars::geo
