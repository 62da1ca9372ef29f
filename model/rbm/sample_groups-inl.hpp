// Arithmetic on groups of SIMD vectors of float, one lane per sample. A group is a vector, a pair of vectors, or a pair
// of pairs.
// The vectors of a group are independent, so the processor overlaps their operations. This hides latency (a square root
// takes twenty cycles).
// Included once for each target (instruction set) of the library Highway.
#if defined(YARS_MODEL_RBM_SAMPLE_GROUPS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef YARS_MODEL_RBM_SAMPLE_GROUPS_INL
#undef YARS_MODEL_RBM_SAMPLE_GROUPS_INL
#else
#define YARS_MODEL_RBM_SAMPLE_GROUPS_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "lib/simd/fused-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::rbm::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace fused = yars::simd::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;
using Floats = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

// Pair of groups of the same kind. `near` has the samples nearer to the aircraft.
template <class Half>
struct Pair {
  Half near, far;
};

template <class Value>
inline constexpr bool kIsPair = false;
template <class Half>
inline constexpr bool kIsPair<Pair<Half>> = true;

// Applies `step` to each vector of the groups.
template <class Step, class Group, class... Groups>
HWY_INLINE auto each(Step step, const Group& first, const Groups&... others) {
  if constexpr (kIsPair<Group>) {
    auto near = each(step, first.near, others.near...);
    return Pair<decltype(near)>{near, each(step, first.far, others.far...)};
  } else {
    return step(first, others...);
  }
}

template <class Group>
HWY_INLINE std::size_t lanes_of() {
  if constexpr (kIsPair<Group>) {
    return 2 * lanes_of<decltype(Group::near)>();
  } else {
    return hn::Lanes(Tag());
  }
}

template <class Group>
HWY_INLINE Group constant(float value) {
  if constexpr (kIsPair<Group>) {
    auto half = constant<decltype(Group::near)>(value);
    return {half, half};
  } else {
    return hn::Set(Tag(), value);
  }
}

template <class Group>
HWY_INLINE Group load(const float* from) {
  if constexpr (kIsPair<Group>) {
    using Half = decltype(Group::near);
    return {load<Half>(from), load<Half>(from + lanes_of<Half>())};
  } else {
    return hn::LoadU(Tag(), from);
  }
}

template <class Group>
HWY_INLINE void store(const Group& value, float* to) {
  if constexpr (kIsPair<Group>) {
    store(value.near, to);
    store(value.far, to + lanes_of<decltype(Group::near)>());
  } else {
    hn::StoreU(value, Tag(), to);
  }
}

template <class Group>
HWY_INLINE Group add(const Group& a, const Group& b) {
  return each([](Floats x, Floats y) { return hn::Add(x, y); }, a, b);
}
template <class Group>
HWY_INLINE Group sub(const Group& a, const Group& b) {
  return each([](Floats x, Floats y) { return hn::Sub(x, y); }, a, b);
}
template <class Group>
HWY_INLINE Group mul(const Group& a, const Group& b) {
  return each([](Floats x, Floats y) { return hn::Mul(x, y); }, a, b);
}
template <class Group>
HWY_INLINE Group div(const Group& a, const Group& b) {
  return each([](Floats x, Floats y) { return hn::Div(x, y); }, a, b);
}
template <class Group>
HWY_INLINE Group max(const Group& a, const Group& b) {
  return each([](Floats x, Floats y) { return hn::Max(x, y); }, a, b);
}
template <class Group>
HWY_INLINE Group min(const Group& a, const Group& b) {
  return each([](Floats x, Floats y) { return hn::Min(x, y); }, a, b);
}
template <class Group>
HWY_INLINE Group abs(const Group& a) {
  return each([](Floats x) { return hn::Abs(x); }, a);
}
template <class Group>
HWY_INLINE Group sqrt(const Group& a) {
  return each([](Floats x) { return hn::Sqrt(x); }, a);
}
// a * b + c, c - a * b, a * b - c, each rounded once (lib/simd/fused-inl.hpp).
template <class Group>
HWY_INLINE Group mul_add(const Group& a, const Group& b, const Group& c) {
  return each([](Floats x, Floats y, Floats z) { return fused::mul_add(x, y, z); }, a, b, c);
}
template <class Group>
HWY_INLINE Group neg_mul_add(const Group& a, const Group& b, const Group& c) {
  return each([](Floats x, Floats y, Floats z) { return fused::neg_mul_add(x, y, z); }, a, b, c);
}
template <class Group>
HWY_INLINE Group mul_sub(const Group& a, const Group& b, const Group& c) {
  return each([](Floats x, Floats y, Floats z) { return fused::mul_sub(x, y, z); }, a, b, c);
}

template <class Group>
HWY_INLINE auto less(const Group& a, const Group& b) {
  return each([](Floats x, Floats y) { return hn::Lt(x, y); }, a, b);
}
template <class Group>
HWY_INLINE auto less_or_equal(const Group& a, const Group& b) {
  return each([](Floats x, Floats y) { return hn::Le(x, y); }, a, b);
}
// False for NaN.
template <class Group>
HWY_INLINE auto is_number(const Group& a) {
  return each([](Floats x) { return hn::Eq(x, x); }, a);
}
template <class Group>
HWY_INLINE auto both(const Group& a, const Group& b) {
  return each([](Mask x, Mask y) { return hn::And(x, y); }, a, b);
}
template <class Group>
HWY_INLINE bool none(const Group& mask) {
  if constexpr (kIsPair<Group>) {
    return none(each([](Mask x, Mask y) { return hn::Or(x, y); }, mask.near, mask.far));
  } else {
    return hn::AllFalse(Tag(), mask);
  }
}
template <class Group>
HWY_INLINE bool all(const Group& mask) {
  if constexpr (kIsPair<Group>) {
    return all(both(mask.near, mask.far));
  } else {
    return hn::AllTrue(Tag(), mask);
  }
}
template <class Group, class GroupMask>
HWY_INLINE Group choose(const GroupMask& mask, const Group& yes, const Group& no) {
  return each([](Mask m, Floats x, Floats y) { return hn::IfThenElse(m, x, y); }, mask, yes, no);
}
// `yes` in the lanes of the mask, 0 in the others.
template <class Group, class GroupMask>
HWY_INLINE Group or_zero(const GroupMask& mask, const Group& yes) {
  return each([](Mask m, Floats x) { return hn::IfThenElseZero(m, x); }, mask, yes);
}

}  // namespace yars::model::rbm::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
