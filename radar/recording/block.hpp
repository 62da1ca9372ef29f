// Block of a recording: the items of about 1 s of sim time, which can be decoded without other blocks. An item is one
// record. Its lossless compression: columnar delta coding, Zstandard, chunks and CRC-32 checksums.
// Format: a head of 56 bytes with checksums, then a body of chunks.
// First chunk: the kind of each item, in the order of recording.
// Other chunks, in ascending order of kind: the fixed-size records as columns, then their variable-size tails.
// Source: docs/recordings.md. Errors: for a damaged block or input the functions return false or nullopt.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "radar/recording/recorded_kinds.hpp"

namespace yars::recording {

// Zstandard compressor. All calls use one context (ZSTD_CCtx).
class Compressor {
 public:
  Compressor();
  // Appends the compressed form of `bytes` to `compressed`. Returns false and appends nothing if compression does
  // not make `bytes` shorter.
  bool compress(std::span<const std::byte> bytes, std::vector<std::byte>& compressed);

 private:
  struct Release {
    void operator()(void* tables) const;
  };
  std::unique_ptr<void, Release> tables_;
};

// Decompresses `compressed` into `bytes`. Returns false unless the result fills `bytes` exactly.
bool decompress(std::span<const std::byte> compressed, std::span<std::byte> bytes);

std::uint32_t checksum_of(std::span<const std::byte> bytes);  // CRC-32 of zlib (ISO 3309)

// Columnar coding of records of one size. Slowly varying values give residuals with few nonzero bytes.
// Column: the 8-byte words at the same offset of all records.
// Prediction: each word is extrapolated from the 1, 2 or 3 words before it in its column. A column has one order,
// which is this number of words.
// Residual: the prediction error modulo 2^64, zigzag coded: small errors of either sign become small unsigned numbers.
// The coding is exact for any bytes.
// Byte planes: plane n has byte n (weight 256^n) of all residuals of a column. Planes of zeros are omitted.
// Format, in this sequence: the first record; for each column one byte with its order and one byte with the planes
// present (bit n: plane n); the planes, column by column, with one byte for each record after the first.

// Appends the coded `records` to `coded`. `records`: complete records of `record_bytes` each, without padding between.
void encode_columns(std::span<const std::byte> records, std::size_t record_bytes, std::vector<std::byte>& coded);

// Decodes `count` records and appends them to `records`. Returns false and appends nothing if the length of `coded`
// does not match `count`, or if an order is not 1 to 3.
bool decode_columns(std::span<const std::byte> coded, std::size_t count, std::size_t record_bytes,
                    std::vector<std::byte>& records);

// A block's body is a series of chunks (block.hpp). A chunk's head has kind of record, part, compression, uncompressed
// size and stored size. The bytes follow the head, uncompressed if compression does not shorten them.
// What the bytes of a chunk are: kinds of the items in order, fixed-size records, tails, or the index of the file.
enum class ChunkPart : std::uint8_t { order = 0, records = 1, tails = 2, index = 3 };

struct ChunkName {
  std::uint8_t kind;  // 0 for `order` and `index`
  ChunkPart part;
};

// Compresses `bytes` and appends them to `body` as a chunk.
void append_chunk(ChunkName name, std::span<const std::byte> bytes, Compressor& compressor,
                  std::vector<std::byte>& body);

// Removes the chunk at the beginning of `body` and returns its decompressed bytes. nullopt if the chunk's name
// is not `name`, or if the chunk has more than `max_bytes` decompressed, or is incomplete or damaged.
std::optional<std::vector<std::byte>> take_chunk(ChunkName name, std::size_t max_bytes,
                                                 std::span<const std::byte>& body);

// Limits of a block of items. The reader treats a block beyond them as damaged, which bounds its memory.
inline constexpr std::size_t kMaxBlockBytes = std::size_t{8} << 20;  // 8 MiB; limit of raw_bytes and of body_bytes
inline constexpr std::size_t kMaxBlockItems = std::size_t{1} << 14;

enum class BlockContent : std::uint32_t { items = 1, index = 2 };  // index: table of the blocks, for seeking

struct BlockHead {
  std::array<char, 4> magic;
  BlockContent content;
  std::uint64_t kinds;                 // bit n: the block has items of kind n
  std::int64_t first_tick, last_tick;  // lowest, highest tick of the items; without ticks see BlockBuilder::take()
  std::uint32_t items;                 // number of items; in an index: number of blocks
  std::uint32_t raw_bytes;             // size of all records and tails before compression
  std::uint32_t body_bytes;            // size of all chunks as stored, with their heads
  std::uint32_t body_checksum;
  std::uint32_t reserved;
  std::uint32_t head_checksum;  // checksum of the bytes of the head before this field
};
static_assert(sizeof(BlockHead) == 56);

// The magic number: the first four bytes of a block.
std::string_view magic_of_blocks();

// Returns the block as stored in the file: the head with magic number, body_bytes and checksums set, then the body.
std::vector<std::byte> block_bytes(BlockHead head, std::span<const std::byte> body);

// True if magic number and head checksum are correct. A block of items must also be within the limits above; an
// index may have any size.
bool is_sound(const BlockHead& head);

// True if the body has the length and the checksum that the head states.
bool body_matches(const BlockHead& head, std::span<const std::byte> body);

// Encoder: collects items and compresses them into a block.
class BlockBuilder {
 public:
  // True if the item needs a new block: this block is full, or the item's tick is about 1 s or more away from the first
  // tick of this block. False if this block has no items.
  bool is_full_for(const RecordParts& parts, std::optional<std::int64_t> tick) const;
  void append(const RecordedKind& kind, const RecordParts& parts, std::optional<std::int64_t> tick);
  bool empty() const { return order_.empty(); }
  // Returns the block as stored in the file, and empties the builder. If no item of the next block has a tick,
  // that block's first and last tick are the last tick of this block.
  std::vector<std::byte> take(Compressor& compressor);

  std::uint64_t kinds() const { return kinds_; }  // bit n: the block has items of kind n
  std::int64_t first_tick() const { return first_tick_.value_or(last_tick_); }
  std::int64_t last_tick() const { return last_tick_; }

 private:
  struct Column {
    std::vector<std::byte> records, tails;
  };
  std::map<std::uint8_t, Column> columns_;  // key: number of the kind
  std::vector<std::byte> order_;            // kind of each item, in the order of recording
  std::uint64_t kinds_ = 0;
  std::optional<std::int64_t> first_tick_;
  std::int64_t last_tick_ = 0;
  std::size_t raw_bytes_ = 0;
};

// Decoder: iterates over the items of a block in the order of recording.
class BlockItems {
 public:
  // Decodes a body for which is_sound() and body_matches() are true. nullopt: the chunks are damaged or
  // do not match the head. Memory: at most about kMaxBlockBytes for each of body, coded columns and records.
  static std::optional<BlockItems> decode(const BlockHead& head, std::span<const std::byte> body);
  std::optional<RecordingItem> next();                            // nullopt: no further item
  std::optional<RecordingItem> last_of(std::uint8_t kind) const;  // last item of this kind in the block

 private:
  struct Column {
    const RecordedKind* kind = nullptr;
    std::size_t count = 0;
    std::vector<std::byte> records, tails;
    std::vector<std::size_t> tail_begins;  // offset of each tail, and end of the last; empty: kind without tails
    std::size_t at = 0;                    // index of the next record
  };
  static bool decode(Column& column, std::size_t& remaining_bytes, std::span<const std::byte>& body);
  static bool decode_tails(Column& column, std::size_t& remaining_bytes, std::span<const std::byte>& body);
  static RecordingItem item(const Column& column, std::size_t at);

  std::map<std::uint8_t, Column> columns_;  // key: number of the kind
  std::vector<std::byte> order_;
  std::size_t at_ = 0;
};

}  // namespace yars::recording
