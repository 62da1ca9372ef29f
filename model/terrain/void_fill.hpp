// Puts smooth heights where a grid has voids, so that a wavelet does not spend bits on cliffs: each void gets the
// mean of what lies around it, taken from ever coarser grids until there is something. Other posts stay as they
// are. A grid of voids alone becomes 0.
#pragma once

#include "model/terrain/jpeg2000.hpp"

namespace yars::model::terrain {

void fill_voids(HeightGrid& grid);

}  // namespace yars::model::terrain
