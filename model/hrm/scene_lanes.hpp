// The loops of the scene's raster over vertices and triangles, by vectors (Highway, chosen at run time; equal bits on
// every target).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace yars::model::hrm::lanes {

// From a tile's east, north and up to the grid: counted from the centre of the map, so that float is precise.
struct VertexMap {
  float right_m, up_m;  // of the tile's origin
  float right_east, right_north, up_east, up_north;
  float lift_m;                                // up = 0 above the map plane
  float toward_east, toward_north, toward_up;  // unit vector to the radar
  float centre_m;                              // over ground, aircraft to the centre
  float columns_a_tangent, middle_column;
  float rows_a_metre, middle_row;
};
// Of a tile, by vertex.
struct TileVertices {
  const float *east_m, *north_m, *up_m;
  const float *normal_east, *normal_north, *normal_up;
};
// On the grid, by vertex: place, height above the map plane, and how squarely the surface faces the radar (null: all
// normals are those of the triangles, so nobody asks).
struct GridVertices {
  float *column, *row, *height_m, *facing;
};
void place_vertices(std::size_t count, const TileVertices& tile, const VertexMap& map, const GridVertices& grid);

inline constexpr float kSurfaceReach = 0.5F;  // [rows] of a surface beyond its edges

// What of the grid is drawn, and the size of its cells.
struct GridLimits {
  float first_column, last_column, first_row, last_row;
  float column_width_m, row_height_m;
  float sine, cosine;  // of the grazing angle
  float wall_normal2;  // square of the upward part of a wall's normal against the level part, at most
};
// Numbers of the triangles [begin, end) that cross a column within the limits and face up, or are walls and face the
// radar; ascending. `found` has room for all and fifteen more. Returns how many.
std::size_t select_triangles(std::size_t begin, std::size_t end, const std::array<std::uint32_t, 3>* corners,
                             const GridVertices& grid, const GridLimits& limits, std::uint32_t* found);

}  // namespace yars::model::hrm::lanes
