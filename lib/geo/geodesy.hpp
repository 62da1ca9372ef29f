// Geodesy on WGS84: geodesics, azimuthal equidistant projection, magnetic variation, height of mean sea level; size of
// the Earth, for approximations on a sphere.
// Inputs: latitude and longitude in degrees; azimuths, distances and heights as types of quantity.hpp.
// Outputs: positions, distances, azimuths; plane points in metres; magnetic variation in degrees.
// Frame: transforms are named target-from-source; docs/conventions.md fixes axes, zeros and signs.
// Accuracy: 15 nanometres for geodesics; 1 mm for GeodesicSeries up to the range for which its order was chosen.
// Threads: no shared mutable state.
// Source: Karney 2013, "Algorithms for geodesics", J. Geodesy 87, 43-55; library GeographicLib; NIMA TR8350.2, WGS84
//   (semi-major axis a = 6,378,137 m, flattening f: 1/f = 298.257223563).
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "lib/geo/quantity.hpp"

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

// Position on the ellipsoid WGS84: geodetic latitude [-90, 90] and longitude [-180, 180], in degrees.
struct GeoPoint {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;

  friend bool operator==(const GeoPoint&, const GeoPoint&) = default;
};

// Distance between two positions, and the azimuth of the geodesic at each. Both azimuths are those of travel
// from the start to the end.
struct GeodesicInverse {
  Length distance;
  Bearing azimuth_at_start;
  Bearing azimuth_at_end;
};

// Distance and azimuths of the shortest geodesic between two positions.
GeodesicInverse geodesic_inverse(GeoPoint from, GeoPoint to);
// Position at a distance from `from` along the geodesic that starts at `azimuth`.
GeoPoint geodesic_direct(GeoPoint from, Bearing azimuth, Length distance);

// Geodesic from one position along one azimuth, for many positions on it. The constructor does the work that all
// positions share; each position then costs the evaluation of one series. No memory is allocated, because the kernel
// makes a ray for each sweep.
class GeodesicRay {
 public:
  GeodesicRay(GeoPoint start, Bearing azimuth);
  GeodesicRay(const GeodesicRay&);
  GeodesicRay& operator=(const GeodesicRay&);
  ~GeodesicRay();

  GeoPoint position(Length distance) const;
  // Position and the azimuth of the ray there.
  struct PositionAndAzimuth {
    GeoPoint point;
    Bearing azimuth;
  };
  PositionAndAzimuth position_and_azimuth(Length distance) const;

 private:
  struct Line;
  Line& line();
  const Line& line() const;
  alignas(std::max_align_t) std::array<std::byte, 1024> storage_;  // holds a Line: 920 bytes in GeographicLib 2.5
};

// Radius of curvature of the ellipsoid at a latitude, in the vertical plane of an azimuth (Euler's theorem). It is the
// local earth radius for a ray in this direction.
Length radius_of_curvature(double latitude_deg, Bearing azimuth);

// Short geodesic: latitude and longitude as Taylor polynomials in the distance from the start.
// Accuracy: within 1 mm of GeodesicRay up to the range given to order_for() (tests/lib/geo/geodesic_series_test.cpp).
// Limit: the series diverges at ranges beyond the distance to the nearer pole. Ranges must be much shorter than this
// distance.
struct GeodesicSeries {
  static constexpr int kMaxOrder = 8;

  // The lowest order with an error of at most 1 mm up to `range`, for every azimuth. 0 if kMaxOrder does not suffice.
  static int order_for(double latitude_deg, Length range);

  // Coefficient k [deg/m^k] belongs to power k of the distance [m], k from 0 to `order`. The longitude is not wrapped
  // at the antimeridian.
  using Coefficients = std::array<double, kMaxOrder + 1>;
  int order;
  Coefficients latitude_deg{};
  Coefficients longitude_deg{};
};

// The short geodesics from one start in all directions. Their Taylor coefficients are polynomials in the cosine of the
// azimuth, those of longitude times its sine.
// Cost: 0.3 microseconds for a start with order 3, 1.4 with order 7; tens of nanoseconds for a direction.
class GeodesicFan {
 public:
  // `order` is in [1, GeodesicSeries::kMaxOrder]. `start` must not be a pole.
  GeodesicFan(GeoPoint start, int order);

  GeoPoint start() const { return start_; }
  int order() const { return order_; }
  GeodesicSeries series(Bearing azimuth) const;

 private:
  // Entry i belongs to power (degree - 2 i) of the cosine. The degree is k in latitude and k - 1 in longitude.
  using Coefficient = std::array<double, GeodesicSeries::kMaxOrder / 2 + 1>;
  GeoPoint start_;
  int order_;
  std::array<Coefficient, GeodesicSeries::kMaxOrder + 1> latitude_deg_{}, longitude_deg_{};
};

// Point of a plane, in metres along its x and y axis.
struct PlanePoint {
  double x_m = 0.0, y_m = 0.0;
};

// Azimuthal equidistant projection about an origin. Distance and azimuth from the origin are those of the geodesic.
// Exact for every point of the ellipsoid except the antipode. y points along the azimuth `up` at the origin, x points
// 90 degrees to its right; by default x is east and y is north.
class AzimuthalEquidistant {
 public:
  explicit AzimuthalEquidistant(GeoPoint origin, Bearing up = {}) : origin_(origin), up_(up) {}

  GeoPoint origin() const { return origin_; }
  PlanePoint plane_from_geodetic(GeoPoint point) const;
  // The point (0, 0) gives the origin bit for bit.
  GeoPoint geodetic_from_plane(PlanePoint point) const;

 private:
  GeoPoint origin_;
  Bearing up_;
};

// Magnetic variation (angle from true to magnetic north) by a model of the earth's field, such as the World Magnetic
// Model. The model's data must be installed. Debian packages only the program that downloads the data,
// geographiclib-get-magnetic.
class MagneticField {
 public:
  // An empty `name` selects GeographicLib's default model, an empty `folder` its default data folder. If the data
  // cannot be read, has_data() is false and problem() has the reason.
  MagneticField(const std::string& name, const std::string& folder);
  MagneticField(MagneticField&&) noexcept;
  MagneticField& operator=(MagneticField&&) noexcept;
  ~MagneticField();

  bool has_data() const { return model_ != nullptr; }
  const std::string& problem() const { return problem_; }
  // Variation [deg], east positive. `year`, with fraction, is clamped to the years of the model. NaN without data.
  double variation_deg(GeoPoint point, HeightAboveEllipsoid height, double year) const;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
  std::string problem_;
};

// Height of mean sea level above the ellipsoid by a grid of a geoid, such as EGM96 or EGM2008. The grid must be
// installed. Debian packages only the program that downloads grids, geographiclib-get-geoids.
class Geoid {
 public:
  // The first installed grid of EGM2008 and then EGM96, of 5 minutes of arc or the next coarser one; its memory is at
  // most 20 MB. An empty `folder` selects GeographicLib's folder of geoids. Without a usable grid has_data() is false
  // and problem() has the reason.
  explicit Geoid(const std::string& folder = {});
  Geoid(Geoid&&) noexcept;
  Geoid& operator=(Geoid&&) noexcept;
  ~Geoid();

  bool has_data() const { return grid_ != nullptr; }
  const std::string& problem() const { return problem_; }
  const std::string& name() const { return name_; }  // such as "egm96-5"; empty without data
  // Without data the height above the ellipsoid is taken as the altitude: -107 m to +86 m off.
  AltitudeMsl altitude(GeoPoint point, HeightAboveEllipsoid height) const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
  std::string name_, problem_;
};

}  // namespace yars::geo
