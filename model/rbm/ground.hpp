// What the ground of a sweep reflects, for `standard`: the configuration's materials, sea and texture made into tables
// once, and into one number a sample each sweep. Agrees with SurfaceReturn within the sea table's bounds (0.02 dB below
// 15 degrees of grazing) and for a look that is the middle one of the ray.
#pragma once

#include <cstdint>

#include "lib/memory/line_vector.hpp"
#include "model/rbm/ground_lanes.hpp"
#include "model/rbm/look.hpp"
#include "model/reflectivity/land.hpp"
#include "model/reflectivity/sea_table.hpp"

namespace yars::model::rbm {

class Ground {
 public:
  Ground(const radar::RadarConfiguration& configuration, std::size_t samples);

  // Once a sweep: the sizes of resolution cell and sample [m], for the texture.
  void use_resolution(double pulse_length_m, double spacing_m);

  // Codes of the samples that reflect() reads; terrain::kRunSlack more.
  memory::LineVector<std::int32_t>& materials() { return codes_; }

  struct Sample {
    const float* land = nullptr;  // (1 - water) gamma, texture and cardinal effect in it; null: plain land everywhere
    const float* sea = nullptr;   // water * sigma0; null: no water in the sweep
  };
  // `water` and `sin_grazing` as the terrain and sight() gave them; where the material is water so becomes `water`.
  // `materials`: whether materials() was filled.
  Sample reflect(const Look& look, const terrain::PlaceRun& places, float* water, const float* sin_grazing,
                 bool materials);

 private:
  void face_walls(const terrain::PlaceRun& places, geo::Bearing azimuth);

  bool textured_plain_ = false;  // land without culture
  bool textured_land_ = false;   // any land
  bool textured_sea_ = false;
  std::uint32_t walled_ = 0;  // the materials with walls, a bit each
  reflectivity::LandReturn land_;
  reflectivity::SeaTable sea_;
  geo::Bearing wind_from_;
  lanes::MaterialTables tables_;
  memory::LineVector<float> sigma0_;  // of the sea over the grazing angle, this sweep
  reflectivity::GroundGrid grid_;
  double cell_m_ = 0.0;
  memory::LineVector<std::int32_t> codes_, level_;
  memory::LineVector<float> everywhere_, land_gamma_, sea_sigma0_;
};

}  // namespace yars::model::rbm
