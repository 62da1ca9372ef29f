#include "model/hrm/response_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/response_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;

void add_neighbours(std::size_t count, const float* from, std::ptrdiff_t stride, std::ptrdiff_t first,
                    std::span<const float> weights, float* to) {
  const Tag d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    auto sum = hn::LoadU(d, to + i);
    const float* before = from + i - first * stride;
    const float* behind = from + i + first * stride;
    for (const float weight : weights) {
      sum = hn::Add(sum, hn::Mul(hn::Set(d, weight), hn::Add(hn::LoadU(d, before), hn::LoadU(d, behind))));
      before -= stride;
      behind += stride;
    }
    hn::StoreU(sum, d, to + i);
  }
}

void scale(std::size_t count, const float* from, float weight, float* to) {
  const Tag d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d))
    hn::StoreU(hn::Mul(hn::Set(d, weight), hn::LoadU(d, from + i)), d, to + i);
}

bool keep_above(std::size_t count, const float* from, float limit, float* to) {
  const Tag d;
  auto most = hn::Zero(d);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto value = hn::LoadU(d, from + i);
    const auto kept = hn::IfThenElseZero(hn::Gt(value, hn::Set(d, limit)), value);
    most = hn::Max(most, kept);
    hn::StoreU(kept, d, to + i);
  }
  return !hn::AllFalse(d, hn::Gt(most, hn::Zero(d)));
}

}  // namespace yars::model::hrm::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::lanes {

HWY_EXPORT(add_neighbours);
HWY_EXPORT(scale);
HWY_EXPORT(keep_above);

void add_neighbours(std::size_t count, const float* from, std::ptrdiff_t stride, std::ptrdiff_t first,
                    std::span<const float> weights, float* to) {
  HWY_DYNAMIC_DISPATCH(add_neighbours)(count, from, stride, first, weights, to);
}
void scale(std::size_t count, const float* from, float weight, float* to) {
  HWY_DYNAMIC_DISPATCH(scale)(count, from, weight, to);
}
bool keep_above(std::size_t count, const float* from, float limit, float* to) {
  return HWY_DYNAMIC_DISPATCH(keep_above)(count, from, limit, to);
}

}  // namespace yars::model::hrm::lanes
#endif  // HWY_ONCE
