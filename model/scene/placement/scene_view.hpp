// Immutable view of polygonal scenes in memory: triangles in square tiles, objects, scatterers.
// Source of the data: OpenFlight files, placed on the terrain by a SceneStore. A view does not contain terrain.
// Units: metres; degrees where the name says so.
// Frame of a tile: east and north on the azimuthal equidistant plane about Tile::origin; up from Tile::zero_msl_m.
// Threads: immutable, so any number of threads may read a view.
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

// Bounding box in the tile's frame: metres east, north, up.
struct Bounds {
  float east_min_m = 0, east_max_m = 0, north_min_m = 0, north_max_m = 0, up_min_m = 0, up_max_m = 0;
};

// Triangles whose centres, seen from above, lie in one square with a side of 128 m. A triangle may extend beyond the
// square. A square with too many vertices for one tile has several tiles.
// Layout: structure of arrays, so that one SIMD load reads a coordinate of several vertices. Small element types save
// memory bandwidth, which limits the speed of patch maps.
struct Tile {
  static constexpr std::size_t kMaxVertices = 65536;

  std::size_t triangles() const { return kind.size(); }
  std::array<std::uint16_t, 3> corners(std::size_t t) const { return {corner[0][t], corner[1][t], corner[2][t]}; }

  geo::GeoPoint origin;
  double zero_msl_m = 0.0;                   // altitude MSL at which up_m is 0
  Bounds bounds;                             // of all triangles, including their parts beyond the square
  std::vector<float> east_m, north_m, up_m;  // by vertex
  std::uint32_t first_with_normal = 0;  // number of leading vertices without a normal, which belong to flat triangles
  // Outward unit normals of the vertices from index `first_with_normal` on.
  std::vector<float> normal_east, normal_north, normal_up;
  // By triangle: three vertex indices, counter-clockwise as seen from outside. Either all three vertices have a normal
  // or none has.
  std::array<std::vector<std::uint16_t>, 3> corner;
  std::uint32_t on_ground = 0;        // number of leading triangles on the ground, which only set the ground's gamma
  std::vector<std::uint16_t> kind;    // by triangle: index into SceneView::kinds()
  std::vector<std::uint32_t> object;  // by triangle: index into SceneView::objects()
};

// Position and dimensions of one OpenFlight object.
struct SceneObject {
  std::string name;
  geo::GeoPoint middle;      // centre of the bounding rectangle
  double base_msl_m = 0.0;   // altitude MSL of the model's z = 0 at the object; depends on Placement::heights
  double height_m = 0.0;     // height of the highest point above the base
  double length_m = 0.0;     // longer side of the bounding rectangle seen from above
  double width_m = 0.0;      // shorter side
  double heading_deg = 0.0;  // true heading of the longer side, [0, 180)
  std::uint16_t kind = 0;    // surface kind with the largest area
};

// Immutable set of loaded scenes. When the set changes, a store makes a new view with a higher generation.
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

  // Finds the tiles whose bounds overlap the circle about `position`, in a deterministic order. A spatial index limits
  // the cost to nearby tiles. `found` is cleared first; its capacity remains.
  virtual void tiles_near(geo::GeoPoint position, double radius_m, std::vector<const Tile*>& found) const = 0;
  // Scatterers of each scene, in a deterministic order. Empty unless the view was made with SceneUse::scatterers.
  virtual std::span<const Scatterers* const> scatterers() const { return {}; }
};

using SceneViewPointer = std::shared_ptr<const SceneView>;

}  // namespace yars::model::scene
