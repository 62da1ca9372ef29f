// A scene to a radar that does not resolve it: what stands is summed up in squares of the scene's plane, and so is what
// covers the ground; in levels of 32 to 256 m, so that a scan costs what it resolves. Areas and materials only: what
// they return is the radar's affair. Made when a scene is placed; immutable.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "lib/geo/frames.hpp"
#include "model/scene/sphere_tree.hpp"

namespace yars::model::scene {

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

}  // namespace yars::model::scene
