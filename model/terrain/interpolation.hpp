// Interpolation inside one cell, in double, at one place: the truth that the fast look-up is held against. Coordinates
// are degrees from the cell's south-west corner, [0, 1], clamped. Voids among the posts are left out and the other
// weights scaled up; what the kernel of the cubic reaches beyond the cell's edge repeats the edge.
#pragma once

#include "model/terrain/cell.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::terrain {

// Bilinear between four posts; nearest: the nearest of them; cubic: Catmull-Rom over sixteen, bilinear where one of
// those is void. Water is the share of posts at 0 m by the bilinear (nearest) weights.
Surface interpolate(const Cell& cell, double north_deg, double east_deg,
                    radar::Interpolation interpolation = radar::Interpolation::bilinear);

}  // namespace yars::model::terrain
