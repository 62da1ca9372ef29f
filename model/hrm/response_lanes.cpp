#include "model/hrm/response_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/response_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kBlock>;

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

// What a block receives from each of the points in turn, summed before it is stored: neighbours' sums would wait for
// one another.
void spread_along(const float* from, std::size_t reach, const float* middle, float* to) {
  const Tag d;
  std::size_t points[kBlock];
  std::size_t count = 0;
  for (std::size_t i = 0; i < kBlock; ++i)
    if (from[i] != 0.0F) points[count++] = i;
  const auto begin = -static_cast<std::ptrdiff_t>(reach * kBlock);
  for (std::ptrdiff_t at = begin; at < -begin + static_cast<std::ptrdiff_t>(kBlock);
       at += static_cast<std::ptrdiff_t>(hn::Lanes(d))) {
    auto sum = hn::LoadU(d, to + at);
    for (std::size_t k = 0; k < count; ++k)
      sum = hn::Add(sum, hn::Mul(hn::Set(d, from[points[k]]),
                                 hn::LoadU(d, middle + at - static_cast<std::ptrdiff_t>(points[k]))));
    hn::StoreU(sum, d, to + at);
  }
}

}  // namespace yars::model::hrm::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::lanes {

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
void spread_along(const float* from, std::size_t reach, const float* middle, float* to) {
  HWY_DYNAMIC_DISPATCH(spread_along)(from, reach, middle, to);
}

}  // namespace yars::model::hrm::lanes
#endif  // HWY_ONCE
