// Scatterers of a scene for a radar that does not resolve it, and their sums while it is placed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "model/scene/placement/plan_geometry.hpp"
#include "model/scene/placement/spatial_index.hpp"

namespace yars::model::scene {

// Which faces of a scene are walls and which lie on the ground: one rule for whoever looks at them.
inline constexpr double kLevelNormal = 0.98;  // upward part of a unit normal that is level
inline constexpr double kOnGround_m = 0.5;    // above its object's base a level face lies on the ground
inline constexpr double kNearGround_m = 2.0;  // the same against terrain
// Steeper than 70 degrees a face is a wall: square of the upward part of its normal against the level part.
inline constexpr double kWallNormal2 = 0.13;

// A scene to a radar that does not resolve it: what stands is summed up in squares of the scene's plane, and so is what
// covers the ground; in levels of 32 to 256 m, so that a scan costs what it resolves. Areas and materials only: what
// they return is the radar's affair. Made when a scene is placed; immutable.

// Faces of one material that look about the same way (within 4 degrees of azimuth, 15 of elevation).
struct Facing {
  float east_m2 = 0, north_m2 = 0, up_m2 = 0;  // sum of area times normal
  std::uint8_t material = 0;
  bool wall = false;
};

// What stands in one square.
struct Scatterer {
  float east_m = 0, north_m = 0, up_m = 0;  // in the frame: its middle by area, on the ellipsoid
  float middle_msl_m = 0, least_msl_m = 0, most_msl_m = 0;
  float extent_m = 0;  // of an evenly filled square that spreads as much
  std::uint32_t first_facing = 0, facings = 0;
};

// What lies on the ground of one square: its material is seen instead of the ground's.
struct Cover {
  float share = 0;  // of the square, at most 1
  std::uint32_t first_facing = 0, facings = 0;
};

inline constexpr std::array<double, 4> kScattererSides_m{32.0, 64.0, 128.0, 256.0};

struct ScattererLevel {
  std::vector<Scatterer> scatterers;  // in the order of the tree
  SphereTree tree;
  std::unordered_map<std::uint64_t, Cover> covers;  // by square_key()
  std::vector<Facing> facings;

  std::span<const Facing> facings_of(const Scatterer& of) const {
    return {facings.data() + of.first_facing, of.facings};
  }
  std::span<const Facing> facings_of(const Cover& of) const { return {facings.data() + of.first_facing, of.facings}; }
};

struct Scatterers {
  explicit Scatterers(geo::GeoPoint at) : place(at), frame(at, geo::HeightAboveEllipsoid::metres(0.0)) {}

  geo::GeoPoint place;
  geo::LocalTangentFrame frame;  // east, north, up at the place, on the ellipsoid
  double reach_m = 0.0;          // from the place to the farthest corner of a square
  std::array<ScattererLevel, kScattererSides_m.size()> levels;
  std::size_t finest = 0;  // level; a scene too large for smaller squares has none of those

  // The level of the largest squares that are not larger than what is resolved, else of the smallest.
  std::size_t level_for(double resolved_m) const;
  std::uint64_t bytes() const;
};

// Of the square with this side that holds a point of the scene's plane [m].
std::uint64_t square_key(double east_m, double north_m, double side_m);

// Sums the faces of a scene up to scatterers while it is placed.
// Squares are made larger as a scene turns out to be larger, so that there is a bound on what it takes; what does not
// fit even then is left out.
class ScatterBuilder {
 public:
  // What lies farther from the place than `most_reach_m` is left out.
  explicit ScatterBuilder(double max_reach_m) : max_reach_m_(max_reach_m) {}

  // A triangle, counter-clockwise from outside, not much longer than the smallest square: metres east and north on the
  // scene's plane, altitude MSL. It counts where its middle is.
  void add_standing(const std::array<geo::Vector3, 3>& corners, std::uint8_t material);
  // The same of one that lies on the ground, seen from above: each square gets what lies in it.
  void add_lying(const std::array<geo::Vector3, 3>& corners, std::uint8_t material);

  // Ends the work; null if nothing was added.
  std::shared_ptr<const Scatterers> take(const Plane& plane);

 private:
  struct FacingSum {
    std::uint32_t key = 0;  // material, elevation and azimuth of the normal
    geo::Vector3 area_m2;
  };
  struct Square {
    geo::Vector3 middle;  // sums, times area
    double spread = 0.0;  // sum of area times square of the distance from the plane's origin
    double area_m2 = 0.0;
    double least_m = 0.0, most_m = 0.0;
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
  void finish(const Plane& plane, double side_m, Scatterers& result, ScattererLevel& level) const;

  double max_reach_m_;
  std::size_t finest_ = 0;    // level
  Squares standing_, lying_;  // of the level under way
};

}  // namespace yars::model::scene
