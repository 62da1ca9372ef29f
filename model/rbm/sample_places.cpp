#include "model/rbm/sample_places.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "model/rbm/lanes.hpp"
#include "model/rbm/polynomials.hpp"

namespace yars::model::rbm {

namespace {
constexpr std::size_t kKnots = 5;
constexpr double kEarthRadiusM = 6371008.8;  // [m] only to judge how near the pole is
// Interpolating latitude and longitude holds while the pole is this many half ranges from the apex: the error falls
// with its fifth power. Smaller: metres lost at 75 degrees; greater: more sweeps take the slower way.
constexpr double kPoleHalfRanges = 12.0;

using Knots = std::array<double, kKnots>;

// A polynomial through the knots in Newton's form, in t over [-1, 1].
struct Newton {
  Knots knot{};
  Knots difference{};
};

// Chebyshev points: the interpolation error is spread evenly over the ray.
Knots chebyshev_points() {
  Knots points{};
  for (std::size_t k = 0; k < kKnots; ++k) {
    points[k] = std::cos(std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(kKnots));
  }
  return points;
}

Newton newton_form(const Knots& points, const Knots& values) {
  Newton form{points, values};
  for (std::size_t order = 1; order < kKnots; ++order) {
    for (std::size_t k = kKnots - 1; k >= order; --k) {
      form.difference[k] = (form.difference[k] - form.difference[k - 1]) / (points[k] - points[k - order]);
    }
  }
  return form;
}

inline double value_at(const Newton& form, double t) {
  double p = form.difference[4];
  p = p * (t - form.knot[3]) + form.difference[3];
  p = p * (t - form.knot[2]) + form.difference[2];
  p = p * (t - form.knot[1]) + form.difference[1];
  return p * (t - form.knot[0]) + form.difference[0];
}

YARS_LANES void evaluate_geodetic(std::size_t count, const double* __restrict distance_m, double scale, Newton latitude,
                                  Newton longitude, double* __restrict latitude_deg, double* __restrict longitude_deg) {
  for (std::size_t i = 0; i < count; ++i) {
    const double t = distance_m[i] * scale - 1.0;
    latitude_deg[i] = value_at(latitude, t);
    longitude_deg[i] = value_at(longitude, t);
  }
}

void evaluate_vector(std::span<const double> distance_m, double scale, const std::array<Newton, 3>& axis,
                     double pole_longitude_deg, std::span<double> latitude_deg, std::span<double> longitude_deg) {
  for (std::size_t i = 0; i < distance_m.size(); ++i) {
    const double t = distance_m[i] * scale - 1.0;
    const double x = value_at(axis[0], t);
    const double y = value_at(axis[1], t);
    const double z = value_at(axis[2], t);
    const double level = std::sqrt(x * x + y * y);
    latitude_deg[i] = polynomials::arctangent(z, level) / geo::kRadiansPerDegree;
    // On the pole itself any longitude is right.
    longitude_deg[i] = level > 0.0 ? polynomials::arctangent(y, x) / geo::kRadiansPerDegree : pole_longitude_deg;
  }
}
}  // namespace

void sample_places(geo::GeoPoint apex, geo::Bearing azimuth, geo::Length range, std::span<const double> distance_m,
                   std::span<double> latitude_deg, std::span<double> longitude_deg) {
  static const Knots points = chebyshev_points();
  const geo::GeodesicRay ray(apex, azimuth);
  std::array<geo::GeoPoint, kKnots> places;
  for (std::size_t k = 0; k < kKnots; ++k) places[k] = ray.position(0.5 * (points[k] + 1.0) * range);
  const double scale = 2.0 / range.metres();

  const double half_range_rad = 0.5 * range.metres() / kEarthRadiusM;
  const double to_pole_rad = (90.0 - std::abs(apex.latitude_deg)) * geo::kRadiansPerDegree;
  if (to_pole_rad > kPoleHalfRanges * half_range_rad) {
    Knots latitude{};
    Knots longitude{};
    for (std::size_t k = 0; k < kKnots; ++k) {
      latitude[k] = places[k].latitude_deg;
      // Unwrapped against the apex, so that the antimeridian is no jump.
      longitude[k] = apex.longitude_deg + geo::wrapped_degrees(places[k].longitude_deg - apex.longitude_deg);
    }
    evaluate_geodetic(distance_m.size(), distance_m.data(), scale, newton_form(points, latitude),
                      newton_form(points, longitude), latitude_deg.data(), longitude_deg.data());
    return;
  }
  std::array<Knots, 3> axis{};
  for (std::size_t k = 0; k < kKnots; ++k) {
    const double latitude_rad = places[k].latitude_deg * geo::kRadiansPerDegree;
    const double longitude_rad = places[k].longitude_deg * geo::kRadiansPerDegree;
    axis[0][k] = std::cos(latitude_rad) * std::cos(longitude_rad);
    axis[1][k] = std::cos(latitude_rad) * std::sin(longitude_rad);
    axis[2][k] = std::sin(latitude_rad);
  }
  evaluate_vector(distance_m, scale,
                  {newton_form(points, axis[0]), newton_form(points, axis[1]), newton_form(points, axis[2])},
                  apex.longitude_deg, latitude_deg, longitude_deg);
}

}  // namespace yars::model::rbm
