// Modifies a well-formed file by the fuzzer's input, so that a reader gets past the file's header.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace yars::fuzz {

// The input consists of pieces of (offset in two bytes, length, bytes). Each piece overwrites `length` bytes of the
// file, beginning at `offset` times `step` modulo the file's size.
inline void lay_pieces(std::vector<std::byte>& file, std::span<const std::uint8_t> input, std::size_t step = 1) {
  while (input.size() >= 3 && !file.empty()) {
    const std::size_t offset = (input[0] * 256U + input[1]) * step % file.size();
    const std::size_t length = std::min({std::size_t{input[2]}, input.size() - 3, file.size() - offset});
    if (length > 0) std::memcpy(file.data() + offset, input.data() + 3, length);
    input = input.subspan(3 + length);
  }
}

}  // namespace yars::fuzz
