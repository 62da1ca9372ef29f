// The broad shapes of the made-up earth, from noise on the sphere: coasts with bays, capes and islands, a plain,
// ranges in chains along the coast with valleys between. A function of place, seed and box alone.
#pragma once

#include <cstdint>
#include <optional>

#include "lib/geo/frames.hpp"
#include "lib/geo/geodesic.hpp"
#include "model/terrain/landscape_box.hpp"

namespace yars::model::terrain {

class BroadRelief {
 public:
  // With a box, land falls to the sea before the box's edge: the box holds islands.
  explicit BroadRelief(std::uint32_t seed, std::optional<LandscapeBox> island = std::nullopt)
      : seed_(seed), island_(island) {}

  // [m], negative under the sea, before valleys, gullies and rivers.
  double height_m(geo::GeoPoint place) const;

 private:
  struct Shore {
    double coast_km;  // way inland of the coast, negative at sea
    double fade;      // [0, 1] of mountains and hills
  };
  Shore beside_edge(double coast_km, geo::GeoPoint place, geo::Vector3 bent) const;
  double noise(geo::Vector3 point_km, double wavelength_km, std::uint32_t layer, int octaves = 1) const;
  double ridges(geo::Vector3 point_km, double wavelength_km, std::uint32_t layer, int octaves) const;

  std::uint32_t seed_;
  std::optional<LandscapeBox> island_;
};

}  // namespace yars::model::terrain
