// Rivers as they lie in the land: the tree of a tile's drainage drawn as winding courses, in straight pieces of some
// 200 m, and what a piece does to the ground about it: water, a flat valley floor, slopes up to the land as it was.
// Courses of neighbouring tiles meet in the middle of a gate.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "worldgen/terrain/drainage.hpp"

namespace yars::worldgen {

struct RiverPiece {
  geo::GeoPoint from;   // upstream end
  double east_m = 0.0;  // to its downstream end
  double north_m = 0.0;
  double parallel = 1.0;  // cosine of its latitude
  // At the upstream and the downstream end [m].
  struct End {
    double water_m;       // height
    double half_width_m;  // of the water
    double floor_m;       // way from the middle to where the floor ends
    double reach_m;       // and to where the land is as it was
  } ends[2];

  // [m] from the piece's box of influence; wider than the widest reach.
  double reach_m() const { return ends[0].reach_m > ends[1].reach_m ? ends[0].reach_m : ends[1].reach_m; }
};

std::vector<RiverPiece> river_pieces(const ReliefTile& relief, const Drainage& drainage, std::uint32_t seed);

// What pieces do to one row of posts: heights [m] in place, and how far in a valley each post is.
class RiverRow {
 public:
  // Pieces that may touch the row; they outlive the object. Longitudes of posts from west to east.
  RiverRow(double latitude_deg, std::span<const double> longitudes_deg)
      : latitude_deg_(latitude_deg), longitudes_deg_(longitudes_deg) {}

  void add(const RiverPiece& piece);
  // Lowers and fills the ground; sea stays. `valley`: 1 = land as without rivers, 0 = valley floor, -1 = water.
  void shape(std::span<double> heights_m, std::span<float> valley);

 private:
  struct Touch {
    std::size_t post;
    double water_m;
    double part;  // [0, 1] of the land's own height above the floor; negative: water
  };
  void add_post(const RiverPiece& piece, std::size_t post, double east_m, double north_m);

  double latitude_deg_;
  std::span<const double> longitudes_deg_;
  std::vector<Touch> touches_;
};

}  // namespace yars::worldgen
