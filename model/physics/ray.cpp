#include "model/physics/ray.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "lib/geo/earth.hpp"
#include "lib/geo/geodesy.hpp"
#include "model/physics/ray_simd.hpp"
#include "model/terrain/formats/cell.hpp"

namespace yars::model::physics {

namespace {
constexpr double kMaxTurn_rad = 0.5 * geo::kRadiansPerDegree;
constexpr double kShareOfWay = 0.25;  // of the way to the pole, so that what a piece begins with holds to its end
}  // namespace

PoleWay::PoleWay(geo::GeoPoint apex, geo::Bearing azimuth, double bend_m, double shortest_m)
    : bend_m_(bend_m), shortest_m_(shortest_m) {
  const double to_pole_m = (90.0 - std::abs(apex.latitude_deg)) * geo::kMaxMetresPerDegree;
  const double towards = apex.latitude_deg >= 0.0 ? 1.0 : -1.0;
  nearest_m_ = to_pole_m * std::cos(azimuth.radians()) * towards;
  offset_m_ = std::abs(to_pole_m * std::sin(azimuth.radians()));
}

// A circle about the pole bends by L^2 / 8 r, and the longitude along a line by as much at the most.
double PoleWay::straight_at(double to_pole_m) const {
  const double by_bend_m = std::sqrt(8.0 * bend_m_ * to_pole_m);
  const double by_turn_m = kMaxTurn_rad * to_pole_m * to_pole_m / std::max(offset_m_, 1.0);
  return std::max(shortest_m_, std::min({by_bend_m, by_turn_m, kShareOfWay * to_pole_m}));
}

double PoleWay::straight_m(double along_m) const {
  return straight_at(std::hypot(along_m - nearest_m_, offset_m_));
}

double PoleWay::least_straight_m(double from_m, double to_m) const {
  return straight_m(std::clamp(nearest_m_, from_m, to_m));
}

namespace {
// Interpolating latitude and longitude holds while the pole is this many half ranges from the apex: the error falls
// with its power of the knots. Smaller: metres lost at 75 degrees; greater: more sweeps take the slower way.
constexpr double kPoleHalfRanges = 12.0;

using Knots = std::array<double, kMaxKnots>;

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
std::array<Knots, kMaxKnots + 1> chebyshev_points() {
  std::array<Knots, kMaxKnots + 1> points{};
  for (int knots = kMinKnots; knots <= kMaxKnots; ++knots)
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
simd::Curve curve_of(const Newton& form, int corner_deg) {
  const auto knots = static_cast<std::size_t>(form.knots);
  simd::Curve curve{knots, {}};
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
double value_at(const simd::Curve& curve, double x) {
  double sum = 0.0;
  for (std::size_t k = curve.terms; k-- > 0;) sum = sum * x + curve.coefficient[k];
  return sum;
}

// The curves count from the corner.
void place_by_curves(geo::GeoPoint apex, const float* distance_m, const simd::Curves& curves, PlaceArrays& places) {
  if (const std::size_t piece = simd::piece_samples(places.count); piece > 0) {
    simd::along_curves(
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

simd::Curves curves_of(const geo::GeodesicSeries& series, terrain::CellPlace corner) {
  const auto terms = static_cast<std::size_t>(series.order) + 1;
  simd::Curves curves{1.0, 0.0, {terms, series.latitude_deg}, {terms, series.longitude_deg}};
  curves.north.coefficient[0] -= corner.south_deg;
  curves.east.coefficient[0] -= corner.west_deg;
  return curves;
}

void place_by_knots(geo::GeoPoint apex, const geo::GeodesicRay& ray, geo::Length range, int knots,
                    const float* distance_m, PlaceArrays& places) {
  static const std::array<Knots, kMaxKnots + 1> points_of = chebyshev_points();
  const double half_range_rad = 0.5 * range.metres() / geo::kMeanEarthRadius_m;
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
    place_by_knots(apex, ray, range, std::clamp(knots, kMinKnots, kMaxKnots), distance_m, places);
    return;
  }
  for (std::size_t i = 0; i < places.count; ++i)
    put(places, i, apex, ray.position(geo::Length::metres(static_cast<double>(distance_m[i]))));
}

namespace {
constexpr double kPiece_m = 500.0;   // longest
constexpr double kShortest_m = 1.0;  // beside a pole
constexpr double kBend_m = 0.2;      // that a piece may lie off the straight way
constexpr double kNothing = -std::numeric_limits<double>::infinity();

// Of two spacings; 0 is none.
double finer(double a, double b) {
  return a > 0.0 && b > 0.0 ? std::min(a, b) : std::max(a, b);
}
}  // namespace

double GroundWalk::highest_tangent(double from_m, double to_m) const {
  const geo::GeodesicRay ray(look_.apex, look_.azimuth);
  const PoleWay way(look_.apex, look_.azimuth, kBend_m, kShortest_m);
  if (way.least_straight_m(from_m, to_m) >= kPiece_m) return highest_of_pieces(ray, from_m, to_m);
  double highest = kNothing;
  for (double begin_m = from_m; begin_m < to_m;) {
    const double end_m = std::min(begin_m + std::min(way.straight_m(begin_m), kPiece_m), to_m);
    highest = std::max(highest, highest_of_piece(ray, begin_m, end_m, end_m < to_m));
    begin_m = end_m;
  }
  return highest;
}

// All as long.
double GroundWalk::highest_of_pieces(const geo::GeodesicRay& ray, double from_m, double to_m) const {
  const int pieces = static_cast<int>(std::max(1.0, std::ceil((to_m - from_m) / kPiece_m)));
  double highest = kNothing;
  for (int piece = 0; piece < pieces; ++piece) {
    const double begin_m = from_m + (to_m - from_m) * piece / pieces;
    const double end_m = from_m + (to_m - from_m) * (piece + 1) / pieces;
    highest = std::max(highest, highest_of_piece(ray, begin_m, end_m, piece + 1 < pieces));
  }
  return highest;
}

double GroundWalk::highest_of_piece(const geo::GeodesicRay& ray, double from_m, double to_m, bool with_end) const {
  const geo::GeoPoint begin = ray.position(geo::Length::metres(from_m));
  const geo::GeoPoint end = ray.position(geo::Length::metres(to_m));
  const terrain::PostSpacing at_begin = terrain_.post_spacing_at(begin), at_end = terrain_.post_spacing_at(end);
  const terrain::PostSpacing posts{finer(at_begin.walked_m, at_end.walked_m),
                                   finer(at_begin.columns_deg, at_end.columns_deg)};
  if (!(posts.walked_m > 0.0)) return kNothing;
  const Piece piece{begin,
                    end.latitude_deg - begin.latitude_deg,
                    geo::wrapped_degrees(end.longitude_deg - begin.longitude_deg),
                    from_m,
                    to_m,
                    posts};
  const double steps = std::ceil((to_m - from_m) * steps_a_post_ / posts.walked_m);
  double highest = highest_of_columns(piece);
  for (double step = 1.0; with_end ? step <= steps : step < steps; step += 1.0)
    highest = std::max(highest, tangent_along(piece, step / steps));
  return highest;
}

// Towards a pole columns stand closer than what is walked by: there each line of them is looked at, as far as they lie
// a step apart.
double GroundWalk::highest_of_columns(const Piece& piece) const {
  const double latitude_rad = (piece.begin.latitude_deg + 0.5 * piece.north_deg) * geo::kRadiansPerDegree;
  const double column_m = geo::kMetresPerDegree * piece.posts.columns_deg * std::cos(latitude_rad);
  if (column_m >= piece.posts.walked_m) return kNothing;
  const double first = piece.begin.longitude_deg / piece.posts.columns_deg;
  const double columns = piece.east_deg / piece.posts.columns_deg;
  const double steps = (piece.to_m - piece.from_m) * steps_a_post_ / piece.posts.walked_m;
  const double stride = std::max(1.0, std::floor(std::abs(columns) / std::max(steps, 1.0)));
  const double first_line = std::floor(std::min(first, first + columns)) + 1.0;
  const double last_line = std::ceil(std::max(first, first + columns)) - 1.0;
  const int lines = static_cast<int>(std::floor((last_line - first_line) / stride)) + 1;
  double highest = kNothing;
  for (int line = 0; line < lines; ++line)
    highest = std::max(highest, tangent_along(piece, (first_line + line * stride - first) / columns));
  return highest;
}

double GroundWalk::tangent_along(const Piece& piece, double share) const {
  return tangent(
      {piece.begin.latitude_deg + share * piece.north_deg, piece.begin.longitude_deg + share * piece.east_deg},
      piece.from_m + share * (piece.to_m - piece.from_m));
}

double GroundWalk::tangent(geo::GeoPoint place, double distance_m) const {
  const double peak_m = terrain_.surface_at(place, interpolation_).peak_m;
  return std::isnan(peak_m) ? kNothing : earth_.sight(look_.altitude.metres(), distance_m, peak_m).tangent;
}

}  // namespace yars::model::physics
