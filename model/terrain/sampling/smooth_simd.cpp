#include "model/terrain/sampling/smooth_simd.hpp"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/terrain/sampling/smooth_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Must follow highway.h, which defines HWY_NAMESPACE.
#include "lib/simd/fused-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::terrain::smooth::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace fused = yars::simd::HWY_NAMESPACE;

using FloatLanes = hn::CappedTag<float, kRunSlack>;
using IntLanes = hn::RebindToSigned<FloatLanes>;
using Floats = hn::Vec<FloatLanes>;

// Maximum ratio of the slope at a post to the smaller of the height differences to its two neighbours. Above 3 the
// cubic may overshoot (Fritsch, Carlson 1980).
constexpr float kMaxSlopeRatio = 3.0F;

// Heights of the four nodes (points of the finer grid) around a position. `north`, `east`: the position, from 0 at the
// south-western node to 1 at the next node north or east.
struct Quad {
  Floats south_west, south_east, north_west, north_east, north, east;
};
HWY_INLINE Floats bilinear(const Quad& quad) {
  const auto south = fused::mul_add(quad.east, hn::Sub(quad.south_east, quad.south_west), quad.south_west);
  const auto north = fused::mul_add(quad.east, hn::Sub(quad.north_east, quad.north_west), quad.north_west);
  return fused::mul_add(quad.north, hn::Sub(north, south), south);
}

// Bilinear mean over the nodes that are not void, with their weights scaled to a sum of 1. NaN if these nodes have no
// weight.
HWY_INLINE Floats without_voids(const Quad& quad) {
  const FloatLanes d;
  const auto one = hn::Set(d, 1.0F);
  auto weights = hn::Zero(d), sum = hn::Zero(d);
  const auto add = [&](Floats node, Floats weight) HWY_ATTR {
    const auto known = hn::Eq(node, node);
    weights = hn::Add(weights, hn::IfThenElseZero(known, weight));
    sum = hn::Add(sum, hn::IfThenElseZero(known, hn::Mul(weight, node)));
  };
  const auto south = hn::Sub(one, quad.north), west = hn::Sub(one, quad.east);
  add(quad.south_west, hn::Mul(south, west));
  add(quad.south_east, hn::Mul(south, quad.east));
  add(quad.north_west, hn::Mul(quad.north, west));
  add(quad.north_east, hn::Mul(quad.north, quad.east));
  const auto some = hn::Gt(weights, hn::Zero(d));
  const auto nothing = hn::Set(d, std::numeric_limits<float>::quiet_NaN());
  return hn::IfThenElse(some, hn::Div(sum, hn::IfThenElse(some, weights, one)), nothing);
}

bool heights(const Nodes& nodes, const float* north_deg, const float* east_deg, std::size_t count, float* elevation_m) {
  bool all = true;
  const FloatLanes d;
  const IntLanes di;
  const auto zero = hn::Zero(d);
  const auto last_row = hn::Set(d, static_cast<float>(nodes.rows - 1));
  const auto last_column = hn::Set(d, static_cast<float>(nodes.columns - 1));
  const auto one = hn::Set(d, 1.0F);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto row =
        hn::Sub(hn::Mul(hn::LoadU(d, north_deg + i), hn::Set(d, nodes.rows_per_degree)), hn::Set(d, nodes.first_row));
    const auto column = hn::Sub(hn::Mul(hn::LoadU(d, east_deg + i), hn::Set(d, nodes.columns_per_degree)),
                                hn::Set(d, nodes.first_column));
    auto within = hn::And(hn::And(hn::Ge(row, zero), hn::Le(row, last_row)),
                          hn::And(hn::Ge(column, zero), hn::Le(column, last_column)));
    const auto active = hn::FirstN(d, count - i);
    all = all && hn::AllFalse(d, hn::AndNot(within, active));
    within = hn::And(within, active);
    if (hn::AllFalse(d, within)) continue;
    const auto south = hn::IfThenElseZero(within, hn::Min(hn::Floor(row), hn::Sub(last_row, one)));
    const auto west = hn::IfThenElseZero(within, hn::Min(hn::Floor(column), hn::Sub(last_column, one)));
    const auto at = hn::Add(hn::Mul(hn::ConvertTo(di, south), hn::Set(di, nodes.columns)), hn::ConvertTo(di, west));
    const Quad quad{hn::GatherIndex(d, nodes.height_m, at),
                    hn::GatherIndex(d, nodes.height_m + 1, at),
                    hn::GatherIndex(d, nodes.height_m + nodes.columns, at),
                    hn::GatherIndex(d, nodes.height_m + nodes.columns + 1, at),
                    hn::Sub(row, south),
                    hn::Sub(column, west)};
    auto height = bilinear(quad);
    const auto has_void = hn::And(within, hn::Ne(height, height));
    if (!hn::AllFalse(d, has_void)) height = hn::IfThenElse(has_void, without_voids(quad), height);
    hn::BlendedStore(height, within, d, elevation_m + i);
  }
  return all;
}

void limited_slopes(std::size_t count, const Neighbours& posts, float* slope) {
  const FloatLanes d;
  const auto zero = hn::Zero(d);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto here = hn::LoadU(d, posts.here + i);
    auto behind = hn::Sub(here, hn::LoadU(d, posts.before + i));
    auto ahead = hn::Sub(hn::LoadU(d, posts.after + i), here);
    // Next to a void, the difference on the other side replaces the unknown one.
    behind = hn::IfThenElse(hn::Eq(behind, behind), behind, ahead);
    ahead = hn::IfThenElse(hn::Eq(ahead, ahead), ahead, behind);
    const auto max_slope = hn::Mul(hn::Set(d, kMaxSlopeRatio), hn::Min(hn::Abs(behind), hn::Abs(ahead)));
    const auto mean = hn::Mul(hn::Set(d, 0.5F), hn::Add(behind, ahead));
    const auto limited = hn::Max(hn::Neg(max_slope), hn::Min(mean, max_slope));
    hn::StoreU(hn::IfThenElseZero(hn::Gt(hn::Mul(behind, ahead), zero), limited), d, slope + i);
  }
}

void between(std::size_t count, const Interval& ends, float fraction, float* height) {
  const FloatLanes d;
  const float complement = 1.0F - fraction;
  // Hermite basis functions at `fraction`: of the height difference far - near, and of the slopes at near and far.
  const auto rise = hn::Set(d, fraction * fraction * (3.0F - 2.0F * fraction));
  const auto start = hn::Set(d, fraction * complement * complement);
  const auto end = hn::Set(d, -fraction * fraction * complement);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto near = hn::LoadU(d, ends.near + i);
    const auto far = hn::LoadU(d, ends.far + i);
    auto value = fused::mul_add(rise, hn::Sub(far, near), near);
    value = fused::mul_add(start, hn::LoadU(d, ends.near_slope + i), value);
    value = fused::mul_add(end, hn::LoadU(d, ends.far_slope + i), value);
    const auto known_end = hn::IfThenElse(hn::Eq(near, near), near, far);
    hn::StoreU(hn::IfThenElse(hn::Eq(value, value), value, known_end), d, height + i);
  }
}

}  // namespace yars::model::terrain::smooth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::terrain::smooth {

HWY_EXPORT(heights);
HWY_EXPORT(limited_slopes);
HWY_EXPORT(between);

bool heights(const Nodes& nodes, const float* north_deg, const float* east_deg, std::size_t count, float* elevation_m) {
  return HWY_DYNAMIC_DISPATCH(heights)(nodes, north_deg, east_deg, count, elevation_m);
}
void limited_slopes(std::size_t count, const Neighbours& posts, float* slope) {
  HWY_DYNAMIC_DISPATCH(limited_slopes)(count, posts, slope);
}
void between(std::size_t count, const Interval& ends, float fraction, float* height) {
  HWY_DYNAMIC_DISPATCH(between)(count, ends, fraction, height);
}

}  // namespace yars::model::terrain::smooth
#endif  // HWY_ONCE
