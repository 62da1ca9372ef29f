// Immutable view of polygonal scenes in memory, without terrain: triangles in square tiles, objects, scatterers.
// A SceneStore places the data of OpenFlight files on the terrain. Units: metres; degrees where the name says so.
// Frame of a tile: east and north on the azimuthal equidistant plane about Tile::origin; up from Tile::zero_msl_m.
// Frame of scatterers: the same projection about the scene's position, x east, y north [m]. Squares divide this plane.
// Covers are sums (areas [m^2], materials) of the faces of a square on the ground, scatterers of all others, such as
// walls, roofs and slopes, for radar modes that do not resolve faces; model/rbm computes the return. Four levels have
// squares with sides of 32 to 256 m. To limit its cost, a scan uses the largest squares that are not wider than the
// range between its samples, else the smallest that the scene has.
// Threads: immutable once built, so any number of threads may read a view.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/placement/geometry.hpp"

namespace yars::model::scene {

// Limits that classify faces as level, lying on the ground, or walls.
inline constexpr double kLevelNormal = 0.98;  // faces are level if the vertical part of their unit normal exceeds this
inline constexpr double kOnGround_m = 0.5;  // level faces below this height above their object's base lie on the ground
// [m] In scenes whose heights count from mean sea level (SceneHeights::sea_level), kOnGround_m does not apply: level
// faces less than this above or below the terrain lie on the ground.
inline constexpr double kNearGround_m = 2.0;
// Faces steeper than 70 degrees are walls: upper bound of (vertical / horizontal part of the normal)^2.
inline constexpr double kWallNormal2 = 0.13;

// Sum of those faces of a square that have one material, and normals in one bin of 4 degrees of azimuth by 15 degrees
// of elevation. Level faces are not divided by azimuth.
struct Facing {
  float east_m2 = 0, north_m2 = 0, up_m2 = 0;  // sum of area times normal
  std::uint8_t material = 0;                   // surface material code of DFAD (Digital Feature Analysis Data)
  bool wall = false;                           // true: steeper than 70 degrees (kWallNormal2)
};

// Sum of the standing faces in one square.
struct Scatterer {
  float east_m = 0, north_m = 0, up_m = 0;               // foot of the centroid on the ellipsoid, in Scatterers::frame
  float middle_msl_m = 0, min_msl_m = 0, max_msl_m = 0;  // altitudes MSL of centroid, lowest and highest point
  // Side of the uniformly filled square with the same mean squared distance from the centroid, seen from above. At most
  // the side of the level's squares.
  float extent_m = 0;
  std::uint32_t first_facing = 0, facings = 0;  // index of the first in ScattererLevel::facings, and their number
};

// Sum of the faces on the ground in one square. On the fraction `share` of the square, their materials replace the
// material of the ground.
struct Cover {
  float share = 0;  // fraction of the square's area, at most 1
  std::uint32_t first_facing = 0, facings = 0;
};

inline constexpr std::array<double, 4> kScattererSides_m{32.0, 64.0, 128.0, 256.0};

inline constexpr std::size_t kFacingSlack = 16;  // spare facings after the last one, which SIMD code reads

struct ScattererLevel {
  std::vector<Scatterer> scatterers;  // in the order of `tree`
  SphereTree tree;
  std::unordered_map<std::uint64_t, Cover> covers;  // by square_key()
  std::vector<Facing> facings;                      // the last kFacingSlack belong to no square

  std::span<const Facing> facings_of(const Scatterer& of) const {
    return {facings.data() + of.first_facing, of.facings};
  }
  std::span<const Facing> facings_of(const Cover& of) const { return {facings.data() + of.first_facing, of.facings}; }
};

struct Scatterers {
  explicit Scatterers(geo::GeoPoint at) : position(at), frame(at, geo::HeightAboveEllipsoid::metres(0.0)) {}

  geo::GeoPoint position;
  geo::LocalTangentFrame frame;  // east, north, up at `position`, on the ellipsoid
  // [m] Radius of a circle about `position` that contains every square with cover and, about every scatterer's
  // centroid, a circle whose radius is the side length of the scatterer's square.
  double reach_m = 0.0;
  std::array<ScattererLevel, kScattererSides_m.size()> levels;
  std::size_t finest = 0;  // index of the finest level in use; in large scenes the levels before `finest` are empty

  // Returns the level with the largest squares whose side is at most `resolved_m`, or `finest` if there is none.
  std::size_t level_for(double resolved_m) const;
  std::uint64_t bytes() const;
};

// Key of the square with side `side_m` that contains a point of the scene's plane.
std::uint64_t square_key(double east_m, double north_m, double side_m);

// Builds Scatterers while a scene is placed. If a scene needs too many squares, the builder changes to larger squares,
// to bound memory. If even the largest squares are too many, faces that need a further square are left out. Also left
// out are triangles on the ground that are longer than 64 sides of the largest squares, eastward or northward.
class ScatterBuilder {
 public:
  // Faces with their centre farther than `max_reach_m` from the origin of the scene's plane are left out.
  explicit ScatterBuilder(double max_reach_m) : max_reach_m_(max_reach_m) {}

  // Adds a standing triangle, counter-clockwise seen from outside. Corners [m]: x, y on the scene's plane, z MSL.
  // The square that contains the centre gets the whole triangle, which should not be much larger than a 32 m square.
  void add_standing(const std::array<geo::Vector3, 3>& corners, std::uint8_t material);
  // Adds a triangle on the ground. Each square gets the part of the area that lies in the square, seen from above.
  void add_lying(const std::array<geo::Vector3, 3>& corners, std::uint8_t material);

  // Returns the scatterers and leaves the builder empty. Null if nothing was added.
  std::shared_ptr<const Scatterers> take(const geo::AzimuthalEquidistant& plane);

 private:
  struct FacingSum {
    std::uint32_t key = 0;  // material, elevation and azimuth of the normal, wall or not
    geo::Vector3 area_m2;
  };
  struct Square {
    // Sum of area times centre. A standing face counts with its own centre, a lying face with the square's.
    geo::Vector3 middle;
    double spread = 0.0;  // sum of area times squared horizontal distance from the plane's origin
    double area_m2 = 0.0;
    double min_m = 0.0, max_m = 0.0;  // lowest and highest altitude MSL
    std::vector<FacingSum> facings;
  };
  using Squares = std::unordered_map<std::uint64_t, Square>;
  using Keys = std::vector<std::uint64_t>;

  bool within_reach(const std::array<geo::Vector3, 3>& corners) const;
  double side_m() const { return kScattererSides_m[finest_]; }
  bool coarsen();
  Square* square_in(Squares& squares, geo::Vector3 at);
  static void add(Square& square, std::uint32_t key, geo::Vector3 area_m2);
  static Keys sorted_keys(const Squares& squares);
  static Squares coarser(const Squares& squares);
  void finish(const geo::AzimuthalEquidistant& plane, double side_m, Scatterers& result, ScattererLevel& level) const;

  double max_reach_m_;
  std::size_t finest_ = 0;    // finest level in use: that of the squares in standing_ and lying_
  Squares standing_, lying_;  // squares with standing faces, with faces on the ground
};

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
