#include "model/physics/ray.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "lib/geo/geodesy.hpp"
#include "model/physics/ray_simd.hpp"
#include "model/terrain/formats/cell.hpp"

namespace yars::model::physics {

namespace {
// Maximum longitude change along a piece, extrapolated from the rate of change at the piece's start.
constexpr double kMaxTurn_rad = 0.5 * geo::kRadiansPerDegree;
// Maximum ratio of a piece's length to its distance from the pole. Bend and longitude change are extrapolated from the
// piece's start. With this ratio the true values are less than twice the extrapolated values.
constexpr double kMaxPoleDistanceFraction = 0.25;
}  // namespace

PolarPassage::PolarPassage(geo::GeoPoint apex, geo::Bearing azimuth, double max_bend_m, double min_piece_m)
    : max_bend_m_(max_bend_m), min_piece_m_(min_piece_m) {
  const double to_pole_m = (90.0 - std::abs(apex.latitude_deg)) * geo::kMaxMetresPerDegree;
  const double towards = apex.latitude_deg >= 0.0 ? 1.0 : -1.0;
  nearest_m_ = to_pole_m * std::cos(azimuth.radians()) * towards;
  offset_m_ = std::abs(to_pole_m * std::sin(azimuth.radians()));
}

// An arc of length L on a circle of radius r about the pole deviates from its chord by L^2 / (8 r). If longitude is
// taken as linear in distance along a straight ray, the error of the position is at most as large.
double PolarPassage::straight_at(double to_pole_m) const {
  const double by_bend_m = std::sqrt(8.0 * max_bend_m_ * to_pole_m);
  const double by_turn_m = kMaxTurn_rad * to_pole_m * to_pole_m / std::max(offset_m_, 1.0);
  return std::max(min_piece_m_, std::min({by_bend_m, by_turn_m, kMaxPoleDistanceFraction * to_pole_m}));
}

double PolarPassage::max_straight_m(double along_m) const {
  const double beyond_m = along_m - nearest_m_;
  return straight_at(std::sqrt(beyond_m * beyond_m + offset_m_ * offset_m_));
}

double PolarPassage::min_straight_m(double from_m, double to_m) const {
  return max_straight_m(std::clamp(nearest_m_, from_m, to_m));
}

namespace {
// [half ranges] Distance from apex to pole beyond which latitude and longitude are interpolated, not the unit vector.
// A smaller value gives metres of error at 75 degrees of latitude. With a greater value more sweeps interpolate the
// unit vector, which is slower.
constexpr double kPoleHalfRanges = 12.0;

using Knots = std::array<double, kMaxKnots>;

// Interpolation polynomial through the knots in Newton's form, in t over [-1, 1].
struct Newton {
  int knots = 0;
  Knots knot{};
  Knots difference{};  // divided differences
};

// Chebyshev points for each number of knots. They spread the interpolation error evenly over the ray.
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
      const auto i = static_cast<std::size_t>(k);
      form.difference[i] =
          (form.difference[i] - form.difference[i - 1]) / (points[i] - points[i - static_cast<std::size_t>(order)]);
    }
  return form;
}

// Converts Newton's form to powers of t. The polynomial gives degrees from the corner's latitude or longitude.
simd::Curve curve_of(const Newton& form, int corner_deg) {
  const auto knots = static_cast<std::size_t>(form.knots);
  simd::Curve curve{knots, {}};
  curve.coefficient[0] = form.difference[knots - 1];
  for (std::size_t k = knots - 1; k-- > 0;) {
    // Multiply by (t - knot), add the next difference.
    for (std::size_t power = knots - 1; power > 0; --power)
      curve.coefficient[power] = curve.coefficient[power - 1] - form.knot[k] * curve.coefficient[power];
    curve.coefficient[0] = form.difference[k] - form.knot[k] * curve.coefficient[0];
  }
  curve.coefficient[0] -= corner_deg;
  return curve;
}

// Stores one position. Its longitude need not be wrapped to [-180, 180).
void store_position(PositionArrays& positions, std::size_t i, geo::GeoPoint apex, geo::GeoPoint position) {
  const double north_deg = position.latitude_deg - positions.corner.south_deg;
  // Longitude relative to the apex: continuous across the antimeridian.
  const double east_deg = apex.longitude_deg + geo::wrapped_degrees(position.longitude_deg - apex.longitude_deg) -
                          positions.corner.west_deg;
  positions.cells_north[i] = static_cast<float>(std::floor(north_deg));
  positions.cells_east[i] = static_cast<float>(std::floor(east_deg));
  positions.north_deg[i] = static_cast<float>(north_deg - std::floor(north_deg));
  positions.east_deg[i] = static_cast<float>(east_deg - std::floor(east_deg));
}

simd::PositionSpans spans_of(PositionArrays& positions) {
  return {positions.cells_north.data(), positions.cells_east.data(), positions.north_deg.data(),
          positions.east_deg.data()};
}

// Positions from the interpolated unit vector. `axis`: its three components, as functions of t = distance * scale - 1.
void sample_by_vector(geo::GeoPoint apex, const float* distance_m, double scale, const std::array<Newton, 3>& axis,
                      PositionArrays& positions) {
  simd::VectorCurves curves;
  curves.knots = static_cast<std::size_t>(axis[0].knots);
  curves.scale = scale;
  curves.knot = axis[0].knot;
  for (std::size_t k = 0; k < axis.size(); ++k) curves.difference[k] = axis[k].difference;
  curves.apex_east_deg = apex.longitude_deg;
  curves.south_deg = positions.corner.south_deg;
  curves.west_deg = positions.corner.west_deg;
  simd::positions_by_vector(positions.count, distance_m, curves, spans_of(positions));
}

// The curves give degrees north and east of positions.corner.
void sample_by_curves(const float* distance_m, const simd::Curves& curves, PositionArrays& positions) {
  simd::positions_on_curves(positions.count, distance_m, curves, spans_of(positions));
}

simd::Curves curves_of(const geo::GeodesicSeries& series, terrain::CellCorner corner) {
  const auto terms = static_cast<std::size_t>(series.order) + 1;
  simd::Curves curves{1.0, 0.0, {terms, series.latitude_deg}, {terms, series.longitude_deg}};
  curves.north.coefficient[0] -= corner.south_deg;
  curves.east.coefficient[0] -= corner.west_deg;
  return curves;
}

void sample_by_knots(geo::GeoPoint apex, const geo::GeodesicRay& ray, geo::Length range, int knots,
                     const float* distance_m, PositionArrays& positions) {
  static const std::array<Knots, kMaxKnots + 1> points_of = chebyshev_points();
  const double half_range_rad = 0.5 * range.metres() / geo::kMeanEarthRadius_m;
  const double to_pole_rad = (90.0 - std::abs(apex.latitude_deg)) * geo::kRadiansPerDegree;
  const bool near_pole = to_pole_rad <= kPoleHalfRanges * half_range_rad;
  const Knots& points = points_of[static_cast<std::size_t>(knots)];
  const double scale = 2.0 / range.metres();
  std::array<Knots, 3> value{};
  for (int k = 0; k < knots; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const geo::GeoPoint position = ray.position(0.5 * (points[i] + 1.0) * range);
    if (near_pole) {
      const double latitude_rad = position.latitude_deg * geo::kRadiansPerDegree;
      const double longitude_rad = position.longitude_deg * geo::kRadiansPerDegree;
      value[0][i] = std::cos(latitude_rad) * std::cos(longitude_rad);
      value[1][i] = std::cos(latitude_rad) * std::sin(longitude_rad);
      value[2][i] = std::sin(latitude_rad);
    } else {
      value[0][i] = position.latitude_deg;
      value[1][i] = apex.longitude_deg + geo::wrapped_degrees(position.longitude_deg - apex.longitude_deg);
    }
  }
  const Newton first = newton_form(knots, points, value[0]);
  const Newton second = newton_form(knots, points, value[1]);
  if (near_pole) {
    sample_by_vector(apex, distance_m, scale, {first, second, newton_form(knots, points, value[2])}, positions);
    return;
  }
  sample_by_curves(
      distance_m,
      {scale, 1.0, curve_of(first, positions.corner.south_deg), curve_of(second, positions.corner.west_deg)},
      positions);
}
}  // namespace

void PositionSampler::sample(geo::GeoPoint apex, geo::Bearing azimuth, geo::Length range, int knots,
                             const float* distance_m, PositionArrays& positions) {
  positions.corner = terrain::cell_containing(apex);
  const int order = knots >= kSeriesKnots ? geo::GeodesicSeries::order_for(apex.latitude_deg, range) : 0;
  if (order > 0) {
    if (!fan_ || fan_->start() != apex || fan_->order() != order) fan_.emplace(apex, order);
    sample_by_curves(distance_m, curves_of(fan_->series(azimuth), positions.corner), positions);
    return;
  }
  const geo::GeodesicRay ray(apex, azimuth);
  if (knots != kExactPositions) {
    sample_by_knots(apex, ray, range, std::clamp(knots, kMinKnots, kMaxKnots), distance_m, positions);
    return;
  }
  for (std::size_t i = 0; i < positions.count; ++i)
    store_position(positions, i, apex, ray.position(geo::Length::metres(static_cast<double>(distance_m[i]))));
}

void sample_positions(geo::GeoPoint apex, geo::Bearing azimuth, geo::Length range, int knots, const float* distance_m,
                      PositionArrays& positions) {
  PositionSampler().sample(apex, azimuth, range, knots, distance_m, positions);
}

namespace {
constexpr double kMaxPiece_m = 500.0;  // longest piece, 10 mm off the geodesic up to 60 degrees of latitude
constexpr double kMinPiece_m = 1.0;    // shortest piece, near a pole
constexpr double kMaxBend_m = 0.2;     // maximum deviation of a piece from the geodesic, near a pole
constexpr double kNoGround = -std::numeric_limits<double>::infinity();

// The finer of two post spacings; 0 means no posts.
double finer(double a, double b) {
  return a > 0.0 && b > 0.0 ? std::min(a, b) : std::max(a, b);
}
}  // namespace

GroundWalk::GroundWalk(const SweepGeometry& geometry, const EffectiveEarth& earth, const terrain::TerrainView& terrain,
                       radar::Interpolation interpolation, double steps_per_post)
    : geometry_(geometry),
      earth_(earth),
      terrain_(terrain),
      interpolation_(interpolation),
      steps_per_post_(steps_per_post),
      ray_(geometry.apex, geometry.azimuth),
      passage_(geometry.apex, geometry.azimuth, kMaxBend_m, kMinPiece_m) {}

double GroundWalk::highest_tangent(double from_m, double to_m) const {
  double highest = kNoGround;
  visit(from_m, to_m, 0.0, [&](const Point& point) {
    if (point.distance_m >= to_m || std::isnan(point.surface.peak_m)) return;
    highest = std::max(highest, earth_.tangent(geometry_.altitude.metres(), point.distance_m, point.surface.peak_m));
  });
  return highest;
}

namespace {
// Crossings of parallel lines, which lie at whole numbers, by a piece from `from` to `from` + `run`, as fractions of
// the piece: the first, and the interval. Of more than `most` lines only every n-th is taken.
std::pair<double, double> crossings(double from, double run, double most) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (run == 0.0) return {kNone, 0.0};
  const double stride = std::max(1.0, std::floor(std::abs(run) / std::max(most, 1.0)));
  const double first = run > 0.0 ? std::floor(from) + 1.0 : std::ceil(from) - 1.0;
  return {(first - from) / run, stride / std::abs(run)};
}
}  // namespace

GroundWalk::Piece GroundWalk::piece_from(double from_m, double limit_m, double bare_step_m) const {
  const double to_m = std::min(from_m + std::min(passage_.max_straight_m(from_m), kMaxPiece_m), limit_m);
  const geo::GeoPoint begin = ray_.position(geo::Length::metres(from_m));
  const geo::GeoPoint end = ray_.position(geo::Length::metres(to_m));
  const terrain::PostSpacing at_begin = terrain_.post_spacing_at(begin), at_end = terrain_.post_spacing_at(end);
  const double posts_m = finer(at_begin.ray_step_m, at_end.ray_step_m);
  Piece piece{begin,
              end.latitude_deg - begin.latitude_deg,
              geo::wrapped_degrees(end.longitude_deg - begin.longitude_deg),
              from_m,
              to_m,
              {},
              {std::numeric_limits<double>::infinity(), 0.0},
              {std::numeric_limits<double>::infinity(), 0.0},
              posts_m > 0.0 || bare_step_m > 0.0};
  if (!piece.left) return piece;
  const double step_m = posts_m > 0.0 ? posts_m / steps_per_post_ : bare_step_m;
  const double steps = std::max(1.0, std::ceil((to_m - from_m) / step_m));
  piece.steps = {1.0 / steps, 1.0 / steps};
  if (!(posts_m > 0.0)) return piece;
  const auto lines = [&](double from_deg, double run_deg, double spacing_deg) {
    const auto [first, interval] = crossings(from_deg / spacing_deg, run_deg / spacing_deg, steps);
    return Series{first, interval};
  };
  piece.rows = lines(begin.latitude_deg, piece.north_deg, finer(at_begin.rows_deg, at_end.rows_deg));
  piece.columns = lines(begin.longitude_deg, piece.east_deg, finer(at_begin.columns_deg, at_end.columns_deg));
  return piece;
}

GroundWalk::Point GroundWalk::next_point(Piece& piece) const {
  // A position within a millimetre of the end counts as the end, so that the ground does not hide itself.
  constexpr double kEnd = 1.0 - 1e-6;
  double fraction = 1.0;
  for (const Series* series : {&piece.steps, &piece.rows, &piece.columns})
    fraction = std::min(fraction, series->next());
  for (Series* series : {&piece.steps, &piece.rows, &piece.columns})
    if (series->next() <= fraction) series->number += 1.0;
  piece.left = fraction < kEnd;
  if (!piece.left) fraction = 1.0;
  const geo::GeoPoint position{piece.begin.latitude_deg + fraction * piece.north_deg,
                               piece.begin.longitude_deg + fraction * piece.east_deg};
  return {piece.left ? piece.from_m + fraction * (piece.to_m - piece.from_m) : piece.to_m, position,
          terrain_.surface_at(position, interpolation_)};
}

}  // namespace yars::model::physics
