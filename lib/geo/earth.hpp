// Size of the Earth, for approximations on a sphere. Exact distances come from lib/geo/geodesy.hpp.
// Source: NIMA TR8350.2, WGS84 (a = 6,378,137 m, 1/f = 298.257223563).
#pragma once

namespace yars::geo {

// [m] mean radius (2a + b) / 3. Within 0.6 % of every radius of curvature of the ellipsoid. Changing it changes every
// picture over a round earth.
inline constexpr double kMeanEarthRadius_m = 6'371'008.8;

// [m] arc of one degree on the mean sphere, to 1 m. Within 0.7 % of a degree of latitude anywhere.
inline constexpr double kMetresPerDegree = 111'195.0;

// [m] bounds of one degree of latitude on the ellipsoid: 110,574 m at the equator, 111,693.98 m at a pole. A search
// that converts metres to degrees by the lower bound misses nothing; the upper one bounds every distance in degrees.
inline constexpr double kMinMetresPerDegree = 110'500.0;
inline constexpr double kMaxMetresPerDegree = 111'694.0;

}  // namespace yars::geo
