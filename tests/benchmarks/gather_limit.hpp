// Upper limit of terrain sampling on this machine: the rate of two 32-bit gathers per sample along the rays of a scan.
// A gather is a SIMD load from scattered addresses, here with the widest vectors available. Benchmarks compare the
// samples per second of the algorithms with this limit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace yars::benchmarks {

// Reads two words of 32 bits per entry: posts[entry] with posts[entry + 1], and the same two posts `row` further.
// All these posts must exist; the number of entries is a multiple of 16. Returns the sum of all words, modulo 2^32.
std::uint32_t gather_pairs(const std::int16_t* posts, std::span<const std::int32_t> entries, std::int32_t row);

// Instruction set that gather_pairs() uses on this machine: "avx512f", "avx2" or "scalar".
std::string_view gather_width();

}  // namespace yars::benchmarks
