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

// One of the four bytes of a word as a number.
template <int kShift>
HWY_INLINE Floats byte_of(hn::Vec<SignedTag> word) {
  const SignedTag di;
  return hn::ConvertTo(Tag(), hn::And(hn::ShiftRight<kShift>(word), hn::Set(di, 0xff)));
}

// A place along an axis of the table, apart: the texel, and the way on from it.
struct Apart {
  hn::Vec<SignedTag> whole;
  Floats share;
};
// Rounded half a texel before the place: a place on a texel may count as the end of the one before, which is the same.
HWY_INLINE Apart apart(Floats place) {
  const Tag d;
  constexpr float kOnes = 12582912.0F;  // 1.5 * 2^23: in the sum the last bit counts ones
  const auto sum = hn::Add(hn::Sub(place, hn::Set(d, 0.5F)), hn::Set(d, kOnes));
  return {hn::BitCast(SignedTag(), sum), hn::Sub(place, hn::Sub(sum, hn::Set(d, kOnes)))};
}

HWY_INLINE Floats look_up(const DetailTable& table, Floats x, Floats y) {
  const SignedTag di;
  const auto mask = hn::Set(di, table.edge - 1);
  const Apart column = apart(x);
  const Apart row = apart(y);
  const auto i = hn::And(column.whole, mask);
  const auto j = hn::And(row.whole, mask);
  const auto low_bits = hn::Set(di, kDetailBlock - 1);
  // Whole lines of blocks, whole blocks of the line, and within the block.
  const auto lines = hn::Mul(hn::AndNot(low_bits, j), hn::Set(di, table.edge));
  const auto blocks = hn::ShiftLeft<2>(hn::AndNot(low_bits, i));
  const auto within = hn::Add(hn::ShiftLeft<2>(hn::And(j, low_bits)), hn::And(i, low_bits));
  const auto at = hn::Add(hn::Add(lines, blocks), within);
  static_assert(kDetailBlock == 4);
  const auto word = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(table.texels), at);
  const auto near_left = byte_of<0>(word);
  const auto far_left = byte_of<16>(word);
  const auto low = hn::Add(near_left, hn::Mul(column.share, hn::Sub(byte_of<8>(word), near_left)));
  const auto high = hn::Add(far_left, hn::Mul(column.share, hn::Sub(byte_of<24>(word), far_left)));
  return hn::Add(low, hn::Mul(row.share, hn::Sub(high, low)));
}

void modulate(std::size_t count, const DetailTable& table, const float* east_deg, const float* north_deg,
              float east_scale, float north_scale, float* gain) {
  const Tag d;
  const auto cosine = hn::Set(d, kStretch * kTurnCosine);
  const auto sine = hn::Set(d, kStretch * kTurnSine);
  const auto unit2 = hn::Set(d, table.unit2);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto east = hn::Mul(hn::LoadU(d, east_deg + i), hn::Set(d, east_scale));
    const auto north = hn::Mul(hn::LoadU(d, north_deg + i), hn::Set(d, north_scale));
    const auto turned_east = hn::Sub(hn::Mul(cosine, east), hn::Mul(sine, north));
    const auto turned_north = hn::Add(hn::Mul(sine, east), hn::Mul(cosine, north));
    const auto factor = hn::Mul(look_up(table, east, north), look_up(table, turned_east, turned_north));
    hn::StoreU(hn::Mul(hn::LoadU(d, gain + i), hn::Mul(factor, unit2)), d, gain + i);
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
