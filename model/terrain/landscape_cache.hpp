// Tiles of the made-up earth, each made once when first wanted, kept while there is room; the longest unused go
// first. Any number of threads; a maker may ask the same cache for other tiles, never for its own in a circle.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>

#include "model/terrain/cell.hpp"

namespace yars::model::terrain {

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

}  // namespace yars::model::terrain
