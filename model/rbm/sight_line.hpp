// Whether the ground hides a point from the aircraft: every line of posts on the way is looked at, by the fast path of
// the standard algorithm. Terrain that is not made of posts is looked at 512 times.
#pragma once

#include "lib/geo/geodesic.hpp"
#include "lib/memory/line_vector.hpp"
#include "lib/radar/configuration.hpp"
#include "model/rbm/look.hpp"
#include "model/rbm/ray_crests.hpp"
#include "model/rbm/sample_places.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::rbm {

// Holds the room for one way: one instance a thread. No allocation after construction.
class SightLine {
 public:
  SightLine();

  // True if nothing on the ground hides a point at this altitude [m MSL] from the look's place. A void hides nothing
  // above sea level. Distance over ground > 0.
  bool clear(const radar::Fidelity& fidelity, const Look& look, const terrain::TerrainView& terrain,
             const geo::GeodesicInverse& way, double altitude_m);

 private:
  PlaceArrays places_;
  RayCrests ray_crests_;
  memory::LineVector<float> distance_m_, elevation_m_, water_, peak_m_, crest_;
};

}  // namespace yars::model::rbm
