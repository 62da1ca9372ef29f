// A part of a block's body: what kind and part, sizes raw and packed, then the bytes, packed, or as they are where
// packing does not gain.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tools/recording/packing.hpp"

namespace yars::tools::recording {

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
