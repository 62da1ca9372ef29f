// Lossless compression of a recording: columnar delta coding, Zstandard, chunks and CRC-32 checksums.
// Source: docs/recordings.md. Errors: for damaged input the decoding functions return false or nullopt.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

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

}  // namespace yars::recording
