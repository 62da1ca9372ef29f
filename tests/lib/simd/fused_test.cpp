// Multiply-add with one rounding (lib/simd/fused-inl.hpp): each vector target against std::fma.
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/lib/simd/fused_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// After highway.h, which defines the vector target.
#include "lib/simd/fused-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::fused_test::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace fused = yars::simd::HWY_NAMESPACE;

// Writes `count` values each of a * b + c, then of c - a * b, then of a * b - c. `count` is a multiple of 16.
template <class Number>
HWY_INLINE void all_three(std::size_t count, const Number* a, const Number* b, const Number* c, Number* results) {
  const hn::CappedTag<Number, 16> d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto x = hn::LoadU(d, a + i);
    const auto y = hn::LoadU(d, b + i);
    const auto z = hn::LoadU(d, c + i);
    hn::StoreU(fused::mul_add(x, y, z), d, results + i);
    hn::StoreU(fused::neg_mul_add(x, y, z), d, results + count + i);
    hn::StoreU(fused::mul_sub(x, y, z), d, results + 2 * count + i);
  }
}
void floats(std::size_t count, const float* a, const float* b, const float* c, float* results) {
  all_three(count, a, b, c, results);
}
void doubles(std::size_t count, const double* a, const double* b, const double* c, double* results) {
  all_three(count, a, b, c, results);
}

}  // namespace yars::fused_test::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <gtest/gtest.h>

#include "tests/lib/simd/vector_targets.hpp"

namespace yars::fused_test {
namespace {

HWY_EXPORT(floats);
HWY_EXPORT(doubles);

template <class Number>
struct Triples {
  std::vector<Number> a, b, c;
  void add(Number x, Number y, Number z) {
    a.push_back(x);
    b.push_back(y);
    c.push_back(z);
  }
  // Pads to a multiple of 16, the largest number of lanes.
  void pad() {
    while (a.size() % 16 != 0) add(1, 1, 1);
  }
};

// All triples of 14 special values: zeros, ones, subnormal, largest, infinite, NaN.
template <class Number>
Triples<Number> special_triples() {
  using Limits = std::numeric_limits<Number>;
  const std::array<Number, 14> values{0,
                                      -Number{0},
                                      1,
                                      -1,
                                      Number{1} + Limits::epsilon(),
                                      Number{1} - Limits::epsilon() / 2,
                                      Limits::min(),
                                      -Limits::denorm_min(),
                                      Limits::min() * Number(1.5),
                                      Limits::max(),
                                      -Limits::max(),
                                      Limits::infinity(),
                                      -Limits::infinity(),
                                      Limits::quiet_NaN()};
  Triples<Number> triples;
  for (const Number x : values)
    for (const Number y : values)
      for (const Number z : values) triples.add(x, y, z);
  return triples;
}

// Equal value and sign, or both NaN.
bool same(auto one, auto other) {
  return (std::isnan(one) && std::isnan(other)) || (one == other && std::signbit(one) == std::signbit(other));
}

template <class Number, class Action>
void expect_rounded_once(const Triples<Number>& triples, const Action& all_three) {
  const std::size_t count = triples.a.size();
  std::vector<Number> results(3 * count);
  test::for_each_vector_target([&](const char* target) {
    all_three(count, triples.a.data(), triples.b.data(), triples.c.data(), results.data());
    for (std::size_t i = 0; i < count; ++i) {
      const Number x = triples.a[i], y = triples.b[i], z = triples.c[i];
      ASSERT_TRUE(same(results[i], std::fma(x, y, z))) << target << ' ' << x << ' ' << y << ' ' << z;
      ASSERT_TRUE(same(results[count + i], std::fma(-x, y, z))) << target << ' ' << x << ' ' << y << ' ' << z;
      ASSERT_TRUE(same(results[2 * count + i], std::fma(x, y, -z))) << target << ' ' << x << ' ' << y << ' ' << z;
    }
  });
}

void expect_floats(const Triples<float>& triples) {
  expect_rounded_once(triples, [](auto... arguments) { HWY_DYNAMIC_DISPATCH(floats)(arguments...); });
}

TEST(Fused, RoundsAnyFloatsOnceOnEveryTarget) {
  std::mt19937 random(1);
  Triples<float> triples = special_triples<float>();
  for (int i = 0; i < 100000; ++i)
    triples.add(std::bit_cast<float>(static_cast<std::uint32_t>(random())),
                std::bit_cast<float>(static_cast<std::uint32_t>(random())),
                std::bit_cast<float>(static_cast<std::uint32_t>(random())));
  triples.pad();
  expect_floats(triples);
}

// Cases in which rounding to double and then to float gives a wrong result: the product lies half-way between two
// floats, and the addend is small.
TEST(Fused, RoundsHalfWayCasesOnceOnEveryTarget) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> bits(0, 0xfff);
  Triples<float> triples;
  for (int i = 0; i < 20000; ++i) {
    const float x = 1.0F + static_cast<float>(bits(random)) * 0x1p-12F;
    const float y = 1.0F + static_cast<float>(bits(random) | 1) * 0x1p-12F;
    const float small = std::ldexp(static_cast<float>(bits(random) - 2048), -90);
    triples.add(x, y, small);
    triples.add(x * 0x1p-80F, y * 0x1p-68F, small * 0x1p-50F);  // product in the subnormal range
  }
  triples.pad();
  expect_floats(triples);
}

TEST(Fused, RoundsDoublesOnceOnEveryTarget) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  Triples<double> triples = special_triples<double>();
  for (int i = 0; i < 20000; ++i) triples.add(normal(random), normal(random), normal(random));
  triples.pad();
  expect_rounded_once(triples, [](auto... arguments) { HWY_DYNAMIC_DISPATCH(doubles)(arguments...); });
}

}  // namespace
}  // namespace yars::fused_test
#endif  // HWY_ONCE
