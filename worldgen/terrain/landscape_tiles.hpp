// Tiles of the made-up earth: settlements, and a cache of relief, rivers and settlements by degree.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "model/terrain/formats/cell.hpp"
#include "worldgen/terrain/drainage.hpp"
#include "worldgen/terrain/rivers.hpp"

namespace yars::worldgen {

// What people have built on one tile of the made-up earth: towns, of sizes by a rank law (the r-th is the largest
// by the root of r smaller), on low and gentle ground, rather by the sea, by rivers and at their mouths; airfields
// on level ground outside of towns. A function of the tile's relief and rivers.
struct Town {
  geo::GeoPoint centre;
  double radius_m = 0.0;  // of the built-up area, on average
};

struct Airfield {
  geo::GeoPoint centre;      // of the runway
  double bearing_deg = 0.0;  // [0, 180) of the runway
  double length_m = 0.0;     // of the runway
  double elevation_m = 0.0;  // of the level ground, whole metres
};

inline constexpr double kRunwayHalfWidth_m = 70.0;  // [m] with shoulders: two posts of level 1 wide
inline constexpr double kPadBeyond_m = 250.0;       // [m] level ground beyond the runway's ends
inline constexpr double kPadHalfWidth_m = 500.0;    // [m] level ground to either side
inline constexpr double kPadBlend_m = 500.0;        // [m] from the level ground to the land as it was
inline constexpr double kTownMostSteep = 0.05;      // [m/m] at a town's centre
inline constexpr double kLargestTown_m = 7000.0;    // [m] radius

struct Places {
  std::vector<Town> towns;  // larger first
  std::vector<Airfield> airfields;
};

Places settle(const ReliefTile& relief, const Drainage& drainage, std::uint32_t seed);

// A place on or about an airfield: way along and across the runway from its middle [m].
struct OnAirfield {
  double along_m = 0.0;
  double across_m = 0.0;
};
OnAirfield on_airfield(const Airfield& airfield, geo::GeoPoint place);

// Tiles of the made-up earth, each made once when first wanted, kept while there is room; the longest unused go
// first. Any number of threads; a maker may ask the same cache for other tiles, never for its own in a circle.
template <class Tile>
class LandscapeCache {
 public:
  explicit LandscapeCache(std::size_t limit) : limit_(limit) {}

  template <class Make>
  std::shared_ptr<const Tile> get(CellPlace place, const Make& make) {
    const std::shared_ptr<Entry> entry = entry_of(place);
    const std::lock_guard lock(entry->mutex);
    if (!entry->tile) entry->tile = std::make_shared<const Tile>(make());
    return entry->tile;
  }

 private:
  struct Entry {
    std::mutex mutex;
    std::shared_ptr<const Tile> tile;
    std::uint64_t last_use = 0;  // guarded by the cache's mutex
  };

  std::shared_ptr<Entry> entry_of(CellPlace place) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<Entry>& entry = entries_[{place.south_deg, place.west_deg}];
    if (!entry) entry = std::make_shared<Entry>();
    entry->last_use = ++uses_;
    const std::shared_ptr<Entry> wanted = entry;
    if (entries_.size() > limit_) drop_longest_unused();
    return wanted;
  }
  void drop_longest_unused() {
    auto oldest = entries_.begin();
    for (auto each = entries_.begin(); each != entries_.end(); ++each)
      if (each->second->last_use < oldest->second->last_use) oldest = each;
    entries_.erase(oldest);
  }

  std::size_t limit_;
  std::mutex mutex_;
  std::map<std::pair<int, int>, std::shared_ptr<Entry>> entries_;
  std::uint64_t uses_ = 0;
};

// What stands on a tile's relief.
struct TileFeatures {
  Drainage drainage;
  std::vector<RiverPiece> rivers;
  Places places;
};

// The made-up earth by degrees: relief, rivers and places of a tile, each made once when first wanted and kept
// while there is room. Any number of threads; the same answers whatever was asked before.
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

}  // namespace yars::worldgen
