#include "model/hrm/raster_lanes.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/raster_lanes.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind highway.h, or it would have no target yet.
#include "model/hrm/facet-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Bits = hn::Vec<BitsTag>;

constexpr float kWide = 12.0F;           // columns of a triangle that is drawn by itself
constexpr std::size_t kFlush = 1024;     // grid points kept before they are put down
constexpr std::size_t kFetchAhead = 24;  // of them
constexpr float kUnderRoof_m = 0.02F;
constexpr float kMostWall = 1.0e9F;
constexpr std::uint32_t kFullWall = 0x7fffffffU;

// A point's surface as one number: the height in the upper half, made so that it ascends as an integer too, and the
// gain in the lower half, where what stands is greater than any ground. Its own inverse.
static_assert(std::endian::native == std::endian::little);
HWY_INLINE std::int64_t in_order(std::int64_t point) {
  constexpr std::int64_t kHeight = 0x7fffffff00000000;
  return point ^ ((point >> 63) & kHeight);
}
// The upper half of a vector of heights; no negative zero, which would be less than zero.
HWY_INLINE Floats plain(Floats height) {
  return hn::Add(height, hn::Zero(Tag()));
}
HWY_INLINE Bits in_order(Floats height) {
  const BitsTag db;
  const auto bits = hn::BitCast(SignedTag(), height);
  const auto turned = hn::And(hn::ShiftRight<31>(bits), hn::Set(SignedTag(), 0x7fffffff));
  return hn::BitCast(db, hn::Xor(bits, turned));
}

// Where a grid point lies in the arrays.
HWY_INLINE Bits place_on(const FanGrid& grid, Floats column, Floats row) {
  const SignedTag di;
  const BitsTag db;
  const auto i = hn::BitCast(db, hn::ConvertTo(di, column));
  const auto strip = hn::Mul(hn::ShiftRight<4>(i), hn::Set(db, static_cast<std::uint32_t>(grid.strip_size())));
  const auto line = hn::ShiftLeft<4>(hn::BitCast(db, hn::ConvertTo(di, row)));
  return hn::Add(hn::Add(strip, line), hn::And(i, hn::Set(db, kStripColumns - 1U)));
}

// A batch of small triangles, a lane each.
class SmallTriangles {
 public:
  SmallTriangles(const Canvas& canvas, Fragments& fragments) : canvas_(canvas), fragments_(fragments) {}

  void fill(const Triangle& triangle, const Facet& facet, Floats gain, Mask active) {
    const Tag d;
    const auto rows = set(static_cast<float>(canvas_.grid->rows));
    const auto end = hn::Min(hn::Ceil(triangle.right.column), set(canvas_.limits.last_column));
    auto column = hn::Max(hn::Ceil(triangle.left.column), set(canvas_.limits.first_column));
    active = hn::And(active, hn::Lt(column, end));
    const Edges rows_at(triangle, &Corner::row);
    for (; !hn::AllFalse(d, active);
         column = hn::Add(column, set(1.0F)), active = hn::And(active, hn::Lt(column, end))) {
      const auto [along, beside] = rows_at.at(column);
      const auto near = hn::Min(along, beside);
      const auto far = hn::Max(along, beside);
      const auto last = hn::Min(hn::Ceil(hn::Add(far, set(kSurfaceReach))), rows);
      auto row = hn::Max(hn::Ceil(hn::Sub(near, set(kSurfaceReach))), hn::Zero(d));
      auto wanted = hn::And(active, hn::Lt(row, last));
      auto at = place_on(*canvas_.grid, hn::IfThenElseZero(active, column), hn::IfThenElseZero(wanted, row));
      const auto base = hn::Add(facet.value, hn::Mul(facet.by_column, column));
      while (!hn::AllFalse(d, wanted)) {
        const auto height = hn::Add(base, hn::Mul(facet.by_row, hn::Min(hn::Max(row, near), far)));
        keep(at, triangle.within(height), gain, wanted);
        at = hn::Add(at, hn::Set(BitsTag(), static_cast<std::uint32_t>(kStripColumns)));
        row = hn::Add(row, set(1.0F));
        wanted = hn::And(wanted, hn::Lt(row, last));
      }
    }
  }

  // Seen from above a wall is the line between its two corners that lie farthest apart across; the profile steps up at
  // the first grid point that a surface behind the line reaches. Its columns together return as if they were as wide as
  // it is; one narrower than a column is met by chance, and counts whole then.
  void stand(const Triangle& triangle, Floats gain, Mask active) {
    const Tag d;
    const auto width = hn::Sub(triangle.right.column, triangle.left.column);
    const auto columns = hn::Sub(hn::Ceil(triangle.right.column), hn::Ceil(triangle.left.column));
    gain = hn::IfThenElse(hn::Lt(width, set(1.0F)), gain, hn::Mul(gain, hn::Div(width, columns)));
    const auto rows = set(static_cast<float>(canvas_.grid->rows));
    const auto end = hn::Min(hn::Ceil(triangle.right.column), set(canvas_.limits.last_column));
    auto column = hn::Max(hn::Ceil(triangle.left.column), set(canvas_.limits.first_column));
    active = hn::And(active, hn::Lt(column, end));
    const Edges rows_at(triangle, &Corner::row);
    const Edges heights_at(triangle, &Corner::height);
    for (; !hn::AllFalse(d, active);
         column = hn::Add(column, set(1.0F)), active = hn::And(active, hn::Lt(column, end))) {
      const auto line = rows_at.at(column).first;
      const auto row = hn::Ceil(hn::Sub(line, set(kSurfaceReach)));
      const auto wanted = hn::And(active, hn::And(hn::Ge(row, hn::Zero(d)), hn::Lt(row, rows)));
      if (hn::AllFalse(d, wanted)) continue;
      const auto [along, beside] = heights_at.at(column);
      const auto tall = hn::Abs(hn::Sub(along, beside));
      const auto at = place_on(*canvas_.grid, hn::IfThenElseZero(wanted, column), hn::IfThenElseZero(wanted, row));
      keep_wall(at, tall, gain, wanted);
      // A fence has no roof to be seen by: it is its own. Where there is one that one is higher.
      keep(at, hn::Sub(hn::Max(along, beside), set(kUnderRoof_m)), gain, wanted);
    }
  }

  // Puts down what was kept, when there is much or all is drawn: places are fetched ahead of their turn.
  void flush(bool all) {
    if (!all && count_ < kFlush && walls_ < kFlush) return;
    for (std::size_t i = 0; i < count_; ++i) {
      hwy::Prefetch(canvas_.arrays.surface + fragments_.at[std::min(i + kFetchAhead, count_ - 1)]);
      SurfacePoint& point = canvas_.arrays.surface[fragments_.at[i]];
      const std::uint64_t height = fragments_.height[i];
      const auto fragment = static_cast<std::int64_t>(height << 32 | std::bit_cast<std::uint32_t>(fragments_.gain[i]));
      point = std::bit_cast<SurfacePoint>(in_order(std::max(in_order(std::bit_cast<std::int64_t>(point)), fragment)));
    }
    for (std::size_t i = 0; i < walls_; ++i) {
      hwy::Prefetch(canvas_.arrays.walls + fragments_.wall_at[std::min(i + kFetchAhead, walls_ - 1)]);
      WallPoint& point = canvas_.arrays.walls[fragments_.wall_at[i]];
      point.height += fragments_.wall_height[i];
      point.returned += fragments_.wall_return[i];
      if (((point.height | point.returned) & ~kFullWall) == 0) [[likely]]
        continue;
      point.height = std::min(point.height, kFullWall);
      point.returned = std::min(point.returned, kFullWall);
    }
    count_ = walls_ = 0;
  }

 private:
  void keep(Bits at, Floats height, Floats gain, Mask wanted) {
    const BitsTag db;
    if (fragments_.at.size() < count_ + kStripColumns) fragments_.grow();
    const auto mask = hn::RebindMask(db, wanted);
    hn::StoreU(hn::Compress(at, mask), db, &fragments_.at[count_]);
    hn::StoreU(hn::Compress(in_order(plain(height)), mask), db, &fragments_.height[count_]);
    hn::StoreU(hn::Compress(hn::Neg(gain), wanted), Tag(), &fragments_.gain[count_]);
    count_ += hn::CountTrue(Tag(), wanted);
  }
  void keep_wall(Bits at, Floats tall, Floats gain, Mask wanted) {
    const BitsTag db;
    const SignedTag di;
    if (fragments_.wall_at.size() < walls_ + kStripColumns) fragments_.grow_walls();
    const auto steps = [&](Floats number) HWY_ATTR {
      const auto most = hn::Min(hn::Mul(number, set(1.0F / kWallStep_m)), set(kMostWall));
      return hn::BitCast(db, hn::ConvertTo(di, hn::Add(most, set(0.5F))));
    };
    const auto mask = hn::RebindMask(db, wanted);
    hn::StoreU(hn::Compress(at, mask), db, &fragments_.wall_at[walls_]);
    hn::StoreU(hn::Compress(steps(tall), mask), db, &fragments_.wall_height[walls_]);
    hn::StoreU(hn::Compress(steps(hn::Mul(tall, gain)), mask), db, &fragments_.wall_return[walls_]);
    walls_ += hn::CountTrue(Tag(), wanted);
  }

  const Canvas& canvas_;
  Fragments& fragments_;
  std::size_t count_ = 0, walls_ = 0;
};

// Column by column, for a column is a profile: a surface reaches half a row beyond its edges, so that on average it is
// as long as it is, and its height there is that of the edge. One triangle, a lane a column. `put(at, row, near, far,
// wanted)` draws a vector of grid points.
template <class Put>
HWY_INLINE void fill_wide(const Triangle& triangle, const Canvas& canvas, float reach, const Put& put) {
  const Tag d;
  const FanGrid& grid = *canvas.grid;
  const float first = std::max(hn::GetLane(hn::Ceil(triangle.left.column)), canvas.limits.first_column);
  const float last = std::min(hn::GetLane(hn::Ceil(triangle.right.column)), canvas.limits.last_column);
  if (!(first < last)) return;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  const auto iota = hn::Iota(d, 0.0F);
  const Edges rows_at(triangle, &Corner::row);
  for (int start = static_cast<int>(first) / lanes * lanes; start < static_cast<int>(last); start += lanes) {
    const auto column = hn::Add(iota, set(static_cast<float>(start)));
    const auto active = hn::And(hn::Ge(column, set(first)), hn::Lt(column, set(last)));
    const auto [along, beside] = rows_at.at(column);
    const auto near = hn::Min(along, beside);
    const auto far = hn::Max(along, beside);
    const auto begin = hn::IfThenElse(active, hn::Max(hn::Ceil(hn::Sub(near, set(reach))), hn::Zero(d)),
                                      set(static_cast<float>(grid.rows)));
    const auto end =
        hn::IfThenElseZero(active, hn::Min(hn::Ceil(hn::Add(far, set(reach))), set(static_cast<float>(grid.rows))));
    const auto from = static_cast<int>(hn::GetLane(hn::MinOfLanes(d, begin)));
    const auto to = static_cast<int>(hn::GetLane(hn::MaxOfLanes(d, end)));
    for (int line = from; line < to; ++line) {
      const auto row = set(static_cast<float>(line));
      put(grid.at(start, line), column, hn::Min(hn::Max(row, near), far),
          hn::And(hn::Ge(row, begin), hn::Lt(row, end)));
    }
  }
}

HWY_INLINE void fill_high(const Triangle& triangle, const Facet& facet, Floats gain, const Canvas& canvas) {
  const Tag d;
  const auto negative = hn::Neg(gain);
  fill_wide(triangle, canvas, kSurfaceReach, [&](std::size_t at, Floats column, Floats row, Mask wanted) HWY_ATTR {
    const auto base = hn::Add(facet.value, hn::Mul(facet.by_column, column));
    const auto height = plain(triangle.within(hn::Add(base, hn::Mul(facet.by_row, row))));
    auto* const points = &canvas.arrays.surface[at].gain;
    Floats old_gain, old_height;
    hn::LoadInterleaved2(d, points, old_gain, old_height);
    const auto stronger = hn::RebindMask(d, hn::Gt(hn::BitCast(BitsTag(), negative), hn::BitCast(BitsTag(), old_gain)));
    const auto best = hn::Or(hn::Gt(height, old_height), hn::And(hn::Eq(height, old_height), stronger));
    const auto drawn = hn::And(wanted, best);
    hn::StoreInterleaved2(hn::IfThenElse(drawn, negative, old_gain), hn::IfThenElse(drawn, height, old_height), d,
                          points);
  });
}

HWY_INLINE Corner corner_of(const GridVertices& vertices, std::size_t i) {
  return {set(vertices.column[i]), set(vertices.row[i]), set(vertices.height_m[i])};
}

HWY_INLINE std::array<std::size_t, 3> corners_of(const FoundTriangles& triangles, std::size_t i) {
  const auto corner = [&](std::size_t k) { return static_cast<std::size_t>(triangles.corner[k][i]); };
  return {corner(0), corner(1), corner(2)};
}

HWY_INLINE Triangle ordered(Corner a, Corner b, Corner c) {
  order(a, b);
  order(b, c);
  order(a, b);
  return {a, b, c};
}

void paint_ground(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                  const Canvas& canvas) {
  const Tag d;
  for (std::size_t i = 0; i < triangles.count; ++i) {
    const std::array<std::size_t, 3> corners = corners_of(triangles, i);
    const Corner a = corner_of(vertices, corners[0]);
    const Corner b = corner_of(vertices, corners[1]);
    const Corner c = corner_of(vertices, corners[2]);
    const Facet facet = facet_of(a, b, c, canvas.limits);
    if (!hn::AllTrue(d, hn::Gt(facet.area, hn::Zero(d)))) continue;
    auto gain = set(tile.gamma[tile.kind[triangles.number[i]]]);
    if (corners[0] >= vertices.bare) {
      const auto facing = [&](int k) HWY_ATTR { return set(vertices.facing[corners[k] - vertices.bare]); };
      gain = hn::Mul(gain, shading(facing(0), facing(1), facing(2), facet));
    }
    fill_wide(ordered(a, b, c), canvas, 0.0F, [&](std::size_t at, Floats, Floats, Mask wanted) HWY_ATTR {
      auto* const points = &canvas.arrays.surface[at].gain;
      Floats old, height;
      hn::LoadInterleaved2(d, points, old, height);
      hn::StoreInterleaved2(hn::IfThenElse(hn::And(wanted, hn::Ge(old, hn::Zero(d))), gain, old), height, d, points);
    });
  }
}

// The corners of a vector's triangles.
struct CornerNumbers {
  hn::Vec<SignedTag> first, second, third;
};
HWY_INLINE CornerNumbers numbers_at(const FoundTriangles& triangles, std::size_t i) {
  const SignedTag di;
  return {hn::LoadU(di, &triangles.corner[0][i]), hn::LoadU(di, &triangles.corner[1][i]),
          hn::LoadU(di, &triangles.corner[2][i])};
}
HWY_INLINE Corner gather(const GridVertices& vertices, hn::Vec<SignedTag> i) {
  const Tag d;
  return {hn::GatherIndex(d, vertices.column, i), hn::GatherIndex(d, vertices.row, i),
          hn::GatherIndex(d, vertices.height_m, i)};
}

HWY_INLINE Floats shaded(Floats gamma, const GridVertices& vertices, const CornerNumbers& corners, const Facet& facet) {
  const Tag d;
  const SignedTag di;
  const auto bare = hn::Set(di, static_cast<std::int32_t>(vertices.bare));
  const auto curved = hn::Gt(corners.first, hn::Sub(bare, hn::Set(di, 1)));
  if (hn::AllFalse(di, curved)) return gamma;
  const auto facing = [&](hn::Vec<SignedTag> corner) HWY_ATTR {
    return hn::GatherIndex(d, vertices.facing, hn::Max(hn::Sub(corner, bare), hn::Zero(di)));
  };
  const auto factor = shading(facing(corners.first), facing(corners.second), facing(corners.third), facet);
  return hn::IfThenElse(hn::RebindMask(d, curved), hn::Mul(gamma, factor), gamma);
}

// Those of a vector that are large, one by one.
void draw_wide(const FoundTriangles& triangles, std::size_t first, const float* gain, Mask wide,
               const GridVertices& vertices, const Canvas& canvas) {
  const Tag d;
  HWY_ALIGN float which[kStripColumns];
  hn::Store(hn::IfThenElseZero(wide, set(1.0F)), d, which);
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    if (which[lane] == 0.0F) continue;
    const std::array<std::size_t, 3> corners = corners_of(triangles, first + lane);
    const Corner a = corner_of(vertices, corners[0]);
    const Corner b = corner_of(vertices, corners[1]);
    const Corner c = corner_of(vertices, corners[2]);
    fill_high(ordered(a, b, c), facet_of(a, b, c, canvas.limits), set(gain[lane]), canvas);
  }
}

void draw_standing(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                   const Canvas& canvas, Fragments& fragments) {
  const Tag d;
  SmallTriangles small(canvas, fragments);
  HWY_ALIGN float gamma[kStripColumns] = {};
  HWY_ALIGN float cardinal[kStripColumns] = {};
  const std::size_t step = hn::Lanes(d);
  for (std::size_t i = 0; i < triangles.count; i += step) {
    const std::size_t count = std::min(step, triangles.count - i);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::size_t kind = tile.kind[triangles.number[i + lane]];
      gamma[lane] = tile.gamma[kind];
      cardinal[lane] = tile.cardinal[kind];
    }
    // What stands behind the last is an old corner: in the tile's numbers or before them, and not drawn.
    const auto there = hn::FirstN(d, count);
    const CornerNumbers corners = numbers_at(triangles, i);
    const Corner a = gather(vertices, corners.first);
    const Corner b = gather(vertices, corners.second);
    const Corner c = gather(vertices, corners.third);
    const Facet facet = facet_of(a, b, c, canvas.limits);
    const Triangle triangle = ordered(a, b, c);
    const auto wall = hn::And(there, hn::And(facet.steep, hn::Gt(facet.towards, hn::Zero(d))));
    if (!hn::AllFalse(d, wall))
      small.stand(triangle, wall_gain(canvas.cardinal, facet, hn::Load(d, gamma), hn::Load(d, cardinal)), wall);
    const auto above = hn::And(there, hn::Gt(facet.area, hn::Zero(d)));
    if (hn::AllFalse(d, above)) continue;
    const auto gain = shaded(hn::Load(d, gamma), vertices, corners, facet);
    const auto wide = hn::And(above, hn::Gt(hn::Sub(triangle.right.column, triangle.left.column), set(kWide)));
    small.fill(triangle, facet, gain, hn::AndNot(wide, above));
    small.flush(false);
    if (hn::AllFalse(d, wide)) continue;
    HWY_ALIGN float gains[kStripColumns];
    hn::Store(gain, d, gains);
    draw_wide(triangles, i, gains, wide, vertices, canvas);
  }
  small.flush(true);
}

}  // namespace yars::model::hrm::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::lanes {

HWY_EXPORT(paint_ground);
HWY_EXPORT(draw_standing);

void paint_ground(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                  const Canvas& canvas) {
  HWY_DYNAMIC_DISPATCH(paint_ground)(triangles, tile, vertices, canvas);
}
void draw_standing(const FoundTriangles& triangles, const TileSurfaces& tile, const GridVertices& vertices,
                   const Canvas& canvas, Fragments& fragments) {
  HWY_DYNAMIC_DISPATCH(draw_standing)(triangles, tile, vertices, canvas, fragments);
}

}  // namespace yars::model::hrm::lanes
#endif  // HWY_ONCE
