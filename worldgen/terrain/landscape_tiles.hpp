// Tiles (one degree each) of the generated landscape: towns and airfields, and a cache of relief, rivers, settlements.
// Input: a seed, optionally an island's box; a cell. Output: ReliefTile and TileFeatures, immutable.
// Accuracy: the result does not depend on earlier calls. Threads: any.
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

struct Town {
  geo::GeoPoint centre;
  double radius_m = 0.0;  // mean radius of the built-up area
};

struct Airfield {
  geo::GeoPoint centre;      // centre of the runway
  double bearing_deg = 0.0;  // true bearing of the runway in [0, 180)
  double length_m = 0.0;     // length of the runway
  double elevation_m = 0.0;  // [m MSL] elevation of the level ground, whole metres
};

inline constexpr double kRunwayHalfWidth_m =
    70.0;  // with shoulders; the full width exceeds 93 m (3 arc seconds), the distance between posts of DTED level 1
inline constexpr double kPadBeyond_m = 250.0;       // level ground beyond the runway's ends
inline constexpr double kPadHalfWidth_m = 500.0;    // level ground on either side of the runway's centre line
inline constexpr double kPadBlend_m = 500.0;        // transition from level ground to the land
inline constexpr double kMaxTownSteepness = 0.05;   // [m/m] maximum slope at a town's centre
inline constexpr double kMaxTownRadius_m = 7000.0;  // maximum radius of a town

struct Settlements {
  std::vector<Town> towns;  // larger first
  std::vector<Airfield> airfields;
};

// Towns and airfields of a tile. A town's radius is proportional to 1 / sqrt(rank), but at least 450 m; rank 1 is the
// largest town. Towns lie on low, gentle ground, preferably by the sea, by rivers and at river mouths. Airfields lie on
// level ground outside towns. Tiles whose middle is poleward of 68 degrees have neither.
Settlements settlements_of(const ReliefTile& relief, const Drainage& drainage, std::uint32_t seed);

// Position relative to a runway's centre [m]. `along_m` is positive in the direction of the bearing, `across_m` to the
// right of it.
struct RunwayPosition {
  double along_m = 0.0;
  double across_m = 0.0;
};
RunwayPosition runway_position(const Airfield& airfield, geo::GeoPoint position);

// Cache of at most `limit` tiles. get() makes a tile that is not in the cache. The least recently used tile is dropped
// first. Safe for any number of threads. `make` may get other tiles from the same cache; a cycle of such calls
// deadlocks.
template <class Tile>
class LandscapeCache {
 public:
  explicit LandscapeCache(std::size_t limit) : limit_(limit) {}

  template <class Make>
  std::shared_ptr<const Tile> get(CellCorner corner, const Make& make) {
    const std::shared_ptr<Entry> entry = entry_of(corner);
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

  std::shared_ptr<Entry> entry_of(CellCorner corner) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<Entry>& entry = entries_[{corner.south_deg, corner.west_deg}];
    if (!entry) entry = std::make_shared<Entry>();
    entry->last_use = ++uses_;
    std::shared_ptr<Entry> kept = entry;
    if (entries_.size() > limit_) drop_least_recently_used();
    return kept;
  }
  void drop_least_recently_used() {
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

// Rivers, towns and airfields of a tile.
struct TileFeatures {
  Drainage drainage;
  std::vector<RiverPiece> rivers;
  Settlements settlements;
};

// Relief and features of tiles, computed at first use and cached.
class LandscapeTiles {
 public:
  LandscapeTiles(std::uint32_t seed, std::optional<LandscapeBox> island);

  std::shared_ptr<const ReliefTile> relief(CellCorner corner);
  std::shared_ptr<const TileFeatures> features(CellCorner corner);

 private:
  std::shared_ptr<const Drainage> drainage(CellCorner corner);

  std::uint32_t seed_;
  BroadRelief broad_;
  Gullies valleys_;
  RiverBasins basins_;
  LandscapeCache<ReliefTile> reliefs_;
  LandscapeCache<Drainage> drainages_;
  LandscapeCache<TileFeatures> features_;
};

}  // namespace yars::worldgen
