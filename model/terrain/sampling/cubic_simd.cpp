#include "model/terrain/sampling/cubic_simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/terrain/sampling/cubic_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Must follow highway.h, which defines HWY_NAMESPACE.
#include "lib/simd/fused-inl.hpp"
#include "model/terrain/sampling/post_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::terrain::sampling::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace fused = yars::simd::HWY_NAMESPACE;

using namespace post_simd::HWY_NAMESPACE;

// Position along rows or columns. Its interval lies between the second and the third of four posts. The posts are read
// as two pairs, which stay inside the grid. At an edge of the grid the post beyond it equals that of the edge.
struct CubicAxis {
  Floats fraction;                      // [0, 1] from the second post to the third
  Ints first, second;                   // index of the first post of each pair
  hn::Mask<IntLanes> at_begin, at_end;  // the interval is the first or the last of the grid
};
HWY_INLINE CubicAxis axis_at(const float* degrees, int posts) {
  const FloatLanes d;
  const IntLanes di;
  const auto intervals = hn::Set(d, static_cast<float>(posts - 1));
  // NaN becomes 0, because Max returns its other operand.
  const auto position = hn::Min(hn::Max(hn::Mul(hn::LoadU(d, degrees), intervals), hn::Zero(d)), intervals);
  const auto whole = hn::Min(hn::Floor(position), hn::Set(d, static_cast<float>(posts - 2)));
  const auto index = hn::ConvertTo(di, whole);
  const auto last = hn::Set(di, posts - 2);
  const auto one = hn::Set(di, 1);
  return {hn::Sub(position, whole), hn::Max(hn::Sub(index, one), hn::Zero(di)), hn::Min(hn::Add(index, one), last),
          hn::Eq(index, hn::Zero(di)), hn::Eq(index, last)};
}

// Catmull-Rom weights of four posts.
struct CubicWeights {
  Floats first, second, third, fourth;
};
HWY_INLINE CubicWeights weights_at(Floats t) {
  const FloatLanes d;
  const auto half_t = hn::Mul(t, hn::Set(d, 0.5F));
  const auto half_square = hn::Mul(half_t, t);
  const auto one = hn::Set(d, 1.0F);
  const auto first = hn::Mul(half_t, fused::mul_sub(hn::Sub(hn::Set(d, 2.0F), t), t, one));
  const auto second = fused::mul_add(half_square, fused::mul_sub(hn::Set(d, 3.0F), t, hn::Set(d, 5.0F)), one);
  const auto third = hn::Mul(half_t, fused::mul_add(fused::neg_mul_add(hn::Set(d, 3.0F), t, hn::Set(d, 4.0F)), t, one));
  return {first, second, third, hn::Mul(half_square, hn::Sub(t, one))};
}

// Four posts of a row, from two words of gather_word().
struct CubicRow {
  Ints first, second, third, fourth;
};
HWY_INLINE CubicRow row_of(Ints west, Ints east, const CubicAxis& columns) {
  return {western(west), hn::IfThenElse(columns.at_begin, western(west), eastern(west)),
          hn::IfThenElse(columns.at_end, eastern(east), western(east)), eastern(east)};
}

HWY_INLINE Floats sum_of(const CubicRow& row, const CubicWeights& weights) {
  const FloatLanes d;
  auto sum = hn::Mul(weights.first, hn::ConvertTo(d, row.first));
  sum = fused::mul_add(weights.second, hn::ConvertTo(d, row.second), sum);
  sum = fused::mul_add(weights.third, hn::ConvertTo(d, row.third), sum);
  return fused::mul_add(weights.fourth, hn::ConvertTo(d, row.fourth), sum);
}

HWY_INLINE hn::Mask<IntLanes> any_void(const CubicRow& row) {
  const auto nothing = hn::Set(IntLanes(), kVoid);
  return hn::Or(hn::Or(hn::Eq(row.first, nothing), hn::Eq(row.second, nothing)),
                hn::Or(hn::Eq(row.third, nothing), hn::Eq(row.fourth, nothing)));
}

void cubic_heights(const Grid& grid, const float* north_deg, const float* east_deg, std::size_t count,
                   float* elevation_m) {
  const FloatLanes d;
  const BlockLanes blocks(*grid.posts);
  const std::int16_t* const posts = grid.posts->data();
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const CubicAxis rows = axis_at(north_deg + i, grid.rows);
    const CubicAxis columns = axis_at(east_deg + i, grid.columns);
    const Words south_west = gather(posts, blocks.offset(rows.first, columns.first));
    const Words south_east = gather(posts, blocks.offset(rows.first, columns.second));
    const Words north_west = gather(posts, blocks.offset(rows.second, columns.first));
    const Words north_east = gather(posts, blocks.offset(rows.second, columns.second));
    const auto choose = [](hn::Mask<IntLanes> mask, Ints yes, Ints no) { return hn::IfThenElse(mask, yes, no); };
    const CubicRow first = row_of(south_west.south, south_east.south, columns);
    const CubicRow second = row_of(choose(rows.at_begin, south_west.south, south_west.north),
                                   choose(rows.at_begin, south_east.south, south_east.north), columns);
    const CubicRow third = row_of(choose(rows.at_end, north_west.north, north_west.south),
                                  choose(rows.at_end, north_east.north, north_east.south), columns);
    const CubicRow fourth = row_of(north_west.north, north_east.north, columns);
    const CubicWeights along = weights_at(rows.fraction), across = weights_at(columns.fraction);
    auto height = hn::Mul(along.first, sum_of(first, across));
    height = fused::mul_add(along.second, sum_of(second, across), height);
    height = fused::mul_add(along.third, sum_of(third, across), height);
    height = hn::Mul(fused::mul_add(along.fourth, sum_of(fourth, across), height), hn::Set(d, grid.unit_m));
    if (grid.voids) {
      const auto has_void =
          hn::Or(hn::Or(any_void(first), any_void(second)), hn::Or(any_void(third), any_void(fourth)));
      height = hn::IfThenElse(hn::RebindMask(d, has_void), hn::LoadU(d, elevation_m + i), height);
    }
    hn::StoreU(height, d, elevation_m + i);
  }
}

}  // namespace yars::model::terrain::sampling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::terrain::sampling {

HWY_EXPORT(cubic_heights);

void cubic_heights(const Grid& grid, const float* north_deg, const float* east_deg, std::size_t count,
                   float* elevation_m) {
  HWY_DYNAMIC_DISPATCH(cubic_heights)(grid, north_deg, east_deg, count, elevation_m);
}

}  // namespace yars::model::terrain::sampling
#endif  // HWY_ONCE
