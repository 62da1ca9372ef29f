// Fast sampling of one cell: heights, water and material codes over a run of positions.
#pragma once

#include <cstddef>
#include <cstdint>

#include "model/terrain/formats/cell.hpp"
#include "model/terrain/formats/culture.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::terrain::look_up {

// The fast look-up in one cell: bilinear elevation and water over a run of places, by vectors of whatever width the
// machine has (Highway, chosen at run time); every width gives the same bits. The posts of the places ahead are
// fetched while those at hand are joined.

// One grid of a cell.
struct Grid {
  const PostBlocks* posts = nullptr;
  int rows = 0, columns = 0;
  bool voids = false;   // whether any post is kVoidPost
  bool sea = false;     // whether any post is exactly 0 m
  float unit_m = 1.0F;  // [m] of a post
};

// How many of the places from the first on lie in the cell of the first: both numbers are equal.
std::size_t places_alike(const float* cells_north, const float* cells_east, std::size_t count);

// Fills `count` entries; arrays have kRunSlack more. `water` may be null. A void post is left out and the other weights
// are scaled; four voids give NaN. Places [deg] from the cell's corner, [0, 1]; beyond counts as on the edge.
// `nearest`: of the four posts the nearest alone.
void heights(const Grid& grid, const float* north_deg, const float* east_deg, std::size_t count, bool nearest,
             float* elevation_m, float* water);

// The fast look-up in one culture: material codes over a run of places, by vectors (Highway, chosen at run time; the
// same codes on every target).

// Code of the culture's post nearest to each place, as whole numbers; places [deg] from the cell's corner, [0, 1];
// beyond counts as on the edge. Arrays have kRunSlack more; those of `material` are overwritten.
void codes(const Culture& culture, const float* north_deg, const float* east_deg, std::size_t count,
           std::int32_t* material);

}  // namespace yars::model::terrain::look_up
