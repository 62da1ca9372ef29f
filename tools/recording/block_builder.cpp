#include "tools/recording/block_builder.hpp"

#include <algorithm>

#include "tools/recording/block_head.hpp"
#include "tools/recording/chunk.hpp"
#include "tools/recording/columns.hpp"

namespace yars::tools::recording {

namespace {

// Longer: packs better, and a seek or a cut costs more.
constexpr std::uint64_t kBlockTicks = 200;  // 1 s of sim time
// Half of what a reader takes, so that an item of any size still fits.
constexpr std::size_t kFullBytes = kMostBlockBytes / 2;
constexpr std::size_t kFullItems = kMostBlockItems / 2;

void append_bytes(std::vector<std::byte>& bytes, std::span<const std::byte> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

}  // namespace

bool BlockBuilder::is_full_for(const RecordParts& parts, std::optional<std::int64_t> tick) const {
  if (empty()) return false;
  if (raw_bytes_ + parts.fixed.size() + parts.tail.size() > kFullBytes || order_.size() >= kFullItems) return true;
  if (!tick || !first_tick_) return false;
  // From a second before to a second behind the first; unsigned, for any ticks.
  return static_cast<std::uint64_t>(*tick) - static_cast<std::uint64_t>(*first_tick_) + kBlockTicks >= 2 * kBlockTicks;
}

void BlockBuilder::append(const RecordedKind& kind, const RecordParts& parts, std::optional<std::int64_t> tick) {
  Column& column = columns_[kind.number];
  append_bytes(column.records, parts.fixed);
  append_bytes(column.tails, parts.tail);
  order_.push_back(static_cast<std::byte>(kind.number));
  kinds_ |= std::uint64_t{1} << kind.number;
  raw_bytes_ += parts.fixed.size() + parts.tail.size();
  if (!tick) return;
  last_tick_ = first_tick_ ? std::max(last_tick_, *tick) : *tick;
  first_tick_ = std::min(first_tick_.value_or(*tick), *tick);
}

std::vector<std::byte> BlockBuilder::take(Packer& packer) {
  std::vector<std::byte> body, coded;
  append_chunk({0, ChunkPart::order}, order_, packer, body);
  for (const auto& [number, column] : columns_) {
    const RecordedKind& kind = *recorded_kind(number);
    if (column.records.empty()) continue;
    coded.clear();
    encode_columns(column.records, kind.bytes, coded);
    append_chunk({number, ChunkPart::records}, coded, packer, body);
    if (kind.tail_bytes != nullptr) append_chunk({number, ChunkPart::tails}, column.tails, packer, body);
  }
  BlockHead head{};
  head.content = BlockContent::items;
  head.kinds = kinds_;
  head.first_tick = first_tick();
  head.last_tick = last_tick_;
  head.items = static_cast<std::uint32_t>(order_.size());
  head.raw_bytes = static_cast<std::uint32_t>(raw_bytes_);
  for (auto& [number, column] : columns_) {
    column.records.clear();
    column.tails.clear();
  }
  order_.clear();
  kinds_ = 0;
  first_tick_.reset();
  raw_bytes_ = 0;
  return sealed(head, body);
}

}  // namespace yars::tools::recording
