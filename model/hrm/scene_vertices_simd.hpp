// Vector loops over vertices and triangles of a scene tile: transform to the polar grid, selection of visible
// triangles.
// Frame: tile east, north, up [m] to columns and rows of the grid, height above the map plane [m].
// Determinism: Highway targets chosen at run time give equal bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace yars::model::hrm::simd {

// Transform of one tile. Positions count from the centre of the map to keep float precise.
struct VertexMap {
  float right_m, up_m;  // of the tile's origin
  float right_east, right_north, up_east, up_north;
  float lift_m;                                // height of up = 0 above the map plane
  float toward_east, toward_north, toward_up;  // unit vector to the radar
  float centre_m;                              // over ground, aircraft to the centre
  float columns_per_tangent, middle_column;
  float rows_per_metre, middle_row;
};
// Vertices of a tile; normals begin with the first vertex that has one.
struct TileVertices {
  const float *east_m, *north_m, *up_m;
  const float *normal_east, *normal_north, *normal_up;
};
// Vertices on the grid: position, height above the map plane [m], and from vertex `bare` on the cosine between the
// normal and the direction to the radar. Vertices before `bare` belong to flat triangles and have no normals.
struct GridVertices {
  float *column, *row, *height_m, *facing;
  std::uint32_t bare;
};
void transform_vertices(std::size_t count, const TileVertices& tile, const VertexMap& map, const GridVertices& grid);

inline constexpr float kSurfaceReach = 0.5F;  // [rows] by which a surface extends beyond its edges

// Part of the grid to draw, and the size of its cells.
struct GridLimits {
  float first_column, last_column, first_row, last_row;
  float column_width_m, row_height_m;
  float sine, cosine;  // of the grazing angle
  float wall_normal2;  // walls: upper bound of (upward / level part of the normal)^2
};
// Vertex indices of the three corners, by triangle.
using Corners = std::array<const std::uint16_t*, 3>;

// Selected triangles of a tile: triangle numbers and corners. Reused by the caller, so that its capacity is kept.
struct FoundTriangles {
  static constexpr std::size_t kSlack = 16;  // entries that vectors may touch beyond the last

  void reserve(std::size_t triangles) {
    if (number.size() >= triangles + kSlack) return;
    number.resize(triangles + kSlack);
    for (std::vector<std::int32_t>& vertices : corner) vertices.resize(triangles + kSlack);
  }

  std::size_t count = 0;
  std::vector<std::uint32_t> number;
  std::array<std::vector<std::int32_t>, 3> corner;
};

// Selects, in ascending order, triangles of [begin, end) that cross a column within the limits. They face up, or are
// walls that face the radar.
void select_triangles(std::size_t begin, std::size_t end, const Corners& corners, const GridVertices& grid,
                      const GridLimits& limits, FoundTriangles& found);

}  // namespace yars::model::hrm::simd
