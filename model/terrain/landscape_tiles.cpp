#include "model/terrain/landscape_tiles.hpp"

#include <algorithm>
#include <utility>

namespace yars::model::terrain {

namespace {

constexpr GullyOctave kValleys[] = {{9000, 0.27}, {4300, 0.24}};
// Relief of a tile takes 60 kB, its features less; a block of 8 x 8 cells wants some 200.
constexpr std::size_t kTilesKept = 700;

}  // namespace

LandscapeTiles::LandscapeTiles(std::uint32_t seed, std::optional<LandscapeBox> island)
    : seed_(seed),
      broad_(seed, island),
      valleys_{seed + 2048U, kValleys},
      basins_(broad_),
      reliefs_(kTilesKept),
      drainages_(kTilesKept),
      features_(kTilesKept) {}

std::shared_ptr<const ReliefTile> LandscapeTiles::relief(CellPlace place) {
  return reliefs_.get(place, [&] { return ReliefTile(place, broad_, valleys_); });
}

std::shared_ptr<const Drainage> LandscapeTiles::drainage(CellPlace place) {
  return drainages_.get(place, [&] {
    if (basins_.frozen(place)) return Drainage{};
    std::vector<RiverEntry> entries;
    for (const RiverGate& gate : basins_.entries(place)) {
      if (!basins_.coastal(gate.from)) {
        entries.push_back({gate, basins_.drained_km2(gate.from)});
        continue;
      }
      // Gates of the coast lead toward more sea: no circle.
      const auto above = drainage(gate.from);
      for (std::size_t exit = 0; exit < above->exits.size(); ++exit)
        if (above->exits[exit].to == place && above->exits[exit].along == gate.along)
          entries.push_back({gate, above->exits_km2[exit]});
    }
    Drainage drained = drain(*relief(place), basins_.exits(place), std::move(entries));
    // What leaves an inland tile is what its neighbour is told.
    if (!basins_.coastal(place))
      std::fill(drained.exits_km2.begin(), drained.exits_km2.end(), basins_.drained_km2(place));
    return drained;
  });
}

std::shared_ptr<const TileFeatures> LandscapeTiles::features(CellPlace place) {
  return features_.get(place, [&] {
    TileFeatures features{*drainage(place), {}, {}};
    const auto land = relief(place);
    features.rivers = river_pieces(*land, features.drainage, seed_ + 2560U);
    features.places = settle(*land, features.drainage, seed_ + 2570U);
    return features;
  });
}

}  // namespace yars::model::terrain
