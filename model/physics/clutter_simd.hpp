// SIMD loops over the samples of a sweep, written with the Highway library: reflectivity of the ground, speckle, video.
// Texture is a random factor on the reflectivity that is fixed to the ground (clutter.hpp).
// Inputs: arrays of samples; GroundInputs, NoiseState, VideoInputs.
// Outputs: gamma of land and sigma0 of sea as power ratios, speckle as gamma variates of mean 1, 8-bit video.
// Accuracy of the reflectivity: see ground_return.hpp.
// Threads: pure functions. The instruction set is chosen at run time; results are equal bit by bit on all of them.
// Unless a function states otherwise, arrays have terrain::kRunSlack more entries than samples, because vectors read
// past the end. Arrays for rbm::simd::sweep() have kPairSlack (ray.hpp) more entries than samples.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/radar/modes.hpp"
#include "model/physics/clutter.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::physics::simd {

// Land coefficients by material code.
struct MaterialTables {
  std::array<float, radar::kMaterials> gamma{};
  // First entry of GroundInputs::levels of the materials with a configured texture, or with none.
  std::array<std::int32_t, radar::kMaterials> entry{};
};

// Ground of one sweep. A set of materials has one bit per material code.
struct GroundInputs {
  const MaterialTables* tables = nullptr;
  terrain::PositionRun positions;
  const float* water = nullptr;            // fraction of water [0, 1]
  const std::int32_t* material = nullptr;  // codes; null: code 0 everywhere. The water material is 100 % water.
  const float* wall_gain = nullptr;        // factor on gamma; read only for materials with walls
  const SeaTable* sea = nullptr;           // may be null if there are neither water nor materials
  float upwind = 0.0F;                     // cosine of the angle between the ray and the direction the wind comes from
  float* sigma0 = nullptr;                 // buffer for sigma0_at_azimuth(), filled at the first sample with water
  const GroundGrid* grid = nullptr;        // cells of the texture
  const float* levels = nullptr;           // levels of texture, kTextureLevels for each entry; factors of mean 1
  const std::int32_t* rural = nullptr;     // first entry of `levels` of rural land, by sample
  const std::int32_t* even = nullptr;      // the same of even land
  std::int32_t sea_entry = 0;              // the same of the sea, if `sea_steps` is null
  const float* sea_steps = nullptr;        // step of TextureSteps of the sea across 45 degrees of wind, by sample
  float sea_turn = 0.0F;                   // added to the steps at the sweep's azimuth
  TextureDrift drift;                      // of the sea's texture
  float glint = 0.0F;                      // |R|^2 / s^2 of the specular echo of the sea; 0: none
  float glint_octaves = 0.0F;              // log2(e) / s^2
  std::uint32_t textured = 0;              // set of land materials with texture
  std::uint32_t configured = 0;            // set of materials whose entry is that of `tables`
  std::uint32_t even_kinds = 0;            // set of materials of even land
  std::uint32_t walled = 0;                // set of materials with walls
  bool textured_sea = false;
};

// Fills land[i] = (1 - water) * gamma * texture * wall gain, and sea[i] = water * sigma0 * texture with sigma0 at
// `sin_grazing`.
void reflect(std::size_t count, const GroundInputs& ground, const float* sin_grazing, float* land, float* sea);

// Parts of the texture grid in a one-degree square. The square's south-west corner is `cells_north` and `cells_east`
// whole degrees from `ground.positions.corner` (arguments of texture_degree()).
struct TextureDegree {
  std::int32_t row = 0, column = 0;               // part at the square's south-west corner
  float row_offset = 0.0F, column_offset = 0.0F;  // [0, 1) fraction of that part outside the square
  float rows = 0.0F, columns = 0.0F;              // parts per degree
  std::int32_t cells_around = 1;                  // cells round the earth
  bool polar = false;                             // beyond kPolar_deg
};
TextureDegree texture_degree(const GroundInputs& ground, const TextureDrift& drift, float cells_north,
                             float cells_east);

// drifted_bits() of `count` samples from `first` on.
void polar_bits(const GroundInputs& ground, const TextureDrift& drift, std::size_t first, std::size_t count,
                std::int32_t* bits);

// True if any of the first `count` entries is above 0. No entry beyond them is read.
bool any_positive(std::size_t count, const float* values);

// Index of the first sample >= `from` with a material of the set `codes`; `count` if there is none.
std::size_t next_sample_with_material(std::size_t count, std::uint32_t codes, const std::int32_t* material,
                                      std::size_t from);

// Sigma0 of the table's entries at one azimuth: 2^(across + cosine * upwind). `cosine`: see GroundInputs::upwind.
// `sigma0` has capacity for the entries and one more vector.
void sigma0_at_azimuth(const SeaTable& table, float cosine, float* sigma0);

// Fills variate[i] = gamma variate of mean 1 and variance 1/looks of the cell of sample i < count. Up to 16 more
// entries are overwritten.
void speckle(std::size_t count, NoiseState state, int looks, SpeckleCells cells, float* variate);

struct VideoInputs {
  const float* before;  // power of three successive sweeps (PowerWindow), `count` entries each
  const float* centre;
  const float* after;
  const float* weights;  // weights of the three sweeps
  float noise;           // power added to the weighted sum
  const float* variate;  // speckle of each sample; null: no speckle; 16 more entries are read
  float gain_db;
  float dynamic_range_db;
  const float* time_control = nullptr;  // factor on `noise` by sample; null: 1
};

// Azimuth smear, noise, speckle and log receiver: video = 255 (1 + (10 log10 power + gain_db) / dynamic_range_db),
// clipped to [0, 255]. Exactly `count` entries of `video` are written.
void form_video(std::size_t count, const VideoInputs& inputs, std::uint8_t* video);

}  // namespace yars::model::physics::simd
