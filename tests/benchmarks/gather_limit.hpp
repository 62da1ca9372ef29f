// Upper limit of terrain sampling on this machine: two paired 32-bit gathers per sample along the rays of a scan, with
// the widest vectors available. Benchmarks compare the algorithms' samples per second with it.
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
