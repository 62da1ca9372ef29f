// The look-up of the made-up detail, by vectors (Highway, chosen at run time; equal bits on every target).
#pragma once

#include <cstddef>

namespace yars::model::hrm::lanes {

// A periodic table of edge * edge texels, edge a power of two.
struct DetailTable {
  const float* texels = nullptr;
  int edge = 0;
};

// gain[i] *= table(east, north) * table(both turned and stretched), bilinear; east = east_deg[i] * east_scale and so
// on, in texels. Vectors read and write up to 15 entries behind the last.
void modulate(std::size_t count, const DetailTable& table, const float* east_deg, const float* north_deg,
              float east_scale, float north_scale, float* gain);

}  // namespace yars::model::hrm::lanes
