// Ray over the ground: geodetic positions of its samples, and the horizon that the ground between samples makes.
// The horizon at a distance is the maximum tangent of the elevation angles of all nearer ground.
// Inputs: apex, azimuth, range, distances of the samples [m].
// Outputs: latitude and longitude, split into whole degrees and fractions [deg]; tangents of elevation angles.
// Frame: WGS84. Longitudes are continuous across the antimeridian.
// Accuracy: positions within 0.5 m up to 160 NM at every latitude, except with fewer than five knots (see kMinKnots).
// GroundWalk: 10 mm up to 60 degrees of latitude, 0.2 m beyond.
// Voids do not raise a horizon. GroundWalk keeps references to its inputs.
// Source: docs/spec/physics.md#geometry, docs/spec/physics.md#shadow.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/memory/line_vector.hpp"
#include "lib/radar/modes.hpp"
#include "model/physics/environment.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::physics {

// Division of a ray near a pole into pieces that are straight in latitude and longitude within a bound. The ray is
// modelled as a straight line in the tangent plane of the nearer pole, with an error of 20 m in 320 NM.
class PolarPassage {
 public:
  // `max_bend_m`: maximum distance between ray and piece. `min_piece_m`: minimum length of a piece. A piece of this
  // length may be farther than `max_bend_m` from the ray.
  PolarPassage(geo::GeoPoint apex, geo::Bearing azimuth, double max_bend_m, double min_piece_m);

  // Maximum length of a piece that begins at a distance along the ray. Longitude changes by less than one degree along
  // a piece, except along pieces of the minimum length.
  double max_straight_m(double along_m) const;
  // Minimum of max_straight_m() between two distances along the ray.
  double min_straight_m(double from_m, double to_m) const;

 private:
  double straight_at(double to_pole_m) const;

  double nearest_m_;  // distance along the ray of its point nearest to the pole; negative: behind the apex
  double offset_m_;   // distance from that point to the pole
  double max_bend_m_, min_piece_m_;
};

// Methods for the positions of a sweep's samples, selected by the number of knots:
// - kSeriesKnots or more: a Taylor series of the geodesic if its error is at most 1 mm (GeodesicSeries). This holds for
//   rays much shorter than the distance to the pole. Other rays are interpolated, with at most kMaxKnots knots.
// - 1 to kSeriesKnots - 1: interpolation with that many knots, at least kMinKnots.
// - kExactPositions (0): the geodesic itself at every sample.
// Knots are exact positions on the geodesic. Interpolation between them is in double: of the unit vector near a pole,
// of latitude and longitude elsewhere.
// Accuracy with five knots or more: 0.5 m against the geodesic up to 160 NM, millimetres at middle latitudes.
inline constexpr int kMinKnots = 2;
inline constexpr int kMaxKnots = 9;
inline constexpr int kExactPositions = 0;
inline constexpr int kSeriesKnots = 5;

// Number of entries after the last sample that a pair of vectors may read.
inline constexpr std::size_t kPairSlack = 2 * terrain::kRunSlack;

// Positions of a sweep's samples: whole degrees from the south-west corner of the apex's one-degree cell, and fractions
// of a degree. run() refers to the arrays.
struct PositionArrays {
  explicit PositionArrays(std::size_t samples)
      : count(samples),
        cells_north(samples + kPairSlack),
        cells_east(cells_north),
        north_deg(cells_north),
        east_deg(cells_north) {}
  terrain::PositionRun run() const {
    return {corner,
            {cells_north.data(), count},
            {cells_east.data(), count},
            {north_deg.data(), count},
            {east_deg.data(), count}};
  }

  std::size_t count;
  terrain::CellCorner corner;  // corner of the apex's cell
  memory::CacheAlignedVector<float> cells_north, cells_east, north_deg, east_deg;
};

// Positions of samples, ray after ray. What depends on the apex alone is kept for the next ray. One thread at a time.
class PositionSampler {
 public:
  // Computes the positions of all samples. `distance_m` has one finite value in [0, range] per sample, in ascending
  // order. terrain::kRunSlack entries after the last sample are read.
  void sample(geo::GeoPoint apex, geo::Bearing azimuth, geo::Length range, int knots, const float* distance_m,
              PositionArrays& positions);

 private:
  std::optional<geo::GeodesicFan> fan_;  // of the last apex
};

// Like PositionSampler::sample(), for a single ray.
void sample_positions(geo::GeoPoint apex, geo::Bearing azimuth, geo::Length range, int knots, const float* distance_m,
                      PositionArrays& positions);

// Walk over the ground along a ray, in double. The algorithm `reference` uses it. Positions of the walk: every row and
// column of posts that the ray crosses, and steps of the posts' spacing / `steps_per_post`. Exact geodesic positions
// are at most 500 m apart, closer near a pole. Between these positions the ray is straight in latitude and longitude.
// Accuracy of the positions: 10 mm up to 60 degrees of latitude, 0.2 m beyond.
class GroundWalk {
 public:
  static constexpr double kStepsPerPost = 10.0;  // steps per spacing of the posts

  GroundWalk(const SweepGeometry& geometry, const EffectiveEarth& earth, const terrain::TerrainView& terrain,
             radar::Interpolation interpolation, double steps_per_post = kStepsPerPost);

  const EffectiveEarth& earth() const { return earth_; }

  struct Point {
    double distance_m;  // over ground
    geo::GeoPoint position;
    terrain::Surface surface;
  };

  // The ground below the ray's start.
  terrain::Surface below() const { return terrain_.surface_at(geometry_.apex, interpolation_); }

  // Calls visit(point) for each position of the walk, ascending, from the first one farther than `from_m` to `to_m`
  // itself. On ground without posts the steps are `bare_step_m` long; 0: such ground is left out.
  template <class Visit>
  void visit(double from_m, double to_m, double bare_step_m, const Visit& visit) const {
    for (double begin_m = from_m; begin_m < to_m;) {
      Piece piece = piece_from(begin_m, to_m, bare_step_m);
      begin_m = piece.to_m;
      while (piece.left) visit(next_point(piece));
    }
  }

  // Maximum tangent of the ground strictly between two distances over ground. Minus infinity if this ground is void
  // or has no posts.
  double highest_tangent(double from_m, double to_m) const;

  // Maximum tangent of all ground nearer than a point at the distance `point_m`. `distance_m` has the distances of the
  // samples, `horizon(i)` the maximum tangent of the ground up to and including sample i. Only the ground between the
  // point and the last sample nearer than the point is walked.
  template <class Horizon>
  double horizon_before(std::span<const double> distance_m, double point_m, const Horizon& horizon) const {
    const std::size_t nearer = samples_nearer(distance_m, point_m);
    const bool has_nearer = nearer > 0 && !std::isnan(distance_m[nearer - 1]);
    const double walked = highest_tangent(has_nearer ? distance_m[nearer - 1] : 0.0, point_m);
    return has_nearer ? std::max(walked, horizon(nearer - 1)) : walked;
  }

 private:
  // Positions along a piece at equal intervals, as fractions of the piece. The next one is first + number * interval.
  struct Series {
    double first, interval;
    double number = 0.0;
    double next() const { return first + number * interval; }
  };
  // Piece of the ray, straight in latitude and longitude.
  struct Piece {
    geo::GeoPoint begin;
    double north_deg, east_deg;  // from begin to end; `east_deg` is continuous across the antimeridian
    double from_m, to_m;
    Series steps, rows, columns;
    bool left;  // its end is still to be visited
  };
  Piece piece_from(double from_m, double limit_m, double bare_step_m) const;
  Point next_point(Piece& piece) const;

  const SweepGeometry& geometry_;
  const EffectiveEarth& earth_;
  const terrain::TerrainView& terrain_;
  radar::Interpolation interpolation_;
  double steps_per_post_;
  geo::GeodesicRay ray_;
  PolarPassage passage_;
};

}  // namespace yars::model::physics
