// Block of a recording: about one second of items that decodes without other blocks. Head, encoder and decoder.
// Format: a head of 56 bytes with checksums, then a body of chunks. The first chunk has the kind of each item in their
// order. Then follow, for each kind by number, its records as columns and their tails. Source: docs/recordings.md.
// Errors: a damaged block is reported by false or no value.
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

// Limits on reading a block of items; a block with more counts as damaged. They bound the memory of a reader.
inline constexpr std::size_t kMaxBlockBytes = std::size_t{8} << 20;  // [bytes] packed, and also unpacked
inline constexpr std::size_t kMaxBlockItems = std::size_t{1} << 14;

enum class BlockContent : std::uint32_t { items = 1, index = 2 };

struct BlockHead {
  std::array<char, 4> magic;
  BlockContent content;
  std::uint64_t kinds;  // bit n: the block has items of kind n
  std::int64_t first_tick, last_tick;
  std::uint32_t items;         // number of items; in an index: number of blocks
  std::uint32_t raw_bytes;     // all records and tails before packing
  std::uint32_t packed_bytes;  // the body
  std::uint32_t body_checksum;
  std::uint32_t reserved;
  std::uint32_t head_checksum;  // of the bytes of the head before this field
};
static_assert(sizeof(BlockHead) == 56);

// The first bytes of a block.
std::string_view magic_of_blocks();

// Head and body as stored in the file. Fills in magic, packed_bytes and checksums.
std::vector<std::byte> sealed(BlockHead head, std::span<const std::byte> body);

// Whether magic and checksum are right and, for a block of items, the sizes are within the limits. The size of an index
// is limited only by the length of the file.
bool is_sound(const BlockHead& head);

// Whether the body has the length and the checksum given in the head.
bool belongs(const BlockHead& head, std::span<const std::byte> body);

// Encoder: collects items and packs them into a block.
class BlockBuilder {
 public:
  // Whether this item needs a new block: it is a second or more from the first one in time, or the block is full.
  bool is_full_for(const RecordParts& parts, std::optional<std::int64_t> tick) const;
  void append(const RecordedKind& kind, const RecordParts& parts, std::optional<std::int64_t> tick);
  bool empty() const { return order_.empty(); }
  // Returns the block as stored in the file and empties the builder. If the next block has no item with a tick, it gets
  // the last tick of this block.
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
  // None when the body contradicts its head although its checksum is right. Memory: at most about kMaxBlockBytes for
  // each of body, columns and records.
  static std::optional<BlockItems> decode(const BlockHead& head, std::span<const std::byte> body);
  std::optional<RecordingItem> next();
  std::optional<RecordingItem> last_of(std::uint8_t kind) const;  // last item of this kind in the block

 private:
  struct Column {
    const RecordedKind* kind = nullptr;
    std::size_t count = 0;
    std::vector<std::byte> records, tails;
    std::vector<std::size_t> tail_begins;  // offsets, one more than records; empty: no tails
    std::size_t at = 0;                    // next record
  };
  static bool decode(Column& column, std::size_t& remaining_bytes, std::span<const std::byte>& body);
  static bool decode_tails(Column& column, std::size_t& remaining_bytes, std::span<const std::byte>& body);
  static RecordingItem item(const Column& column, std::size_t at);

  std::map<std::uint8_t, Column> columns_;  // by the kind's number
  std::vector<std::byte> order_;
  std::size_t at_ = 0;
};

}  // namespace yars::tools::recording
