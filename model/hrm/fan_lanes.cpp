#include "model/hrm/fan_lanes.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/fan_lanes.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kMostLanes = 16;
using Tag = hn::CappedTag<float, kMostLanes>;
using SignedTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;
constexpr std::ptrdiff_t kFetchAhead = 4;  // rows

// Where a column begins in the fan: its strip, and its place in a row of it.
HWY_INLINE hn::Vec<SignedTag> start_of(hn::Vec<SignedTag> column, std::int32_t strip_size) {
  const SignedTag di;
  const auto strip = hn::ShiftRight<4>(column);
  return hn::Add(hn::Mul(strip, hn::Set(di, strip_size)), hn::And(column, hn::Set(di, kStripColumns - 1)));
}

void draw_row(const FanGrid& grid, const float* fan, const MapRow& row, float* pixel) {
  const Tag d;
  const SignedTag di;
  const auto ahead2 = hn::Set(d, row.ahead_m * row.ahead_m);
  const auto middle_column = hn::Set(d, static_cast<float>(-grid.first_tangent / grid.tangent_step));
  const auto columns_a_metre = hn::Set(d, static_cast<float>(1.0 / grid.tangent_step) / row.ahead_m);
  const auto first_distance = hn::Set(d, static_cast<float>(grid.first_distance_m));
  const auto rows_a_metre = hn::Set(d, static_cast<float>(1.0 / grid.spacing_m));
  const auto last_column = hn::Set(di, grid.columns - 2);
  const auto last_row = hn::Set(di, grid.rows - 2);
  const auto nothing = hn::Zero(di);
  const auto strip_size = static_cast<std::int32_t>(grid.strip_size());
  // A column is as wide as distance * step / (1 + tangent^2), which is step * ahead^2 / distance.
  const double ahead_m = static_cast<double>(row.ahead_m);
  const auto scale_a_metre = hn::Set(
      d, static_cast<float>(static_cast<double>(row.scale) / (grid.tangent_step * grid.spacing_m * ahead_m * ahead_m)));
  const auto lanes = hn::ConvertTo(d, hn::Iota(di, 0));
  for (int i = 0; i < row.columns; i += static_cast<int>(hn::Lanes(d))) {
    const auto number = hn::Add(lanes, hn::Set(d, static_cast<float>(i)));
    const auto right = hn::Add(hn::Set(d, row.first_right_m), hn::Mul(number, hn::Set(d, row.pixel_m)));
    const auto distance = hn::Sqrt(hn::Add(hn::Mul(right, right), ahead2));
    const auto x = hn::Add(middle_column, hn::Mul(right, columns_a_metre));
    const auto y = hn::Mul(hn::Sub(distance, first_distance), rows_a_metre);
    const auto column = hn::Min(hn::Max(hn::ConvertTo(di, x), nothing), last_column);
    const auto line = hn::Min(hn::Max(hn::ConvertTo(di, y), nothing), last_row);
    const auto across = hn::Sub(x, hn::ConvertTo(d, column));
    const auto along = hn::Sub(y, hn::ConvertTo(d, line));
    const auto offset = hn::ShiftLeft<4>(line);
    const auto left_at = hn::Add(start_of(column, strip_size), offset);
    // The rows below will look nearer: their streams, one a strip, are too many for the processor to see.
    hwy::Prefetch(fan + hn::GetLane(left_at) - kFetchAhead * kStripColumns);
    const auto right_at = hn::Add(start_of(hn::Add(column, hn::Set(di, 1)), strip_size), offset);
    const auto near_left = hn::GatherIndex(d, fan, left_at);
    const auto near_right = hn::GatherIndex(d, fan, right_at);
    const auto far_left = hn::GatherIndex(d, fan + kStripColumns, left_at);
    const auto far_right = hn::GatherIndex(d, fan + kStripColumns, right_at);
    const auto near = hn::Add(near_left, hn::Mul(across, hn::Sub(near_right, near_left)));
    const auto far = hn::Add(far_left, hn::Mul(across, hn::Sub(far_right, far_left)));
    const auto value = hn::Add(near, hn::Mul(along, hn::Sub(far, near)));
    const auto drawn = hn::Mul(value, hn::Mul(scale_a_metre, distance));
    const auto left = static_cast<std::size_t>(row.columns - i);
    if (left >= hn::Lanes(d)) {
      hn::StoreU(drawn, d, pixel + i);
    } else {
      HWY_ALIGN float last[kMostLanes];
      hn::StoreU(drawn, d, last);
      std::copy_n(last, left, pixel + i);
    }
  }
}

}  // namespace yars::model::hrm::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::lanes {

HWY_EXPORT(draw_row);

void draw_row(const FanGrid& grid, const float* fan, const MapRow& row, float* pixel) {
  HWY_DYNAMIC_DISPATCH(draw_row)(grid, fan, row, pixel);
}

}  // namespace yars::model::hrm::lanes
#endif  // HWY_ONCE
