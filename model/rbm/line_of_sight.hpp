// Line of sight over posts: crests along a ray, and whether they hide a point.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/memory/line_vector.hpp"
#include "lib/radar/configuration.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::rbm {

// The crests of a ray (terrain_view.hpp) at every latitude: near a pole the ways between places are not straight in
// latitude and longitude, and are split until they are. Where pieces are as short as a tenth of the finest posts'
// spacing, the ground at their ends counts too.
// Holds the room for one ray: one instance a thread. No allocation after construction.
class RayCrests {
 public:
  explicit RayCrests(std::size_t places);

  struct Ray {
    geo::GeoPoint apex;
    geo::Bearing azimuth;
    geo::Length range;
    int knots = physics::kExactPlaces;  // of physics::sample_places()
  };
  // As TerrainView::crests() for the places of this ray.
  bool find(const terrain::TerrainView& terrain, const Ray& ray, const physics::PlaceArrays& places,
            const terrain::RaySight& sight, std::span<float> tangent);

 private:
  void split(const physics::PolarPassage& way, std::span<const float> distance_m);
  void look_up_short_pieces(const terrain::TerrainView& terrain, const terrain::RaySight& sight);

  physics::PlaceArrays pieces_;  // their ends
  memory::LineVector<float> distance_m_, elevation_m_, water_, peak_m_, crest_;
  std::vector<std::size_t> ends_;  // for each place, the piece that ends there
  // Pieces too short for lines of posts: [first, last).
  std::size_t first_short_ = 0, last_short_ = 0;
};

// Whether the ground hides a point from the aircraft: every line of posts on the way is looked at, by the fast path of
// the standard algorithm. Terrain that is not made of posts is looked at 512 times.
// Holds the room for one way: one instance a thread. No allocation after construction.
class SightLine {
 public:
  SightLine();

  // True if nothing on the ground hides a point at this altitude [m MSL] from the look's place. A void hides nothing
  // above sea level. Distance over ground > 0.
  bool clear(const radar::Fidelity& fidelity, const physics::SweepGeometry& look, const terrain::TerrainView& terrain,
             const geo::GeodesicInverse& way, double altitude_m);

 private:
  physics::PlaceArrays places_;
  RayCrests ray_crests_;
  memory::LineVector<float> distance_m_, elevation_m_, water_, peak_m_, crest_;
};

}  // namespace yars::model::rbm
