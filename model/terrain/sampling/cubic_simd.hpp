// SIMD cubic interpolation of one cell: Catmull-Rom through the sixteen posts around successive positions.
// Input: one grid of the cell; offsets north and east of the cell's south-west corner [deg], [0, 1].
// Output: elevation [m MSL], only where all sixteen posts have heights. Offsets beyond [0, 1] are clamped.
// Arrays: `count` entries and kRunSlack spare entries.
// Accuracy: see TerrainView::surfaces(). Every vector width gives the same bits (Highway, target chosen at run time).
#pragma once

#include <cstddef>

#include "model/terrain/sampling/height_simd.hpp"

namespace yars::model::terrain::sampling {

// Replaces `elevation_m`, the result of heights() at the same positions.
void cubic_heights(const Grid& grid, const float* north_deg, const float* east_deg, std::size_t count,
                   float* elevation_m);

}  // namespace yars::model::terrain::sampling
