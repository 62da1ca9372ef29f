// Running maximum of the tangents of elevation angles along a sweep. It decides which samples are in shadow. Groups
// (sample_groups-inl.hpp) of float vectors are computed together.
// Included once for each target (instruction set) of the library Highway.
// Results do not depend on the vector width, because a maximum does not round.
#if defined(YARS_MODEL_RBM_HORIZON_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef YARS_MODEL_RBM_HORIZON_SIMD_INL
#undef YARS_MODEL_RBM_HORIZON_SIMD_INL
#else
#define YARS_MODEL_RBM_HORIZON_SIMD_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "model/rbm/sample_groups-inl.hpp"
#include "model/rbm/sweep_simd.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::rbm::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Permutation that gives each lane the value of the lane `back` positions nearer to the first lane. The first `back`
// lanes get the value of the first lane.
HWY_INLINE auto lanes_before(std::size_t back) {
  const hn::RebindToSigned<Tag> di;
  const auto lane = hn::Sub(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(back)));
  return hn::IndicesFromVec(Tag(), hn::Max(lane, hn::Zero(di)));
}

// Permutation that gives each lane the value of the last lane.
HWY_INLINE auto last_lane() {
  const hn::RebindToSigned<Tag> di;
  return hn::IndicesFromVec(Tag(), hn::Set(di, static_cast<std::int32_t>(hn::Lanes(Tag())) - 1));
}

// Maximum tangent of all samples up to each sample.
template <class Group>
struct Horizon {
  Group upto;    // including the sample
  Group before;  // excluding the sample
};

// Running maximum over successive groups of samples.
class RunningMaximum {
 public:
  HWY_INLINE RunningMaximum()
      : back_{lanes_before(1), lanes_before(2), lanes_before(4), lanes_before(8)},
        last_(last_lane()),
        carry_(constant<Floats>(kNoHorizon)) {}

  // Horizons of the next group of samples, which have the tangents `tangent`.
  template <class Group>
  HWY_INLINE Horizon<Group> after(const Group& tangent) {
    auto maximum = tangent;
    // After step k, a lane has the maximum over itself and the 2^(k+1) - 1 lanes before it.
    for (std::size_t step = 0; std::size_t{1} << step < hn::Lanes(Tag()); ++step)
      maximum = max(maximum, each([&](Floats x) { return hn::TableLookupLanes(x, back_[step]); }, maximum));
    return with_carry(maximum);
  }

 private:
  static_assert(hn::MaxLanes(Tag()) <= 16);

  // `maximum`: running maximum within each vector.
  template <class Group>
  HWY_INLINE Horizon<Group> with_carry(const Group& maximum) {
    if constexpr (kIsPair<Group>) {
      const auto near = with_carry(maximum.near);
      const auto far = with_carry(maximum.far);
      return {{near.upto, far.upto}, {near.before, far.before}};
    } else {
      const auto upto = hn::Max(maximum, carry_);
      const auto before = hn::IfThenElse(hn::FirstN(Tag(), 1), carry_, hn::TableLookupLanes(upto, back_[0]));
      carry_ = hn::TableLookupLanes(upto, last_);
      return {upto, before};
    }
  }

  using Indices = decltype(last_lane());
  Indices back_[4];
  Indices last_;
  Floats carry_;  // maximum of all previous samples, in every lane
};

}  // namespace yars::model::rbm::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
