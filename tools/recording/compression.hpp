// Lossless compression of a recording: columns of differences, Zstandard, chunks, CRC-32 checksums.
// Source: docs/recordings.md. Errors: functions that decode return false or no value for damaged input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace yars::tools::recording {

// Zstandard compressor. Reuses its tables in all calls.
class Packer {
 public:
  Packer();
  // Appends the compressed `bytes` to `packed`. Returns false and appends nothing when they would not be shorter.
  bool pack(std::span<const std::byte> bytes, std::vector<std::byte>& packed);

 private:
  struct Release {
    void operator()(void* tables) const;
  };
  std::unique_ptr<void, Release> tables_;
};

// Decompresses `packed` into `bytes`. Returns false unless it fills `bytes` exactly. Writes only within `bytes`.
bool unpack(std::span<const std::byte> packed, std::span<std::byte> bytes);

std::uint32_t checksum_of(std::span<const std::byte> bytes);  // CRC-32, polynomial of zlib

// Column coding of records of one size: slowly varying values become zeros, which Zstandard packs well.
// Each 8-byte word of a record is a column. A word is predicted from one to three words before it in its column (order
// 1 to 3). The prediction error, zigzag coded, is split into planes of bytes of equal weight. Planes of zeros are
// omitted. Arithmetic is modulo 2^64, so any bytes decode exactly.
// Format: the first record, then for each word a byte with the order and a byte with the planes (bit n: bytes of weight
// 256^n). The planes follow, with one byte for each record after the first.

// `records`: whole records of `record_bytes` each, without padding between them. Appends to `coded`.
void encode_columns(std::span<const std::byte> records, std::size_t record_bytes, std::vector<std::byte>& coded);

// Appends `count` records to `records`. Returns false and appends nothing when the length or an order of `coded` is not
// valid for this number of records.
bool decode_columns(std::span<const std::byte> coded, std::size_t count, std::size_t record_bytes,
                    std::vector<std::byte>& records);

// A chunk is a part of a block's body: a head with kind, part, raw size and packed size, then the bytes. They are
// stored unpacked where packing does not make them shorter.
enum class ChunkPart : std::uint8_t { order = 0, records = 1, tails = 2, index = 3 };

struct ChunkName {
  std::uint8_t kind;  // 0 for `order` and `index`
  ChunkPart part;
};

// Packs `bytes` and appends the chunk to `body`.
void append_chunk(ChunkName name, std::span<const std::byte> bytes, Packer& packer, std::vector<std::byte>& body);

// Unpacks the chunk at the begin of `body` and removes it from `body`. None when it has another name, is longer than
// `max_bytes` unpacked, or is incomplete or damaged.
std::optional<std::vector<std::byte>> take_chunk(ChunkName name, std::size_t max_bytes,
                                                 std::span<const std::byte>& body);

}  // namespace yars::tools::recording
