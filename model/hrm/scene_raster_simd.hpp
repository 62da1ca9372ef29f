// Triangles of a scene drawn onto a fan, by vectors (Highway, chosen at run time; equal bits on every target): small
// ones many at a time, a lane each; those that cross many columns one by one, a lane a column. What stands is drawn in
// any order with one result: of two surfaces the higher wins, of equal ones the stronger, and never the ground.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/hrm/patch_geometry.hpp"
#include "model/hrm/scene_vertices_simd.hpp"

namespace yars::model::hrm::simd {

// By PolarGrid::at().
struct SceneArrays {
  SurfacePoint* surface = nullptr;  // in: the ground
  WallPoint* walls = nullptr;       // in: none
};

// A tile's triangles and what they are made of, by kind.
struct TileSurfaces {
  const std::uint16_t* kind = nullptr;
  const float* gamma = nullptr;
  const float* cardinal = nullptr;  // how much more a wall returns square on
};

// The cardinal effect over the sine of the angle between a wall's normal and the line of sight: from 0 in even steps,
// 0 behind the last; an entry more than steps.
struct CardinalShape {
  std::span<const float> share;
  float steps_a_sine = 0.0F;
};

struct Canvas {
  const PolarGrid* grid = nullptr;
  SceneArrays arrays;
  GridLimits limits;
  CardinalShape cardinal;
};

// Grid points that something reaches. Kept by who draws, so that there is room.
struct Fragments {
  void grow() {
    at.resize(2 * at.size() + kLeast);
    height.resize(at.size());
    gain.resize(at.size());
  }
  void grow_walls() {
    wall_at.resize(2 * wall_at.size() + kLeast);
    wall_height.resize(wall_at.size());
    wall_return.resize(wall_at.size());
  }

  static constexpr std::size_t kLeast = 4096;
  std::vector<std::uint32_t> at, wall_at;
  std::vector<std::uint32_t> height;  // as scene_raster_simd.cpp compares them
  std::vector<float> gain;
  std::vector<std::uint32_t> wall_height, wall_return;
};

// Gives the ground between the corners their gamma, in the order of the numbers.
void paint_ground(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                  const Canvas& canvas);

// Draws what stands, as select_triangles() found it.
void draw_standing(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                   const Canvas& canvas, Fragments& fragments);

}  // namespace yars::model::hrm::simd
