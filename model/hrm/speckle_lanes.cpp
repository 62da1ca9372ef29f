#include "model/hrm/speckle_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/speckle_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind highway.h, or it would have no target yet.
#include "model/rbm/polynomials-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace polynomials = rbm::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;
using SignedTag = hn::RebindToSigned<Tag>;
using BitsTag = hn::RebindToUnsigned<Tag>;
using Floats = hn::Vec<Tag>;

constexpr float kLn2 = 0.693147181F;

// noise_bits() of rbm/noise.hpp for a vector of cells, draw 0.
HWY_INLINE hn::Vec<BitsTag> random_bits(rbm::NoiseState state, hn::Vec<BitsTag> cell) {
  const BitsTag d;
  auto x = hn::Xor(hn::Mul(cell, hn::Set(d, rbm::kDrawsPerCell)), hn::Set(d, state.first));
  x = hn::Xor(x, hn::ShiftRight<16>(x));
  x = hn::Mul(x, hn::Set(d, 0x7feb352dU));
  x = hn::Xor(x, hn::ShiftRight<15>(x));
  x = hn::Mul(x, hn::Set(d, 0x846ca68bU));
  x = hn::Xor(x, hn::Xor(hn::ShiftRight<16>(x), hn::Set(d, state.second)));
  x = hn::Mul(x, hn::Set(d, 0x9e3779b1U));
  return hn::Xor(x, hn::ShiftRight<15>(x));
}

// Sine of a number of half turns in [-1/2, 1/2]: Taylor's series, error 4e-6.
HWY_INLINE Floats sine(Floats half_turns) {
  const Tag d;
  const auto y = hn::Mul(half_turns, half_turns);
  auto p = hn::Set(d, 0.0821458866F);
  p = polynomials::step(d, p, y, -0.599264529F);
  p = polynomials::step(d, p, y, 2.55016404F);
  p = polynomials::step(d, p, y, -5.16771278F);
  p = polynomials::step(d, p, y, 3.14159265F);
  return hn::Mul(p, half_turns);
}

void draw_gaussian(std::size_t count, rbm::NoiseState state, float* real, float* imaginary) {
  const Tag d;
  const BitsTag db;
  const SignedTag di;
  constexpr float kStep = 1.0F / 65536.0F;
  const auto lane = hn::Iota(db, 0U);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto bits = random_bits(state, hn::Add(lane, hn::Set(db, static_cast<std::uint32_t>(i))));
    const auto high = hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<16>(bits)));
    const auto uniform = hn::Add(hn::Mul(high, hn::Set(d, kStep)), hn::Set(d, 0.5F * kStep));
    const auto radius = hn::Sqrt(hn::Mul(hn::Set(d, -kLn2), polynomials::log2(d, uniform)));
    // Fifteen bits are an angle within half a turn, the last one is the sign of both parts.
    const auto low = hn::And(hn::ShiftRight<1>(bits), hn::Set(db, 0x7fffU));
    const auto angle =
        hn::Sub(hn::Mul(hn::ConvertTo(d, hn::BitCast(di, low)), hn::Set(d, 2.0F * kStep)), hn::Set(d, 0.5F));
    const auto sign = hn::BitCast(d, hn::ShiftLeft<31>(bits));
    const auto signed_radius = hn::Xor(radius, sign);
    // cos(x) = sin(1/2 - |x|), in half turns.
    const auto cosine = sine(hn::Sub(hn::Set(d, 0.5F), hn::Abs(angle)));
    hn::StoreU(hn::Mul(signed_radius, cosine), d, real + i);
    hn::StoreU(hn::Mul(signed_radius, sine(angle)), d, imaginary + i);
  }
}

void interpolate(std::size_t count, const Neighbours& where, const float* cells, float* field) {
  const Tag d;
  const SignedTag di;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto cell = hn::LoadU(di, where.cell + i);
    const auto first = hn::Mul(hn::LoadU(d, where.first + i), hn::GatherIndex(d, cells, cell));
    const auto second = hn::Mul(hn::LoadU(d, where.second + i), hn::GatherIndex(d, cells + 1, cell));
    hn::StoreU(hn::Add(first, second), d, field + i);
  }
}

void intensity(std::size_t count, int looks, WeightedField near, WeightedField far, float* mean) {
  const Tag d;
  const auto scale = hn::Set(d, 1.0F / static_cast<float>(looks));
  const auto near_weight = hn::Set(d, near.weight);
  const auto far_weight = hn::Set(d, far.weight);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    auto sum = hn::Zero(d);
    for (std::size_t part = 0; part < 2 * static_cast<std::size_t>(looks); ++part) {
      const std::size_t at = part * count + i;
      const auto field = hn::Add(hn::Mul(near_weight, hn::LoadU(d, near.numbers + at)),
                                 hn::Mul(far_weight, hn::LoadU(d, far.numbers + at)));
      sum = hn::Add(sum, hn::Mul(field, field));
    }
    hn::StoreU(hn::Mul(sum, scale), d, mean + i);
  }
}

}  // namespace yars::model::hrm::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::lanes {

HWY_EXPORT(draw_gaussian);
HWY_EXPORT(interpolate);
HWY_EXPORT(intensity);

void draw_gaussian(std::size_t count, rbm::NoiseState state, float* real, float* imaginary) {
  HWY_DYNAMIC_DISPATCH(draw_gaussian)(count, state, real, imaginary);
}
void interpolate(std::size_t count, const Neighbours& where, const float* cells, float* field) {
  HWY_DYNAMIC_DISPATCH(interpolate)(count, where, cells, field);
}
void intensity(std::size_t count, int looks, WeightedField near, WeightedField far, float* mean) {
  HWY_DYNAMIC_DISPATCH(intensity)(count, looks, near, far, mean);
}

}  // namespace yars::model::hrm::lanes
#endif  // HWY_ONCE
