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

HWY_INLINE void put_row(const float* gain, const float* height_m, std::size_t pitch, SurfacePoint* points) {
  for (std::size_t lane = 0; lane < kStripColumns; ++lane) points[lane] = {gain[lane * pitch], height_m[lane * pitch]};
}

#if HWY_TARGET == HWY_SCALAR
void put_side_by_side(std::size_t count, const float* gain, const float* height_m, std::size_t pitch,
                      SurfacePoint* points) {
  for (std::size_t row = 0; row < count; ++row)
    put_row(gain + row, height_m + row, pitch, points + row * kStripColumns);
}
#else
constexpr std::size_t kSquare = 4;

// Two rows of four columns' numbers, of four rows.
struct Rows {
  hn::Vec<hn::FixedTag<float, kSquare> > first, second, third, fourth;
};
HWY_INLINE Rows turned(const float* columns, std::size_t pitch) {
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

// Four columns by four rows.
HWY_INLINE void put_square(const float* gain, const float* height_m, std::size_t pitch, SurfacePoint* points) {
  const hn::FixedTag<float, kSquare> d;
  const Rows gains = turned(gain, pitch);
  const Rows heights = turned(height_m, pitch);
  hn::StoreInterleaved2(gains.first, heights.first, d, &points->gain);
  hn::StoreInterleaved2(gains.second, heights.second, d, &points[kStripColumns].gain);
  hn::StoreInterleaved2(gains.third, heights.third, d, &points[2 * kStripColumns].gain);
  hn::StoreInterleaved2(gains.fourth, heights.fourth, d, &points[3 * kStripColumns].gain);
}

void put_side_by_side(std::size_t count, const float* gain, const float* height_m, std::size_t pitch,
                      SurfacePoint* points) {
  std::size_t row = 0;
  for (; row + kSquare <= count; row += kSquare)
    for (std::size_t lane = 0; lane < kStripColumns; lane += kSquare)
      put_square(gain + lane * pitch + row, height_m + lane * pitch + row, pitch, points + row * kStripColumns + lane);
  for (; row < count; ++row) put_row(gain + row, height_m + row, pitch, points + row * kStripColumns);
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
void put_side_by_side(std::size_t count, const float* gain, const float* height_m, std::size_t pitch,
                      SurfacePoint* points) {
  HWY_DYNAMIC_DISPATCH(put_side_by_side)(count, gain, height_m, pitch, points);
}

}  // namespace yars::model::hrm::lanes
#endif  // HWY_ONCE
