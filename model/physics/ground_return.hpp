// Cross section of the ground: of one sample in double precision, and of a whole sweep.
#pragma once

#include <array>
#include <cstdint>

#include "lib/memory/line_vector.hpp"
#include "lib/radar/configuration.hpp"
#include "model/physics/clutter.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::model::physics {

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

// The cross section of the ground in one resolution cell: land by material with its cardinal effect, sea by wind and
// grazing angle, both under a texture that stays on the ground. Plain double: what `reference` computes a sample.
class SurfaceReturn {
 public:
  explicit SurfaceReturn(const radar::RadarConfiguration& configuration);

  // Sets the cells that texture is drawn in. Once a sweep; does something when the range has changed.
  void use_resolution(double pulse_length_m, double spacing_m);

  // sigma0 times the area lit, texture included [m^2].
  double cross_section_m2(const Receiver& receiver, const Facet& facet) const;

 private:
  double texture(std::size_t material, geo::GeoPoint place) const;

  LandReturn land_;
  SeaReturn sea_;
  std::array<TextureLevels, radar::kMaterials> texture_{};  // by material, water's the sea's
  std::array<bool, radar::kMaterials> textured_{};
  GroundGrid grid_;
  double cell_m_ = 0.0;
};

// What the ground of a sweep reflects, for `standard`: the configuration's materials, sea and texture made into tables
// once, and once a sweep what depends on where it looks. Agrees with SurfaceReturn within the sea table's bounds (0.02
// dB below 15 degrees of grazing) and for a look that is the middle one of the ray.
class Ground {
 public:
  Ground(const radar::RadarConfiguration& configuration, std::size_t samples);

  // Once a sweep: the sizes of resolution cell and sample [m], for the texture.
  void use_resolution(double pulse_length_m, double spacing_m);

  // Codes of the samples that prepare() and reflect() read; terrain::kRunSlack more.
  memory::LineVector<std::int32_t>& materials() { return codes_; }

  // The ground below a sweep's places, for simd::sweep(); null: plain dry land everywhere. `water` as the terrain gave
  // it; `materials`: whether materials() was filled. Lasts until the next call; the places have to last as long.
  const simd::GroundInputs* prepare(const SweepGeometry& look, const terrain::PlaceRun& places, const float* water,
                                    bool materials);

  // The same as arrays, for who has the sines of the grazing angle already.
  struct Sample {
    const float* land = nullptr;  // (1 - water) gamma, texture and cardinal effect in it; null: plain land everywhere
    const float* sea = nullptr;   // water * sigma0; null: no water in the sweep
  };
  Sample reflect(const SweepGeometry& look, const terrain::PlaceRun& places, const float* water,
                 const float* sin_grazing, bool materials);

 private:
  void face_walls(const terrain::PlaceRun& places, geo::Bearing azimuth);

  LandReturn land_;
  SeaTable sea_;
  double wind_north_, wind_east_;  // unit vector to where the wind comes from
  simd::MaterialTables tables_;
  simd::GroundInputs inputs_;
  memory::LineVector<float> sigma0_;  // of the sea over the grazing angle, this sweep
  GroundGrid grid_;
  double cell_m_ = 0.0;
  memory::LineVector<std::int32_t> codes_;
  memory::LineVector<float> wall_gain_, land_gamma_, sea_sigma0_;
  StreetFinder streets_;
};

}  // namespace yars::model::physics
