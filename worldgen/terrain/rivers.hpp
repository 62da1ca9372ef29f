// River courses of a tile, as straight pieces of about 200 m, and their effect on the ground.
// Input: relief and drainage of a tile. Output: pieces; for a row of posts, lowered heights and valley shares.
// Each piece has water, a flat valley floor, and slopes up to the original land.
// Courses of neighbouring tiles meet half way through a gate.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "worldgen/terrain/drainage.hpp"

namespace yars::worldgen {

struct RiverPiece {
  geo::GeoPoint from;     // upstream end
  double east_m = 0.0;    // offset of the downstream end
  double north_m = 0.0;   // likewise
  double parallel = 1.0;  // cosine of its latitude
  // Cross-section at the upstream and the downstream end.
  struct End {
    double water_m;       // height of the water
    double half_width_m;  // of the water
    double floor_m;       // distance from the axis to the end of the valley floor
    double reach_m;       // distance from the axis to the original land
  } ends[2];

  // [m] greatest distance of influence.
  double reach_m() const { return ends[0].reach_m > ends[1].reach_m ? ends[0].reach_m : ends[1].reach_m; }
};

// The pieces of all rivers of a tile.
std::vector<RiverPiece> river_pieces(const ReliefTile& relief, const Drainage& drainage, std::uint32_t seed);

// Applies pieces to one row of posts.
class RiverRow {
 public:
  // Longitudes of the posts from west to east, at least two; they must outlive the object.
  RiverRow(double latitude_deg, std::span<const double> longitudes_deg)
      : latitude_deg_(latitude_deg), longitudes_deg_(longitudes_deg) {}

  void add(const RiverPiece& piece);
  // Lowers and fills the ground in place; sea does not change. `valley`: 1 = no valley, 0 = valley floor, -1 = water.
  // Requires `valley` above 1.5 on entry.
  void shape(std::span<double> heights_m, std::span<float> valley);

 private:
  struct Influence {
    std::size_t post;
    double water_m;
    double part;  // [0, 1] share of the land's height above the floor; negative: water
  };
  void add_post(const RiverPiece& piece, std::size_t post, double east_m, double north_m);

  double latitude_deg_;
  std::span<const double> longitudes_deg_;
  std::vector<Influence> influences_;
};

}  // namespace yars::worldgen
