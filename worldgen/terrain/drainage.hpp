// Drainage of one tile of one degree: a tree of lattice nodes (relief.hpp) per river, with drained areas and water
// heights.
// Input: relief of the tile; gates (passages through its edge) by which rivers leave and enter; area drained by each
// entering river.
// Output: river nodes, downstream before upstream. Water never rises downstream.
// Method: a priority flood, a search that spreads upstream from sea and exits, lowest ground first. A node drains to
//   the neighbour from which the flood came. If that neighbour is higher, the river cuts through the ground.
// Units: heights in metres above mean sea level; areas in km2.
#pragma once

#include <vector>

#include "worldgen/terrain/river_basins.hpp"

namespace yars::worldgen {

inline constexpr double kRiverKm2 = 60.0;  // minimum drained area of a river

struct RiverNode {
  int row = 0, column = 0;
  // Index in Drainage::nodes of the next node, less than this node's index; -1: the water ends or leaves the tile here.
  int downstream = -1;
  int exit = -1;          // index in Drainage::exits of the gate through which the water leaves here, else -1
  double area_km2 = 0.0;  // drained area, including the area of this node
  double ground_m = 0.0;  // height of the ground without the river
  double water_m = 0.0;   // height of the water
};

struct RiverEntry {
  RiverGate gate;
  double area_km2 = 0.0;  // drained area upstream of the gate
};

struct Drainage {
  std::vector<RiverNode> nodes;   // downstream before upstream
  std::vector<RiverGate> exits;   // gates by which rivers can leave the tile
  std::vector<double> exits_km2;  // area drained through each exit; 0 at the sea
  std::vector<RiverEntry> entries;
  bool landlocked = false;  // no sea and no exit; the water ends at the lowest node
};

// Drainage of a tile with these exits and entries.
Drainage drain(const ReliefTile& relief, std::vector<RiverGate> exits, std::vector<RiverEntry> entries);

// Node of a tile. A gate leads from the node gate_source() in one tile to the node gate_target() in the next tile.
struct TileNode {
  int row = 0, column = 0;
};
TileNode gate_source(const RiverGate& gate);
TileNode gate_target(const RiverGate& gate);

}  // namespace yars::worldgen
