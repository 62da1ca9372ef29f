// Block of a recording: about 1 s of items. It is decoded without other blocks. Header, encoder and decoder.
// Format: a header of 56 bytes with checksums, then a body of chunks.
//   First chunk: the kind of each item, in the order of recording.
//   Further chunks: for each kind in order of its number, the records as columns, then their tails of variable size.
// Errors: a damaged block gives false or no value.
// Source: docs/recordings.md.
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

// Limits of a block of items. A block that exceeds one counts as damaged. They bound the memory of a reader.
inline constexpr std::size_t kMaxBlockBytes = std::size_t{8} << 20;  // [bytes] compressed, and also uncompressed
inline constexpr std::size_t kMaxBlockItems = std::size_t{1} << 14;

enum class BlockContent : std::uint32_t { items = 1, index = 2 };

struct BlockHead {
  std::array<char, 4> magic;
  BlockContent content;
  std::uint64_t kinds;  // bit n: the block has items of kind n
  std::int64_t first_tick, last_tick;
  std::uint32_t items;         // number of items; in an index: number of blocks
  std::uint32_t raw_bytes;     // [bytes] all records and tails before compression
  std::uint32_t packed_bytes;  // [bytes] the body
  std::uint32_t body_checksum;
  std::uint32_t reserved;
  std::uint32_t head_checksum;  // of the header's bytes before this field
};
static_assert(sizeof(BlockHead) == 56);

// Magic number: the first 4 bytes of a block.
std::string_view magic_of_blocks();

// Bytes of a block as stored in the file. Sets magic, packed_bytes and checksums of the header.
std::vector<std::byte> sealed(BlockHead head, std::span<const std::byte> body);

// True if magic number and header checksum are right and, for a block of items, its sizes are within the limits.
// The size of an index is limited only by the length of the file.
bool is_sound(const BlockHead& head);

// True if the body has the length and the checksum that the header gives.
bool belongs(const BlockHead& head, std::span<const std::byte> body);

// Encoder: collects items and compresses them into a block.
class BlockBuilder {
 public:
  // True if this item needs a new block: the block is full, or the item is 1 s or more from the first item with a tick.
  bool is_full_for(const RecordParts& parts, std::optional<std::int64_t> tick) const;
  void append(const RecordedKind& kind, const RecordParts& parts, std::optional<std::int64_t> tick);
  bool empty() const { return order_.empty(); }
  // Returns the block as stored in the file and empties the builder. last_tick() is kept: a next block without ticks
  // gets it.
  std::vector<std::byte> take(Packer& packer);

  std::uint64_t kinds() const { return kinds_; }  // bit n: the block has items of kind n
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

// Decoder: returns the items of a block in the order of recording.
class BlockItems {
 public:
  // Decodes a body whose checksum is right. None: it contradicts its header.
  // Memory: at most about kMaxBlockBytes each for body, columns and records.
  static std::optional<BlockItems> decode(const BlockHead& head, std::span<const std::byte> body);
  std::optional<RecordingItem> next();                            // none: all items have been returned
  std::optional<RecordingItem> last_of(std::uint8_t kind) const;  // last item of this kind in the block

 private:
  struct Column {
    const RecordedKind* kind = nullptr;
    std::size_t count = 0;
    std::vector<std::byte> records, tails;
    std::vector<std::size_t> tail_begins;  // [bytes] offsets in `tails`, one more than records; empty: no tails
    std::size_t at = 0;                    // index of the next record
  };
  static bool decode(Column& column, std::size_t& remaining_bytes, std::span<const std::byte>& body);
  static bool decode_tails(Column& column, std::size_t& remaining_bytes, std::span<const std::byte>& body);
  static RecordingItem item(const Column& column, std::size_t at);

  std::map<std::uint8_t, Column> columns_;  // by the kind's number
  std::vector<std::byte> order_;
  std::size_t at_ = 0;
};

}  // namespace yars::tools::recording
