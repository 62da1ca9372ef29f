// A cell on another grid of the same degree: box means as long as the old intervals are a multiple of the new ones
// (as reduce_by), bilinear else. Both keep edges equal for neighbours whose edges are equal. Sea and voids as in
// reduce.hpp, and the unit stays: at exactly 0 m only where more than half is sea; void only where all posts taken are.
#pragma once

#include "model/terrain/cell.hpp"

namespace yars::model::terrain {

// Requires rows, columns >= 2.
Cell resample(const Cell& cell, int rows, int columns);

}  // namespace yars::model::terrain
