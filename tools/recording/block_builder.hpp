// Gathers the items of a block until it is written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "tools/recording/packing.hpp"
#include "tools/recording/recorded_kinds.hpp"

namespace yars::tools::recording {

class BlockBuilder {
 public:
  // Whether this item belongs into the next block: a second is over, time has jumped, or the block is full.
  bool is_full_for(const RecordParts& parts, std::optional<std::int64_t> tick) const;
  void append(const RecordedKind& kind, const RecordParts& parts, std::optional<std::int64_t> tick);
  bool empty() const { return order_.empty(); }
  // The block as it goes into the file. The builder is then empty; a next block without a time of its own has the
  // last one's.
  std::vector<std::byte> take(Packer& packer);

  std::uint64_t kinds() const { return kinds_; }  // bit n: kind n is inside
  std::int64_t first_tick() const { return first_tick_.value_or(last_tick_); }
  std::int64_t last_tick() const { return last_tick_; }

 private:
  struct Column {
    std::vector<std::byte> records, tails;
  };
  std::map<std::uint8_t, Column> columns_;  // by the kind's number
  std::vector<std::byte> order_;
  std::uint64_t kinds_ = 0;
  std::optional<std::int64_t> first_tick_;
  std::int64_t last_tick_ = 0;
  std::size_t raw_bytes_ = 0;
};

}  // namespace yars::tools::recording
