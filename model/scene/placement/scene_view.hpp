// A polygonal scene as the radar reads it: triangles on the earth in square tiles, immutable, in memory. Made by a
// store from OpenFlight files (readers open them, a generator writes them); the terrain stands apart.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/placement/scatterers.hpp"

namespace yars::model::scene {

// Metres east and north of the tile's origin (azimuthal equidistant), up from the tile's zero.
struct Bounds {
  float east_least_m = 0, east_most_m = 0, north_least_m = 0, north_most_m = 0, up_least_m = 0, up_most_m = 0;
};

// Triangles whose middles lie in one square of the earth; large ones reach beyond it, the bounds hold them whole. A
// square of very many is several tiles. Arrays of structures are split, so that a row of vertices is one load; what a
// map reads of a tile is kept small, for it waits for memory.
struct Tile {
  static constexpr std::size_t kMaxVertices = 65536;

  std::size_t triangles() const { return kind.size(); }
  std::array<std::uint16_t, 3> corners(std::size_t t) const { return {corner[0][t], corner[1][t], corner[2][t]}; }

  geo::GeoPoint origin;
  double zero_msl_m = 0.0;  // altitude of up = 0
  Bounds bounds;
  std::vector<float> east_m, north_m, up_m;  // a vertex each
  std::uint32_t bare = 0;  // so many vertices, the first ones, have no normals: each triangle's own is theirs
  std::vector<float> normal_east, normal_north, normal_up;  // of the others, from `bare` on: unit, outwards
  // A triangle each: vertices, counter-clockwise from outside; all three bare or none.
  std::array<std::vector<std::uint16_t>, 3> corner;
  std::uint32_t on_ground = 0;  // so many triangles, the first ones, lie on the ground: paint, no height of their own
  std::vector<std::uint16_t> kind;    // a triangle each: into SceneView::kinds()
  std::vector<std::uint32_t> object;  // a triangle each: into SceneView::objects()
};

// A thing that stands by itself (an OpenFlight object): what it is to a radar that does not resolve it.
struct SceneObject {
  std::string name;
  geo::GeoPoint middle;
  double base_msl_m = 0.0;  // the ground that it stands on
  double height_m = 0.0;    // of its highest point above the base
  double length_m = 0.0;    // of its box seen from above, the longer side
  double width_m = 0.0;
  double heading_deg = 0.0;  // [deg] true, of the longer side, [0, 180)
  std::uint16_t kind = 0;    // of the largest part of its surface
};

class SceneView {
 public:
  SceneView() = default;
  SceneView(const SceneView&) = delete;
  SceneView& operator=(const SceneView&) = delete;
  virtual ~SceneView() = default;

  virtual std::uint64_t generation() const = 0;
  virtual std::uint64_t resident_bytes() const = 0;
  virtual const std::vector<SurfaceKind>& kinds() const = 0;
  virtual const std::vector<SceneObject>& objects() const = 0;

  // Tiles whose bounds come within the radius, in a fixed order; found by an index, so the cost is that of what is
  // near and not of what there is. `found` is cleared first and keeps its room.
  virtual void tiles_near(geo::GeoPoint position, double radius_m, std::vector<const Tile*>& found) const = 0;
  // The same for objects whose middles lie within the radius: indices into objects(), ascending.
  virtual void objects_near(geo::GeoPoint position, double radius_m, std::vector<std::uint32_t>& found) const = 0;
  // Scene by scene in a fixed order, where the view was made for who does not resolve them.
  virtual std::span<const Scatterers* const> scatterers() const { return {}; }
};

using SceneViewPointer = std::shared_ptr<const SceneView>;

}  // namespace yars::model::scene
