// River courses of a tile, as straight pieces of about 200 m, and their effect on the ground.
// Input: relief and drainage of a tile.
// Output: the pieces; for a row of posts, heights with valleys, and the position of each post across its valley.
// Each piece has water, a flat valley floor, and slopes up to the original ground.
// Courses of adjacent tiles meet midway between the two nodes of a gate (RiverGate in river_basins.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "worldgen/terrain/drainage.hpp"

namespace yars::worldgen {

struct RiverPiece {
  geo::GeoPoint from;     // upstream end
  double east_m = 0.0;    // offset of the downstream end to the east
  double north_m = 0.0;   // offset of the downstream end to the north
  double parallel = 1.0;  // cosine of the mean latitude of both ends
  // Cross-section at an end; ends[0] is upstream, ends[1] downstream. Lengths in metres, heights in m MSL. The axis is
  // the straight line between both ends.
  struct End {
    double water_m;       // height of the water surface
    double half_width_m;  // half the width of the water
    double floor_m;       // distance from the axis to the edge of the valley floor
    double extent_m;      // distance from the axis to unchanged ground
  } ends[2];

  // [m] Maximum distance from the axis at which the piece changes the ground.
  double extent_m() const { return ends[0].extent_m > ends[1].extent_m ? ends[0].extent_m : ends[1].extent_m; }
};

// The pieces of all rivers of a tile.
std::vector<RiverPiece> river_pieces(const ReliefTile& relief, const Drainage& drainage, std::uint32_t seed);

// Applies river pieces to one row of posts.
class RiverRow {
 public:
  // `longitudes_deg`: longitudes of the posts from west to east, evenly spaced, at least two. The array must outlive
  // the RiverRow.
  RiverRow(double latitude_deg, std::span<const double> longitudes_deg)
      : latitude_deg_(latitude_deg), longitudes_deg_(longitudes_deg) {}

  void add(const RiverPiece& piece);
  // Cuts and fills the ground of the row in place for all added pieces. Posts at or below 0 m do not change.
  // `valley`: position of each post across its valley. 1: outside; 1 to 0: slope; 0: floor; -1: water. On entry, all
  // values must exceed 1.5 (not yet set).
  void shape(std::span<double> heights_m, std::span<float> valley);

 private:
  struct Influence {
    std::size_t post;
    double water_m;
    double part;  // [0, 1] fraction of the ground's height above the floor that remains; -1: water
  };
  void add_post(const RiverPiece& piece, std::size_t post, double east_m, double north_m);

  double latitude_deg_;
  std::span<const double> longitudes_deg_;
  std::vector<Influence> influences_;
};

}  // namespace yars::worldgen
