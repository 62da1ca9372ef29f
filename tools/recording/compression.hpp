// Lossless compression of a recording: Zstandard, columns of differences, chunks, checksums.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace yars::tools::recording {

// Lossless packing (Zstandard) and checksums (CRC-32) of the parts of a recording.

// Keeps its tables from one call to the next.
class Packer {
 public:
  Packer();
  // Appends what packs `bytes`; false, and nothing is appended, when that would not be shorter.
  bool pack(std::span<const std::byte> bytes, std::vector<std::byte>& packed);

 private:
  struct Release {
    void operator()(void* tables) const;
  };
  std::unique_ptr<void, Release> tables_;
};

// Fills `bytes` from `packed`; false when it unpacks to anything but as many bytes. Takes no memory that `bytes` has
// not.
bool unpack(std::span<const std::byte> packed, std::span<std::byte> bytes);

std::uint32_t checksum_of(std::span<const std::byte> bytes);

// Records of one size as columns: what hardly changes from record to record becomes zeros, and zeros pack to nothing.
// Each 8-byte word of a record is a column. The first record stands whole; of each later word stands what a straight
// line, or a curve of second order, through the words before misses (integers that wrap: nothing is lost, whatever the
// bytes mean), cut into planes of bytes of equal weight; planes of zeros are left out.
// Form: the first record; for each word a byte with the order of its differences (1..3) and a byte with its planes (bit
// n: bytes of weight 256^n); then the planes, each of one byte for each later record.

// `records`: whole ones of `record_bytes`, one behind the other. Appends to `coded`.
void encode_columns(std::span<const std::byte> records, std::size_t record_bytes, std::vector<std::byte>& coded);

// Appends `count` records to `records`; false, and nothing is appended, when `coded` is not what this many records
// encode to.
bool decode_columns(std::span<const std::byte> coded, std::size_t count, std::size_t record_bytes,
                    std::vector<std::byte>& records);

// A part of a block's body: what kind and part, sizes raw and packed, then the bytes, packed, or as they are where
// packing does not gain.
enum class ChunkPart : std::uint8_t { order = 0, records = 1, tails = 2, index = 3 };

struct ChunkName {
  std::uint8_t kind;  // 0 where the part is of no kind
  ChunkPart part;
};

// Appends to `body`.
void append_chunk(ChunkName name, std::span<const std::byte> bytes, Packer& packer, std::vector<std::byte>& body);

// The chunk at the begin of `body`, unpacked; `body` then begins behind it. Nothing when it is another one, longer than
// `most` bytes unpacked, or not whole.
std::optional<std::vector<std::byte>> take_chunk(ChunkName name, std::size_t most, std::span<const std::byte>& body);

}  // namespace yars::tools::recording
