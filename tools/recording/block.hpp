// A block of a recording, about a second that decodes alone: head, encoder, decoder.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tools/recording/compression.hpp"
#include "tools/recording/recorded_kinds.hpp"

namespace yars::tools::recording {

// A block of a recording: about a second of it, that decodes alone. A head of fixed size with checksums, then a body of
// chunks: the order of the items (the number of a kind each), then of each kind inside, by number, its records as
// columns and their tails. The last block holds the index.
inline constexpr std::size_t kMaxBlockBytes = std::size_t{8} << 20;  // [bytes] unpacked, and packed: more is damage
inline constexpr std::size_t kMaxBlockItems = std::size_t{1} << 14;

enum class BlockContent : std::uint32_t { items = 1, index = 2 };

struct BlockHead {
  std::array<char, 4> magic;
  BlockContent content;
  std::uint64_t kinds;  // bit n: kind n is inside
  std::int64_t first_tick, last_tick;
  std::uint32_t items;         // of an index: blocks
  std::uint32_t raw_bytes;     // of all records and tails before they are packed
  std::uint32_t packed_bytes;  // of the body
  std::uint32_t body_checksum;
  std::uint32_t reserved;
  std::uint32_t head_checksum;  // of the head up to here
};
static_assert(sizeof(BlockHead) == 56);

// The first bytes of a block.
std::string_view magic_of_blocks();

// Head and body as they go into the file: fills magic, packed_bytes and checksums in.
std::vector<std::byte> sealed(BlockHead head, std::span<const std::byte> body);

// Whether magic and checksum are a block's, and sizes within the limits of one of items. An index is as long as the
// file bears out.
bool is_sound(const BlockHead& head);

// Whether the body has the length and the checksum that the head tells.
bool belongs(const BlockHead& head, std::span<const std::byte> body);

// Gathers the items of a block until it is written.
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

// The items of a block, in the order in which they were recorded.
class BlockItems {
 public:
  // Nothing when the body is not what its head says, though its checksum is right. Takes at most some
  // kMaxBlockBytes of memory for each of body, columns and records.
  static std::optional<BlockItems> decode(const BlockHead& head, std::span<const std::byte> body);
  std::optional<RecordingItem> next();
  std::optional<RecordingItem> last_of(std::uint8_t kind) const;  // the block's last item of this kind

 private:
  struct Column {
    const RecordedKind* kind = nullptr;
    std::size_t count = 0;
    std::vector<std::byte> records, tails;
    std::vector<std::size_t> tail_begins;  // one more than records; empty: no tails
    std::size_t at = 0;
  };
  static bool decode(Column& column, std::size_t& left, std::span<const std::byte>& body);
  static bool decode_tails(Column& column, std::size_t& left, std::span<const std::byte>& body);
  static RecordingItem item(const Column& column, std::size_t at);

  std::map<std::uint8_t, Column> columns_;  // by the kind's number
  std::vector<std::byte> order_;
  std::size_t at_ = 0;
};

}  // namespace yars::tools::recording
