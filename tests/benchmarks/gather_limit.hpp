// What the machine gives for terrain look-ups and nothing else: two paired 32-bit gathers a sample along the rays of a
// scan, by the widest vectors that the machine has. The ruler for the samples a second of the algorithms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace yars::benchmarks {

// Reads for every offset the words at it and one row further; each word holds two neighbouring posts of 16 bits.
// Returns a sum that depends on all of them. Offsets + row stay inside the words; their number is a multiple of 16.
std::uint32_t gather_pairs(std::span<const std::uint32_t> words, std::span<const std::int32_t> offsets,
                           std::int32_t row);

// "avx512f", "avx2" or "scalar": what gather_pairs() uses here.
std::string_view gather_width();

}  // namespace yars::benchmarks
