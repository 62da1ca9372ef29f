#include "worldgen/terrain/river_basins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "lib/random/counter_rng.hpp"

namespace yars::worldgen {

namespace {

constexpr int kFrozen_deg = 72;      // tiles poleward of this latitude have no rivers
constexpr int kSamplesPerSide = 8;   // samples per side of a tile
constexpr int kMaxPathCost = 25000;  // cost of about 20 tiles; a tile with a costlier path has no gate
constexpr int kNoPath = std::numeric_limits<int>::max() / 4;
// Along every path of tiles the water falls from gate to gate. From the exit of an inland tile to the highest exit of
// the next tile it falls by kMinFall_m to kMaxFall_m; from an exit of a coastal tile, by kGateFall_m to kMaxFall_m.
constexpr double kMinFall_m = 15.0;   // more than drainage.cpp needs for any course between gates
constexpr double kMaxFall_m = 180.0;  // where the ground falls more, the river cuts into the ground
constexpr double kGateFall_m = 5.0;
constexpr int kGatesPerEdge = 3;   // maximum for coastal tiles
constexpr double kDry_m = 1.0;     // [m MSL] minimum height of nodes on land
constexpr double kNoGate_m = 1e9;  // RiverGate::water_m that gate_between() returns if no nodes are on land
constexpr int kGateMargin = 12;    // [nodes] minimum distance of gates from the ends of an edge

struct Step {
  int north, east;
};
constexpr std::array<Step, 4> kSteps = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

std::pair<int, int> key_of(CellCorner corner) {
  return {corner.south_deg, corner.west_deg};
}

double tile_km2(CellCorner corner) {
  constexpr double kSideKm = kTileMetres / 1000.0;
  return kSideKm * kSideKm * std::cos((corner.south_deg + 0.5) * geo::kRadiansPerDegree);
}

}  // namespace

bool RiverBasins::frozen(CellCorner corner) const {
  return corner.south_deg >= kFrozen_deg || corner.south_deg + 1 <= -kFrozen_deg;
}

bool RiverBasins::coastal(CellCorner corner) {
  const std::lock_guard lock(mutex_);
  return is_coastal(corner);
}

std::vector<RiverGate> RiverBasins::exits(CellCorner corner) {
  const std::lock_guard lock(mutex_);
  return exits_of(corner);
}

std::vector<RiverGate> RiverBasins::entries(CellCorner corner) {
  const std::lock_guard lock(mutex_);
  std::vector<RiverGate> entries;
  for (const Step step : kSteps)
    for (const RiverGate& gate : exits_of(neighbour_of(corner, step.north, step.east)))
      if (gate.to == corner) entries.push_back(gate);
  return entries;
}

double RiverBasins::drained_km2(CellCorner inland) {
  const std::lock_guard lock(mutex_);
  return area_leaving(inland);
}

const RiverBasins::Outline& RiverBasins::outline(CellCorner corner) {
  const auto [found, fresh] = outlines_.try_emplace(key_of(corner));
  if (!fresh) return found->second;
  double sum_m = 0.0;
  constexpr int kStride = kTileNodes / kSamplesPerSide;
  for (int row = 0; row < kSamplesPerSide; ++row)
    for (int column = 0; column < kSamplesPerSide; ++column) {
      const double height_m =
          broad_.height_m(lattice_node((corner.south_deg + 90) * kTileNodes + row * kStride + kStride / 2,
                                       (corner.west_deg + 180) * kTileNodes + column * kStride + kStride / 2));
      found->second.sea_samples += static_cast<int>(height_m < kRiverEnd_m);
      sum_m += std::max(0.0, height_m);
    }
  found->second.mean_m = static_cast<int>(sum_m / (kSamplesPerSide * kSamplesPerSide));
  return found->second;
}

// Cost of a step between neighbouring tiles. High ground is expensive. A random part (hash) makes equal costs unlikely.
int RiverBasins::step_cost(CellCorner from, CellCorner to) {
  return 1000 + outline(from).mean_m + outline(to).mean_m +
         static_cast<int>(random::lattice_hash(to.south_deg, to.west_deg, 0, 7U) % 64U);
}

// Cost of the cheapest path to a coastal tile, by Dijkstra's algorithm; kNoPath if it would exceed kMaxPathCost. Known
// costs of other tiles shorten the search.
int RiverBasins::cost_to_sea(CellCorner start) {
  if (const auto known = costs_.find(key_of(start)); known != costs_.end()) return known->second;
  struct Candidate {
    int cost;
    int rank;  // 0: `cost` is for the whole path to the sea; 1: for the path to `corner`
    CellCorner corner;
    bool operator<(const Candidate& other) const {
      return std::tuple(cost, rank, key_of(corner)) > std::tuple(other.cost, other.rank, key_of(other.corner));
    }
  };
  std::priority_queue<Candidate> open;
  std::map<Key, bool> done;
  open.push({0, 1, start});
  int cost = kNoPath;
  while (!open.empty() && open.top().cost <= kMaxPathCost) {
    const Candidate best = open.top();
    open.pop();
    if (best.rank == 0 || is_coastal(best.corner)) {
      cost = best.cost;
      break;
    }
    if (!done.try_emplace(key_of(best.corner), true).second) continue;
    if (const auto known = costs_.find(key_of(best.corner)); known != costs_.end()) {
      if (known->second < kNoPath) open.push({best.cost + known->second, 0, best.corner});
      continue;
    }
    for (const Step step : kSteps) {
      const CellCorner to = neighbour_of(best.corner, step.north, step.east);
      if (frozen(to) || done.contains(key_of(to))) continue;
      open.push({best.cost + step_cost(best.corner, to), 1, to});
    }
  }
  costs_[key_of(start)] = cost;
  return cost;
}

std::optional<CellCorner> RiverBasins::downstream_of(CellCorner corner) {
  if (const auto known = downstream_.find(key_of(corner)); known != downstream_.end()) return known->second;
  std::optional<CellCorner> chosen;
  if (!frozen(corner) && !is_coastal(corner) && cost_to_sea(corner) < kNoPath) {
    int min_cost = kNoPath;
    for (const Step step : kSteps) {
      const CellCorner to = neighbour_of(corner, step.north, step.east);
      if (frozen(to)) continue;
      const int cost = cost_to_sea(to);
      if (cost >= kNoPath || cost + step_cost(corner, to) >= min_cost) continue;
      min_cost = cost + step_cost(corner, to);
      chosen = to;
    }
  }
  downstream_[key_of(corner)] = chosen;
  return chosen;
}

// Gate at the lowest pair of nodes, one on each side of an edge, in [first, last) along the edge. Every second pair is
// examined; its height is that of the higher node. The gate's water_m is the height of the pair. If no pair is on
// land, water_m is kNoGate_m and the gate lies in the middle.
RiverGate RiverBasins::gate_between(CellCorner from, int north, int east, int first, int last) const {
  RiverGate gate{from, neighbour_of(from, north, east), north, east, (first + last) / 2, kNoGate_m};
  const int row = (from.south_deg + 90) * kTileNodes;
  const int column = (from.west_deg + 180) * kTileNodes;
  for (int along = first; along < last; along += 2) {
    const auto height_m = [&](int beyond) {
      const int line = (north + east > 0 ? kTileNodes - 1 + beyond : -beyond);
      return broad_.height_m(north != 0 ? lattice_node(row + line, column + along)
                                        : lattice_node(row + along, column + line));
    };
    const double level_m = std::max(height_m(0), height_m(1));
    if (level_m >= gate.water_m || std::min(height_m(0), height_m(1)) < kDry_m) continue;
    gate.water_m = level_m;
    gate.along = along;
  }
  return gate;
}

// Water height at the highest exit of a tile, at least 0. Water must not enter the tile at a lower height.
double RiverBasins::highest_exit_m(CellCorner corner) {
  double highest_m = 0.0;
  for (const RiverGate& gate : exits_of(corner)) highest_m = std::max(highest_m, gate.water_m);
  return highest_m;
}

std::optional<RiverGate> RiverBasins::inland_exit(CellCorner corner) {
  const std::optional<CellCorner> to = downstream_of(corner);
  if (!to) return std::nullopt;
  const double base_m = highest_exit_m(*to);
  for (const Step step : kSteps) {
    if (!(neighbour_of(corner, step.north, step.east) == *to)) continue;
    RiverGate gate = gate_between(corner, step.north, step.east, kGateMargin, kTileNodes - kGateMargin);
    gate.water_m = std::clamp(gate.water_m, base_m + kMinFall_m, base_m + kMaxFall_m);
    return gate;
  }
  return std::nullopt;
}

// Gates to each neighbour with more sea, one in each section of the edge that has land.
std::vector<RiverGate> RiverBasins::coastal_exits(CellCorner corner) {
  std::vector<RiverGate> exits;
  for (const Step step : kSteps) {
    const CellCorner to = neighbour_of(corner, step.north, step.east);
    if (frozen(to) || outline(to).sea_samples <= outline(corner).sea_samples) continue;
    const double base_m = highest_exit_m(to);
    constexpr int kSection = (kTileNodes - 2 * kGateMargin) / kGatesPerEdge;
    for (int section = 0; section < kGatesPerEdge; ++section) {
      const int first = kGateMargin + section * kSection;
      RiverGate gate = gate_between(corner, step.north, step.east, first, first + kSection);
      if (gate.water_m >= kNoGate_m) continue;
      gate.water_m = std::clamp(gate.water_m, base_m + kGateFall_m, base_m + kMaxFall_m);
      exits.push_back(gate);
    }
  }
  return exits;
}

std::vector<RiverGate> RiverBasins::exits_of(CellCorner corner) {
  if (const auto known = exits_.find(key_of(corner)); known != exits_.end()) return known->second;
  std::vector<RiverGate> exits;
  if (!frozen(corner) && is_coastal(corner)) exits = coastal_exits(corner);
  if (!frozen(corner) && !is_coastal(corner))
    if (const auto gate = inland_exit(corner)) exits.push_back(*gate);
  exits_[key_of(corner)] = exits;
  return exits;
}

double RiverBasins::area_leaving(CellCorner corner) {
  if (const auto known = areas_km2_.find(key_of(corner)); known != areas_km2_.end()) return known->second;
  double area_km2 = tile_km2(corner);
  for (const Step step : kSteps) {
    const CellCorner from = neighbour_of(corner, step.north, step.east);
    if (frozen(from) || is_coastal(from)) continue;
    if (const auto to = downstream_of(from); to && *to == corner) area_km2 += area_leaving(from);
  }
  areas_km2_[key_of(corner)] = area_km2;
  return area_km2;
}

}  // namespace yars::worldgen
