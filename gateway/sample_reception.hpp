// Numbers of the samples that arrive from one host on one topic: repeated samples and losses; hosts with one name.
// Patch maps that arrive row by row. Inputs: start (random number of the sending gateway process) and number of each
// sample, in order of arrival; the record of a map and its rows, in any order, each any number of times.
// Outputs: whether the sample is new; counts; a map with its pixels once all rows are there and the hash is right.
// Errors: rows that do not fit are left out. A whole map with a wrong hash waits: rows of an earlier map with its
// number may be among its own, and are replaced when these arrive.
// Use: after a partition DDS delivers the stored history of a topic again, and a lost sample is not reported by it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/messages/pictures.hpp"

namespace yars::gateway {

class SampleNumbers {
 public:
  // False: the sample has arrived before, or is older than one that has arrived. `max_repeats`: samples that DDS may
  // deliver again in a row. After more of them, the highest number is taken for an error, and counting begins anew. So
  // is a number far ahead, until kConfirmations samples have followed it.
  bool is_new(std::uint64_t start, std::uint64_t number, std::uint64_t max_repeats = kDefaultRepeats) {
    if (start_ != start) {
      if (former_start_ == start) {
        ++repeated_;  // from a gateway process that has ended
        return false;
      }
      former_start_ = std::exchange(start_, start);
      next_ = number;
    }
    constexpr std::uint64_t kNone = ~std::uint64_t{0};  // no sender counts so far; the number after it would be 0
    const bool follows = run_ > 0 && number >= run_next_ && number - run_next_ < kFar;
    run_ = follows ? run_ + 1 : 1;
    run_next_ = number + 1;
    const bool is_old = number < next_ && run_ <= max_repeats;
    const bool is_far = number >= next_ && number - next_ >= kFar;
    if (number == kNone || is_old || (is_far && run_ < kConfirmations)) {
      ++repeated_;
      return false;
    }
    if (number > next_ && !is_far) lost_ += number - next_;
    next_ = number + 1;
    ++received_;
    return true;
  }
  // The former process has not ended: its samples count again, if it is this one.
  void readmit(std::uint64_t start) {
    if (former_start_ == start) former_start_.reset();
  }
  // Continues where a predecessor of this process stopped: `next` is the number of the next sample to take.
  void resume(std::uint64_t start, std::uint64_t next) {
    start_ = start;
    next_ = next;
  }
  bool knows(std::uint64_t start) const { return start_ == start; }  // samples of this process have arrived
  std::uint64_t next() const { return next_; }  // number of the next expected sample; 0: none has arrived
  std::uint64_t received() const { return received_; }
  std::uint64_t repeated() const { return repeated_; }
  std::uint64_t lost() const { return lost_; }  // also states that a newer state replaced before they were taken

 private:
  static constexpr std::uint64_t kFar = 65536;  // 5 min of sweeps, the longest cut after which each sample is taken
  static constexpr std::uint64_t kConfirmations = 3;
  static constexpr std::uint64_t kDefaultRepeats = 4096;  // above the depth of every history
  std::uint64_t run_ = 0, run_next_ = 0;  // samples in a row with rising numbers; the least number that continues it
  std::optional<std::uint64_t> start_, former_start_;  // of the process that writes, and of the one before
  std::uint64_t next_ = 0, received_ = 0, repeated_ = 0, lost_ = 0;
};

// Whether several processes announce themselves with one name at the same time.
// Inputs: start of each announcement, with CLOCK_MONOTONIC times [ns].
// Use: a gateway that was started again has another start, and its predecessor's never comes back.
class SharedName {
 public:
  static constexpr std::int64_t kMin_ns = 1'500'000'000;  // a predecessor's late samples end earlier
  // [ns] Without a return for so long there is one process. Of two announcements within a pass only one is seen.
  static constexpr std::int64_t kEnd_ns = 3'000'000'000;

  void hear(std::uint64_t start, std::int64_t now_ns) {
    if (start == starts_[0]) return;
    const auto known = std::find(starts_.begin(), starts_.end(), start);
    if (known == starts_.end()) {
      std::shift_right(starts_.begin(), starts_.end(), 1);
    } else {
      if (now_ns - returned_ns_ > kEnd_ns) since_ns_ = now_ns;
      returned_ns_ = now_ns;
      std::rotate(starts_.begin(), known, known + 1);
    }
    starts_[0] = start;
  }
  bool is_shared(std::int64_t now_ns) const {
    return returned_ns_ - since_ns_ > kMin_ns && now_ns - returned_ns_ <= kEnd_ns;
  }
  // True if it is shared, and was not a minute ago.
  bool is_news(std::int64_t now_ns) {
    constexpr std::int64_t kAgain_ns = 60'000'000'000;
    if (!is_shared(now_ns)) return false;
    const std::int64_t before_ns = std::exchange(shared_ns_, now_ns);
    return before_ns == 0 || now_ns - before_ns >= kAgain_ns;
  }

 private:
  std::array<std::uint64_t, 4> starts_{};        // newest first; 0: none
  std::int64_t shared_ns_ = 0;                   // last time at which is_news() found it shared
  std::int64_t since_ns_ = 0, returned_ns_ = 0;  // first and last return of an earlier start in the present row
};

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
