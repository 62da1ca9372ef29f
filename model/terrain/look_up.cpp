#include "model/terrain/look_up.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/terrain/look_up.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace yars::model::terrain::look_up::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FloatLanes = hn::CappedTag<float, kRunSlack>;
using WholeLanes = hn::RebindToSigned<FloatLanes>;
using Floats = hn::Vec<FloatLanes>;
using Wholes = hn::Vec<WholeLanes>;

// Places located ahead of their look-up: their posts have come into the cache by then.
constexpr std::size_t kAhead = 128;
constexpr std::int32_t kVoid = -32768;

// Where places lie: the entry of the post south-west of each, and the way on from it [0, 1].
struct Located {
  HWY_ALIGN std::int32_t entry[kAhead];
  HWY_ALIGN float north[kAhead];
  HWY_ALIGN float east[kAhead];
};

// Quotient of a small non-negative whole number by the step of the blocks: times 65536 / step, rounded up, is exact
// below 13000.
template <int kStep>
HWY_INLINE Wholes divided(Wholes number) {
  constexpr std::uint16_t kInverse = (65536 + kStep - 1) / kStep;
#if HWY_TARGET == HWY_SCALAR
  return hn::ShiftRight<16>(hn::Mul(number, hn::Set(WholeLanes(), std::int32_t{kInverse})));
#else
  const hn::Repartition<std::uint16_t, WholeLanes> d16;
  return hn::BitCast(WholeLanes(), hn::MulHigh(hn::BitCast(d16, number), hn::Set(d16, kInverse)));
#endif
}

// Not a number counts as 0: what lies in the slack must not lead anywhere.
HWY_INLINE Floats clamped(Floats value, Floats most) {
  const auto zero = hn::Zero(FloatLanes());
  const auto raised = hn::IfThenElseZero(hn::Gt(value, zero), value);
  return hn::IfThenElse(hn::Lt(raised, most), raised, most);
}

// Brings the posts of a few places in a row towards the processor; where they lie dense one line serves them all.
HWY_INLINE void fetch(const std::int16_t* posts, const std::int32_t* entry, std::size_t places) {
  hwy::Prefetch(posts + entry[0]);
  if (entry[0] / static_cast<std::int32_t>(PostBlocks::kPosts) ==
      entry[places - 1] / static_cast<std::int32_t>(PostBlocks::kPosts))
    return;
  for (std::size_t i = 1; i < places; ++i) hwy::Prefetch(posts + entry[i]);
}

HWY_INLINE void locate(const Grid& grid, const float* north_deg, const float* east_deg, std::size_t count,
                       Located& located) {
  const FloatLanes d;
  const WholeLanes di;
  const auto last_row = hn::Set(di, grid.rows - 2);
  const auto last_column = hn::Set(di, grid.columns - 2);
  const auto row_intervals = hn::Set(d, static_cast<float>(grid.rows - 1));
  const auto column_intervals = hn::Set(d, static_cast<float>(grid.columns - 1));
  const auto block_columns = hn::Set(di, grid.posts->block_columns());
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto row = clamped(hn::Mul(hn::LoadU(d, north_deg + i), row_intervals), row_intervals);
    const auto column = clamped(hn::Mul(hn::LoadU(d, east_deg + i), column_intervals), column_intervals);
    const auto whole_row = hn::Min(hn::ConvertTo(di, row), last_row);
    const auto whole_column = hn::Min(hn::ConvertTo(di, column), last_column);
    const auto block_row = divided<PostBlocks::kRowStep>(whole_row);
    const auto block_column = divided<PostBlocks::kColumnStep>(whole_column);
    const auto row_within = hn::Sub(whole_row, hn::Add(block_row, hn::Add(block_row, block_row)));
    const auto column_within = hn::Sub(whole_column, hn::Sub(hn::ShiftLeft<3>(block_column), block_column));
    const auto block = hn::Add(hn::Mul(block_row, block_columns), block_column);
    hn::Store(hn::Add(hn::ShiftLeft<5>(block), hn::Add(hn::ShiftLeft<3>(row_within), column_within)), di,
              located.entry + i);
    fetch(grid.posts->data(), located.entry + i, hn::Lanes(d));
    hn::Store(hn::Sub(row, hn::ConvertTo(d, whole_row)), d, located.north + i);
    hn::Store(hn::Sub(column, hn::ConvertTo(d, whole_column)), d, located.east + i);
  }
}

// The four posts about a place.
struct Posts {
  Wholes south_west, south_east, north_west, north_east;
};

HWY_INLINE Posts gather(const std::int16_t* posts, Wholes entry) {
  [[maybe_unused]] const WholeLanes di;
  // Two posts side by side are one word; a row further is 8 posts on.
  const auto* const words = reinterpret_cast<const std::int32_t*>(posts);
  const auto* const words_north = reinterpret_cast<const std::int32_t*>(posts + PostBlocks::kColumns);
#if HWY_TARGET == HWY_SCALAR
  // Highway would load a word where none is aligned.
  const auto word = [entry](const std::int32_t* from) {
    std::int32_t both = 0;
    std::memcpy(&both, reinterpret_cast<const std::int16_t*>(from) + hn::GetLane(entry), sizeof both);
    return hn::Set(WholeLanes(), both);
  };
  const auto south = word(words);
  const auto north = word(words_north);
#else
  const auto offset = hn::ShiftLeft<1>(entry);
  const auto south = hn::GatherOffset(di, words, offset);
  const auto north = hn::GatherOffset(di, words_north, offset);
#endif
  return {hn::ShiftRight<16>(hn::ShiftLeft<16>(south)), hn::ShiftRight<16>(south),
          hn::ShiftRight<16>(hn::ShiftLeft<16>(north)), hn::ShiftRight<16>(north)};
}

HWY_INLINE Floats blended(Floats south_west, Floats south_east, Floats north_west, Floats north_east, Floats north,
                          Floats east) {
  const auto south_m = hn::Add(south_west, hn::Mul(east, hn::Sub(south_east, south_west)));
  const auto north_m = hn::Add(north_west, hn::Mul(east, hn::Sub(north_east, north_west)));
  return hn::Add(south_m, hn::Mul(north, hn::Sub(north_m, south_m)));
}

HWY_INLINE Floats shore(const Posts& posts, Floats north, Floats east) {
  const FloatLanes d;
  const WholeLanes di;
  const auto one = hn::Set(d, 1.0F);
  const auto at_sea = [&](Wholes post) {
    return hn::IfThenElseZero(hn::RebindMask(d, hn::Eq(post, hn::Zero(di))), one);
  };
  return blended(at_sea(posts.south_west), at_sea(posts.south_east), at_sea(posts.north_west), at_sea(posts.north_east),
                 north, east);
}

HWY_INLINE hn::Mask<WholeLanes> any_equal(const Posts& posts, Wholes value) {
  return hn::Or(hn::Or(hn::Eq(posts.south_west, value), hn::Eq(posts.south_east, value)),
                hn::Or(hn::Eq(posts.north_west, value), hn::Eq(posts.north_east, value)));
}

// Voids are left out: sums of weighted posts and of their weights, divided at the end.
struct Joined {
  Floats height, water;
};
HWY_INLINE Joined without_voids(const Posts& posts, Floats north, Floats east) {
  const FloatLanes d;
  const WholeLanes di;
  const auto one = hn::Set(d, 1.0F);
  const auto south = hn::Sub(one, north);
  const auto west = hn::Sub(one, east);
  auto weights = hn::Zero(d);
  auto height = hn::Zero(d);
  auto water = hn::Zero(d);
  const auto add = [&](Wholes post, Floats weight) {
    const auto known = hn::RebindMask(d, hn::Ne(post, hn::Set(di, kVoid)));
    const auto counted = hn::IfThenElseZero(known, weight);
    weights = hn::Add(weights, counted);
    height = hn::Add(height, hn::Mul(counted, hn::ConvertTo(d, post)));
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

HWY_INLINE void join(const Grid& grid, std::size_t count, const Located& located, bool nearest, float* elevation_m,
                     float* water) {
  const FloatLanes d;
  const WholeLanes di;
  const auto one = hn::Set(d, 1.0F);
  const auto half = hn::Set(d, 0.5F);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const Posts posts = gather(grid.posts->data(), hn::Load(di, located.entry + i));
    auto north = hn::Load(d, located.north + i);
    auto east = hn::Load(d, located.east + i);
    if (nearest) {
      north = hn::IfThenElseZero(hn::Ge(north, half), one);
      east = hn::IfThenElseZero(hn::Ge(east, half), one);
    }
    auto height = blended(hn::ConvertTo(d, posts.south_west), hn::ConvertTo(d, posts.south_east),
                          hn::ConvertTo(d, posts.north_west), hn::ConvertTo(d, posts.north_east), north, east);
    // Where a vector has none of a kind the work is spared; a place's result is its own whatever its company.
    const bool dry = water == nullptr || !grid.sea || hn::AllFalse(di, any_equal(posts, hn::Zero(di)));
    auto share = dry ? hn::Zero(d) : shore(posts, north, east);
    if (grid.voids) {
      const auto holed = any_equal(posts, hn::Set(di, kVoid));
      if (!hn::AllFalse(di, holed)) {
        const Joined joined = without_voids(posts, north, east);
        height = hn::IfThenElse(hn::RebindMask(d, holed), joined.height, height);
        share = hn::IfThenElse(hn::RebindMask(d, holed), joined.water, share);
      }
    }
    hn::StoreU(height, d, elevation_m + i);
    if (water != nullptr) hn::StoreU(share, d, water + i);
  }
}

void heights(const Grid& grid, const float* north_deg, const float* east_deg, std::size_t count, bool nearest,
             float* elevation_m, float* water) {
  if (count == 0) return;
  Located located[2];
  const auto batch = [count](std::size_t start) { return std::min(kAhead, count - start); };
  locate(grid, north_deg, east_deg, batch(0), located[0]);
  for (std::size_t start = 0, turn = 0; start < count; start += kAhead, turn = 1 - turn) {
    const std::size_t next = start + kAhead;
    if (next < count) locate(grid, north_deg + next, east_deg + next, batch(next), located[1 - turn]);
    join(grid, batch(start), located[turn], nearest, elevation_m + start, water == nullptr ? nullptr : water + start);
  }
}

void codes(const Culture& culture, const float* north_deg, const float* east_deg, std::size_t count,
           std::int32_t* material) {
  const FloatLanes d;
  const WholeLanes di;
  const std::uint8_t* const posts = culture.codes().data();
  const auto rows = hn::Set(d, static_cast<float>(culture.rows() - 1));
  const auto columns = hn::Set(d, static_cast<float>(culture.columns() - 1));
  const auto half = hn::Set(d, 0.5F);
  const auto nearest = [&](const float* degrees, Floats intervals) {
    // Half up, as std::lround does with what is not negative.
    return hn::ConvertTo(di, hn::Add(clamped(hn::Mul(hn::LoadU(d, degrees), intervals), intervals), half));
  };
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto entry =
        hn::Add(hn::Mul(nearest(north_deg + i, rows), hn::Set(di, culture.columns())), nearest(east_deg + i, columns));
#if HWY_TARGET == HWY_SCALAR
    // Highway would load a word where none is aligned.
    const auto word = hn::Set(di, std::int32_t{posts[hn::GetLane(entry)]});
#else
    const auto word = hn::GatherOffset(di, reinterpret_cast<const std::int32_t*>(posts), entry);
#endif
    hn::StoreU(hn::And(word, hn::Set(di, 0xff)), di, material + i);
  }
}

std::size_t places_alike(const float* cells_north, const float* cells_east, std::size_t count) {
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

}  // namespace yars::model::terrain::look_up::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::terrain::look_up {

HWY_EXPORT(heights);
HWY_EXPORT(places_alike);
HWY_EXPORT(codes);

void heights(const Grid& grid, const float* north_deg, const float* east_deg, std::size_t count, bool nearest,
             float* elevation_m, float* water) {
  HWY_DYNAMIC_DISPATCH(heights)(grid, north_deg, east_deg, count, nearest, elevation_m, water);
}

std::size_t places_alike(const float* cells_north, const float* cells_east, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(places_alike)(cells_north, cells_east, count);
}

void codes(const Culture& culture, const float* north_deg, const float* east_deg, std::size_t count,
           std::int32_t* material) {
  HWY_DYNAMIC_DISPATCH(codes)(culture, north_deg, east_deg, count, material);
}

}  // namespace yars::model::terrain::look_up
#endif  // HWY_ONCE
