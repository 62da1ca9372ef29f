#include "radar/recording/block.hpp"

#include <algorithm>
#include <cstring>

#include "radar/recording/compression.hpp"

namespace yars::recording {

namespace {

constexpr std::array<char, 4> kBlockMagic{'Y', 'B', 'L', 'K'};

std::uint32_t checksum_of_head(const BlockHead& head) {
  return checksum_of(std::as_bytes(std::span(&head, 1)).first(offsetof(BlockHead, head_checksum)));
}

}  // namespace

std::string_view magic_of_blocks() {
  return {kBlockMagic.data(), kBlockMagic.size()};
}

std::vector<std::byte> block_bytes(BlockHead head, std::span<const std::byte> body) {
  head.magic = kBlockMagic;
  head.body_bytes = static_cast<std::uint32_t>(body.size());
  head.body_checksum = checksum_of(body);
  head.reserved = 0;
  head.head_checksum = checksum_of_head(head);
  std::vector<std::byte> block(sizeof head + body.size());
  std::memcpy(block.data(), &head, sizeof head);
  std::copy(body.begin(), body.end(), block.begin() + sizeof head);
  return block;
}

bool is_sound(const BlockHead& head) {
  if (head.magic != kBlockMagic || head.head_checksum != checksum_of_head(head)) return false;
  if (head.content == BlockContent::index) return true;
  return head.content == BlockContent::items && head.raw_bytes <= kMaxBlockBytes && head.body_bytes <= kMaxBlockBytes &&
         head.items <= kMaxBlockItems;
}

bool body_matches(const BlockHead& head, std::span<const std::byte> body) {
  return body.size() == head.body_bytes && checksum_of(body) == head.body_checksum;
}

namespace {

// Duration of a block: 1 s of sim time. Longer blocks compress better, but cost more in a seek and lose more by damage.
constexpr std::uint64_t kBlockTicks = 200;
// A block is full at half of the reader's limits. An item of more than kFullBytes has a block of its own. The reader
// accepts that block if the item has at most twice kFullBytes.
constexpr std::size_t kFullBytes = kMaxBlockBytes / 2;
constexpr std::size_t kFullItems = kMaxBlockItems / 2;

void append_bytes(std::vector<std::byte>& bytes, std::span<const std::byte> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

}  // namespace

bool BlockBuilder::is_full_for(const RecordParts& parts, std::optional<std::int64_t> tick) const {
  if (empty()) return false;
  if (raw_bytes_ + parts.fixed.size() + parts.tail.size() > kFullBytes || order_.size() >= kFullItems) return true;
  if (!tick || !first_tick_) return false;
  // True unless the tick is from 200 before to 199 after the first tick. Unsigned arithmetic is defined for any ticks.
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

std::vector<std::byte> BlockBuilder::take(Compressor& compressor) {
  std::vector<std::byte> body, coded;
  append_chunk({0, ChunkPart::order}, order_, compressor, body);
  for (const auto& [number, column] : columns_) {
    const RecordedKind& kind = *recorded_kind(number);
    if (column.records.empty()) continue;
    coded.clear();
    encode_columns(column.records, kind.bytes, coded);
    append_chunk({number, ChunkPart::records}, coded, compressor, body);
    if (kind.tail_bytes != nullptr) append_chunk({number, ChunkPart::tails}, column.tails, compressor, body);
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
  return block_bytes(head, body);
}

std::optional<BlockItems> BlockItems::decode(const BlockHead& head, std::span<const std::byte> body) {
  BlockItems block;
  auto order = take_chunk({0, ChunkPart::order}, head.items, body);
  if (!order || order->size() != head.items) return std::nullopt;
  block.order_ = std::move(*order);
  for (const std::byte number : block.order_) {
    const auto kind = std::to_integer<std::uint8_t>(number);
    Column& column = block.columns_[kind];
    if (column.count == 0) column.kind = recorded_kind(kind);
    if (column.kind == nullptr) return std::nullopt;
    ++column.count;
  }
  std::size_t remaining_bytes = head.raw_bytes;
  for (auto& [number, column] : block.columns_)
    if (!decode(column, remaining_bytes, body)) return std::nullopt;
  if (remaining_bytes != 0 || !body.empty()) return std::nullopt;
  return block;
}

bool BlockItems::decode(Column& column, std::size_t& remaining_bytes, std::span<const std::byte>& body) {
  const RecordedKind& kind = *column.kind;
  const std::size_t bytes = column.count * kind.bytes;
  if (bytes > remaining_bytes) return false;
  remaining_bytes -= bytes;
  // Upper bound of the coded size. Here a column is the 8-byte words at one offset of all records. The coding adds two
  // bytes for each column and pads the last word of each record.
  constexpr std::size_t kWord_bytes = 8;
  const std::size_t max_bytes = (column.count + 2) * (kind.bytes + kWord_bytes);
  const auto coded = take_chunk({kind.number, ChunkPart::records}, max_bytes, body);
  if (!coded || !decode_columns(*coded, column.count, kind.bytes, column.records)) return false;
  return kind.tail_bytes == nullptr || decode_tails(column, remaining_bytes, body);
}

bool BlockItems::decode_tails(Column& column, std::size_t& remaining_bytes, std::span<const std::byte>& body) {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < column.count; ++i) {
    column.tail_begins.push_back(bytes);
    bytes += column.kind->tail_bytes(std::span(column.records).subspan(i * column.kind->bytes, column.kind->bytes));
  }
  column.tail_begins.push_back(bytes);
  if (bytes > remaining_bytes) return false;
  remaining_bytes -= bytes;
  auto tails = take_chunk({column.kind->number, ChunkPart::tails}, bytes, body);
  if (!tails || tails->size() != bytes) return false;
  column.tails = std::move(*tails);
  return true;
}

RecordingItem BlockItems::item(const Column& column, std::size_t at) {
  RecordParts parts{std::span(column.records).subspan(at * column.kind->bytes, column.kind->bytes), {}};
  if (!column.tail_begins.empty())
    parts.tail =
        std::span(column.tails).subspan(column.tail_begins[at], column.tail_begins[at + 1] - column.tail_begins[at]);
  return column.kind->item_from(parts);
}

std::optional<RecordingItem> BlockItems::next() {
  if (at_ == order_.size()) return std::nullopt;
  Column& column = columns_[std::to_integer<std::uint8_t>(order_[at_++])];
  return item(column, column.at++);
}

std::optional<RecordingItem> BlockItems::last_of(std::uint8_t kind) const {
  const auto column = columns_.find(kind);
  if (column == columns_.end()) return std::nullopt;
  return item(column->second, column->second.count - 1);
}

}  // namespace yars::recording
