// What the machine gives for terrain look-ups and nothing else: two paired 32-bit gathers a sample along the rays of a
// scan, by the widest vectors that the machine has. The ruler for the samples a second of the algorithms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace yars::benchmarks {

// Reads for every entry the pair of posts at it and the pair `row` entries further, each pair as one word of 32 bits.
// All must lie within the posts; the number of entries is a multiple of 16. Returns a sum that depends on all of them.
std::uint32_t gather_pairs(const std::int16_t* posts, std::span<const std::int32_t> entries, std::int32_t row);

// "avx512f", "avx2" or "scalar": what gather_pairs() uses here.
std::string_view gather_width();

}  // namespace yars::benchmarks
