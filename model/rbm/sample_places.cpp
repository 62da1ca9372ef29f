#include "model/rbm/sample_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lib/geo/geodesic_series.hpp"
#include "model/rbm/place_lanes.hpp"
#include "model/rbm/polynomials.hpp"
#include "model/terrain/cell.hpp"

namespace yars::model::rbm {

namespace {
constexpr double kEarthRadiusM = 6371008.8;  // [m] only to judge how near the pole is
// Interpolating latitude and longitude holds while the pole is this many half ranges from the apex: the error falls
// with its power of the knots. Smaller: metres lost at 75 degrees; greater: more sweeps take the slower way.
constexpr double kPoleHalfRanges = 12.0;

using Knots = std::array<double, kMostKnots>;

// A polynomial through the knots in Newton's form, in t over [-1, 1].
struct Newton {
  int knots = 0;
  Knots knot{};
  Knots difference{};

  double at(double t) const {
    double p = difference[static_cast<std::size_t>(knots - 1)];
    for (auto k = static_cast<std::size_t>(knots - 1); k-- > 0;) p = p * (t - knot[k]) + difference[k];
    return p;
  }
};

// Chebyshev points of every number of knots: the interpolation error is spread evenly over the ray.
std::array<Knots, kMostKnots + 1> chebyshev_points() {
  std::array<Knots, kMostKnots + 1> points{};
  for (int knots = kLeastKnots; knots <= kMostKnots; ++knots)
    for (int k = 0; k < knots; ++k)
      points[static_cast<std::size_t>(knots)][static_cast<std::size_t>(k)] =
          std::cos(std::numbers::pi * (k + 0.5) / knots);
  return points;
}

Newton newton_form(int knots, const Knots& points, const Knots& values) {
  Newton form{knots, points, values};
  for (int order = 1; order < knots; ++order)
    for (int k = knots - 1; k >= order; --k) {
      const auto here = static_cast<std::size_t>(k);
      form.difference[here] = (form.difference[here] - form.difference[here - 1]) /
                              (points[here] - points[here - static_cast<std::size_t>(order)]);
    }
  return form;
}

// The same in powers of t, counted from the corner.
places::Curve curve_of(const Newton& form, int corner_deg) {
  const auto knots = static_cast<std::size_t>(form.knots);
  places::Curve curve{knots, {}};
  curve.coefficient[0] = form.difference[knots - 1];
  for (std::size_t k = knots - 1; k-- > 0;) {
    // Times (t - knot), plus the next difference.
    for (std::size_t power = knots - 1; power > 0; --power)
      curve.coefficient[power] = curve.coefficient[power - 1] - form.knot[k] * curve.coefficient[power];
    curve.coefficient[0] = form.difference[k] - form.knot[k] * curve.coefficient[0];
  }
  curve.coefficient[0] -= corner_deg;
  return curve;
}

// Puts one place, whose longitude may be a turn off.
void put(PlaceArrays& places, std::size_t i, geo::GeoPoint apex, geo::GeoPoint place) {
  const double north_deg = place.latitude_deg - places.corner.south_deg;
  // Unwrapped against the apex, so that the antimeridian is no jump.
  const double east_deg =
      apex.longitude_deg + geo::wrapped_degrees(place.longitude_deg - apex.longitude_deg) - places.corner.west_deg;
  places.cells_north[i] = static_cast<float>(std::floor(north_deg));
  places.cells_east[i] = static_cast<float>(std::floor(east_deg));
  places.north_deg[i] = static_cast<float>(north_deg - std::floor(north_deg));
  places.east_deg[i] = static_cast<float>(east_deg - std::floor(east_deg));
}

void place_by_vector(geo::GeoPoint apex, const float* distance_m, double scale, const std::array<Newton, 3>& axis,
                     PlaceArrays& places) {
  for (std::size_t i = 0; i < places.count; ++i) {
    const double t = static_cast<double>(distance_m[i]) * scale - 1.0;
    const double x = axis[0].at(t);
    const double y = axis[1].at(t);
    const double level = std::sqrt(x * x + y * y);
    // On the pole itself any longitude is right.
    const double longitude_rad =
        level > 0.0 ? polynomials::arctangent(y, x) : apex.longitude_deg * geo::kRadiansPerDegree;
    put(places, i, apex,
        {polynomials::arctangent(axis[2].at(t), level) / geo::kRadiansPerDegree,
         longitude_rad / geo::kRadiansPerDegree});
  }
}
double value_at(const places::Curve& curve, double x) {
  double sum = 0.0;
  for (std::size_t k = curve.terms; k-- > 0;) sum = sum * x + curve.coefficient[k];
  return sum;
}

// The curves count from the corner.
void place_by_curves(geo::GeoPoint apex, const float* distance_m, const places::Curves& curves, PlaceArrays& places) {
  if (const std::size_t piece = places::piece_samples(places.count); piece > 0) {
    places::along_curves(
        places.count, piece, distance_m, curves,
        {places.cells_north.data(), places.cells_east.data(), places.north_deg.data(), places.east_deg.data()});
    return;
  }
  for (std::size_t i = 0; i < places.count; ++i) {
    const double x = static_cast<double>(distance_m[i]) * curves.scale - curves.shift;
    put(places, i, apex,
        {value_at(curves.north, x) + places.corner.south_deg, value_at(curves.east, x) + places.corner.west_deg});
  }
}

places::Curves curves_of(const geo::GeodesicSeries& series, terrain::CellPlace corner) {
  const auto terms = static_cast<std::size_t>(series.order) + 1;
  places::Curves curves{1.0, 0.0, {terms, series.latitude_deg}, {terms, series.longitude_deg}};
  curves.north.coefficient[0] -= corner.south_deg;
  curves.east.coefficient[0] -= corner.west_deg;
  return curves;
}

void place_by_knots(geo::GeoPoint apex, const geo::GeodesicRay& ray, geo::Length range, int knots,
                    const float* distance_m, PlaceArrays& places) {
  static const std::array<Knots, kMostKnots + 1> points_of = chebyshev_points();
  const double half_range_rad = 0.5 * range.metres() / kEarthRadiusM;
  const double to_pole_rad = (90.0 - std::abs(apex.latitude_deg)) * geo::kRadiansPerDegree;
  const bool near_pole = to_pole_rad <= kPoleHalfRanges * half_range_rad;
  const Knots& points = points_of[static_cast<std::size_t>(knots)];
  const double scale = 2.0 / range.metres();
  std::array<Knots, 3> value{};
  for (int k = 0; k < knots; ++k) {
    const auto here = static_cast<std::size_t>(k);
    const geo::GeoPoint place = ray.position(0.5 * (points[here] + 1.0) * range);
    if (near_pole) {
      const double latitude_rad = place.latitude_deg * geo::kRadiansPerDegree;
      const double longitude_rad = place.longitude_deg * geo::kRadiansPerDegree;
      value[0][here] = std::cos(latitude_rad) * std::cos(longitude_rad);
      value[1][here] = std::cos(latitude_rad) * std::sin(longitude_rad);
      value[2][here] = std::sin(latitude_rad);
    } else {
      value[0][here] = place.latitude_deg;
      value[1][here] = apex.longitude_deg + geo::wrapped_degrees(place.longitude_deg - apex.longitude_deg);
    }
  }
  const Newton first = newton_form(knots, points, value[0]);
  const Newton second = newton_form(knots, points, value[1]);
  if (near_pole) {
    place_by_vector(apex, distance_m, scale, {first, second, newton_form(knots, points, value[2])}, places);
    return;
  }
  place_by_curves(apex, distance_m,
                  {scale, 1.0, curve_of(first, places.corner.south_deg), curve_of(second, places.corner.west_deg)},
                  places);
}
}  // namespace

void sample_places(geo::GeoPoint apex, geo::Bearing azimuth, geo::Length range, int knots, const float* distance_m,
                   PlaceArrays& places) {
  places.corner = terrain::cell_holding(apex);
  const int order = knots >= kSeriesKnots ? geo::GeodesicSeries::order_for(apex.latitude_deg, range) : 0;
  if (order > 0) {
    place_by_curves(apex, distance_m, curves_of(geo::GeodesicSeries(apex, azimuth, order), places.corner), places);
    return;
  }
  const geo::GeodesicRay ray(apex, azimuth);
  if (knots != kExactPlaces) {
    place_by_knots(apex, ray, range, std::clamp(knots, kLeastKnots, kMostKnots), distance_m, places);
    return;
  }
  for (std::size_t i = 0; i < places.count; ++i)
    put(places, i, apex, ray.position(geo::Length::metres(static_cast<double>(distance_m[i]))));
}

}  // namespace yars::model::rbm
