#include "tests/benchmarks/gather_limit.hpp"

#include <immintrin.h>

#include <array>
#include <cstring>

namespace yars::benchmarks {

namespace {

__attribute__((target("avx512f"))) std::uint32_t gather_512(const std::int16_t* posts,
                                                            std::span<const std::int32_t> offsets, std::int32_t row) {
  __m512i sum = _mm512_setzero_si512();
  const __m512i below = _mm512_set1_epi32(row);
  for (std::size_t i = 0; i + 16 <= offsets.size(); i += 16) {
    const __m512i offset = _mm512_loadu_si512(offsets.data() + i);
    const __m512i upper = _mm512_i32gather_epi32(offset, posts, 2);
    const __m512i lower = _mm512_i32gather_epi32(_mm512_add_epi32(offset, below), posts, 2);
    sum = _mm512_add_epi32(sum, _mm512_add_epi32(upper, lower));
  }
  std::array<std::uint32_t, 16> lanes{};
  _mm512_storeu_si512(lanes.data(), sum);
  std::uint32_t total = 0;
  for (const std::uint32_t lane : lanes) total += lane;
  return total;
}

__attribute__((target("avx2"))) std::uint32_t gather_256(const std::int16_t* posts,
                                                         std::span<const std::int32_t> offsets, std::int32_t row) {
  __m256i sum = _mm256_setzero_si256();
  const __m256i below = _mm256_set1_epi32(row);
  const auto* base = reinterpret_cast<const int*>(posts);
  for (std::size_t i = 0; i + 8 <= offsets.size(); i += 8) {
    const __m256i offset = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(offsets.data() + i));
    const __m256i upper = _mm256_i32gather_epi32(base, offset, 2);
    const __m256i lower = _mm256_i32gather_epi32(base, _mm256_add_epi32(offset, below), 2);
    sum = _mm256_add_epi32(sum, _mm256_add_epi32(upper, lower));
  }
  std::array<std::uint32_t, 8> lanes{};
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(lanes.data()), sum);
  std::uint32_t total = 0;
  for (const std::uint32_t lane : lanes) total += lane;
  return total;
}

std::uint32_t gather_scalar(const std::int16_t* posts, std::span<const std::int32_t> offsets, std::int32_t row) {
  std::uint32_t total = 0;
  for (const std::int32_t offset : offsets) {
    for (const std::int32_t entry : {offset, offset + row}) {
      std::uint32_t word = 0;
      std::memcpy(&word, posts + entry, sizeof word);
      total += word;
    }
  }
  return total;
}

}  // namespace

std::uint32_t gather_pairs(const std::int16_t* posts, std::span<const std::int32_t> entries, std::int32_t row) {
  if (__builtin_cpu_supports("avx512f")) return gather_512(posts, entries, row);
  if (__builtin_cpu_supports("avx2")) return gather_256(posts, entries, row);
  return gather_scalar(posts, entries, row);
}

std::string_view gather_width() {
  if (__builtin_cpu_supports("avx512f")) return "avx512f";
  return __builtin_cpu_supports("avx2") ? "avx2" : "scalar";
}

}  // namespace yars::benchmarks
