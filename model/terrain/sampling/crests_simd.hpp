// Crests of a ray: for each step from one position to the next, the maximum tangent of the ground's elevation angle,
//   seen by the observer at the ray's start. A crest decides which ground farther along the ray lies in shadow.
// Candidates: each point where a step crosses a row or column of posts, with the height interpolated between two posts.
//   Another candidate lies a tenth of the post spacing before the step's end. It limits the error where bilinear ground
//   bulges between the rows and columns.
// Input: positions of a ray, one grid of a cell. Output: tangents, one per step.
// Accuracy: every vector width gives the same bits (Highway, target chosen at run time).
// Source: docs/decisions/0019-shadow-by-lines-of-posts.md.
#pragma once

#include <cstddef>

#include "model/terrain/sampling/height_simd.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain::crests {

// Positions of a ray (see PositionRun and RaySight). Arrays have kRunSlack spare entries.
struct Ray {
  const float* cells_north = nullptr;
  const float* cells_east = nullptr;
  const float* north_deg = nullptr;
  const float* east_deg = nullptr;
  const float* distance_m = nullptr;
  float curvature = 0.0F;  // [1/m] of the sphere
  SightSeries series{};    // sight_series()
  // A lower bound of the fall of the ground at the height h within the distance d is its squared distance times
  // least_fall - lift_per_height h - lift_per_square d d.
  float least_fall = 0.0F, lift_per_height = 0.0F, lift_per_square = 0.0F;
  // Tangents that ground must reach to be of interest, one per position, ascending; null: all ground is.
  const float* floor = nullptr;
  // [m] Distance between neighbouring positions if it is the same everywhere and `floor` is given, else 0.
  float even_step_m = 0.0F;
};

// A cell on the ray's path.
struct CrossedCell {
  sampling::Grid grid;
  float cells_north = 0.0F, cells_east = 0.0F;  // whole cells from the ray's reference corner to this cell
  float spacing_m = 0.0F;  // [m] the smaller of row and column spacing, but at least 1/3 of the row spacing
  // True if columns are closer than a third of the row spacing, as toward a pole. Columns are then skipped as long as
  // the examined ones are at most 0.3 spacing_m apart along the ray. Longitudes are then compared modulo 360 degrees,
  // because those of a ray past a pole may be 360 degrees too large or too small.
  bool close_columns = false;
};

// For each i in [first, end): raises tangent[i] to the maximum tangent between positions i - 1 and i if that is higher
// and reaches floor[i]. Lower tangents may or may not be stored. Examines only the part of the step inside the cell.
// Requires first >= 1, and that steps are straight in latitude and longitude; with even_step_m, within 5 km.
void raise(const CrossedCell& cell, const Ray& ray, std::size_t first, std::size_t end, float* tangent);

}  // namespace yars::model::terrain::crests
