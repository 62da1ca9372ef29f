#include "tools/recording/block_items.hpp"

#include "tools/recording/chunk.hpp"
#include "tools/recording/columns.hpp"

namespace yars::tools::recording {

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
  std::size_t left = head.raw_bytes;
  for (auto& [number, column] : block.columns_)
    if (!decode(column, left, body)) return std::nullopt;
  if (left != 0 || !body.empty()) return std::nullopt;
  return block;
}

bool BlockItems::decode(Column& column, std::size_t& left, std::span<const std::byte>& body) {
  const RecordedKind& kind = *column.kind;
  const std::size_t bytes = column.count * kind.bytes;
  if (bytes > left) return false;
  left -= bytes;
  // Columns are longer than records at most by what describes them, and by the rest of a last word.
  constexpr std::size_t kWord = 8;
  const std::size_t most = (column.count + 2) * (kind.bytes + kWord);
  const auto coded = take_chunk({kind.number, ChunkPart::records}, most, body);
  if (!coded || !decode_columns(*coded, column.count, kind.bytes, column.records)) return false;
  return kind.tail_bytes == nullptr || decode_tails(column, left, body);
}

bool BlockItems::decode_tails(Column& column, std::size_t& left, std::span<const std::byte>& body) {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < column.count; ++i) {
    column.tail_begins.push_back(bytes);
    bytes += column.kind->tail_bytes(std::span(column.records).subspan(i * column.kind->bytes, column.kind->bytes));
  }
  column.tail_begins.push_back(bytes);
  if (bytes > left) return false;
  left -= bytes;
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

}  // namespace yars::tools::recording
