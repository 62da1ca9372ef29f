// Immutable view of polygonal scenes in memory: triangles on the earth in square tiles, objects, scatterers.
// Source of the data: OpenFlight files, placed on the terrain by a SceneStore. The terrain itself is separate.
// Units: metres; angles in degrees, as named.
// Frame: per tile, east and north on the azimuthal equidistant plane about its origin, up from its zero.
// Threads: any number may read a view.
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

// Triangles with their centres in one square of the earth; `bounds` covers them whole, also beyond the square. A square
// with too many vertices has several tiles. Each coordinate is an array of its own, so a vector of vertices is one
// load. Patch maps are limited by memory bandwidth, so the arrays are small.
struct Tile {
  static constexpr std::size_t kMaxVertices = 65536;

  std::size_t triangles() const { return kind.size(); }
  std::array<std::uint16_t, 3> corners(std::size_t t) const { return {corner[0][t], corner[1][t], corner[2][t]}; }

  geo::GeoPoint origin;
  double zero_msl_m = 0.0;  // altitude of up = 0, MSL
  Bounds bounds;
  std::vector<float> east_m, north_m, up_m;  // by vertex
  std::uint32_t bare = 0;  // number of leading vertices without normals; they belong to flat triangles
  std::vector<float> normal_east, normal_north, normal_up;  // unit, outwards; by vertex from `bare` on
  // By triangle: vertex indices, counter-clockwise from outside. All three corners are bare or none is.
  std::array<std::vector<std::uint16_t>, 3> corner;
  std::uint32_t on_ground = 0;        // number of leading triangles that lie on the ground and set only its gamma
  std::vector<std::uint16_t> kind;    // by triangle: index into SceneView::kinds()
  std::vector<std::uint32_t> object;  // by triangle: index into SceneView::objects()
};

// Dimensions of one OpenFlight object, for radars that do not resolve it.
struct SceneObject {
  std::string name;
  geo::GeoPoint middle;
  double base_msl_m = 0.0;  // ground below the object, MSL
  double height_m = 0.0;    // highest point above the base
  double length_m = 0.0;    // longer side of its box seen from above
  double width_m = 0.0;
  double heading_deg = 0.0;  // true heading of the longer side, [0, 180)
  std::uint16_t kind = 0;    // kind with the largest surface area
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

  // Finds the tiles with bounds within the radius, in a fixed order. An index limits the cost to nearby tiles. `found`
  // is cleared first; its capacity is kept.
  virtual void tiles_near(geo::GeoPoint position, double radius_m, std::vector<const Tile*>& found) const = 0;
  // Finds the objects with centres within the radius: indices into objects(), ascending.
  virtual void objects_near(geo::GeoPoint position, double radius_m, std::vector<std::uint32_t>& found) const = 0;
  // Scatterers by scene, in a fixed order; empty unless the view holds SceneUse::scatterers.
  virtual std::span<const Scatterers* const> scatterers() const { return {}; }
};

using SceneViewPointer = std::shared_ptr<const SceneView>;

}  // namespace yars::model::scene
