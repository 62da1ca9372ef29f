// What the ground of a sweep reflects, for `standard`: the configuration's materials, sea and texture made into tables
// once, and once a sweep what depends on where it looks. Agrees with SurfaceReturn within the sea table's bounds (0.02
// dB below 15 degrees of grazing) and for a look that is the middle one of the ray.
#pragma once

#include <cstdint>

#include "lib/memory/line_vector.hpp"
#include "model/rbm/ground_lanes.hpp"
#include "model/rbm/look.hpp"
#include "model/reflectivity/land.hpp"
#include "model/reflectivity/sea_table.hpp"
#include "model/terrain/street_grid.hpp"

namespace yars::model::rbm {

class Ground {
 public:
  Ground(const radar::RadarConfiguration& configuration, std::size_t samples);

  // Once a sweep: the sizes of resolution cell and sample [m], for the texture.
  void use_resolution(double pulse_length_m, double spacing_m);

  // Codes of the samples that prepare() and reflect() read; terrain::kRunSlack more.
  memory::LineVector<std::int32_t>& materials() { return codes_; }

  // The ground below a sweep's places, for lanes::sweep(); null: plain dry land everywhere. `water` as the terrain gave
  // it; `materials`: whether materials() was filled. Lasts until the next call; the places have to last as long.
  const lanes::GroundInputs* prepare(const Look& look, const terrain::PlaceRun& places, const float* water,
                                     bool materials);

  // The same as arrays, for who has the sines of the grazing angle already.
  struct Sample {
    const float* land = nullptr;  // (1 - water) gamma, texture and cardinal effect in it; null: plain land everywhere
    const float* sea = nullptr;   // water * sigma0; null: no water in the sweep
  };
  Sample reflect(const Look& look, const terrain::PlaceRun& places, const float* water, const float* sin_grazing,
                 bool materials);

 private:
  void face_walls(const terrain::PlaceRun& places, geo::Bearing azimuth);

  reflectivity::LandReturn land_;
  reflectivity::SeaTable sea_;
  double wind_north_, wind_east_;  // unit vector to where the wind comes from
  lanes::MaterialTables tables_;
  lanes::GroundInputs inputs_;
  memory::LineVector<float> sigma0_;  // of the sea over the grazing angle, this sweep
  reflectivity::GroundGrid grid_;
  double cell_m_ = 0.0;
  memory::LineVector<std::int32_t> codes_;
  memory::LineVector<float> wall_gain_, land_gamma_, sea_sigma0_;
  terrain::StreetFinder streets_;
};

}  // namespace yars::model::rbm
