// Vector loops over a scene tile: transform of vertices to the polar grid, selection of triangles to draw.
// Frame: tile east, north, up [m] to columns and rows of the grid, height above the map plane [m].
// Determinism: all targets (instruction sets) of the library Highway give equal bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace yars::model::hrm::simd {

// Transform of one tile. Positions are relative to the centre of the map, because float is more precise for small
// numbers. `right` and `up` are directions in the map picture (MapPoint). In TileVertices and toward_up, up is
// vertical.
struct VertexMap {
  float right_m, up_m;                               // tile's origin, from the centre of the map
  float right_east, right_north, up_east, up_north;  // right and up per metre east, north
  float lift_m;                                      // height of the tile's vertical zero above the map plane
  float toward_east, toward_north, toward_up;        // unit vector from the tile to the radar
  float centre_m;                                    // distance over ground from the aircraft to the centre
  float columns_per_tangent, middle_column;          // columns per unit of tangent; column of the map's centre
  float rows_per_metre, middle_row;                  // middle_row: row at the centre's distance
};
// Vertices of a tile. Element 0 of the normals belongs to the first vertex that has a normal.
struct TileVertices {
  const float *east_m, *north_m, *up_m;
  const float *normal_east, *normal_north, *normal_up;
};
// Vertices on the grid: column, row, height above the map plane [m]. The first `first_with_normal` vertices have no
// normals, because their triangles belong to flat, not curved, surfaces. `facing`: cosine between the normal and the
// direction to the radar; element 0 is vertex `first_with_normal`.
struct GridVertices {
  float *column, *row, *height_m, *facing;
  std::uint32_t first_with_normal;
};
void transform_vertices(std::size_t count, const TileVertices& tile, const VertexMap& map, const GridVertices& grid);

inline constexpr float kSurfaceReach = 0.5F;  // [rows] extension of a drawn surface beyond its edges

// Part of the grid to draw, and the distances between grid points at the tile.
struct GridLimits {
  float first_column, last_column, first_row, last_row;
  float column_width_m, row_spacing_m;
  float sine, cosine;  // sine and cosine of the grazing angle at the tile
  float wall_normal2;  // walls have (vertical / horizontal part of the normal)^2 below this
};
// Vertex indices of the three corners, by triangle.
using Corners = std::array<const std::uint16_t*, 3>;

// Selected triangles of a tile: index in the tile (`number`), and vertex indices of the corners. The caller reuses the
// struct to keep its capacity.
struct FoundTriangles {
  static constexpr std::size_t kSlack = 16;  // entries beyond the last that SIMD code may access

  void reserve(std::size_t triangles) {
    if (number.size() >= triangles + kSlack) return;
    number.resize(triangles + kSlack);
    for (std::vector<std::int32_t>& vertices : corner) vertices.resize(triangles + kSlack);
  }

  std::size_t count = 0;
  std::vector<std::uint32_t> number;
  std::array<std::vector<std::int32_t>, 3> corner;
};

// Selects triangles of [begin, end), in ascending order. A selected triangle extends over the centre of at least one
// column and overlaps the part of the grid in `limits`. It faces up, or it is a wall that faces the radar.
void select_triangles(std::size_t begin, std::size_t end, const Corners& corners, const GridVertices& grid,
                      const GridLimits& limits, FoundTriangles& found);

}  // namespace yars::model::hrm::simd
