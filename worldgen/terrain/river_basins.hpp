// Where the water of a whole degree goes, from a few samples of the broad shapes: an inland tile drains through one
// gate into the neighbour on its cheapest way to the sea; a tile on the coast drains to its own sea, and through
// gates to neighbours with more sea. Ways never lead in a circle. Each answer is a function of place, seed and
// box, found from the tiles around alone; whole numbers decide, so that no order of questions matters.
// No water runs poleward of 72 degrees, and a tile that finds no sea nearby keeps its water.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "worldgen/terrain/relief.hpp"

namespace yars::worldgen {

// Where a river passes from one tile into the next.
struct RiverGate {
  CellPlace from;
  CellPlace to;
  int north = 0, east = 0;  // step from `from` to `to`, one of them 0
  int along = 0;            // row or column of the two nodes that face each other
  double bed_m = 0.0;       // height of the water between them
};

class RiverBasins {
 public:
  explicit RiverBasins(const BroadRelief& broad) : broad_(broad) {}

  bool frozen(CellPlace place) const;
  bool coastal(CellPlace place);
  std::vector<RiverGate> exits(CellPlace place);
  std::vector<RiverGate> entries(CellPlace place);
  // [km2] that an inland tile's gate drains, its own area included.
  double drained_km2(CellPlace inland);

 private:
  struct Outline {
    int deep = 0;    // of 64 samples
    int mean_m = 0;  // of the samples, none below 0
  };
  using Key = std::pair<int, int>;

  const Outline& outline(CellPlace place);
  bool is_coastal(CellPlace place) { return outline(place).deep > 0; }
  int step_cost(CellPlace from, CellPlace to);
  int way_to_sea(CellPlace place);
  std::optional<CellPlace> next(CellPlace place);
  RiverGate gate_between(CellPlace from, int north, int east, int first, int last) const;
  double highest_exit_m(CellPlace place);
  std::optional<RiverGate> inland_exit(CellPlace place);
  std::vector<RiverGate> coastal_exits(CellPlace place);
  std::vector<RiverGate> exits_of(CellPlace place);
  double area_leaving(CellPlace place);

  const BroadRelief& broad_;
  std::mutex mutex_;
  std::map<Key, Outline> outlines_;
  std::map<Key, int> ways_;
  std::map<Key, std::optional<CellPlace>> nexts_;
  std::map<Key, std::vector<RiverGate>> exits_;
  std::map<Key, double> areas_km2_;
};

}  // namespace yars::worldgen
