// Bilinear interpolation inside one cell. Coordinates are degrees from the cell's south-west corner, [0, 1],
// clamped; voids among the four posts are left out and the other weights scaled up.
#pragma once

#include <span>

#include "model/terrain/cell.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model::terrain {

// In double, at one place: the truth.
Surface interpolate(const Cell& cell, double north_deg, double east_deg);

// In float for a run of places in one cell: coordinates absolute [deg], `shift_deg` is added to each longitude.
// Within 0.05 m + 1e-6 of the cell's relief of interpolate(); equal to it, rounded, in cells that have voids.
void interpolate_run(const Cell& cell, double shift_deg, std::span<const double> latitude_deg,
                     std::span<const double> longitude_deg, std::span<float> elevation_m, std::span<float> water);

}  // namespace yars::model::terrain
