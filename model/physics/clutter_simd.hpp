// Loops over the samples of a sweep: ground reflectivity with texture, speckle, video.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/radar/world.hpp"
#include "model/physics/clutter.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::physics::simd {

// What the ground of a sweep reflects, for vectors (Highway, chosen at run time; equal bits on every target): the fast
// path of ground_return.hpp. clutter_simd-inl.hpp joins it, a vector of samples at a time. Arrays have
// terrain::kRunSlack entries more than samples; in the pass from terrain to power kPairSlack (ray.hpp).

// By material code.
struct MaterialTables {
  std::array<float, radar::kMaterials> gamma{};
  // Gamma at each level of texture, one material after the other; the same at all where there is none. Water has the
  // sea's levels alone.
  std::array<float, radar::kMaterials * kTextureLevels> texture{};
};

// The ground of one sweep. Sets of materials have a bit a code.
struct GroundInputs {
  const MaterialTables* tables = nullptr;
  terrain::PlaceRun places;
  const float* water = nullptr;            // [0, 1]
  const std::int32_t* material = nullptr;  // codes; null: none anywhere. Water is all water.
  const float* wall_gain = nullptr;        // factor on the gamma of samples of a material with walls; else not read
  const SeaTable* sea = nullptr;           // may be null where neither water nor material is
  float upwind = 0.0F;                     // cosine of the angle between the look and the wind
  float* sigma0 = nullptr;                 // room for fill_sigma0(), which a look that meets water fills
  const GroundGrid* grid = nullptr;
  std::uint32_t textured = 0;  // land
  std::uint32_t walled = 0;
  bool textured_sea = false;
};

// land[i] = (1 - water) * gamma, sea[i] = water * sigma0 under these sines of the grazing angle.
void reflect(std::size_t count, const GroundInputs& ground, const float* sin_grazing, float* land, float* sea);

// The texture's grid within one degree: cells counted from its corner, and the first one's number.
struct TextureDegree {
  std::int32_t row = 0, column = 0;
  float row_share = 0.0F, column_share = 0.0F;  // [0, 1) of the first cell that lies before the corner
  float rows = 0.0F, columns = 0.0F;            // a degree
};
TextureDegree texture_degree(const GroundInputs& ground, float cells_north, float cells_east);

// True if any of the first `count` entries is above 0; no array has to have more.
bool any_positive(std::size_t count, const float* values);

// The first sample from `from` on whose material is one of those in the bits of `codes`; `count` if none is.
std::size_t next_in(std::size_t count, std::uint32_t codes, const std::int32_t* material, std::size_t from);

// Sigma0 of the table's entries for a look: 2^(across + cosine * upwind). `sigma0` has room for as many and a vector
// more.
void fill_sigma0(const SeaTable& table, float cosine, float* sigma0);

// The loops of the standard algorithm from power to video, by vectors (Highway, chosen at run time; equal bits on every
// target).

// variate[cell] = gamma-distributed variate of mean 1 and `looks` looks, for resolution cells 0..cells-1; 16 entries
// more are overwritten.
void speckle(std::size_t cells, NoiseState state, int looks, float* variate);

struct VideoInputs {
  const float* before;  // power of three sweeps, `count` entries each
  const float* centre;
  const float* after;
  const float* weights;      // of the three
  float noise;               // added to their sum
  const float* variate;      // of each resolution cell; null: no speckle; 16 entries more are read
  const std::int32_t* cell;  // of each sample, neighbours in the same or the next; null: each its own; 16 more are read
  float gain_db;
  float dynamic_range_db;
};

// Joined sweeps and noise, speckle, log receiver: video = 255 (1 + (10 log10 power + gain_db) / dynamic_range_db),
// clipped. `video` has exactly `count` entries.
void form_video(std::size_t count, const VideoInputs& inputs, std::uint8_t* video);

}  // namespace yars::model::physics::simd
