// Vector loops for ground on the polar grid: texture sampling, interpolation between columns, interleaving of columns.
// Determinism: all targets (instruction sets) of the library Highway give equal bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "model/hrm/patch_geometry.hpp"

namespace yars::model::hrm::simd {

// Side of a square block of words of DetailTable. Blocks are stored row by row, and so are the words of a
// block. One block is one cache line, so samples along a straight path in any direction read few cache lines.
inline constexpr int kDetailBlock = 4;

// Periodic field of edge * edge words, the fourth root of a texture; `edge` is a power of two and at least
// kDetailBlock. The bytes of word (x, y) are the texels (elements of the field) (x, y), (x + 1, y), (x, y + 1), (x + 1,
// y + 1), lowest byte first; x is east, y is north. A byte b has the value mean + low + step * b.
struct DetailTable {
  const std::uint32_t* texels = nullptr;
  int edge = 0;
  float mean = 0.0F, low = 0.0F, step = 0.0F;
  float tiles_per_texel = 0.0F;  // 1 / spacing of the tiles
};

// gamma[i] *= field(east, north)^4. Here east = east_deg[i] * east_scale and north = north_deg[i] * north_scale, in
// texels. The field is a bilinear sample of the table. Each tile has its own random offset into the table, so that the
// field has no period. Near the borders of tiles the deviation from the mean is the weighted sum of those of two or
// three tiles. The squares of the weights add up to 1, so that the variance is even. `seed` selects the offsets. Reads
// and writes up to 15 entries beyond `count`.
// Source: Heitz and Neyret 2018, "High-Performance By-Example Noise using a Histogram-Preserving Blending Operator".
void modulate(std::size_t count, const DetailTable& table, std::uint32_t seed, const float* east_deg,
              const float* north_deg, float east_scale, float north_scale, float* gamma);

// Fills sixteen columns by linear interpolation between every `step`th column. The first and the last column are
// inputs, so `step` divides 15. Columns begin `pitch` entries apart and have `count` rows. Up to 15 further entries of
// each column are overwritten.
void interpolate_columns(std::size_t count, std::size_t step, float* columns, std::size_t pitch);

// points[16 * row + column] = {gamma[column * pitch + row], height_m[column * pitch + row]} for `count` rows.
void interleave_columns(std::size_t count, const float* gamma, const float* height_m, std::size_t pitch,
                        SurfacePoint* points);

}  // namespace yars::model::hrm::simd
