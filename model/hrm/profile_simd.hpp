// One pass down range over a strip of sixteen columns: shadow, and every visible piece of the profile put where slant
// range has it, by vectors (Highway, chosen at run time; equal bits on every target).
// The profile of a column is a polyline through its heights. What of a piece rises above all before it is seen; its
// power is gamma times the area seen square on, which is the angle it fills times the distance: walls, roofs, slopes
// and level ground alike, and the power of a column is that of its whole visible angle, however coarse the rows.
#pragma once

#include <cstddef>
#include <cstdint>

#include "model/hrm/patch_geometry.hpp"

namespace yars::model::hrm::simd {

// What the gases of the air leave of the power from a row: a parabola in the height above the map plane, which holds
// between two of them [m].
struct GasRow {
  float constant, slope, bend;
  float lowest_m, highest_m;
};

struct Strip {
  int rows = 0;
  float first_distance_m = 0.0F;
  float spacing_m = 0.0F;
  bool layover = true;                // else everything returns from where it stands
  float double_bounce = 0.0F;         // of a wall's foot, against the wall; 0 = none
  const float* distance_m = nullptr;  // by row
  const float* inverse_m = nullptr;   // 1 / distance, by row
  const float* above_m = nullptr;     // aircraft above the map plane, by row
  const float* level_m = nullptr;     // aircraft above the horizontal there, by row
  const GasRow* gas = nullptr;        // by row; null: no gas takes anything
  const float* arc = nullptr;         // width of a column over its distance, sixteen
  const float* horizon = nullptr;     // before row 0, sixteen
  // By row and column.
  const SurfacePoint* surface = nullptr;  // the sign of the gain is of no account
  // The ground on the way from the row before, raised to where a line of sight over its top passes this row: height
  // above the map plane. Null: rows lie so close that there is none.
  const float* crest_m = nullptr;
  WallPoint* walls = nullptr;  // cleared for the next map; null: there are none
  float* power = nullptr;      // [m^2] cross section, by row and column as it appears; is added to
};

void cast_profile(const Strip& strip);

}  // namespace yars::model::hrm::simd
