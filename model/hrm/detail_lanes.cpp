#include "model/hrm/detail_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/detail_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;
using SignedTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;

// The second look at the table: turned by 70 degrees and stretched by the golden ratio, so that the two periods never
// meet.
constexpr float kTurnCosine = 0.3420201F;
constexpr float kTurnSine = 0.9396926F;
constexpr float kStretch = 1.618034F;

HWY_INLINE Floats look_up(const DetailTable& table, Floats x, Floats y) {
  const Tag d;
  const SignedTag di;
  const auto mask = hn::Set(di, table.edge - 1);
  const auto pitch = hn::Set(di, table.edge);
  const auto one = hn::Set(di, 1);
  const auto column = hn::Floor(x);
  const auto row = hn::Floor(y);
  const auto left = hn::And(hn::ConvertTo(di, column), mask);
  const auto right = hn::And(hn::Add(left, one), mask);
  const auto near = hn::And(hn::ConvertTo(di, row), mask);
  const auto near_at = hn::Mul(near, pitch);
  const auto far_at = hn::Mul(hn::And(hn::Add(near, one), mask), pitch);
  const auto a = hn::Sub(x, column);
  const auto b = hn::Sub(y, row);
  const auto near_left = hn::GatherIndex(d, table.texels, hn::Add(near_at, left));
  const auto near_right = hn::GatherIndex(d, table.texels, hn::Add(near_at, right));
  const auto far_left = hn::GatherIndex(d, table.texels, hn::Add(far_at, left));
  const auto far_right = hn::GatherIndex(d, table.texels, hn::Add(far_at, right));
  const auto low = hn::Add(near_left, hn::Mul(a, hn::Sub(near_right, near_left)));
  const auto high = hn::Add(far_left, hn::Mul(a, hn::Sub(far_right, far_left)));
  return hn::Add(low, hn::Mul(b, hn::Sub(high, low)));
}

void modulate(std::size_t count, const DetailTable& table, const float* east_deg, const float* north_deg,
              float east_scale, float north_scale, float* gain) {
  const Tag d;
  const auto cosine = hn::Set(d, kStretch * kTurnCosine);
  const auto sine = hn::Set(d, kStretch * kTurnSine);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto east = hn::Mul(hn::LoadU(d, east_deg + i), hn::Set(d, east_scale));
    const auto north = hn::Mul(hn::LoadU(d, north_deg + i), hn::Set(d, north_scale));
    const auto turned_east = hn::Sub(hn::Mul(cosine, east), hn::Mul(sine, north));
    const auto turned_north = hn::Add(hn::Mul(sine, east), hn::Mul(cosine, north));
    const auto factor = hn::Mul(look_up(table, east, north), look_up(table, turned_east, turned_north));
    hn::StoreU(hn::Mul(hn::LoadU(d, gain + i), factor), d, gain + i);
  }
}

}  // namespace yars::model::hrm::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::lanes {

HWY_EXPORT(modulate);

void modulate(std::size_t count, const DetailTable& table, const float* east_deg, const float* north_deg,
              float east_scale, float north_scale, float* gain) {
  HWY_DYNAMIC_DISPATCH(modulate)(count, table, east_deg, north_deg, east_scale, north_scale, gain);
}

}  // namespace yars::model::hrm::lanes
#endif  // HWY_ONCE
