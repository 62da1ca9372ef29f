// Geodesy on WGS84: geodesics, azimuthal equidistant projection, magnetic variation.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include "lib/geo/quantity.hpp"

namespace yars::geo {

// Geodesics on WGS84; the only caller of GeographicLib. Accuracy: 15 nm (Karney 2013, J. Geodesy 87, 43-55).

// Where on the ellipsoid: geodetic latitude [-90, 90], longitude [-180, 180], degrees, WGS84.
struct GeoPoint {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
};

struct GeodesicInverse {
  Length distance;
  Bearing azimuth_at_start;
  Bearing azimuth_at_end;
};

GeodesicInverse geodesic_inverse(GeoPoint from, GeoPoint to);
GeoPoint geodesic_direct(GeoPoint from, Bearing azimuth, Length distance);

// A ray from one point along one azimuth; positions along it are exact and cheap (one series each). A value: making
// one allocates nothing, for the radar kernel makes one a sweep.
class GeodesicRay {
 public:
  GeodesicRay(GeoPoint start, Bearing azimuth);

  GeoPoint position(Length distance) const;
  // Position and the azimuth of the ray there.
  struct Place {
    GeoPoint point;
    Bearing azimuth;
  };
  Place place(Length distance) const;

 private:
  struct Line;
  const Line& line() const;
  alignas(std::max_align_t) std::array<std::byte, 1024> storage_;  // a Line, which is plain numbers
};

// Radius of curvature of the ellipsoid at a latitude along an azimuth (Euler): the earth radius that a ray feels.
Length radius_of_curvature(double latitude_deg, Bearing azimuth);

// A short ray of WGS84 as two polynomials in the distance: Taylor's series about its start, tens of nanoseconds where
// the exact geodesic takes hundreds for each place. Within 1 mm of GeodesicRay up to the range that the order was
// asked for (tests/lib/geo/geodesic_series_test.cpp). Short means against the way to the nearer pole, where longitude
// turns without bound.
struct GeodesicSeries {
  static constexpr int kMaxOrder = 8;

  // The lowest order that holds within 1 mm for every azimuth; 0: none up to kMaxOrder does.
  static int order_for(double latitude_deg, Length range);

  // Order in [1, kMaxOrder]; no start on a pole.
  GeodesicSeries(GeoPoint start, Bearing azimuth, int order);

  // Coefficients [deg/m^k] of the distance's powers 0..order. Longitude runs on across the antimeridian.
  using Coefficients = std::array<double, kMaxOrder + 1>;
  int order;
  Coefficients latitude_deg{};
  Coefficients longitude_deg{};
};

// A point of a plane that a projection lays out: metres right of the origin and upward, along the plane's `up`.
struct PlanePoint {
  double x_m = 0.0, y_m = 0.0;
};

// Azimuthal equidistant projection about an origin: distance and azimuth from the origin are those of the geodesic,
// drawn flat. Exact for any point of the ellipsoid but the antipode. `up`: the azimuth that y points to; with the
// default, x is east and y is north.
class AzimuthalEquidistant {
 public:
  explicit AzimuthalEquidistant(GeoPoint origin, Bearing up = {}) : origin_(origin), up_(up) {}

  GeoPoint origin() const { return origin_; }
  Bearing up() const { return up_; }
  PlanePoint plane_from_geodetic(GeoPoint point) const;
  // The origin itself, bit for bit, for the zero of the plane.
  GeoPoint geodetic_from_plane(PlanePoint point) const;

 private:
  GeoPoint origin_;
  Bearing up_;
};

// Magnetic variation by a model of the earth's field, where its data is installed (GeographicLib's World Magnetic
// Model; Debian has the program that fetches it, geographiclib-get-magnetic, but not the data).
class MagneticField {
 public:
  // An empty name: the library's own choice; an empty folder: where its data lies by default. has_data() tells whether
  // there was any; a name that was asked for and is not there leaves the reason in problem().
  MagneticField(const std::string& name, const std::string& folder);
  MagneticField(MagneticField&&) noexcept;
  MagneticField& operator=(MagneticField&&) noexcept;
  ~MagneticField();

  bool has_data() const { return model_ != nullptr; }
  const std::string& problem() const { return problem_; }
  // [deg] east positive. A year beyond the model's is taken at its nearest; NaN without data.
  double variation_deg(GeoPoint point, HeightAboveEllipsoid height, double year) const;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
  std::string problem_;
};

}  // namespace yars::geo
