#include "model/terrain/code_look_up.hpp"

#include "model/terrain/terrain_view.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/terrain/code_look_up.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace yars::model::terrain::look_up::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatLanes = hn::CappedTag<float, kRunSlack>;
using WholeLanes = hn::RebindToSigned<FloatLanes>;

// The nearest post; half up, as std::lround does with what is not negative. Not a number counts as 0: what lies in the
// slack must not lead anywhere.
HWY_INLINE hn::Vec<WholeLanes> nearest(const float* degrees, float intervals) {
  const FloatLanes d;
  const auto most = hn::Set(d, intervals);
  const auto inside = hn::Min(hn::Max(hn::Mul(hn::LoadU(d, degrees), most), hn::Zero(d)), most);
  return hn::ConvertTo(WholeLanes(), hn::Add(inside, hn::Set(d, 0.5F)));
}

void codes(const Culture& culture, const float* north_deg, const float* east_deg, std::size_t count,
           std::int32_t* material) {
  const WholeLanes di;
  const std::uint8_t* const posts = culture.codes().data();
  for (std::size_t i = 0; i < count; i += hn::Lanes(di)) {
    const auto row = nearest(north_deg + i, static_cast<float>(culture.rows() - 1));
    const auto column = nearest(east_deg + i, static_cast<float>(culture.columns() - 1));
    const auto entry = hn::Add(hn::Mul(row, hn::Set(di, culture.columns())), column);
#if HWY_TARGET == HWY_SCALAR
    // Highway would load a word where none is aligned.
    const auto word = hn::Set(di, std::int32_t{posts[hn::GetLane(entry)]});
#else
    const auto word = hn::GatherOffset(di, reinterpret_cast<const std::int32_t*>(posts), entry);
#endif
    hn::StoreU(hn::And(word, hn::Set(di, 0xff)), di, material + i);
  }
}

}  // namespace yars::model::terrain::look_up::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::terrain::look_up {

HWY_EXPORT(codes);

void codes(const Culture& culture, const float* north_deg, const float* east_deg, std::size_t count,
           std::int32_t* material) {
  HWY_DYNAMIC_DISPATCH(codes)(culture, north_deg, east_deg, count, material);
}

}  // namespace yars::model::terrain::look_up
#endif  // HWY_ONCE
