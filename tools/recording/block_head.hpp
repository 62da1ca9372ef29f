// A block of a recording: about a second of it, that decodes alone. A head of fixed size with checksums, then a body of
// chunks: the order of the items (the number of a kind each), then of each kind inside, by number, its records as
// columns and their tails. The last block holds the index.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace yars::tools::recording {

inline constexpr std::size_t kMostBlockBytes = std::size_t{8} << 20;  // [bytes] unpacked, and packed: more is damage
inline constexpr std::size_t kMostBlockItems = std::size_t{1} << 14;

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

}  // namespace yars::tools::recording
