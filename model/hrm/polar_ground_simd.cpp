#include "model/hrm/polar_ground_simd.hpp"

#include <cstdint>

#include "model/hrm/patch_geometry.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/polar_ground_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// This header needs the target (instruction set) that highway.h defines.
#include "lib/random/counter_rng-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;
using SignedTag = hn::RebindToSigned<Tag>;
using UnsignedTag = hn::RebindToUnsigned<Tag>;
using Floats = hn::Vec<Tag>;

// Returns one of the four bytes of a word as float.
template <int kShift>
HWY_INLINE Floats byte_of(hn::Vec<SignedTag> word) {
  const SignedTag di;
  return hn::ConvertTo(Tag(), hn::And(hn::ShiftRight<kShift>(word), hn::Set(di, 0xff)));
}

// Coordinate along an axis: whole part, and fraction of the way to the next whole number. `whole` has the bits of a
// float above the number.
struct Coordinate {
  hn::Vec<SignedTag> whole;
  Floats fraction;
};
// Rounds (coordinate - 1/2) to the nearest integer, which replaces rounding the coordinate down. A whole coordinate may
// become fraction 1 of the number before, which gives an equal sample.
HWY_INLINE Coordinate split(Floats coordinate) {
  const Tag d;
  constexpr float kOnes = 12582912.0F;  // 1.5 * 2^23, which makes the last bit of the sum worth 1
  const auto sum = hn::Add(hn::Sub(coordinate, hn::Set(d, 0.5F)), hn::Set(d, kOnes));
  return {hn::BitCast(SignedTag(), sum), hn::Sub(coordinate, hn::Sub(sum, hn::Set(d, kOnes)))};
}

// Position in the field [texels].
struct FieldPosition {
  Coordinate east, north;
};

// Bilinear sample of the field, 0 to 255, with the offset into the table of a tile. `tile`: number of the tile.
HWY_INLINE Floats sample(const DetailTable& table, const FieldPosition& at, hn::Vec<UnsignedTag> tile) {
  const SignedTag di;
  const auto mask = hn::Set(di, table.edge - 1);
  // Fractions of the table's side, so that tables with texels of any width have equal offsets in metres.
  const auto offset = hn::BitCast(di, random::HWY_NAMESPACE::lowbias32(tile));
  const auto half = hn::Set(di, 0xffff);
  const auto texels_of = [&](auto fraction) {
    return hn::ShiftRight<16>(hn::Mul(hn::And(fraction, half), hn::Set(di, table.edge)));
  };
  const auto i = hn::And(hn::Add(at.east.whole, texels_of(offset)), mask);
  const auto j = hn::And(hn::Add(at.north.whole, texels_of(hn::ShiftRight<16>(offset))), mask);
  const auto low_bits = hn::Set(di, kDetailBlock - 1);
  // The index is the sum of three counts of texels: complete rows of blocks, complete blocks in the row, texels before
  // this one in the block.
  const auto lines = hn::Mul(hn::AndNot(low_bits, j), hn::Set(di, table.edge));
  const auto blocks = hn::ShiftLeft<2>(hn::AndNot(low_bits, i));
  const auto within = hn::Add(hn::ShiftLeft<2>(hn::And(j, low_bits)), hn::And(i, low_bits));
  static_assert(kDetailBlock == 4);
  const auto word =
      hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(table.texels), hn::Add(hn::Add(lines, blocks), within));
  const auto near_left = byte_of<0>(word);
  const auto far_left = byte_of<16>(word);
  const auto low = hn::Add(near_left, hn::Mul(at.east.fraction, hn::Sub(byte_of<8>(word), near_left)));
  const auto high = hn::Add(far_left, hn::Mul(at.east.fraction, hn::Sub(byte_of<24>(word), far_left)));
  return hn::Add(low, hn::Mul(at.north.fraction, hn::Sub(high, low)));
}

// The tiles at the corners of a triangle, the nearest first, and the weights of the others. The nearest has the weight
// 1. Only near the middle between tiles another has a weight above 0.
struct Tiles {
  hn::Vec<UnsignedTag> nearest, second, third;
  Floats second_weight, third_weight;
};

// Tiles stand on a triangular lattice. In skewed coordinates its triangles are the halves of squares: the corners (1,
// 0) and (0, 1) of a square, and (0, 0) or (1, 1).
HWY_INLINE Tiles tiles_at(const DetailTable& table, std::uint32_t seed, Floats east, Floats north) {
  const Tag d;
  const UnsignedTag du;
  constexpr float kTangent = 0.57735027F, kInverseCosine = 1.1547005F;  // of 30 degrees
  constexpr float kBlend = 0.12F;                 // width of the blend between two tiles, of their distance
  constexpr std::uint32_t kColumn = 0x9e3779b1U;  // difference in number between tiles of neighbouring columns
  const auto scale = hn::Set(d, table.tiles_per_texel);
  const auto y = hn::Mul(north, scale);
  const Coordinate a = split(hn::Sub(hn::Mul(east, scale), hn::Mul(y, hn::Set(d, kTangent))));
  const Coordinate b = split(hn::Mul(y, hn::Set(d, kInverseCosine)));
  const auto origin = hn::Add(hn::Mul(hn::BitCast(du, a.whole), hn::Set(du, kColumn)),
                              hn::Add(hn::BitCast(du, b.whole), hn::Set(du, seed)));
  const auto one = hn::Set(d, 1.0F);
  const auto rest = hn::Sub(hn::Sub(one, a.fraction), b.fraction);
  const auto beyond = hn::Lt(rest, hn::Zero(d));
  // Barycentric coordinates: 1 at a tile, 0 at the other two.
  const auto along = hn::IfThenElse(beyond, hn::Sub(one, b.fraction), a.fraction);
  const auto across = hn::IfThenElse(beyond, hn::Sub(one, a.fraction), b.fraction);
  const auto corner = hn::Abs(rest);
  const auto column = hn::Set(du, kColumn), row = hn::Set(du, 1U);
  const auto turned = hn::Lt(along, across);
  const auto greater = hn::Max(along, across), smaller = hn::Min(along, across);
  const auto of_greater = hn::IfThenElse(hn::RebindMask(du, turned), row, column);
  const auto of_smaller = hn::IfThenElse(hn::RebindMask(du, turned), column, row);
  const auto of_corner = hn::IfThenElseZero(hn::RebindMask(du, beyond), hn::Add(column, row));
  const auto corner_first = hn::RebindMask(du, hn::Gt(corner, greater));
  const auto corner_last = hn::RebindMask(du, hn::Lt(corner, smaller));
  const auto nearest = hn::Max(greater, corner);
  const auto weight = [&](Floats near) {
    return hn::Max(hn::Sub(one, hn::Mul(hn::Sub(nearest, near), hn::Set(d, 1.0F / kBlend))), hn::Zero(d));
  };
  return {.nearest = hn::Add(origin, hn::IfThenElse(corner_first, of_corner, of_greater)),
          .second = hn::Add(
              origin, hn::IfThenElse(corner_first, of_greater, hn::IfThenElse(corner_last, of_smaller, of_corner))),
          .third = hn::Add(origin, hn::IfThenElse(corner_last, of_corner, of_smaller)),
          .second_weight = weight(hn::Max(hn::Min(greater, corner), smaller)),
          .third_weight = weight(hn::Min(smaller, corner))};
}

// 1 / sqrt(1 + x) for x in [0, 2], within 0.6 %; 1 at 0.
HWY_INLINE Floats inverse_root(Floats x) {
  const Tag d;
  const auto cubic = hn::Add(hn::Set(d, 0.19782754F), hn::Mul(x, hn::Set(d, -0.03867784F)));
  const auto square = hn::Add(hn::Set(d, -0.45389609F), hn::Mul(x, cubic));
  return hn::Add(hn::Set(d, 1.0F), hn::Mul(x, square));
}

// Value of the field less its mean. A weight of 0 changes no bit, so a sample that no lane needs is left out.
HWY_INLINE Floats deviation(const DetailTable& table, std::uint32_t seed, Floats east, Floats north) {
  const Tag d;
  const auto low = hn::Set(d, table.low), step = hn::Set(d, table.step);
  const FieldPosition at{split(east), split(north)};
  const Tiles tiles = tiles_at(table, seed, east, north);
  auto sum = sample(table, at, tiles.nearest);
  if (hn::AllFalse(d, hn::Gt(tiles.second_weight, hn::Zero(d)))) return hn::Add(low, hn::Mul(step, sum));
  sum = hn::Add(sum, hn::Mul(tiles.second_weight, sample(table, at, tiles.second)));
  if (!hn::AllFalse(d, hn::Gt(tiles.third_weight, hn::Zero(d))))
    sum = hn::Add(sum, hn::Mul(tiles.third_weight, sample(table, at, tiles.third)));
  const auto weights = hn::Add(hn::Add(hn::Set(d, 1.0F), tiles.second_weight), tiles.third_weight);
  const auto squares =
      hn::Add(hn::Mul(tiles.second_weight, tiles.second_weight), hn::Mul(tiles.third_weight, tiles.third_weight));
  return hn::Mul(inverse_root(squares), hn::Add(hn::Mul(low, weights), hn::Mul(step, sum)));
}

void modulate(std::size_t count, const DetailTable& table, std::uint32_t seed, const float* east_deg,
              const float* north_deg, float east_scale, float north_scale, float* gamma) {
  const Tag d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto east = hn::Mul(hn::LoadU(d, east_deg + i), hn::Set(d, east_scale));
    const auto north = hn::Mul(hn::LoadU(d, north_deg + i), hn::Set(d, north_scale));
    const auto value = hn::Add(hn::Set(d, table.mean), deviation(table, seed, east, north));
    const auto square = hn::Mul(value, value);
    hn::StoreU(hn::Mul(hn::LoadU(d, gamma + i), hn::Mul(square, square)), d, gamma + i);
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

void modulate(std::size_t count, const DetailTable& table, std::uint32_t seed, const float* east_deg,
              const float* north_deg, float east_scale, float north_scale, float* gamma) {
  HWY_DYNAMIC_DISPATCH(modulate)(count, table, seed, east_deg, north_deg, east_scale, north_scale, gamma);
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
