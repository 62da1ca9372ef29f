// Reflectivity of the ground. SurfaceReturn computes that of one position in double precision. Ground computes that of
// a sweep in float. Inputs: positions, surface materials, fraction of water, grazing angles, azimuth. Outputs: gamma
// and sigma0 as power ratios. Accuracy: at half the selected range, Ground agrees with SurfaceReturn within 0.02 dB
// below 15 degrees grazing. Unknown material codes reflect as land without culture. Threads: one thread at a time may
// use a Ground. Source: docs/spec/physics.md#land, docs/spec/physics.md#sea, docs/spec/physics.md#speckle.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lib/memory/line_vector.hpp"
#include "lib/radar/modes.hpp"
#include "model/physics/clutter.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/physics/texture.hpp"

namespace yars::model::physics {

// Ground at one position.
struct Facet {
  geo::GeoPoint position;
  geo::Bearing azimuth;       // azimuth of the ray at the position
  double sin_grazing = 0.0;   // sine of the grazing angle on level ground; used by the sea
  double water = 0.0;         // [0, 1] fraction of water, as terrain::Surface::water
  std::uint8_t material = 0;  // surface material code; the water material sets the fraction of water to 1
  std::size_t sample = 0;     // number of the sample of the sweep
};

// Textures by material code: the tables of TextureSteps, and a table for each material with a configured texture.
struct LandTextures {
  explicit LandTextures(const RadarParameters& parameters);

  std::vector<float> levels;
  std::array<std::int32_t, radar::kMaterials> entry{};  // first level of configured textures; of the sea at water
  // Sets of material codes: with a configured texture or none; of even land; with texture.
  std::uint32_t configured = 0, even = 0, textured = 0;
};

// Motion of the sea's texture: with the waves, downwind.
struct SeaTexture {
  double north_mps = 0.0, east_mps = 0.0;
  double life_s = 0.0;  // 0: the texture is fixed to the ground

  // None without a beam, as in patch maps.
  TextureDrift drift(const SampleTextures& samples, geo::Duration sim_time) const;
};

// Reflectivity of the ground at one position, in double precision, for the algorithm `reference`.
// Land return depends on material and cardinal effect (stronger return of walls that face the radar). Sea return
// depends on wind and grazing angle. Texture (clutter.hpp) multiplies both.
class SurfaceReturn {
 public:
  explicit SurfaceReturn(const RadarParameters& parameters);
  // Replaces sea state and wind.
  void use_sea(const RadarParameters& parameters);

  // Sets the texture of the samples. Call it once a sweep.
  void use_texture(const TextureSweep& sweep, geo::Duration sim_time = {});

  struct Reflectivity {
    double gamma = 0.0;   // of the land, times its fraction: cross section per area normal to the ray
    double sigma0 = 0.0;  // of the water, times its fraction: cross section per area of the level ground
  };
  Reflectivity at(const Facet& facet) const;

 private:
  double texture(std::size_t material, const Facet& facet) const;

  LandReturn land_;
  SeaReturn sea_;
  SeaTexture sea_texture_;
  TextureDrift drift_;
  LandTextures textures_;
  SampleTextures samples_;
};

// Ground reflectivity of a sweep, for the algorithm `standard`. The constructor makes the tables of materials, sea and
// texture. Tables that depend on azimuth are made once a sweep, for the ray's azimuth at half the selected range.
class Ground {
 public:
  Ground(const RadarParameters& parameters, std::size_t samples);

  // Replaces sea state and wind.
  void use_sea(const RadarParameters& parameters);
  // Sets the number of samples of the following sweeps.
  void resize(std::size_t samples);

  // Sets the texture of the samples. Call it once a sweep.
  void use_texture(const TextureSweep& sweep, geo::Duration sim_time = {});

  // Buffer of material codes. The caller fills it for prepare() and reflect(). Its size is samples + kPairSlack.
  memory::CacheAlignedVector<std::int32_t>& materials() { return codes_; }

  // Ground inputs of a sweep for simd::sweep(). Null: the whole sweep is land without culture and texture.
  // `water` is the fraction of water from the terrain. `materials` is true if materials() is filled.
  // The result is valid until the next call of prepare() or reflect(), and refers to `positions` and `water`.
  const simd::GroundInputs* prepare(const SweepGeometry& geometry, const terrain::PositionRun& positions,
                                    const float* water, bool materials);

  // Reflectivity of all samples as arrays, for callers that have the sines of the grazing angle.
  struct Sample {
    const float* land = nullptr;  // (1 - water) * gamma * texture * cardinal effect; null if prepare() gives null
    const float* sea = nullptr;   // water * sigma0 * texture; null together with `land`
  };
  Sample reflect(const SweepGeometry& geometry, const terrain::PositionRun& positions, const float* water,
                 const float* sin_grazing, bool materials);

 private:
  void compute_wall_gain(const terrain::PositionRun& positions, geo::Bearing azimuth);

  LandReturn land_;
  SeaTable sea_;
  SeaTexture sea_texture_;
  double wind_north_ = 1.0, wind_east_ = 0.0;  // unit vector in the direction that the wind blows from
  simd::MaterialTables tables_;
  simd::GroundInputs inputs_;
  memory::CacheAlignedVector<float> sigma0_;  // sea table at the sweep's azimuth
  LandTextures textures_;
  SampleTextures samples_;
  memory::CacheAlignedVector<std::int32_t> codes_;
  memory::CacheAlignedVector<float> wall_gain_, land_gamma_, sea_sigma0_;
  StreetFinder streets_;
};

}  // namespace yars::model::physics
