// The look-up of the made-up detail, by vectors (Highway, chosen at run time; equal bits on every target).
#pragma once

#include <cstddef>
#include <cstdint>

namespace yars::model::hrm::lanes {

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

}  // namespace yars::model::hrm::lanes
