// SIMD sampling of one cell: heights, water fraction and material codes at successive positions.
// Input: one grid or the culture of the cell; offsets north and east of the cell's south-west corner [deg], [0, 1].
// Output: elevation [m MSL], water fraction [0, 1], DFAD codes (culture.hpp). Offsets beyond [0, 1] are clamped.
// Arrays: `count` entries and kRunSlack spare entries.
// Accuracy: see TerrainView::surfaces(). Every vector width gives the same bits (Highway, target chosen at run time).
#pragma once

#include <cstddef>
#include <cstdint>

#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain::sampling {

// One grid of a cell: heights or peaks.
struct Grid {
  const PostBlocks* posts = nullptr;
  const Ceilings* ceilings = nullptr;
  const CodeBlocks* codes = nullptr;  // codes of the same posts; null: none, or those of another grid
  int rows = 0, columns = 0;
  bool voids = false;   // true if any post is kVoidPost
  bool sea = false;     // true if any post is exactly 0 m
  float unit_m = 1.0F;  // [m] height of post value 1
};

// Number of leading positions in the same cell as the first one. Cell counts: see PositionRun.
std::size_t same_cell_count(const float* cells_north, const float* cells_east, std::size_t count);

// Ground shortly before each position (NearGround) in the same grid.
struct Near {
  float rows = 0.0F, columns = 0.0F;  // [posts] from that ground to the position
  float* elevation_m = nullptr;       // [m MSL]; NaN: beyond the four posts, or void; null: not computed
};

// Outputs of heights(). Each may be null except elevation_m.
struct Heights {
  float* elevation_m = nullptr;      // [m MSL]
  float* water = nullptr;            // fraction of water [0, 1]
  std::int32_t* material = nullptr;  // codes, as codes(); requires Grid::codes
  Near near{};
};

// Bilinear elevation and water fraction. With `nearest`, the values of the nearest of the four posts around the
// position. Void posts are left out, and the weights of the others are scaled to a sum of 1. If the others have no
// weight, the elevation is NaN.
void heights(const Grid& grid, const float* north_deg, const float* east_deg, std::size_t count, bool nearest,
             const Heights& found);

// Byte of the culture post nearest to each position: a material code, if the culture has no shares of water. The spare
// entries of `material` are overwritten.
void codes(const Culture& culture, const float* north_deg, const float* east_deg, std::size_t count,
           std::int32_t* material);

// Replaces the bytes by their material codes, and `water` by the share where it is known (cover_of()). The spare
// entries of both are overwritten.
void unpack_covers(std::size_t count, std::int32_t* material, float* water);

}  // namespace yars::model::terrain::sampling
