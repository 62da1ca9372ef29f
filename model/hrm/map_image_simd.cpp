#include "model/hrm/map_image_simd.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/map_image_simd.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// These headers need the target (instruction set) that highway.h defines.
#include "model/physics/clutter_simd-inl.hpp"
#include "model/physics/polynomials-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace polynomials = physics::HWY_NAMESPACE;

constexpr std::size_t kMaxLanes = 16;
using Tag = hn::CappedTag<float, kMaxLanes>;
using SignedTag = hn::RebindToSigned<Tag>;
using BitsTag = hn::RebindToUnsigned<Tag>;
using Floats = hn::Vec<Tag>;
constexpr std::ptrdiff_t kPrefetchRows = 4;  // distance of the prefetch [rows of the polar grid]

// Index of row 0 of a column, counted from the sector's first column.
HWY_INLINE hn::Vec<SignedTag> start_of(hn::Vec<SignedTag> column, std::int32_t strip_size) {
  const SignedTag di;
  const auto strip = hn::ShiftRight<4>(column);
  return hn::Add(hn::Mul(strip, hn::Set(di, strip_size)), hn::And(column, hn::Set(di, kStripColumns - 1)));
}

// Cross sections at the corners of the grid cells of one vector of pixels.
struct Corners {
  Floats near_left, near_right, far_left, far_right;
};

// `column` and `line`: of the corners near_left. Neighbouring pixels mostly lie in one row of at most two strips, whose
// columns are faster to permute than to gather.
HWY_INLINE Corners corners_at(hn::Vec<SignedTag> column, hn::Vec<SignedTag> line, std::int32_t strip_size,
                              const float* cross_section_m2) {
  const Tag d;
  const SignedTag di;
  const auto first = hn::GetLane(column) / kStripColumns;
  const auto row = hn::GetLane(line);
  const float* const strip = cross_section_m2 + static_cast<std::ptrdiff_t>(first) * strip_size +
                             static_cast<std::ptrdiff_t>(row) * kStripColumns;
  // Prefetches (loads into the cache) the grid rows of the next map rows, which are nearer to the aircraft. The
  // hardware prefetcher cannot follow as many streams as there are strips.
  hwy::Prefetch(strip - kPrefetchRows * kStripColumns);
#if HWY_TARGET <= HWY_AVX3
  const auto lane = hn::Sub(column, hn::Set(di, first * kStripColumns));
  const auto ends = hn::Set(di, 2 * kStripColumns - 1);
  const auto elsewhere = hn::Or(hn::Ne(line, hn::Set(di, row)),
                                hn::Or(hn::Gt(lane, hn::Sub(ends, hn::Set(di, 1))), hn::Lt(lane, hn::Zero(di))));
  if (hn::AllFalse(di, elsewhere)) {
    const float* const next = strip + strip_size;
    const auto in_strip = hn::Set(di, kStripColumns - 1);
    const auto lane_right = hn::Add(lane, hn::Set(di, 1));
    const auto left = hn::IndicesFromVec(d, hn::And(lane, in_strip));
    const auto right = hn::IndicesFromVec(d, hn::And(lane_right, in_strip));
    const auto left_next = hn::RebindMask(d, hn::Gt(lane, in_strip));
    const auto right_next = hn::RebindMask(d, hn::Gt(lane_right, in_strip));
    const auto at = [&](std::ptrdiff_t offset, auto indices, auto in_next) HWY_ATTR {
      return hn::IfThenElse(in_next, hn::TableLookupLanes(hn::Load(d, next + offset), indices),
                            hn::TableLookupLanes(hn::Load(d, strip + offset), indices));
    };
    return {at(0, left, left_next), at(0, right, right_next), at(kStripColumns, left, left_next),
            at(kStripColumns, right, right_next)};
  }
#endif
  const auto offset = hn::ShiftLeft<4>(line);
  const auto left_at = hn::Add(start_of(column, strip_size), offset);
  const auto right_at = hn::Add(start_of(hn::Add(column, hn::Set(di, 1)), strip_size), offset);
  return {hn::GatherIndex(d, cross_section_m2, left_at), hn::GatherIndex(d, cross_section_m2, right_at),
          hn::GatherIndex(d, cross_section_m2 + kStripColumns, left_at),
          hn::GatherIndex(d, cross_section_m2 + kStripColumns, right_at)};
}

void draw_row(const PolarGrid& grid, const float* cross_section_m2, const MapRow& row, float* pixel) {
  const Tag d;
  const SignedTag di;
  const auto ahead2 = hn::Set(d, row.ahead_m * row.ahead_m);
  const auto middle_column = hn::Set(d, static_cast<float>(-grid.first_tangent / grid.tangent_step));
  const auto columns_per_metre = hn::Set(d, static_cast<float>(1.0 / grid.tangent_step) / row.ahead_m);
  const auto first_distance = hn::Set(d, static_cast<float>(grid.first_distance_m));
  const auto rows_per_metre = hn::Set(d, static_cast<float>(1.0 / grid.spacing_m));
  const auto last_column = hn::Set(di, grid.columns - 2);
  const auto last_row = hn::Set(di, grid.rows - 2);
  const auto zero = hn::Zero(di);
  const auto strip_size = static_cast<std::int32_t>(grid.strip_size());
  const bool whole = grid.first_drawn_column() == 0 && grid.end_drawn_column() == grid.columns;
  const auto before_drawn = hn::Set(di, grid.first_drawn_column() - 1);
  const auto end_drawn = hn::Set(di, grid.end_drawn_column());
  const auto first_held = hn::Set(di, grid.first_strip * kStripColumns);
  const auto last_held = hn::Set(di, (grid.end_strip - grid.first_strip) * kStripColumns - 2);
  // Width of a column: distance * tangent_step / (1 + tangent^2) = tangent_step * ahead^2 / distance.
  const double ahead_m = static_cast<double>(row.ahead_m);
  const auto scale_per_metre = hn::Set(
      d, static_cast<float>(static_cast<double>(row.scale) / (grid.tangent_step * grid.spacing_m * ahead_m * ahead_m)));
  const auto lanes = hn::ConvertTo(d, hn::Iota(di, 0));
  for (int i = row.begin; i < row.end; i += static_cast<int>(hn::Lanes(d))) {
    const auto number = hn::Add(lanes, hn::Set(d, static_cast<float>(i)));
    const auto right = hn::Add(hn::Set(d, row.first_right_m), hn::Mul(number, hn::Set(d, row.pixel_m)));
    const auto distance = hn::Sqrt(hn::Add(hn::Mul(right, right), ahead2));
    const auto x = hn::Add(middle_column, hn::Mul(right, columns_per_metre));
    const auto y = hn::Mul(hn::Sub(distance, first_distance), rows_per_metre);
    const auto column = hn::Min(hn::Max(hn::ConvertTo(di, x), zero), last_column);
    const auto line = hn::Min(hn::Max(hn::ConvertTo(di, y), zero), last_row);
    const auto across = hn::Sub(x, hn::ConvertTo(d, column));
    const auto along = hn::Sub(y, hn::ConvertTo(d, line));
    // Lanes that are not drawn get any column of the sector.
    const auto held = hn::Min(hn::Max(hn::Sub(column, first_held), zero), last_held);
    const Corners corners = corners_at(held, line, strip_size, cross_section_m2);
    const auto near = hn::Add(corners.near_left, hn::Mul(across, hn::Sub(corners.near_right, corners.near_left)));
    const auto far = hn::Add(corners.far_left, hn::Mul(across, hn::Sub(corners.far_right, corners.far_left)));
    const auto value = hn::Add(near, hn::Mul(along, hn::Sub(far, near)));
    const auto drawn = hn::Mul(value, hn::Mul(scale_per_metre, distance));
    const auto remaining = static_cast<std::size_t>(row.end - i);
    if (whole && remaining >= hn::Lanes(d)) {
      hn::StoreU(drawn, d, pixel + i);
    } else {
      const auto wanted = hn::RebindMask(d, hn::And(hn::Gt(column, before_drawn), hn::Lt(column, end_drawn)));
      hn::BlendedStore(drawn, hn::And(wanted, hn::FirstN(d, remaining)), d, pixel + i);
    }
  }
}

static_assert(kBlock == kMaxLanes);

void smooth(std::size_t count, const float* from, std::ptrdiff_t stride, std::span<const float> weights, float* to) {
  const Tag d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    auto sum = hn::Mul(hn::Set(d, weights[0]), hn::LoadU(d, from + i));
    const float* before = from + i;
    const float* behind = from + i;
    for (const float weight : weights.subspan(1)) {
      before -= stride;
      behind += stride;
      sum = hn::Add(sum, hn::Mul(hn::Set(d, weight), hn::Add(hn::LoadU(d, before), hn::LoadU(d, behind))));
    }
    hn::StoreU(sum, d, to + i);
  }
}

bool keep_above(const float* from, float limit, float* to) {
  const Tag d;
  bool any = false;
  for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d)) {
    const auto value = hn::LoadU(d, from + i);
    const auto strong = hn::Gt(value, hn::Set(d, limit));
    any = any || !hn::AllFalse(d, strong);
    hn::StoreU(hn::IfThenElseZero(strong, value), d, to + i);
  }
  return any;
}

void spread(const float* from, std::ptrdiff_t stride, std::span<const float> weights, float* to) {
  const Tag d;
  for (const float weight : weights) {
    for (std::size_t i = 0; i < kBlock; i += hn::Lanes(d))
      hn::StoreU(hn::Add(hn::LoadU(d, to + i), hn::Mul(hn::Set(d, weight), hn::LoadU(d, from + i))), d, to + i);
    to += stride;
  }
}

// Sums the contributions of all nonzero entries in a register, then stores the sum. With one store per entry, each
// entry would have to wait for the store of the previous entry.
void spread_along(const float* from, std::size_t radius, const float* middle, float* to) {
  const Tag d;
  std::size_t nonzero[kBlock];
  std::size_t count = 0;
  for (std::size_t i = 0; i < kBlock; ++i)
    if (from[i] != 0.0F) nonzero[count++] = i;
  const auto begin = -static_cast<std::ptrdiff_t>(radius * kBlock);
  for (std::ptrdiff_t at = begin; at < -begin + static_cast<std::ptrdiff_t>(kBlock);
       at += static_cast<std::ptrdiff_t>(hn::Lanes(d))) {
    auto sum = hn::LoadU(d, to + at);
    for (std::size_t k = 0; k < count; ++k)
      sum = hn::Add(sum, hn::Mul(hn::Set(d, from[nonzero[k]]),
                                 hn::LoadU(d, middle + at - static_cast<std::ptrdiff_t>(nonzero[k]))));
    hn::StoreU(sum, d, to + at);
  }
}

constexpr float kLn2 = 0.693147181F;

// Sine of an angle in [-1/2, 1/2] half turns; a half turn is pi rad. Taylor series with an error of 4e-6.
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

void draw_gaussian(std::size_t count, physics::NoiseState state, float* real, float* imaginary) {
  const Tag d;
  const BitsTag db;
  const SignedTag di;
  constexpr float kStep = 1.0F / 65536.0F;
  const auto lane = hn::Iota(db, 0U);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto cell = hn::Add(lane, hn::Set(db, static_cast<std::uint32_t>(i)));
    const auto bits = physics::simd::HWY_NAMESPACE::noise_bits(state, cell);
    // Bits 16 to 31 give the radius.
    const auto high = hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<16>(bits)));
    const auto uniform = hn::Add(hn::Mul(high, hn::Set(d, kStep)), hn::Set(d, 0.5F * kStep));
    const auto radius = hn::Sqrt(hn::Mul(hn::Set(d, -kLn2), polynomials::log2(d, uniform)));
    // Bits 1 to 15 give an angle in [-1/2, 1/2) half turns. Bit 0 is the sign of both parts.
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

// Pixels are finer than cells, so the cells of one vector lie within one vector of cells, which is faster to permute
// than to gather.
void interpolate(std::size_t count, const Neighbours& where, const float* cells, float* field) {
  const Tag d;
  const SignedTag di;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const float* const from = cells + where.cell[i];
    const auto lane = hn::Sub(hn::LoadU(di, where.cell + i), hn::Set(di, where.cell[i]));
    const auto indices = hn::IndicesFromVec(d, lane);
    const auto first = hn::Mul(hn::LoadU(d, where.first + i), hn::TableLookupLanes(hn::LoadU(d, from), indices));
    const auto second = hn::Mul(hn::LoadU(d, where.second + i), hn::TableLookupLanes(hn::LoadU(d, from + 1), indices));
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

}  // namespace yars::model::hrm::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::simd {

HWY_EXPORT(draw_row);

void draw_row(const PolarGrid& grid, const float* cross_section_m2, const MapRow& row, float* pixel) {
  HWY_DYNAMIC_DISPATCH(draw_row)(grid, cross_section_m2, row, pixel);
}

HWY_EXPORT(smooth);
HWY_EXPORT(keep_above);
HWY_EXPORT(spread);
HWY_EXPORT(spread_along);

void smooth(std::size_t count, const float* from, std::ptrdiff_t stride, std::span<const float> weights, float* to) {
  HWY_DYNAMIC_DISPATCH(smooth)(count, from, stride, weights, to);
}
bool keep_above(const float* from, float limit, float* to) {
  return HWY_DYNAMIC_DISPATCH(keep_above)(from, limit, to);
}
void spread(const float* from, std::ptrdiff_t stride, std::span<const float> weights, float* to) {
  HWY_DYNAMIC_DISPATCH(spread)(from, stride, weights, to);
}
void spread_along(const float* from, std::size_t radius, const float* middle, float* to) {
  HWY_DYNAMIC_DISPATCH(spread_along)(from, radius, middle, to);
}

HWY_EXPORT(draw_gaussian);
HWY_EXPORT(interpolate);
HWY_EXPORT(intensity);

void draw_gaussian(std::size_t count, physics::NoiseState state, float* real, float* imaginary) {
  HWY_DYNAMIC_DISPATCH(draw_gaussian)(count, state, real, imaginary);
}
void interpolate(std::size_t count, const Neighbours& where, const float* cells, float* field) {
  HWY_DYNAMIC_DISPATCH(interpolate)(count, where, cells, field);
}
void intensity(std::size_t count, int looks, WeightedField near, WeightedField far, float* mean) {
  HWY_DYNAMIC_DISPATCH(intensity)(count, looks, near, far, mean);
}

}  // namespace yars::model::hrm::simd
#endif  // HWY_ONCE
