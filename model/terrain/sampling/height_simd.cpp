#include "model/terrain/sampling/height_simd.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/terrain/sampling/terrain_view.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/terrain/sampling/height_simd.cpp"
#include <hwy/cache_control.h>
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

// Number of positions in a batch. While one batch is interpolated, the posts of the next batch are prefetched. A
// smaller batch leaves less time for the prefetch.
constexpr std::size_t kBatch = 128;

// A batch of positions in the grid. offset: byte offset of the post to the south-west. north, east: fractions of the
// intervals north and east of that post.
struct Located {
  HWY_ALIGN std::int32_t offset[kBatch];
  HWY_ALIGN float north[kBatch];
  HWY_ALIGN float east[kBatch];
};

// Clamps to [0, max]. NaN becomes 0, because Max returns its other operand. The unused entries after the last position
// therefore give valid addresses.
HWY_INLINE Floats clamped(Floats value, Floats max) {
  return hn::Min(hn::Max(value, hn::Zero(FloatLanes())), max);
}

// Splits a position along rows or columns [posts] into the index of its interval and the fraction within it.
// `last`: index of the last interval, to which its far end belongs (fraction 1).
struct SplitPosition {
  Floats fraction;  // [0, 1]
  Ints whole;
};
HWY_INLINE SplitPosition split(Floats position, Floats last) {
  const auto whole = hn::Min(hn::Floor(position), last);
  return {hn::Sub(position, whole), integer(whole)};
}

// Number of successive positions per prefetch, so that each cache line is prefetched about once.
std::size_t positions_per_line(const Grid& grid, const float* north_deg, const float* east_deg, std::size_t count) {
  if (count < 2) return 1;
  const float rows = std::abs(north_deg[count - 1] - north_deg[0]) * static_cast<float>(grid.rows - 1);
  const float columns = std::abs(east_deg[count - 1] - east_deg[0]) * static_cast<float>(grid.columns - 1);
  const float lines =
      rows / static_cast<float>(PostBlocks::kRowStep) + columns / static_cast<float>(PostBlocks::kColumnStep) + 1.0F;
  return std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<float>(count) / lines));
}

// Computes post offsets and fractions of `count` positions. In each vector, prefetches the posts of the first position
// and of every `fetch_step`-th position after it.
HWY_INLINE void locate(const Grid& grid, const float* north_deg, const float* east_deg, std::size_t count,
                       std::size_t fetch_step, Located& located) {
  const FloatLanes d;
  const IntLanes di;
  const auto row_intervals = hn::Set(d, static_cast<float>(grid.rows - 1));
  const auto column_intervals = hn::Set(d, static_cast<float>(grid.columns - 1));
  const auto last_row = hn::Set(d, static_cast<float>(grid.rows - 2));
  const auto last_column = hn::Set(d, static_cast<float>(grid.columns - 2));
  const BlockLanes blocks(*grid.posts);
  const auto* const bytes = reinterpret_cast<const char*>(grid.posts->data());
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const SplitPosition row =
        split(clamped(hn::Mul(hn::LoadU(d, north_deg + i), row_intervals), row_intervals), last_row);
    const SplitPosition column =
        split(clamped(hn::Mul(hn::LoadU(d, east_deg + i), column_intervals), column_intervals), last_column);
    hn::Store(blocks.offset(row.whole, column.whole), di, located.offset + i);
    hn::Store(row.fraction, d, located.north + i);
    hn::Store(column.fraction, d, located.east + i);
    for (std::size_t position = 0; position < hn::Lanes(d); position += fetch_step)
      hwy::Prefetch(bytes + located.offset[i + position]);
  }
}

// The four posts around a position.
struct Posts {
  Ints south_west, south_east, north_west, north_east;
};

HWY_INLINE Posts unpacked(Words words) {
  return {western(words.south), eastern(words.south), western(words.north), eastern(words.north)};
}

HWY_INLINE Floats bilinear(Floats south_west, Floats south_east, Floats north_west, Floats north_east, Floats north,
                           Floats east) {
  const auto south_m = fused::mul_add(east, hn::Sub(south_east, south_west), south_west);
  const auto north_m = fused::mul_add(east, hn::Sub(north_east, north_west), north_west);
  return fused::mul_add(north, hn::Sub(north_m, south_m), south_m);
}

// Sum of the bilinear weights of the posts at exactly 0 m.
HWY_INLINE Floats water_fraction(const Posts& posts, Floats north, Floats east) {
  const FloatLanes d;
  const IntLanes di;
  const auto one = hn::Set(d, 1.0F);
  const auto at_sea = [&](Ints post) { return hn::IfThenElseZero(hn::RebindMask(d, hn::Eq(post, hn::Zero(di))), one); };
  return bilinear(at_sea(posts.south_west), at_sea(posts.south_east), at_sea(posts.north_west),
                  at_sea(posts.north_east), north, east);
}

HWY_INLINE hn::Mask<IntLanes> any_equal(const Posts& posts, Ints value) {
  return hn::Or(hn::Or(hn::Eq(posts.south_west, value), hn::Eq(posts.south_east, value)),
                hn::Or(hn::Eq(posts.north_west, value), hn::Eq(posts.north_east, value)));
}

// True if no post of the vector is 0. Posts are compared as unsigned 16-bit words: their minimum is 0 if a post is 0.
HWY_INLINE bool none_at_sea([[maybe_unused]] Words words, [[maybe_unused]] const Posts& posts) {
#if HWY_TARGET == HWY_SCALAR
  return hn::AllFalse(IntLanes(), any_equal(posts, hn::Zero(IntLanes())));
#else
  const hn::Repartition<std::uint16_t, IntLanes> d16;
  const auto minimum = hn::Min(hn::BitCast(d16, words.south), hn::BitCast(d16, words.north));
  return hn::AllFalse(d16, hn::Eq(minimum, hn::Zero(d16)));
#endif
}

// Bilinear mean over the posts that are not void, with their weights scaled to a sum of 1: height in units of the grid,
// and water fraction. If these posts have no weight, the height is NaN and the water fraction 0.
struct WeightedMean {
  Floats height, water;
};
HWY_INLINE WeightedMean without_voids(const Posts& posts, Floats north, Floats east) {
  const FloatLanes d;
  const IntLanes di;
  const auto one = hn::Set(d, 1.0F);
  const auto south = hn::Sub(one, north);
  const auto west = hn::Sub(one, east);
  auto weights = hn::Zero(d);
  auto height = hn::Zero(d);
  auto water = hn::Zero(d);
  const auto add = [&](Ints post, Floats weight) {
    const auto known = hn::RebindMask(d, hn::Ne(post, hn::Set(di, kVoid)));
    const auto counted = hn::IfThenElseZero(known, weight);
    weights = hn::Add(weights, counted);
    height = fused::mul_add(counted, hn::ConvertTo(d, post), height);
    water = hn::Add(water, hn::IfThenElseZero(hn::RebindMask(d, hn::Eq(post, hn::Zero(di))), counted));
  };
  add(posts.south_west, hn::Mul(south, west));
  add(posts.south_east, hn::Mul(south, east));
  add(posts.north_west, hn::Mul(north, west));
  add(posts.north_east, hn::Mul(north, east));
  const auto some = hn::Gt(weights, hn::Zero(d));
  const auto divisor = hn::IfThenElse(some, weights, one);
  const auto nothing = hn::Set(d, std::numeric_limits<float>::quiet_NaN());
  return {hn::IfThenElse(some, hn::Div(height, divisor), nothing), hn::Div(water, divisor)};
}

// Height `near` posts before the position. NaN if that lies beyond the four posts or one of them is void.
HWY_INLINE Floats near_height(const Grid& grid, const Posts& posts, Floats north, Floats east, const Near& near) {
  const FloatLanes d;
  const IntLanes di;
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0F);
  const auto before_north = hn::Sub(north, hn::Set(d, near.rows));
  const auto before_east = hn::Sub(east, hn::Set(d, near.columns));
  auto inside =
      hn::And(hn::Ge(hn::Min(before_north, before_east), zero), hn::Le(hn::Max(before_north, before_east), one));
  if (grid.voids) inside = hn::AndNot(hn::RebindMask(d, any_equal(posts, hn::Set(di, kVoid))), inside);
  const auto height =
      bilinear(hn::ConvertTo(d, posts.south_west), hn::ConvertTo(d, posts.south_east),
               hn::ConvertTo(d, posts.north_west), hn::ConvertTo(d, posts.north_east), before_north, before_east);
  return hn::IfThenElse(inside, height, hn::Set(d, std::numeric_limits<float>::quiet_NaN()));
}

// The same outputs from a later position on.
Heights outputs_from(Heights found, std::size_t start) {
  const auto advance = [start](auto*& values) {
    if (values != nullptr) values += start;
  };
  advance(found.elevation_m);
  advance(found.water);
  advance(found.material);
  advance(found.near.elevation_m);
  return found;
}

// Codes of the nearest of the four posts. `offset`: of the south-western post [bytes] in the blocks of heights.
HWY_INLINE Ints code_of_nearest(const CodeBlocks& codes, Ints offset, Floats north, Floats east) {
  const FloatLanes d;
  const IntLanes di;
  const auto half = hn::Set(d, 0.5F);
  const auto up = hn::IfThenElseZero(hn::RebindMask(di, hn::Ge(north, half)), hn::Set(di, CodeBlocks::kColumns));
  const auto right = hn::IfThenElseZero(hn::RebindMask(di, hn::Ge(east, half)), hn::Set(di, 1));
  return gather_code(codes, hn::Add(hn::ShiftRight<1>(offset), hn::Add(up, right)));
}

HWY_INLINE void interpolate(const Grid& grid, std::size_t count, const Located& located, bool nearest,
                            const Heights& found) {
  const FloatLanes d;
  const IntLanes di;
  const auto one = hn::Set(d, 1.0F);
  const auto half = hn::Set(d, 0.5F);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const Words words = gather(grid.posts->data(), hn::Load(di, located.offset + i));
    const Posts posts = unpacked(words);
    auto north = hn::Load(d, located.north + i);
    auto east = hn::Load(d, located.east + i);
    if (nearest) {
      north = hn::IfThenElseZero(hn::Ge(north, half), one);
      east = hn::IfThenElseZero(hn::Ge(east, half), one);
    }
    auto height = bilinear(hn::ConvertTo(d, posts.south_west), hn::ConvertTo(d, posts.south_east),
                           hn::ConvertTo(d, posts.north_west), hn::ConvertTo(d, posts.north_east), north, east);
    // The sea and void branches run only if an element of the vector needs them. Skipping them changes no result.
    const bool dry = found.water == nullptr || !grid.sea || none_at_sea(words, posts);
    auto sea_weight = dry ? hn::Zero(d) : water_fraction(posts, north, east);
    if (grid.voids) {
      const auto has_void = any_equal(posts, hn::Set(di, kVoid));
      if (!hn::AllFalse(di, has_void)) {
        const WeightedMean mean = without_voids(posts, north, east);
        height = hn::IfThenElse(hn::RebindMask(d, has_void), mean.height, height);
        sea_weight = hn::IfThenElse(hn::RebindMask(d, has_void), mean.water, sea_weight);
      }
    }
    hn::StoreU(height, d, found.elevation_m + i);
    if (found.material != nullptr)
      hn::StoreU(code_of_nearest(*grid.codes, hn::Load(di, located.offset + i), hn::Load(d, located.north + i),
                                 hn::Load(d, located.east + i)),
                 di, found.material + i);
    if (found.water != nullptr) hn::StoreU(sea_weight, d, found.water + i);
    if (found.near.elevation_m != nullptr)
      hn::StoreU(near_height(grid, posts, north, east, found.near), d, found.near.elevation_m + i);
  }
}

void to_metres(float unit_m, std::size_t count, float* elevation_m) {
  const FloatLanes d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d))
    hn::StoreU(hn::Mul(hn::LoadU(d, elevation_m + i), hn::Set(d, unit_m)), d, elevation_m + i);
}

void heights(const Grid& grid, const float* north_deg, const float* east_deg, std::size_t count, bool nearest,
             const Heights& found) {
  if (count == 0) return;
  Located located[2];
  const auto batch = [count](std::size_t start) { return std::min(kBatch, count - start); };
  const std::size_t fetch_step = positions_per_line(grid, north_deg, east_deg, count);
  locate(grid, north_deg, east_deg, batch(0), fetch_step, located[0]);
  for (std::size_t start = 0, turn = 0; start < count; start += kBatch, turn = 1 - turn) {
    const std::size_t next = start + kBatch;
    if (next < count) locate(grid, north_deg + next, east_deg + next, batch(next), fetch_step, located[1 - turn]);
    interpolate(grid, batch(start), located[turn], nearest, outputs_from(found, start));
  }
  if (grid.unit_m == 1.0F) return;
  to_metres(grid.unit_m, count, found.elevation_m);
  if (found.near.elevation_m != nullptr) to_metres(grid.unit_m, count, found.near.elevation_m);
}

std::size_t same_cell_count(const float* cells_north, const float* cells_east, std::size_t count) {
  const FloatLanes d;
  const auto north = hn::Set(d, cells_north[0]);
  const auto east = hn::Set(d, cells_east[0]);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto alike =
        hn::And(hn::Eq(hn::LoadU(d, cells_north + i), north), hn::Eq(hn::LoadU(d, cells_east + i), east));
    if (hn::AllTrue(d, alike)) continue;
    return std::min(count, i + static_cast<std::size_t>(hn::FindFirstTrue(d, hn::Not(alike))));
  }
  return count;
}

// Index of the nearest post. Halves round up, as std::lround() does for positive numbers. NaN becomes 0, so that the
// unused entries after the last position give valid addresses.
HWY_INLINE hn::Vec<IntLanes> nearest(const float* degrees, float intervals) {
  const FloatLanes d;
  const auto max = hn::Set(d, intervals);
  const auto inside = hn::Min(hn::Max(hn::Mul(hn::LoadU(d, degrees), max), hn::Zero(d)), max);
  return hn::ConvertTo(IntLanes(), hn::Add(inside, hn::Set(d, 0.5F)));
}

void codes(const Culture& culture, const float* north_deg, const float* east_deg, std::size_t count,
           std::int32_t* material) {
  const IntLanes di;
  const auto last_row = hn::Set(di, culture.rows() - 2), last_column = hn::Set(di, culture.columns() - 2);
  const BlockLanes blocks(culture.blocks());
  for (std::size_t i = 0; i < count; i += hn::Lanes(di)) {
    const auto row = nearest(north_deg + i, static_cast<float>(culture.rows() - 1));
    const auto column = nearest(east_deg + i, static_cast<float>(culture.columns() - 1));
    // Offsets of posts are known up to the last but one row and column.
    const auto south = hn::Min(row, last_row), west = hn::Min(column, last_column);
    const auto beyond = hn::Add(hn::Mul(hn::Sub(row, south), hn::Set(di, CodeBlocks::kColumns)), hn::Sub(column, west));
    const auto entry = hn::Add(hn::ShiftRight<1>(blocks.offset(south, west)), beyond);
    hn::StoreU(gather_code(culture.blocks(), entry), di, material + i);
  }
}

void unpack_covers(std::size_t count, std::int32_t* material, float* water) {
  const IntLanes di;
  const FloatLanes d;
  const auto step = hn::Set(d, 1.0F / static_cast<float>(kWaterSteps));
  for (std::size_t i = 0; i < count; i += hn::Lanes(di)) {
    const auto cover = hn::LoadU(di, material + i);
    const auto share = hn::Sub(hn::ShiftRight<kWaterShift>(cover), hn::Set(di, 1));
    const auto known = hn::RebindMask(d, hn::Gt(share, hn::Set(di, -1)));
    hn::StoreU(hn::IfThenElse(known, hn::Mul(hn::ConvertTo(d, share), step), hn::LoadU(d, water + i)), d, water + i);
    hn::StoreU(hn::And(cover, hn::Set(di, std::int32_t{kMaxMaterial})), di, material + i);
  }
}

}  // namespace yars::model::terrain::sampling::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::terrain::sampling {

HWY_EXPORT(heights);
HWY_EXPORT(same_cell_count);

void heights(const Grid& grid, const float* north_deg, const float* east_deg, std::size_t count, bool nearest,
             const Heights& found) {
  HWY_DYNAMIC_DISPATCH(heights)(grid, north_deg, east_deg, count, nearest, found);
}

std::size_t same_cell_count(const float* cells_north, const float* cells_east, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(same_cell_count)(cells_north, cells_east, count);
}

HWY_EXPORT(codes);
HWY_EXPORT(unpack_covers);

void codes(const Culture& culture, const float* north_deg, const float* east_deg, std::size_t count,
           std::int32_t* material) {
  HWY_DYNAMIC_DISPATCH(codes)(culture, north_deg, east_deg, count, material);
}
void unpack_covers(std::size_t count, std::int32_t* material, float* water) {
  HWY_DYNAMIC_DISPATCH(unpack_covers)(count, material, water);
}

}  // namespace yars::model::terrain::sampling
#endif  // HWY_ONCE
