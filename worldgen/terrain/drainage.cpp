#include "worldgen/terrain/drainage.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "lib/random/counter_rng.hpp"

namespace yars::worldgen {

namespace {

// Maximum random part of a node's flood level (flood_level_m()); without it, rivers on plains run straight.
constexpr double kWinding_m = 4.0;
// Maximum penalty on the flood level near the tile's edge. It keeps rivers from running along the edge, which they may
// cross only at gates.
constexpr double kEdgePenalty_m = 45.0;
constexpr double kEdgeNodes = 9.0;  // [nodes] width of the strip with the penalty
// [m/m] Minimum slope of the water after the first pass of set_water(). At this slope the water falls less than
// 2 m along a course over all nodes of a tile. That is less than the fall between gates (at least kGateFall_m, 5 m, in
// river_basins.cpp).
constexpr double kMinFall = 1e-7;
constexpr int kNodes = kTileNodes * kTileNodes;
constexpr int kEnd = -1;  // no node downstream; no gate

int index_of(TileNode node) {
  return node.row * kTileNodes + node.column;
}

// Priority flood of a tile: where each node drains to, and the order in which the flood reached the nodes.
class Flood {
 public:
  Flood(const ReliefTile& relief, const std::vector<RiverGate>& gates);

  std::vector<int> downstream;  // node to which each node drains, or kEnd
  std::vector<int> exits;       // index of the gate through which water leaves at a node, or kEnd
  std::vector<int> order;       // nodes, downstream before upstream
  bool landlocked = false;      // no sea and no exit

 private:
  struct FloodNode {
    float level_m;
    int node;
    // Reversed, so that the priority queue returns the lowest level first.
    bool operator<(const FloodNode& other) const {
      return level_m != other.level_m ? level_m > other.level_m : node > other.node;
    }
  };
  // Adds a node to the queue, unless the flood has reached it.
  void seed(int node, double level_m) {
    if (reached_[static_cast<std::size_t>(node)]) return;
    reached_[static_cast<std::size_t>(node)] = true;
    open_.push({static_cast<float>(level_m), node});
  }
  bool beside_sea(int row, int column) const;
  void seed_outlets(const std::vector<RiverGate>& gates);
  double flood_level_m(TileNode at) const;
  void spread(const FloodNode& here);

  const ReliefTile& relief_;
  std::vector<bool> reached_;
  std::priority_queue<FloodNode> open_;
};

Flood::Flood(const ReliefTile& relief, const std::vector<RiverGate>& gates)
    : downstream(kNodes, kEnd), exits(kNodes, kEnd), relief_(relief), reached_(kNodes, false) {
  order.reserve(kNodes);
  seed_outlets(gates);
  while (!open_.empty()) {
    const FloodNode here = open_.top();
    open_.pop();
    order.push_back(here.node);
    spread(here);
  }
}

// True for a node on the tile's edge with sea deeper than 10 m (kRiverEnd_m) beyond the edge.
bool Flood::beside_sea(int row, int column) const {
  return (row == 0 && relief_.height_m(-1, column) < kRiverEnd_m) ||
         (row == kTileNodes - 1 && relief_.height_m(kTileNodes, column) < kRiverEnd_m) ||
         (column == 0 && relief_.height_m(row, -1) < kRiverEnd_m) ||
         (column == kTileNodes - 1 && relief_.height_m(row, kTileNodes) < kRiverEnd_m);
}

void Flood::seed_outlets(const std::vector<RiverGate>& gates) {
  int lowest = 0;
  for (int node = 0; node < kNodes; ++node) {
    const int row = node / kTileNodes;
    const int column = node % kTileNodes;
    const double height_m = relief_.height_m(row, column);
    if (height_m < kRiverEnd_m || beside_sea(row, column)) seed(node, height_m);
    if (height_m < relief_.height_m(lowest / kTileNodes, lowest % kTileNodes)) lowest = node;
  }
  for (std::size_t gate = 0; gate < gates.size(); ++gate) {
    const TileNode node = gate_source(gates[gate]);
    if (reached_[static_cast<std::size_t>(index_of(node))]) continue;
    exits[static_cast<std::size_t>(index_of(node))] = static_cast<int>(gate);
    seed(index_of(node), relief_.height_m(node.row, node.column));
  }
  // In a tile without an outlet, the water ends at the lowest node.
  landlocked = open_.empty();
  if (landlocked) seed(lowest, relief_.height_m(lowest / kTileNodes, lowest % kTileNodes));
}

// Priority of a node: its height, plus a random part, plus the penalty near the edge. The flood takes the node with the
// lowest level first (search of GRASS r.watershed, Ehlschlaeger 1989). Once the flood has crossed the rim of a basin,
// it descends to the basin's floor, then rises.
double Flood::flood_level_m(TileNode at) const {
  const CellCorner corner = relief_.corner();
  const std::uint32_t hash =
      random::lattice_hash(corner.south_deg * kTileNodes + at.row, corner.west_deg * kTileNodes + at.column, 1, 5U);
  const int edge_nodes = std::min({at.row, at.column, kTileNodes - 1 - at.row, kTileNodes - 1 - at.column});
  const double near = std::max(0.0, 1.0 - edge_nodes / kEdgeNodes);
  return relief_.height_m(at.row, at.column) + kWinding_m * random::unit_fraction(hash) + kEdgePenalty_m * near * near;
}

void Flood::spread(const FloodNode& here) {
  const int row = here.node / kTileNodes;
  const int column = here.node % kTileNodes;
  for (int north = -1; north <= 1; ++north)
    for (int east = -1; east <= 1; ++east) {
      const TileNode to{row + north, column + east};
      if (to.row < 0 || to.row >= kTileNodes || to.column < 0 || to.column >= kTileNodes) continue;
      const int node = index_of(to);
      if (reached_[static_cast<std::size_t>(node)]) continue;
      downstream[static_cast<std::size_t>(node)] = here.node;
      seed(node, flood_level_m(to));
    }
}

// Drained area of each node, including the areas that enter through gates.
std::vector<double> areas_km2(const ReliefTile& relief, const Flood& flood, const std::vector<RiverEntry>& entries) {
  std::vector<double> areas(kNodes);
  for (int node = 0; node < kNodes; ++node) {
    const double north_km = kNodeMetres / 1000.0;
    const double latitude_deg = relief.node(node / kTileNodes, 0).latitude_deg;
    areas[static_cast<std::size_t>(node)] = north_km * east_m_per_degree(latitude_deg) / kTileNodes / 1000.0;
  }
  for (const RiverEntry& entry : entries)
    areas[static_cast<std::size_t>(index_of(gate_target(entry.gate)))] += entry.area_km2;
  for (auto node = flood.order.rbegin(); node != flood.order.rend(); ++node) {
    const int to = flood.downstream[static_cast<std::size_t>(*node)];
    if (to != kEnd) areas[static_cast<std::size_t>(to)] += areas[static_cast<std::size_t>(*node)];
  }
  return areas;
}

// Sets water heights. Each height starts 2 to 10 m below the ground, but not below sea level. The first pass runs
// downstream and lowers each node's water below the water upstream of the node (by the slope kMinFall), so that the
// river cuts through higher ground. The second pass runs upstream and raises each node's water to at least the level of
// the water downstream of the node. Where a river ends in the sea, its water is set to 0 m.
void set_water(Drainage& drainage) {
  std::vector<RiverNode>& nodes = drainage.nodes;
  std::vector<double> upstream_m(nodes.size(), 1e9);
  for (const RiverEntry& entry : drainage.entries)
    for (std::size_t index = 0; index < nodes.size(); ++index) {
      const TileNode target = gate_target(entry.gate);
      const bool here = nodes[index].row == target.row && nodes[index].column == target.column;
      if (here && entry.area_km2 >= kRiverKm2) upstream_m[index] = std::min(upstream_m[index], entry.gate.water_m);
    }
  for (std::size_t index = nodes.size(); index-- > 0;) {
    RiverNode& node = nodes[index];
    const double depth_m = 2.0 + std::min(8.0, 0.05 * std::sqrt(node.area_km2));
    node.water_m = std::max(0.0, std::min(node.ground_m - depth_m, upstream_m[index]));
    if (node.downstream >= 0) {
      double& below_m = upstream_m[static_cast<std::size_t>(node.downstream)];
      below_m = std::min(below_m, node.water_m - kMinFall * kNodeMetres);
    }
  }
  for (RiverNode& node : nodes) {
    if (node.downstream >= 0)
      node.water_m = std::max(node.water_m, nodes[static_cast<std::size_t>(node.downstream)].water_m);
    else if (node.exit >= 0)
      node.water_m = std::max(node.water_m, drainage.exits[static_cast<std::size_t>(node.exit)].water_m);
    else if (!drainage.landlocked)
      node.water_m = 0.0;  // the sea, in this tile or just beyond its edge
  }
}

}  // namespace

TileNode gate_source(const RiverGate& gate) {
  const int line = gate.north + gate.east > 0 ? kTileNodes - 1 : 0;
  return gate.north != 0 ? TileNode{line, gate.along} : TileNode{gate.along, line};
}

TileNode gate_target(const RiverGate& gate) {
  const int line = gate.north + gate.east > 0 ? 0 : kTileNodes - 1;
  return gate.north != 0 ? TileNode{line, gate.along} : TileNode{gate.along, line};
}

Drainage drain(const ReliefTile& relief, std::vector<RiverGate> exits, std::vector<RiverEntry> entries) {
  const Flood flood(relief, exits);
  const std::vector<double> areas = areas_km2(relief, flood, entries);
  Drainage drainage{{}, std::move(exits), {}, std::move(entries), flood.landlocked};
  std::vector<int> numbers(kNodes, -1);
  for (const int node : flood.order) {
    const double area_km2 = areas[static_cast<std::size_t>(node)];
    if (area_km2 < kRiverKm2) continue;
    const int to = flood.downstream[static_cast<std::size_t>(node)];
    const int row = node / kTileNodes;
    const int column = node % kTileNodes;
    numbers[static_cast<std::size_t>(node)] = static_cast<int>(drainage.nodes.size());
    drainage.nodes.push_back({row, column, to == kEnd ? -1 : numbers[static_cast<std::size_t>(to)],
                              flood.exits[static_cast<std::size_t>(node)], area_km2, relief.height_m(row, column),
                              0.0});
  }
  for (std::size_t exit = 0; exit < drainage.exits.size(); ++exit) {
    const auto node = static_cast<std::size_t>(index_of(gate_source(drainage.exits[exit])));
    drainage.exits_km2.push_back(flood.exits[node] == kEnd ? 0.0 : areas[node]);
  }
  set_water(drainage);
  return drainage;
}

}  // namespace yars::worldgen
