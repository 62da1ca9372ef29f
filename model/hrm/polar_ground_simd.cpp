#include "model/hrm/polar_ground_simd.hpp"

#include <cstdint>

#include "model/hrm/patch_geometry.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/polar_ground_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;
using SignedTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;

// modulate() multiplies two samples of the texture. The coordinates of the second are those of the first, rotated by 70
// degrees and scaled by the golden ratio. The periods of both samples have no common multiple.
constexpr float kTurnCosine = 0.3420201F;
constexpr float kTurnSine = 0.9396926F;
constexpr float kStretch = 1.618034F;

// Returns one of the four bytes of a word as float.
template <int kShift>
HWY_INLINE Floats byte_of(hn::Vec<SignedTag> word) {
  const SignedTag di;
  return hn::ConvertTo(Tag(), hn::And(hn::ShiftRight<kShift>(word), hn::Set(di, 0xff)));
}

// Coordinate along an axis of the texture: index of a texel, and fraction of the way to the next texel.
struct TexelCoordinate {
  hn::Vec<SignedTag> texel;
  Floats fraction;
};
// Rounds (coordinate - 1/2) to the nearest integer, which replaces rounding the coordinate down. A coordinate exactly
// on a texel may become fraction 1 of the previous texel, which gives an equal sample.
HWY_INLINE TexelCoordinate split(Floats coordinate) {
  const Tag d;
  constexpr float kOnes = 12582912.0F;  // 1.5 * 2^23, which makes the last bit of the sum worth 1
  const auto sum = hn::Add(hn::Sub(coordinate, hn::Set(d, 0.5F)), hn::Set(d, kOnes));
  return {hn::BitCast(SignedTag(), sum), hn::Sub(coordinate, hn::Sub(sum, hn::Set(d, kOnes)))};
}

// Bilinear sample of the texture, 0 to 255. `x`, `y`: east and north [texels].
HWY_INLINE Floats sample(const DetailTable& table, Floats x, Floats y) {
  const SignedTag di;
  const auto mask = hn::Set(di, table.edge - 1);
  const TexelCoordinate column = split(x);
  const TexelCoordinate row = split(y);
  const auto i = hn::And(column.texel, mask);
  const auto j = hn::And(row.texel, mask);
  const auto low_bits = hn::Set(di, kDetailBlock - 1);
  // The index is the sum of three counts of texels: complete rows of blocks, complete blocks in the row, texels before
  // this one in the block.
  const auto lines = hn::Mul(hn::AndNot(low_bits, j), hn::Set(di, table.edge));
  const auto blocks = hn::ShiftLeft<2>(hn::AndNot(low_bits, i));
  const auto within = hn::Add(hn::ShiftLeft<2>(hn::And(j, low_bits)), hn::And(i, low_bits));
  const auto at = hn::Add(hn::Add(lines, blocks), within);
  static_assert(kDetailBlock == 4);
  const auto word = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(table.texels), at);
  const auto near_left = byte_of<0>(word);
  const auto far_left = byte_of<16>(word);
  const auto low = hn::Add(near_left, hn::Mul(column.fraction, hn::Sub(byte_of<8>(word), near_left)));
  const auto high = hn::Add(far_left, hn::Mul(column.fraction, hn::Sub(byte_of<24>(word), far_left)));
  return hn::Add(low, hn::Mul(row.fraction, hn::Sub(high, low)));
}

void modulate(std::size_t count, const DetailTable& table, const float* east_deg, const float* north_deg,
              float east_scale, float north_scale, float* gamma) {
  const Tag d;
  const auto cosine = hn::Set(d, kStretch * kTurnCosine);
  const auto sine = hn::Set(d, kStretch * kTurnSine);
  const auto unit2 = hn::Set(d, table.unit2);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto east = hn::Mul(hn::LoadU(d, east_deg + i), hn::Set(d, east_scale));
    const auto north = hn::Mul(hn::LoadU(d, north_deg + i), hn::Set(d, north_scale));
    const auto turned_east = hn::Sub(hn::Mul(cosine, east), hn::Mul(sine, north));
    const auto turned_north = hn::Add(hn::Mul(sine, east), hn::Mul(cosine, north));
    const auto factor = hn::Mul(sample(table, east, north), sample(table, turned_east, turned_north));
    hn::StoreU(hn::Mul(hn::LoadU(d, gamma + i), hn::Mul(factor, unit2)), d, gamma + i);
  }
}

void interpolate_columns(std::size_t count, std::size_t step, float* columns, std::size_t pitch) {
  const hn::CappedTag<float, kStripColumns> d;
  for (std::size_t first = 0; first + step < kStripColumns; first += step) {
    const float* const near = columns + first * pitch;
    const float* const far = near + step * pitch;
    for (std::size_t off = 1; off < step; ++off) {
      const auto fraction = hn::Set(d, static_cast<float>(off) / static_cast<float>(step));
      float* const between = columns + (first + off) * pitch;
      for (std::size_t row = 0; row < count; row += hn::Lanes(d)) {
        const auto here = hn::LoadU(d, near + row);
        hn::StoreU(hn::Add(here, hn::Mul(fraction, hn::Sub(hn::LoadU(d, far + row), here))), d, between + row);
      }
    }
  }
}

HWY_INLINE void store_row(const float* gamma, const float* height_m, std::size_t pitch, SurfacePoint* points) {
  for (std::size_t lane = 0; lane < kStripColumns; ++lane) points[lane] = {gamma[lane * pitch], height_m[lane * pitch]};
}

#if HWY_TARGET == HWY_SCALAR
void interleave_columns(std::size_t count, const float* gamma, const float* height_m, std::size_t pitch,
                        SurfacePoint* points) {
  for (std::size_t row = 0; row < count; ++row)
    store_row(gamma + row, height_m + row, pitch, points + row * kStripColumns);
}
#else
constexpr std::size_t kSquare = 4;

// Block of 4 columns by 4 rows, transposed to one vector per row.
struct Rows {
  hn::Vec<hn::FixedTag<float, kSquare> > first, second, third, fourth;
};
HWY_INLINE Rows transposed(const float* columns, std::size_t pitch) {
  const hn::FixedTag<float, kSquare> d;
  const hn::FixedTag<double, kSquare / 2> pairs;
  const auto a = hn::LoadU(d, columns);
  const auto b = hn::LoadU(d, columns + pitch);
  const auto c = hn::LoadU(d, columns + 2 * pitch);
  const auto e = hn::LoadU(d, columns + 3 * pitch);
  const auto ab_low = hn::BitCast(pairs, hn::InterleaveLower(d, a, b));
  const auto ab_high = hn::BitCast(pairs, hn::InterleaveUpper(d, a, b));
  const auto ce_low = hn::BitCast(pairs, hn::InterleaveLower(d, c, e));
  const auto ce_high = hn::BitCast(pairs, hn::InterleaveUpper(d, c, e));
  return {hn::BitCast(d, hn::InterleaveLower(pairs, ab_low, ce_low)),
          hn::BitCast(d, hn::InterleaveUpper(pairs, ab_low, ce_low)),
          hn::BitCast(d, hn::InterleaveLower(pairs, ab_high, ce_high)),
          hn::BitCast(d, hn::InterleaveUpper(pairs, ab_high, ce_high))};
}

// Stores four columns by four rows as in interleave_columns().
HWY_INLINE void store_block(const float* gamma, const float* height_m, std::size_t pitch, SurfacePoint* points) {
  const hn::FixedTag<float, kSquare> d;
  const Rows gammas = transposed(gamma, pitch);
  const Rows heights = transposed(height_m, pitch);
  hn::StoreInterleaved2(gammas.first, heights.first, d, &points->gamma);
  hn::StoreInterleaved2(gammas.second, heights.second, d, &points[kStripColumns].gamma);
  hn::StoreInterleaved2(gammas.third, heights.third, d, &points[2 * kStripColumns].gamma);
  hn::StoreInterleaved2(gammas.fourth, heights.fourth, d, &points[3 * kStripColumns].gamma);
}

void interleave_columns(std::size_t count, const float* gamma, const float* height_m, std::size_t pitch,
                        SurfacePoint* points) {
  std::size_t row = 0;
  for (; row + kSquare <= count; row += kSquare)
    for (std::size_t lane = 0; lane < kStripColumns; lane += kSquare)
      store_block(gamma + lane * pitch + row, height_m + lane * pitch + row, pitch,
                  points + row * kStripColumns + lane);
  for (; row < count; ++row) store_row(gamma + row, height_m + row, pitch, points + row * kStripColumns);
}
#endif

}  // namespace yars::model::hrm::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::simd {

HWY_EXPORT(modulate);

void modulate(std::size_t count, const DetailTable& table, const float* east_deg, const float* north_deg,
              float east_scale, float north_scale, float* gamma) {
  HWY_DYNAMIC_DISPATCH(modulate)(count, table, east_deg, north_deg, east_scale, north_scale, gamma);
}

HWY_EXPORT(interpolate_columns);
HWY_EXPORT(interleave_columns);

void interpolate_columns(std::size_t count, std::size_t step, float* columns, std::size_t pitch) {
  HWY_DYNAMIC_DISPATCH(interpolate_columns)(count, step, columns, pitch);
}
void interleave_columns(std::size_t count, const float* gamma, const float* height_m, std::size_t pitch,
                        SurfacePoint* points) {
  HWY_DYNAMIC_DISPATCH(interleave_columns)(count, gamma, height_m, pitch, points);
}

}  // namespace yars::model::hrm::simd
#endif  // HWY_ONCE
