// Line of sight over posts: tangents of the crests along a ray, and visibility of a point.
// Inputs: terrain, ray (apex, azimuth, range), altitude of the aircraft [m MSL], effective earth.
// Outputs: tangent of the highest crest before each sample; true or false for a point.
// Accuracy: every line of posts on the ray is tested; a piece of the ray bends by 1 m at most.
// Threads: instances have buffers of their own: one per thread. No allocation after construction.
// Source: docs/spec/physics.md#shadow, docs/decisions/0019-shadow-by-lines-of-posts.md.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/memory/line_vector.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::rbm {

// Crests of a ray (TerrainView::crests) at every latitude. Near a pole a ray is not straight in latitude and longitude:
// the intervals between samples are split into straight pieces.
// At ends of pieces as short as a tenth of the finest posts' spacing the ground itself is sampled too.
class RayCrests {
 public:
  explicit RayCrests(std::size_t samples);

  struct Ray {
    geo::GeoPoint apex;
    geo::Bearing azimuth;
    geo::Length range;
    int knots = physics::kExactPositions;  // method of physics::sample_positions()
  };
  // TerrainView::crests() for the samples of this ray.
  bool find(const terrain::TerrainView& terrain, const Ray& ray, const physics::PositionArrays& positions,
            const terrain::RaySight& sight, std::span<float> tangent);

 private:
  void split(const physics::PolarPassage& passage, std::span<const float> distance_m);
  void sample_short_pieces(const terrain::TerrainView& terrain, const terrain::RaySight& sight);

  physics::PositionArrays pieces_;  // ends of the pieces
  memory::CacheAlignedVector<float> distance_m_, elevation_m_, water_, peak_m_, crest_;
  std::vector<std::size_t> ends_;  // for each sample, the index of the piece that ends at it
  // Interval [first, last) that holds all pieces too short for lines of posts.
  std::size_t first_short_ = 0, last_short_ = 0;
};

// Visibility of a point from the aircraft. The ground is sampled at 512 positions and at every line of posts that the
// path crosses.
class SightLine {
 public:
  SightLine();

  // True if no ground hides a point at the end of the path, at an altitude [m MSL], from the apex of the geometry. A
  // void counts as sea level. The path's distance must be > 0.
  bool clear(const physics::GeometryParameters& parameters, const physics::SweepGeometry& geometry,
             const terrain::TerrainView& terrain, const geo::GeodesicInverse& path, double altitude_m);

 private:
  physics::PositionArrays positions_;
  RayCrests ray_crests_;
  memory::CacheAlignedVector<float> distance_m_, elevation_m_, water_, peak_m_, crest_;
};

}  // namespace yars::model::rbm
