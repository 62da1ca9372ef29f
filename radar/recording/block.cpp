#include "radar/recording/block.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>

namespace yars::recording {

namespace {
// Zstandard level. Level 5 takes twice the time of level 3 and makes a recording 1.6 % smaller. zlib at its best level
// also makes it 1.6 % smaller, but takes ten times as long as level 3.
constexpr int kLevel = 3;
}  // namespace

void Compressor::Release::operator()(void* tables) const {
  ZSTD_freeCCtx(static_cast<ZSTD_CCtx*>(tables));
}

Compressor::Compressor() : tables_(ZSTD_createCCtx()) {}

bool Compressor::compress(std::span<const std::byte> bytes, std::vector<std::byte>& compressed) {
  const std::size_t begin = compressed.size();
  compressed.resize(begin + bytes.size());
  const std::size_t size = ZSTD_compressCCtx(static_cast<ZSTD_CCtx*>(tables_.get()), compressed.data() + begin,
                                             bytes.size(), bytes.data(), bytes.size(), kLevel);
  const bool gains = ZSTD_isError(size) == 0U && size < bytes.size();
  compressed.resize(gains ? begin + size : begin);
  return gains;
}

bool decompress(std::span<const std::byte> compressed, std::span<std::byte> bytes) {
  struct Release {
    void operator()(ZSTD_DCtx* tables) const { ZSTD_freeDCtx(tables); }
  };
  // To make the tables for each piece would take longer than to decompress a piece.
  thread_local const std::unique_ptr<ZSTD_DCtx, Release> tables(ZSTD_createDCtx());
  return tables && ZSTD_decompressDCtx(tables.get(), bytes.data(), bytes.size(), compressed.data(),
                                       compressed.size()) == bytes.size();
}

std::uint32_t checksum_of(std::span<const std::byte> bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

namespace {

using Word = std::uint64_t;
constexpr std::size_t kWord = sizeof(Word);  // [bytes]
constexpr std::size_t kMaxOrder = 3;

std::size_t words_in(std::size_t record_bytes) {
  return (record_bytes + kWord - 1) / kWord;
}

// Word `word` of a record. If the record ends within the word, the missing bytes are zero.
Word load(const std::byte* record, std::size_t word, std::size_t record_bytes) {
  Word value = 0;
  std::memcpy(&value, record + word * kWord, std::min(kWord, record_bytes - word * kWord));
  return value;
}

void store(std::byte* record, std::size_t word, std::size_t record_bytes, Word value) {
  std::memcpy(record + word * kWord, &value, std::min(kWord, record_bytes - word * kWord));
}

// Prediction of the word at `at`, which is 1 or more: the polynomial through the last `order` words before `at`,
// extrapolated. If fewer words precede `at`, the polynomial goes through all of them.
Word predicted(std::span<const Word> column, std::size_t at, std::size_t order) {
  switch (std::min(order, at)) {
    case 1:
      return column[at - 1];
    case 2:
      return 2 * column[at - 1] - column[at - 2];
    default:
      return 3 * (column[at - 1] - column[at - 2]) + column[at - 3];
  }
}

// Zigzag coding: 0, -1, 1, -2 ... become 0, 1, 2, 3 .... The high bytes of small differences are then zero.
Word zigzag_encoded(Word difference) {
  return (difference << 1U) ^ (0 - (difference >> 63U));
}
Word zigzag_decoded(Word value) {
  return (value >> 1U) ^ (0 - (value & 1U));
}

// The order (1 to 3) whose zigzag-coded prediction errors have the smallest total number of significant bits.
std::size_t best_order(std::span<const Word> column) {
  std::size_t best = 1, min_bits = SIZE_MAX;
  for (std::size_t order = 1; order <= kMaxOrder; ++order) {
    std::size_t bits = 0;
    for (std::size_t at = 1; at < column.size(); ++at)
      bits += static_cast<std::size_t>(std::bit_width(zigzag_encoded(column[at] - predicted(column, at, order))));
    if (bits < min_bits) {
      min_bits = bits;
      best = order;
    }
  }
  return best;
}

// Replaces each value of a column after the first by its zigzag-coded prediction error.
void take_differences(std::span<Word> column, std::size_t order) {
  for (std::size_t at = column.size() - 1; at > 0; --at)
    column[at] = zigzag_encoded(column[at] - predicted(column, at, order));
}

}  // namespace

void encode_columns(std::span<const std::byte> records, std::size_t record_bytes, std::vector<std::byte>& coded) {
  const std::size_t count = records.size() / record_bytes;
  if (count == 0) return;
  coded.insert(coded.end(), records.begin(), records.begin() + static_cast<std::ptrdiff_t>(record_bytes));
  const std::size_t words = words_in(record_bytes);
  std::size_t descriptor_at = coded.size();
  coded.resize(descriptor_at + 2 * words);
  std::vector<Word> column(count);
  for (std::size_t word = 0; word < words; ++word) {
    for (std::size_t i = 0; i < count; ++i) column[i] = load(records.data() + i * record_bytes, word, record_bytes);
    const std::size_t order = best_order(column);
    take_differences(column, order);
    Word all_bits = 0;
    for (std::size_t i = 1; i < count; ++i) all_bits |= column[i];
    unsigned planes = 0;
    for (unsigned plane = 0; plane < kWord; ++plane) {
      if ((all_bits >> (8U * plane) & 0xffU) == 0) continue;
      planes |= 1U << plane;
      for (std::size_t i = 1; i < count; ++i) coded.push_back(static_cast<std::byte>(column[i] >> (8U * plane)));
    }
    coded[descriptor_at++] = static_cast<std::byte>(order);
    coded[descriptor_at++] = static_cast<std::byte>(planes);
  }
}

bool decode_columns(std::span<const std::byte> coded, std::size_t count, std::size_t record_bytes,
                    std::vector<std::byte>& records) {
  if (count == 0) return coded.empty();
  const std::size_t words = words_in(record_bytes);
  if (coded.size() < record_bytes + 2 * words) return false;
  const auto orders_and_planes = coded.subspan(record_bytes, 2 * words);
  std::size_t total_planes = 0;
  for (std::size_t word = 0; word < words; ++word) {
    const auto order = std::to_integer<std::size_t>(orders_and_planes[2 * word]);
    if (order < 1 || order > kMaxOrder) return false;
    total_planes += static_cast<std::size_t>(std::popcount(std::to_integer<unsigned>(orders_and_planes[2 * word + 1])));
  }
  if (coded.size() != record_bytes + 2 * words + total_planes * (count - 1)) return false;

  const std::size_t begin = records.size();
  records.resize(begin + count * record_bytes);
  std::byte* const first = records.data() + begin;
  const std::byte* plane_bytes = orders_and_planes.data() + orders_and_planes.size();
  std::vector<Word> column(count);
  for (std::size_t word = 0; word < words; ++word) {
    const auto order = std::to_integer<std::size_t>(orders_and_planes[2 * word]);
    const auto planes = std::to_integer<unsigned>(orders_and_planes[2 * word + 1]);
    std::fill(column.begin(), column.end(), 0);
    column[0] = load(coded.data(), word, record_bytes);
    for (unsigned plane = 0; plane < kWord; ++plane) {
      if ((planes >> plane & 1U) == 0) continue;
      for (std::size_t i = 1; i < count; ++i) column[i] |= std::to_integer<Word>(*plane_bytes++) << (8U * plane);
    }
    for (std::size_t at = 1; at < count; ++at) column[at] = zigzag_decoded(column[at]) + predicted(column, at, order);
    for (std::size_t i = 0; i < count; ++i) store(first + i * record_bytes, word, record_bytes, column[i]);
  }
  return true;
}

namespace {

enum class Compression : std::uint8_t { none = 0, zstd = 1 };

struct ChunkHead {
  std::uint8_t kind;
  ChunkPart part;
  Compression compression;
  std::uint8_t reserved;
  std::uint32_t raw_bytes;
  std::uint32_t stored_bytes;
};
static_assert(sizeof(ChunkHead) == 12);

}  // namespace

void append_chunk(ChunkName name, std::span<const std::byte> bytes, Compressor& compressor,
                  std::vector<std::byte>& body) {
  ChunkHead head{name.kind, name.part, Compression::zstd, 0, static_cast<std::uint32_t>(bytes.size()), 0};
  const std::size_t begin = body.size();
  body.resize(begin + sizeof head);
  if (!compressor.compress(bytes, body)) {
    head.compression = Compression::none;
    body.insert(body.end(), bytes.begin(), bytes.end());
  }
  head.stored_bytes = static_cast<std::uint32_t>(body.size() - begin - sizeof head);
  std::memcpy(body.data() + begin, &head, sizeof head);
}

std::optional<std::vector<std::byte>> take_chunk(ChunkName name, std::size_t max_bytes,
                                                 std::span<const std::byte>& body) {
  ChunkHead head{};
  if (body.size() < sizeof head) return std::nullopt;
  std::memcpy(&head, body.data(), sizeof head);
  if (head.kind != name.kind || head.part != name.part || head.raw_bytes > max_bytes) return std::nullopt;
  if (head.stored_bytes > body.size() - sizeof head) return std::nullopt;
  const auto stored = body.subspan(sizeof head, head.stored_bytes);
  body = body.subspan(sizeof head + head.stored_bytes);
  if (head.compression == Compression::none) {
    if (head.stored_bytes != head.raw_bytes) return std::nullopt;
    return std::vector<std::byte>(stored.begin(), stored.end());
  }
  std::vector<std::byte> bytes(head.raw_bytes);
  if (head.compression != Compression::zstd || !decompress(stored, bytes)) return std::nullopt;
  return bytes;
}

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
