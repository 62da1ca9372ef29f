// Profile of sixteen columns of the polar grid: one pass down range for shadow, power and layover.
// Inputs: a Strip: heights, gammas, crests and walls by row and column. Outputs: cross section [m^2] by apparent row.
// The profile of a column is a polyline through its heights. The part of a piece above all nearer pieces is visible.
// Power of a piece: gamma times its area seen square on, namely column width * angle * slant range.
// So the power of a column is that of its visible angle, for any row spacing.
// Determinism: Highway targets chosen at run time give equal bits.
// Source: docs/radar_maths.md, "Patch maps".
#pragma once

#include <cstddef>
#include <cstdint>

#include "model/hrm/patch_geometry.hpp"

namespace yars::model::hrm::simd {

// Two-way gas transmission of a row: constant + slope h + bend h^2, h the height above the map plane [m]. Heights are
// clamped to [lowest_m, highest_m].
struct GasRow {
  float constant, slope, bend;
  float lowest_m, highest_m;
};

struct Strip {
  int rows = 0;
  float first_distance_m = 0.0F;
  float spacing_m = 0.0F;
  bool layover = true;                   // false: every scatterer returns at its own distance over ground
  float double_bounce = 0.0F;            // return of a wall's foot relative to the wall's; 0: none
  const float* distance_m = nullptr;     // by row
  const float* inverse_m = nullptr;      // 1 / distance, by row
  const float* above_plane_m = nullptr;  // aircraft above the map plane, by row
  const float* above_level_m = nullptr;  // aircraft above the horizontal at the row, by row
  const GasRow* gas = nullptr;           // by row; null: no attenuation
  const float* arc = nullptr;            // width of a column over its distance, sixteen
  const float* horizon = nullptr;        // greatest tangent before row 0, sixteen
  // The following arrays are indexed by row and column.
  const SurfacePoint* surface = nullptr;  // the sign of the gain is ignored
  // Crest between the previous row and this one: the height above the map plane at which the line of sight over it
  // passes this row. Null: rows are so close that there are no crests.
  const float* crest_m = nullptr;
  WallPoint* walls = nullptr;  // set to zero after use; null: no walls
  float* power = nullptr;      // cross section [m^2] by apparent row and by column; results are added
};

void cast_profile(const Strip& strip);

}  // namespace yars::model::hrm::simd
