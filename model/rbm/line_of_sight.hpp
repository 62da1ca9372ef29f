// Line of sight over terrain: crests along a ray, and visibility of points.
// A sample's crest is the highest ground, by elevation angle, between the previous sample and this sample.
// Inputs: terrain, ray (apex, azimuth, range), altitude of the aircraft [m MSL], effective earth (a sphere that
// accounts for refraction).
// Outputs: tangent of the elevation angle of each sample's crest; visibility of a point.
// Accuracy: every line of posts (row or column of them) that the ray crosses is tested, at most 1 m off the ray.
// Threads: one thread at a time may use an instance. No allocation after construction.
// Source: docs/spec/physics.md#shadow, docs/decisions/0019-shadow-by-lines-of-posts.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/memory/line_vector.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::rbm {

// Finds the crests of a ray at any latitude. TerrainView::crests() assumes that the ray is straight in latitude and
// longitude between samples. Near a pole it is curved. There each interval between samples is split into nearly
// straight pieces of at least 3 m; the last piece of an interval may be shorter. The ground at the ends of pieces of
// this minimum length is sampled, too.
class RayCrests {
 public:
  explicit RayCrests(std::size_t samples);

  struct Ray {
    geo::GeoPoint apex;
    geo::Bearing azimuth;
    geo::Length range;
    int knots = physics::kExactPositions;  // method of physics::sample_positions() for the pieces
  };
  // Writes the tangent of each sample's crest. `positions` and `sight` describe the samples. Returns false, and writes
  // nothing, if the ground is a formula without posts.
  bool find(const terrain::TerrainView& terrain, const Ray& ray, const physics::PositionArrays& positions,
            const terrain::RaySight& sight, std::span<float> tangent);

 private:
  void split(const physics::PolarPassage& passage, std::span<const float> distance_m);
  void sample_short_pieces(const terrain::TerrainView& terrain, const terrain::RaySight& sight);

  physics::PositionArrays pieces_;  // ends of the pieces
  memory::CacheAlignedVector<float> distance_m_, elevation_m_, water_, peak_m_, crest_;
  std::vector<std::size_t> ends_;  // for each sample, the index of the piece that ends at the sample
  // Interval [first_short_, last_short_) of pieces_ that includes all pieces of minimum length; empty if both are 0.
  std::size_t first_short_ = 0, last_short_ = 0;
};

// Visibility of a point from the aircraft. The ground is sampled at 512 positions and at every line of posts that the
// path crosses.
class SightLine {
 public:
  SightLine();

  // True if no ground hides the point from the aircraft. `path` leads from the apex to the point; its distance must
  // be > 0. `altitude_m` [m MSL] is the point's altitude. A void counts as ground at sea level.
  bool clear(const physics::GeometryParameters& parameters, const physics::SweepGeometry& geometry,
             const terrain::TerrainView& terrain, const geo::GeodesicInverse& path, double altitude_m);

 private:
  physics::PositionArrays positions_;
  RayCrests ray_crests_;
  memory::CacheAlignedVector<float> distance_m_, elevation_m_, water_, peak_m_, crest_;
};

// Position from which lines of sight are computed, so that successive sweeps share them and they do not depend on
// earlier calls: the middle of the 100 m square of latitude and longitude that contains the aircraft, at its altitude
// rounded up to 5 m. The algorithm `reference` uses the aircraft's own position.
class SightOrigin {
 public:
  SightOrigin() = default;
  SightOrigin(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain, bool exact);
  bool operator==(const SightOrigin&) const = default;

  // `geometry` with the apex at this position, at least 5 m above the ground below it.
  physics::SweepGeometry moved(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain) const;

 private:
  double latitude_deg_ = 0.0, longitude_deg_ = 0.0, altitude_m_ = 0.0;
  bool exact_ = false;
  const terrain::TerrainView* terrain_ = nullptr;
  std::uint64_t generation_ = 0;  // of the terrain
};

// Visibility of movers from a SightOrigin. A mover counts as standing in the middle of the 10 m square of latitude and
// longitude that contains it; `reference` uses the mover's own position. What is found is kept while neither changes.
class MoverSights {
 public:
  MoverSights(const physics::RadarParameters& parameters, std::size_t movers);

  // Prepares a sweep.
  void enter(const physics::SweepGeometry& geometry, const terrain::TerrainView& terrain);
  // True if no ground hides a mover. `number`: less than `movers`; a mover that keeps its number is found sooner.
  bool clear(std::size_t number, geo::GeoPoint position, double above_ground_m, const terrain::TerrainView& terrain);

 private:
  struct Found {
    std::uint64_t origin = 0;  // origin_number_; 0: none
    geo::GeoPoint middle;
    double above_ground_m = 0.0;
    bool clear = false;
  };
  bool exact_;
  physics::GeometryParameters parameters_;
  SightLine sight_line_;
  SightOrigin origin_;
  std::uint64_t origin_number_ = 0;
  physics::SweepGeometry from_;  // the sweep, from origin_
  std::vector<Found> found_;     // by number of the mover
};

}  // namespace yars::model::rbm
