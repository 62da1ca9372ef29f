// The cross section of the ground in one resolution cell: land by material with its cardinal effect, sea by wind and
// grazing angle, both under a texture that stays on the ground. Plain double: what `reference` computes a sample.
#pragma once

#include <array>
#include <cstdint>

#include "lib/radar/configuration.hpp"
#include "model/rbm/receiver.hpp"
#include "model/reflectivity/ground_grid.hpp"
#include "model/reflectivity/land.hpp"
#include "model/reflectivity/sea.hpp"
#include "model/reflectivity/texture.hpp"

namespace yars::model::rbm {

// One sample as the beam sees it.
struct Facet {
  geo::GeoPoint place;
  geo::Bearing look;           // of the ray at the place
  double slant_range_m = 0.0;  // > 0
  double sin_local = 0.0;      // [0, 1] sine of the grazing angle on the facet: what land goes by
  double sin_grazing = 0.0;    // the same on level ground: what the sea goes by
  double water = 0.0;          // [0, 1] share of water by elevation
  std::uint8_t material = 0;   // code; water's makes it all water
};

class SurfaceReturn {
 public:
  explicit SurfaceReturn(const radar::RadarConfiguration& configuration);

  // Sets the cells that texture is drawn in. Once a sweep; does something when the range has changed.
  void use_resolution(double pulse_length_m, double spacing_m);

  // sigma0 times the area lit, texture included [m^2].
  double cross_section_m2(const Receiver& receiver, const Facet& facet) const;

 private:
  double texture(std::size_t material, geo::GeoPoint place) const;

  reflectivity::LandReturn land_;
  reflectivity::SeaReturn sea_;
  std::array<reflectivity::TextureLevels, radar::kMaterials> texture_{};  // by material, water's the sea's
  std::array<bool, radar::kMaterials> textured_{};
  reflectivity::GroundGrid grid_;
  double cell_m_ = 0.0;
};

}  // namespace yars::model::rbm
