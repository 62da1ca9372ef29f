#include "model/hrm/strip_lanes.hpp"

#include <cstdint>

#include "model/hrm/fan_grid.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/strip_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void fill_between(std::size_t count, std::size_t step, float* columns, std::size_t pitch) {
  const hn::CappedTag<float, kStripColumns> d;
  for (std::size_t first = 0; first + step < kStripColumns; first += step) {
    const float* const near = columns + first * pitch;
    const float* const far = near + step * pitch;
    for (std::size_t off = 1; off < step; ++off) {
      const auto share = hn::Set(d, static_cast<float>(off) / static_cast<float>(step));
      float* const between = columns + (first + off) * pitch;
      for (std::size_t row = 0; row < count; row += hn::Lanes(d)) {
        const auto here = hn::LoadU(d, near + row);
        hn::StoreU(hn::Add(here, hn::Mul(share, hn::Sub(hn::LoadU(d, far + row), here))), d, between + row);
      }
    }
  }
}

#if HWY_TARGET == HWY_SCALAR
void put_side_by_side(std::size_t count, const float* columns, std::size_t pitch, float* rows) {
  for (std::size_t row = 0; row < count; ++row)
    for (std::size_t lane = 0; lane < kStripColumns; ++lane)
      rows[row * kStripColumns + lane] = columns[lane * pitch + row];
}
#else
constexpr std::size_t kSquare = 4;

// Four columns by four rows, turned.
HWY_INLINE void turn(const float* columns, std::size_t pitch, float* rows) {
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
  hn::StoreU(hn::BitCast(d, hn::InterleaveLower(pairs, ab_low, ce_low)), d, rows);
  hn::StoreU(hn::BitCast(d, hn::InterleaveUpper(pairs, ab_low, ce_low)), d, rows + kStripColumns);
  hn::StoreU(hn::BitCast(d, hn::InterleaveLower(pairs, ab_high, ce_high)), d, rows + 2 * kStripColumns);
  hn::StoreU(hn::BitCast(d, hn::InterleaveUpper(pairs, ab_high, ce_high)), d, rows + 3 * kStripColumns);
}

void put_side_by_side(std::size_t count, const float* columns, std::size_t pitch, float* rows) {
  std::size_t row = 0;
  for (; row + kSquare <= count; row += kSquare)
    for (std::size_t lane = 0; lane < kStripColumns; lane += kSquare)
      turn(columns + lane * pitch + row, pitch, rows + row * kStripColumns + lane);
  for (; row < count; ++row)
    for (std::size_t lane = 0; lane < kStripColumns; ++lane)
      rows[row * kStripColumns + lane] = columns[lane * pitch + row];
}
#endif

}  // namespace yars::model::hrm::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::lanes {

HWY_EXPORT(fill_between);
HWY_EXPORT(put_side_by_side);

void fill_between(std::size_t count, std::size_t step, float* columns, std::size_t pitch) {
  HWY_DYNAMIC_DISPATCH(fill_between)(count, step, columns, pitch);
}
void put_side_by_side(std::size_t count, const float* columns, std::size_t pitch, float* rows) {
  HWY_DYNAMIC_DISPATCH(put_side_by_side)(count, columns, pitch, rows);
}

}  // namespace yars::model::hrm::lanes
#endif  // HWY_ONCE
