// The loops of the scene's raster over vertices and triangles, by vectors (Highway, chosen at run time; equal bits on
// every target).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace yars::model::hrm::simd {

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
// Of a tile, by vertex; the normals by vertex from the first that has one.
struct TileVertices {
  const float *east_m, *north_m, *up_m;
  const float *normal_east, *normal_north, *normal_up;
};
// On the grid, by vertex: place, height above the map plane; and of the vertices from `bare` on, how squarely the
// surface faces the radar there (the others' triangles are flat, so nobody asks).
struct GridVertices {
  float *column, *row, *height_m, *facing;
  std::uint32_t bare;
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
// The vertices that a triangle's three corners are, by triangle.
using Corners = std::array<const std::uint16_t*, 3>;

// Triangles out of a tile: their numbers there, and their corners. Kept by who looks, so that there is room.
struct FoundTriangles {
  static constexpr std::size_t kSlack = 16;  // entries that vectors may touch behind the last

  void make_room(std::size_t triangles) {
    if (number.size() >= triangles + kSlack) return;
    number.resize(triangles + kSlack);
    for (std::vector<std::int32_t>& vertices : corner) vertices.resize(triangles + kSlack);
  }

  std::size_t count = 0;
  std::vector<std::uint32_t> number;
  std::array<std::vector<std::int32_t>, 3> corner;
};

// Those of the triangles [begin, end) that cross a column within the limits and face up, or are walls and face the
// radar; ascending.
void select_triangles(std::size_t begin, std::size_t end, const Corners& corners, const GridVertices& grid,
                      const GridLimits& limits, FoundTriangles& found);

}  // namespace yars::model::hrm::simd
