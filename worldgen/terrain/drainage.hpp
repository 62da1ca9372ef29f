// The rivers of one tile as a tree over its lattice: each node of a river, its next node downstream, the area it
// drains and the height of its water. Water never rises downstream, from gates that enter the tile down to the sea
// or to a gate that leaves it. A flood from the outlets goes for the lowest ground it sees; a node drains to the
// neighbour that the flood comes from; where that is uphill, the river cuts through.
#pragma once

#include <vector>

#include "worldgen/terrain/river_basins.hpp"

namespace yars::worldgen {

inline constexpr double kRiverKm2 = 60.0;  // [km2] drained: less is no river

struct RiverNode {
  int row = 0, column = 0;
  int downstream = -1;    // index among the nodes, smaller than its own; -1 = the water ends or leaves here
  int exit = -1;          // gate that it leaves by, else -1
  double area_km2 = 0.0;  // drained, this node's own included
  double ground_m = 0.0;  // before the river
  double water_m = 0.0;
};

struct RiverEntry {
  RiverGate gate;
  double area_km2 = 0.0;
};

struct Drainage {
  std::vector<RiverNode> nodes;  // downstream before upstream
  std::vector<RiverGate> exits;
  std::vector<double> exits_km2;  // that leave by each
  std::vector<RiverEntry> entries;
  bool landlocked = false;  // neither sea nor gate: the water ends at the lowest place
};

Drainage drain(const ReliefTile& relief, std::vector<RiverGate> exits, std::vector<RiverEntry> entries);

// The node of a tile that a gate leads from or to.
struct TileNode {
  int row = 0, column = 0;
};
TileNode gate_source(const RiverGate& gate);
TileNode gate_target(const RiverGate& gate);

}  // namespace yars::worldgen
