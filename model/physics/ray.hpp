// Ray over the ground: positions of its samples at every latitude, and the ground between them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/memory/line_vector.hpp"
#include "lib/radar/configuration.hpp"
#include "model/physics/environment.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::physics::polynomials {

// Elementary functions in double without a library call: the same bits whatever the machine's library picks.
// Coefficients: Chebyshev interpolation on the reduced interval.

// Angle [rad] in (-pi, pi] of the direction (x, y), not both zero. Error 1e-12.
inline double arctangent(double y, double x) {
  constexpr double kHalfPi = 1.5707963267948966;
  constexpr double kPi = 3.141592653589793;
  constexpr double kEighthTurnHalf = 0.41421356237309503;  // tan(pi/8)
  const double ay = y < 0.0 ? -y : y;
  const double ax = x < 0.0 ? -x : x;
  const double ratio = ay < ax ? ay / ax : ax / ay;
  const bool folded = ratio > kEighthTurnHalf;
  const double t = folded ? (ratio - 1.0) / (ratio + 1.0) : ratio;
  const double s = t * t;
  double p = -0.037655320648088311;
  p = p * s + 0.069742085005920981;
  p = p * s - 0.08992554733325249;
  p = p * s + 0.1110345699688494;
  p = p * s - 0.14285386547576151;
  p = p * s + 0.19999993052852441;
  p = p * s - 0.33333333276904076;
  p = p * s + 0.99999999999924361;
  const double reduced = p * t + (folded ? 0.5 * kHalfPi : 0.0);
  const double first = ay < ax ? reduced : kHalfPi - reduced;
  const double upper = x < 0.0 ? kPi - first : first;
  return y < 0.0 ? -upper : upper;
}

}  // namespace yars::model::physics::polynomials

namespace yars::model::physics {

// How a ray passes the nearer pole, and how long a piece of it may be there to count as straight in latitude and
// longitude. The ray is a straight line in the plane of the pole: its way past the pole is right within 20 m for 320
// NM.
class PoleWay {
 public:
  // `bend_m`: how far a piece may lie from the straight way between its ends; `shortest_m`: no piece is shorter.
  PoleWay(geo::GeoPoint apex, geo::Bearing azimuth, double bend_m, double shortest_m);

  // [m] that a piece beginning this far along the ray may be long. It turns by less than a degree of longitude, but
  // for the shortest ones.
  double straight_m(double along_m) const;
  // The least of that between two distances along the ray.
  double least_straight_m(double from_m, double to_m) const;

 private:
  double straight_at(double to_pole_m) const;

  double nearest_m_;  // along the ray, where the pole is nearest; negative: behind
  double offset_m_;   // of the pole from the ray there
  double bend_m_, shortest_m_;
};

// Where the samples of a sweep lie. With five knots or more, a Taylor series of the geodesic where it holds within 1 mm
// (GeodesicSeries: rays short against the way to the pole, the usual case); else, and with fewer knots always, by
// interpolation between so many exact points, in double. Away from the poles latitude and longitude are interpolated
// themselves; near them, where longitude turns quickly, the unit vector is. Accuracy with five knots or more: 0.5 m
// against the geodesic for any ray of up to 160 NM from any latitude, millimetres at middle latitudes. Longitudes run
// on across the antimeridian.
inline constexpr int kMinKnots = 2;
inline constexpr int kMaxKnots = 9;
inline constexpr int kExactPlaces = 0;  // as knots: the geodesic itself at every sample
inline constexpr int kSeriesKnots = 5;  // so many or more: a series will do where it is as good

// Entries behind the last sample that a pair of vectors may read.
inline constexpr std::size_t kPairSlack = 2 * terrain::kRunSlack;

// Room for the places of a sweep, and the run that they make.
struct PlaceArrays {
  explicit PlaceArrays(std::size_t samples)
      : count(samples),
        cells_north(samples + kPairSlack),
        cells_east(cells_north),
        north_deg(cells_north),
        east_deg(cells_north) {}
  terrain::PlaceRun run() const {
    return {corner,
            {cells_north.data(), count},
            {cells_east.data(), count},
            {north_deg.data(), count},
            {east_deg.data(), count}};
  }

  std::size_t count;
  terrain::CellPlace corner;  // of the cell that holds the apex
  memory::LineVector<float> cells_north, cells_east, north_deg, east_deg;
};

// Distances [m] in [0, range], finite, ascending, as many as the places; terrain::kRunSlack entries more behind them
// are read.
void sample_places(geo::GeoPoint apex, geo::Bearing azimuth, geo::Length range, int knots, const float* distance_m,
                   PlaceArrays& places);

// The ground along a ray between two distances, in plain double: what the reference raises its horizon with between its
// samples. Steps of a tenth of the posts' spacing, exact geodesic places at most 500 m apart and straight ways in
// latitude and longitude between them: 5 mm off up to 60 degrees of latitude, 0.2 m from 88 to the pole, where places
// lie closer.
// Source: docs/spec/physics.md#shadow.
class GroundWalk {
 public:
  static constexpr double kStepsAPost = 10.0;

  // All are kept by reference.
  GroundWalk(const SweepGeometry& look, const EffectiveEarth& earth, const terrain::TerrainView& terrain,
             radar::Interpolation interpolation, double steps_a_post = kStepsAPost)
      : look_(look), earth_(earth), terrain_(terrain), interpolation_(interpolation), steps_a_post_(steps_a_post) {}

  const EffectiveEarth& earth() const { return earth_; }

  // The greatest tangent of the ground strictly between two distances over ground [m]; minus infinity: void all the
  // way, or no posts there.
  double highest_tangent(double from_m, double to_m) const;

  // The horizon of a point between samples: `horizon(i)` is that of all ground up to sample i; what is left of the way
  // to the point is walked.
  template <class Horizon>
  double horizon_before(std::span<const double> distance_m, double point_m, const Horizon& horizon) const {
    const std::size_t nearer = samples_nearer(distance_m, point_m);
    const bool known = nearer > 0 && !std::isnan(distance_m[nearer - 1]);
    const double walked = highest_tangent(known ? distance_m[nearer - 1] : 0.0, point_m);
    return known ? std::max(walked, horizon(nearer - 1)) : walked;
  }

 private:
  double highest_of_pieces(const geo::GeodesicRay& ray, double from_m, double to_m) const;
  // A way that counts as straight in latitude and longitude, `east_deg` unwrapped.
  struct Piece {
    geo::GeoPoint begin;
    double north_deg, east_deg;
    double from_m, to_m;
    terrain::PostSpacing posts;
  };
  double highest_of_piece(const geo::GeodesicRay& ray, double from_m, double to_m, bool with_end) const;
  double highest_of_columns(const Piece& piece) const;
  double tangent_along(const Piece& piece, double share) const;
  double tangent(geo::GeoPoint place, double distance_m) const;

  const SweepGeometry& look_;
  const EffectiveEarth& earth_;
  const terrain::TerrainView& terrain_;
  radar::Interpolation interpolation_;
  double steps_a_post_;
};

}  // namespace yars::model::physics
