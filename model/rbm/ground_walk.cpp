#include "model/rbm/ground_walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/rbm/pole_way.hpp"

namespace yars::model::rbm {

namespace {
constexpr double kPiece_m = 500.0;              // longest
constexpr double kShortest_m = 1.0;             // beside a pole
constexpr double kBend_m = 0.2;                 // that a piece may lie off the straight way
constexpr double kMetresPerDegree = 111'000.0;  // about
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
  const double column_m = kMetresPerDegree * piece.posts.columns_deg * std::cos(latitude_rad);
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

}  // namespace yars::model::rbm
