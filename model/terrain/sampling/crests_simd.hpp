// The highest ground between neighbouring places of a ray, as it stands against an eye at the ray's beginning: every
// line of posts that the way crosses counts, with the height between its two posts; so does the ground a tenth of the
// spacing before each place, which tells a slope that falls away. By vectors of whatever width the machine has
// (Highway, chosen at run time); every width gives the same bits.
#pragma once

#include <cstddef>

#include "model/terrain/sampling/height_simd.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain::crests {

// A ray as the kernel reads it: arrays have kRunSlack entries more.
struct Ray {
  const float* cells_north = nullptr;
  const float* cells_east = nullptr;
  const float* north_deg = nullptr;
  const float* east_deg = nullptr;
  const float* distance_m = nullptr;
  float altitude_m = 0.0F;
  float curvature = 0.0F;  // [1/m]
};

// The cell whose posts are crossed, in the ray's count.
struct CrossedCell {
  look_up::Grid grid;
  float cells_north = 0.0F, cells_east = 0.0F;
  float spacing_m = 0.0F;  // of its posts, as a walk takes it (PostSpacing)
  // Whether columns stand closer than that, as towards a pole. Then as many are left out as stand closer than 0.3 of
  // it, and longitudes count without whole turns, which a ray past a pole may differ by.
  bool close_columns = false;
};

// For each i in [first, end), first >= 1: raises tangent[i] to the greatest one between the places i - 1 and i, as far
// as that way lies in the cell. The way counts as straight in latitude and longitude.
void raise(const CrossedCell& cell, const Ray& ray, std::size_t first, std::size_t end, float* tangent);

}  // namespace yars::model::terrain::crests
