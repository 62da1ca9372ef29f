// Patch maps that arrive row by row.
// Inputs: the record of a map and its rows, in any order, each any number of times.
// Outputs: the map and its pixels once all rows are there and the hash is right.
// Errors: rows that do not fit the map are left out. A whole map with a wrong hash waits: rows of an earlier map with
//   its number may be among its own, and are replaced when these arrive.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/record_hashes.hpp"

namespace yars::gateway {

class PatchAssembly {
 public:
  struct Whole {
    databuffer::PatchMap map;
    std::vector<std::uint8_t> pixels;
  };

  // `map` is valid (validate()).
  void begin(std::uint64_t host, const databuffer::PatchMap& map) {
    Pending& pending = pending_of(host, map.id);
    if (pending.map && pending.map->hash == map.hash) return;
    pending.map = map;
    pending.changed = true;
  }

  // A row may arrive before its map.
  void add_row(std::uint64_t host, std::uint64_t id, std::uint32_t row, std::span<const std::uint8_t> pixels) {
    if (row >= databuffer::kMaxPatchPixels || pixels.size() > databuffer::kMaxPatchPixels) return;
    Pending& pending = pending_of(host, id);
    if (pending.rows.size() <= row) pending.rows.resize(row + 1);
    pending.rows[row].assign(pixels.begin(), pixels.end());
    pending.changed = true;
  }

  // A map of the host that has become whole, and is forgotten here; nullopt: none.
  std::optional<Whole> take_whole(std::uint64_t host) {
    for (auto pending = pending_.begin(); pending != pending_.end(); ++pending) {
      if (pending->host != host || !pending->changed || !pending->map || pending->rows.size() < pending->map->size)
        continue;
      const std::size_t size = pending->map->size;
      const auto rows = std::span(pending->rows).first(size);
      if (!std::ranges::all_of(rows, [size](const auto& row) { return row.size() == size; })) continue;
      pending->changed = false;
      Whole whole{*pending->map, {}};
      whole.pixels.reserve(size * size);
      for (const auto& row : rows) whole.pixels.insert(whole.pixels.end(), row.begin(), row.end());
      if (databuffer::map_hash(whole.map, whole.pixels) != whole.map.hash) continue;
      pending_.erase(pending);
      return whole;
    }
    return std::nullopt;
  }

 private:
  struct Pending {
    std::uint64_t host = 0, id = 0;
    std::optional<databuffer::PatchMap> map = std::nullopt;
    std::vector<std::vector<std::uint8_t>> rows = {};
    bool changed = false;  // since take_whole() last looked at the whole map
  };
  static constexpr std::size_t kMaxPending = 8;  // as many as the segment has

  Pending& pending_of(std::uint64_t host, std::uint64_t id) {
    for (Pending& pending : pending_)
      if (pending.host == host && pending.id == id) return pending;
    if (pending_.size() == kMaxPending) pending_.erase(pending_.begin());
    pending_.push_back({host, id});
    return pending_.back();
  }

  std::vector<Pending> pending_;  // oldest first
};

}  // namespace yars::gateway
