// Loops of the ground on the polar grid: made-up texture and strips of columns.
#pragma once

#include <cstddef>
#include <cstdint>

#include "model/hrm/patch_geometry.hpp"

namespace yars::model::hrm::simd {

// The look-up of the made-up detail, by vectors (Highway, chosen at run time; equal bits on every target).

// Texels lie in square blocks, row by row within them and among each other: a line of the cache is a block, so that a
// walk in any direction meets few.
inline constexpr int kDetailBlock = 4;

// A periodic table of edge * edge words, edge a power of two and a block at least: bytes of the texels (x, y), (x + 1,
// y), (x, y + 1) and (x + 1, y + 1), the lowest first. `unit2`: the square of what a byte counts by.
struct DetailTable {
  const std::uint32_t* texels = nullptr;
  int edge = 0;
  float unit2 = 1.0F;
};

// gain[i] *= table(east, north) * table(both turned and stretched), bilinear; east = east_deg[i] * east_scale and so
// on, in texels. Vectors read and write up to 15 entries behind the last.
void modulate(std::size_t count, const DetailTable& table, const float* east_deg, const float* north_deg,
              float east_scale, float north_scale, float* gain);

// Sixteen columns of numbers, one after the other: what lies between some of them, and all put side by side, by vectors
// (Highway, chosen at run time, equal bits on every target).

// Every `step`th column is given, the first and the last among them; the others become what lies between their
// neighbours on a straight line. `count` rows; up to 15 more of each column are overwritten.
void fill_between(std::size_t count, std::size_t step, float* columns, std::size_t pitch);

// points[16 * row + column] = {gain[column * pitch + row], height_m[column * pitch + row]} for `count` rows.
void put_side_by_side(std::size_t count, const float* gain, const float* height_m, std::size_t pitch,
                      SurfacePoint* points);

}  // namespace yars::model::hrm::simd
