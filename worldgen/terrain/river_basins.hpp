// River basins: into which neighbours each tile of one degree drains, and through which gates.
// Input: heights of the landscape without valleys (BroadRelief in relief.hpp), at 64 samples per tile and along edges.
// Output: gates by which rivers leave and enter a tile; drained areas [km2].
// An inland tile drains through one gate, along the cheapest path of tiles to the sea (low ground is cheap). A coastal
//   tile drains to its own sea, and through gates to neighbours with more sea. Paths have no cycles.
// Tiles poleward of 72 degrees have no rivers. An inland tile with a path above the maximum cost (kMaxPathCost) has no
//   gate.
// Accuracy: costs are integers with exact sums, so the result does not depend on the order of calls.
// Threads: any.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "worldgen/terrain/relief.hpp"

namespace yars::worldgen {

inline constexpr double kRiverEnd_m = -10.0;  // [m MSL] rivers end in deeper sea and continue across shallower water

// Passage of a river through the edge between two tiles.
struct RiverGate {
  CellCorner from;
  CellCorner to;
  int north = 0, east = 0;  // step from `from` to `to` [tiles]: one is 0, the other 1 or -1
  int along = 0;            // column (step north or south) or row (step east or west) of the nodes beside the edge
  double water_m = 0.0;     // [m MSL] height of the water at the edge
};

class RiverBasins {
 public:
  explicit RiverBasins(const BroadRelief& broad) : broad_(broad) {}

  bool frozen(CellCorner corner) const;  // poleward of 72 degrees
  bool coastal(CellCorner corner);       // true if at least one of the 64 samples lies below -10 m MSL
  // Gates by which rivers leave a tile, and by which they enter it.
  std::vector<RiverGate> exits(CellCorner corner);
  std::vector<RiverGate> entries(CellCorner corner);
  // Area [km2] drained through the gate of an inland tile, including the area of the tile itself.
  double drained_km2(CellCorner inland);

 private:
  struct Outline {
    int sea_samples = 0;  // number of the 64 samples below -10 m
    int mean_m = 0;       // mean height of the samples; the sea counts as 0
  };
  using Key = std::pair<int, int>;

  const Outline& outline(CellCorner corner);
  bool is_coastal(CellCorner corner) { return outline(corner).sea_samples > 0; }
  int step_cost(CellCorner from, CellCorner to);
  int cost_to_sea(CellCorner corner);
  std::optional<CellCorner> downstream_of(CellCorner corner);
  RiverGate gate_between(CellCorner from, int north, int east, int first, int last) const;
  double highest_exit_m(CellCorner corner);
  std::optional<RiverGate> inland_exit(CellCorner corner);
  std::vector<RiverGate> coastal_exits(CellCorner corner);
  std::vector<RiverGate> exits_of(CellCorner corner);
  double area_leaving(CellCorner corner);

  const BroadRelief& broad_;
  std::mutex mutex_;
  std::map<Key, Outline> outlines_;
  std::map<Key, int> costs_;
  std::map<Key, std::optional<CellCorner>> downstream_;
  std::map<Key, std::vector<RiverGate>> exits_;
  std::map<Key, double> areas_km2_;
};

}  // namespace yars::worldgen
