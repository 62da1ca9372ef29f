// Vector loops that draw scene triangles onto the polar grid.
// Standing surfaces are all surfaces that do not lie on the ground. Those of up to 12 columns, and walls of any width,
// are drawn many at a time, one triangle per lane. A wider surface, and each triangle on the ground, is drawn with one
// column per lane. The order in which standing surfaces are drawn has no effect: at each grid point the higher surface
// wins, and at equal height the surface with the greater gamma.
// Cardinal effect: stronger return of walls that face the radar (docs/spec/physics.md#land).
// Determinism: all targets (instruction sets) of the library Highway give equal bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/hrm/map_image.hpp"
#include "model/hrm/patch_geometry.hpp"
#include "model/hrm/scene_vertices_simd.hpp"

namespace yars::model::hrm::simd {

// Arrays indexed by PolarGrid::at().
struct SceneArrays {
  SurfacePoint* surface = nullptr;  // on entry: the ground
  WallPoint* walls = nullptr;       // on entry: zeros
  // Surface labels (map_image.hpp) of `surface`; on entry: those of the ground. Null: not drawn.
  std::uint32_t* label = nullptr;
};

// Surface kind and object by triangle of a tile. Gamma, cardinal effect and material by kind.
struct TileSurfaces {
  std::uint32_t label(std::size_t triangle) const { return surface_label(material[kind[triangle]], object[triangle]); }

  const std::uint16_t* kind = nullptr;
  const std::uint32_t* object = nullptr;   // index into SceneView::objects()
  const std::uint8_t* material = nullptr;  // code of DFAD
  const float* gamma = nullptr;
  const float* cardinal = nullptr;  // added return of a wall at right angles to the line of sight, relative to gamma
};

// Cardinal effect relative to its maximum, by the sine of the horizontal angle between a wall's normal and the line of
// sight. Entries are evenly spaced from sine 0, where the value is 1. The last two entries are 0.
struct CardinalShape {
  std::span<const float> effect;
  float steps_per_sine = 0.0F;
};

// Polar grid to draw on, the part of it to draw, and the cardinal effect.
struct Canvas {
  const PolarGrid* grid = nullptr;
  SceneArrays arrays;
  GridLimits limits;
  CardinalShape cardinal;
};

// Buffer of fragments: drawn grid points, not yet stored in SceneArrays. The caller reuses the buffer to keep its
// capacity.
struct Fragments {
  void grow() {
    at.resize(2 * at.size() + kMinCapacity);
    height.resize(at.size());
    gamma.resize(at.size());
    label.resize(at.size());
  }
  void grow_walls() {
    wall_at.resize(2 * wall_at.size() + kMinCapacity);
    wall_height.resize(wall_at.size());
    wall_return.resize(wall_at.size());
    wall_facing.resize(wall_at.size());
  }

  static constexpr std::size_t kMinCapacity = 4096;
  std::vector<std::uint32_t> at, wall_at;  // PolarGrid::at()
  std::vector<std::uint32_t> height;       // ordered_bits() of the height (small_triangles-inl.hpp)
  std::vector<float> gamma;                // negated gamma of the surface, as in SurfacePoint
  std::vector<std::uint32_t> label;        // of the surface, if SceneArrays::label is not null
  std::vector<std::uint32_t> wall_height, wall_return, wall_facing;  // in steps of kWallStep_m, as in WallPoint
};

// Sets SurfacePoint::gamma of the ground below the triangles. Where triangles overlap, the last one wins. Grid points
// with a negative gamma (standing surfaces) keep it.
void paint_ground(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                  const Canvas& canvas);

// Draws the surfaces and walls of standing triangles that select_triangles() has selected.
void draw_standing(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                   const Canvas& canvas, Fragments& fragments);

}  // namespace yars::model::hrm::simd
