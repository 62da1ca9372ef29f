// What the ground of a sweep reflects, by vectors (Highway, chosen at run time; equal bits on every target): the fast
// path of surface_return.hpp. Only vectors with land of a material, or with water, are worked on. Arrays have
// terrain::kRunSlack entries more than `count`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lib/radar/world.hpp"
#include "model/reflectivity/ground_grid.hpp"
#include "model/reflectivity/sea_table.hpp"
#include "model/reflectivity/texture.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::rbm::lanes {

// By material code.
struct MaterialTables {
  std::array<float, radar::kMaterials> gamma{};
  // Texture levels, one material after the other; a material without texture has ones.
  std::array<float, radar::kMaterials * reflectivity::kTextureLevels> texture{};
};

// True if any of the first `count` entries is above 0; no array has to have more.
bool any_positive(std::size_t count, const float* values);

// Codes of kMaterials and above count as 0; where the material is water so becomes `water`. True if any code is not 0.
bool settle_materials(std::size_t count, std::int32_t* material, float* water);

// The first sample from `from` on whose material is one of those in the bits of `codes`; `count` if none is.
std::size_t next_in(std::size_t count, std::uint32_t codes, const std::int32_t* material, std::size_t from);

// Sigma0 of the table's entries for a look: 2^(across + cosine * upwind). `sigma0` has room for as many and a vector
// more.
void fill_sigma0(const reflectivity::SeaTable& table, float cosine, float* sigma0);

// Texture level [0, 255] of the ground cell that holds each place, as whole numbers; 0 where `wanted` is not above 0 in
// the whole vector.
void texture_levels(std::size_t count, const reflectivity::GroundGrid& grid, const terrain::PlaceRun& places,
                    const float* wanted, std::int32_t* level);

// sea[i] = water * sigma0(sin_grazing) * texture; `level` null: no texture.
void sea_return(std::size_t count, const float* sigma0, const float* water, const float* sin_grazing,
                const float* texture, const std::int32_t* level, float* sea);

// gamma[i] = (1 - water) * gamma of the material * texture; `material` as whole numbers below kMaterials.
void land_return(std::size_t count, const MaterialTables& tables, const std::int32_t* material, const float* water,
                 const std::int32_t* level, float* gamma);

}  // namespace yars::model::rbm::lanes
