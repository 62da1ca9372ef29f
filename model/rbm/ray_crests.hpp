// The crests of a ray (terrain_view.hpp) at every latitude: near a pole the ways between places are not straight in
// latitude and longitude, and are split until they are. Where pieces are as short as a tenth of the finest posts'
// spacing, the ground at their ends counts too.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "model/rbm/look.hpp"
#include "model/rbm/pole_way.hpp"
#include "model/rbm/sample_places.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::rbm {

// Holds the room for one ray: one instance a thread. No allocation after construction.
class RayCrests {
 public:
  explicit RayCrests(std::size_t places);

  struct Ray {
    geo::GeoPoint apex;
    geo::Bearing azimuth;
    geo::Length range;
    int knots = kExactPlaces;  // of sample_places()
  };
  // As TerrainView::crests() for the places of this ray.
  bool find(const terrain::TerrainView& terrain, const Ray& ray, const PlaceArrays& places,
            const terrain::RaySight& sight, std::span<float> tangent);

 private:
  void split(const PoleWay& way, std::span<const float> distance_m);
  void look_up_short_pieces(const terrain::TerrainView& terrain, const terrain::RaySight& sight);

  PlaceArrays pieces_;  // their ends
  memory::LineVector<float> distance_m_, elevation_m_, water_, peak_m_, crest_;
  std::vector<std::size_t> ends_;  // for each place, the piece that ends there
  // Pieces too short for lines of posts: [first, last).
  std::size_t first_short_ = 0, last_short_ = 0;
};

}  // namespace yars::model::rbm
