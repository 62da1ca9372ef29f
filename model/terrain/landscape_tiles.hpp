// The made-up earth by degrees: relief, rivers and places of a tile, each made once when first wanted and kept
// while there is room. Any number of threads; the same answers whatever was asked before.
#pragma once

#include <optional>
#include <vector>

#include "model/terrain/landscape_cache.hpp"
#include "model/terrain/landscape_places.hpp"
#include "model/terrain/landscape_rivers.hpp"

namespace yars::model::terrain {

// What stands on a tile's relief.
struct TileFeatures {
  Drainage drainage;
  std::vector<RiverPiece> rivers;
  Places places;
};

class LandscapeTiles {
 public:
  LandscapeTiles(std::uint32_t seed, std::optional<LandscapeBox> island);

  std::shared_ptr<const ReliefTile> relief(CellPlace place);
  std::shared_ptr<const TileFeatures> features(CellPlace place);
  const BroadRelief& broad() const { return broad_; }

 private:
  std::shared_ptr<const Drainage> drainage(CellPlace place);

  std::uint32_t seed_;
  BroadRelief broad_;
  Gullies valleys_;
  RiverBasins basins_;
  LandscapeCache<ReliefTile> reliefs_;
  LandscapeCache<Drainage> drainages_;
  LandscapeCache<TileFeatures> features_;
};

}  // namespace yars::model::terrain
