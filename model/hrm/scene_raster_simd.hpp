// Vector loops that draw scene triangles onto the polar grid.
// Triangles of up to 12 columns are drawn many at a time, one a lane. Wider ones are drawn singly, one column a lane.
// Order: standing surfaces give the same result in any order. The higher surface wins, then the one with the greater
// gain.
// Determinism: Highway targets chosen at run time give equal bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/hrm/patch_geometry.hpp"
#include "model/hrm/scene_vertices_simd.hpp"

namespace yars::model::hrm::simd {

// Indexed by PolarGrid::at().
struct SceneArrays {
  SurfacePoint* surface = nullptr;  // on entry: the ground
  WallPoint* walls = nullptr;       // on entry: zeros
};

// Surface kind of each triangle of a tile; gamma and cardinal effect of each kind.
struct TileSurfaces {
  const std::uint16_t* kind = nullptr;
  const float* gamma = nullptr;
  const float* cardinal = nullptr;  // additional return of a wall seen square on, relative to its gamma
};

// Cardinal effect by the sine of the angle between a wall's normal and the line of sight. Entries are evenly spaced
// from sine 0; the last two are 0.
struct CardinalShape {
  std::span<const float> share;
  float steps_per_sine = 0.0F;
};

struct Canvas {
  const PolarGrid* grid = nullptr;
  SceneArrays arrays;
  GridLimits limits;
  CardinalShape cardinal;
};

// Grid points reached by triangles and not yet stored. Reused by the caller, so that its capacity is kept.
struct Fragments {
  void grow() {
    at.resize(2 * at.size() + kMinCapacity);
    height.resize(at.size());
    gain.resize(at.size());
  }
  void grow_walls() {
    wall_at.resize(2 * wall_at.size() + kMinCapacity);
    wall_height.resize(wall_at.size());
    wall_return.resize(wall_at.size());
  }

  static constexpr std::size_t kMinCapacity = 4096;
  std::vector<std::uint32_t> at, wall_at;
  std::vector<std::uint32_t> height;  // ordered_bits() of the height
  std::vector<float> gain;
  std::vector<std::uint32_t> wall_height, wall_return;
};

// Sets the gain of the ground below the triangles, in ascending order of triangles.
void paint_ground(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                  const Canvas& canvas);

// Draws standing triangles that select_triangles() has selected.
void draw_standing(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                   const Canvas& canvas, Fragments& fragments);

}  // namespace yars::model::hrm::simd
