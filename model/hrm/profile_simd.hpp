// Profiles of sixteen columns of the polar grid (rows: distance over ground, columns: azimuth): shadow, power and
// layover in one pass away from the aircraft.
// Inputs: heights, gammas, crests and walls by row and column. Outputs: power, as cross section [m^2], by apparent row:
// the row at which the map plane has the slant range of the scatterer (layover).
// With labels, also what each row shows: the strongest surface, and how many surfaces lie there.
// The profile of a column is a polyline through its heights, with one piece between two rows. The part of a piece above
// the lines of sight over all nearer pieces is visible.
// The power of a piece is gamma times its projected area: column width * angle subtended at the radar * slant range.
// So the sum over a column does not depend on the row spacing.
// Determinism: all targets (instruction sets) of the library Highway give equal bits.
// Source: docs/radar_maths.md, "Patch maps".
#pragma once

#include <cstddef>
#include <cstdint>

#include "model/hrm/patch_geometry.hpp"

namespace yars::model::hrm::simd {

// Two-way transmission [0, 1] of the atmosphere's gases to a point of one row: constant + slope * h + bend * h^2. h is
// the point's height [m] above the map plane, clamped to [lowest_m, highest_m].
struct GasRow {
  float constant, slope, bend;
  float lowest_m, highest_m;
};

// One strip (16 columns) of the polar grid: inputs and outputs of cast_profile().
struct Strip {
  int rows = 0;
  float first_distance_m = 0.0F;         // of row 0, over ground from the aircraft
  float spacing_m = 0.0F;                // between rows
  bool layover = true;                   // false: every scatterer appears at its own distance over ground
  float double_bounce = 0.0F;            // echo by way of wall and ground, relative to the wall's own return; 0: none
  const float* distance_m = nullptr;     // by row
  const float* inverse_m = nullptr;      // 1 / PatchGeometry::sight_distance_m(), by row
  const float* above_plane_m = nullptr;  // PatchGeometry::above_plane_m(), by row
  const float* above_level_m = nullptr;  // PatchGeometry::above_level_m(), by row
  const GasRow* gas = nullptr;           // by row; null: no attenuation
  const float* arc = nullptr;            // width of a column divided by distance [rad], by column
  const float* horizon = nullptr;        // greatest tangent of elevation angle of ground nearer than row 0, by column
  // The following arrays are indexed by row and column.
  const SurfacePoint* surface = nullptr;  // gamma is negated for a scene surface not on the ground
  // For a crest between the previous row and this one, the height [m] above the map plane at which the line of sight
  // over the crest passes this row. Null: no crests, because rows are close enough.
  const float* crest_m = nullptr;
  WallPoint* walls = nullptr;  // cast_profile() sets them to zero after use; null: no walls
  float* power = nullptr;      // cross section [m^2] by apparent row and column; cast_profile() adds to it

  // Labels by apparent row and column (map_image.hpp). Null: no labels. On entry: strength and layers are 0.
  float* strength = nullptr;          // greatest cross section [m^2] of one surface
  std::int32_t* shown_row = nullptr;  // row of the surface point with this cross section; undefined at strength 0
  std::int32_t* layers = nullptr;     // number of visible surfaces that appear at the middle of the row
};

// Adds the power of all visible pieces to strip.power, and sets the labels if the strip has them.
void cast_profile(const Strip& strip);

}  // namespace yars::model::hrm::simd
