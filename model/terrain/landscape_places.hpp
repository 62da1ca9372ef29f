// What people have built on one tile of the made-up earth: towns, of sizes by a rank law (the r-th is the largest
// by the root of r smaller), on low and gentle ground, rather by the sea, by rivers and at their mouths; airfields
// on level ground outside of towns. A function of the tile's relief and rivers.
#pragma once

#include <cstdint>
#include <vector>

#include "model/terrain/landscape_drainage.hpp"

namespace yars::model::terrain {

struct Town {
  geo::GeoPoint centre;
  double radius_m = 0.0;  // of the built-up area, on average
};

struct Airfield {
  geo::GeoPoint centre;      // of the runway
  double bearing_deg = 0.0;  // [0, 180) of the runway
  double length_m = 0.0;     // of the runway
  double elevation_m = 0.0;  // of the level ground, whole metres
};

inline constexpr double kRunwayHalfWidthM = 70.0;  // [m] with shoulders: two posts of level 1 wide
inline constexpr double kPadBeyondM = 250.0;       // [m] level ground beyond the runway's ends
inline constexpr double kPadHalfWidthM = 500.0;    // [m] level ground to either side
inline constexpr double kPadBlendM = 500.0;        // [m] from the level ground to the land as it was
inline constexpr double kTownMostSteep = 0.05;     // [m/m] at a town's centre
inline constexpr double kLargestTownM = 7000.0;    // [m] radius

struct Places {
  std::vector<Town> towns;  // larger first
  std::vector<Airfield> airfields;
};

Places settle(const ReliefTile& relief, const Drainage& drainage, std::uint32_t seed);

// A place on or about an airfield: way along and across the runway from its middle [m].
struct OnAirfield {
  double along_m = 0.0;
  double across_m = 0.0;
};
OnAirfield on_airfield(const Airfield& airfield, geo::GeoPoint place);

}  // namespace yars::model::terrain
