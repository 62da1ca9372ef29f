#include "model/rbm/ground_walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace yars::model::rbm {

namespace {
constexpr double kPiece_m = 500.0;
constexpr double kNothing = -std::numeric_limits<double>::infinity();

// Of two spacings; 0 is none.
double finer(double a_m, double b_m) {
  return a_m > 0.0 && b_m > 0.0 ? std::min(a_m, b_m) : std::max(a_m, b_m);
}
}  // namespace

double GroundWalk::highest_tangent(double from_m, double to_m) const {
  if (near_pole(look_)) return kNothing;
  const double pieces = std::max(1.0, std::ceil((to_m - from_m) / kPiece_m));
  const geo::GeodesicRay ray(look_.apex, look_.azimuth);
  double highest = kNothing;
  for (double piece = 0.0; piece < pieces; piece += 1.0) {
    const double begin_m = from_m + (to_m - from_m) * piece / pieces;
    const double end_m = from_m + (to_m - from_m) * (piece + 1.0) / pieces;
    highest = std::max(highest, highest_of_piece(ray, begin_m, end_m, piece + 1.0 < pieces));
  }
  return highest;
}

double GroundWalk::highest_of_piece(const geo::GeodesicRay& ray, double from_m, double to_m, bool with_end) const {
  const geo::GeoPoint begin = ray.position(geo::Length::metres(from_m));
  const geo::GeoPoint end = ray.position(geo::Length::metres(to_m));
  const double spacing_m = finer(terrain_.post_spacing_at(begin), terrain_.post_spacing_at(end));
  if (!(spacing_m > 0.0)) return kNothing;
  const double north_deg = end.latitude_deg - begin.latitude_deg;
  const double east_deg = geo::wrapped_degrees(end.longitude_deg - begin.longitude_deg);
  const double steps = std::ceil((to_m - from_m) * steps_a_post_ / spacing_m);
  double highest = kNothing;
  for (double step = 1.0; with_end ? step <= steps : step < steps; step += 1.0) {
    const double share = step / steps;
    const double distance_m = from_m + share * (to_m - from_m);
    const geo::GeoPoint place{begin.latitude_deg + share * north_deg, begin.longitude_deg + share * east_deg};
    highest = std::max(highest, tangent(place, distance_m));
  }
  return highest;
}

double GroundWalk::tangent(geo::GeoPoint place, double distance_m) const {
  const double peak_m = terrain_.surface_at(place, interpolation_).peak_m;
  return std::isnan(peak_m) ? kNothing : earth_.sight(look_.altitude.metres(), distance_m, peak_m).tangent;
}

}  // namespace yars::model::rbm
