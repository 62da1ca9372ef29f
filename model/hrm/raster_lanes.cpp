#include "model/hrm/raster_lanes.hpp"

#include <algorithm>
#include <utility>

#include "model/hrm/profile_lanes.hpp"
#include "model/hrm/scene_surface.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/raster_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kStripColumns>;
using SignedTag = hn::RebindToSigned<Tag>;
using BitsTag = hn::RebindToUnsigned<Tag>;
using Floats = hn::Vec<Tag>;
using Bits = hn::Vec<BitsTag>;
using Mask = hn::Mask<Tag>;

constexpr float kSmooth = 0.02F;  // vertices that face the radar so differently from the facet are interpolated
constexpr float kWide = 12.0F;    // columns of a triangle that is drawn by itself
constexpr float kUnderRoof_m = 0.02F;
constexpr float kMostWall = 1.0e9F;
constexpr std::uint32_t kFullWall = 0x7fffffffU;

HWY_INLINE Floats set(float value) {
  return hn::Set(Tag(), value);
}

// A corner on the grid: column, row, height, and how squarely its surface faces the radar.
struct Corner {
  Floats column, row, height, facing;
};
HWY_INLINE Corner chosen(Mask first, const Corner& a, const Corner& b) {
  return {hn::IfThenElse(first, a.column, b.column), hn::IfThenElse(first, a.row, b.row),
          hn::IfThenElse(first, a.height, b.height), hn::IfThenElse(first, a.facing, b.facing)};
}
HWY_INLINE void order(Corner& a, Corner& b) {
  const auto turned = hn::Lt(b.column, a.column);
  const Corner left = chosen(turned, b, a);
  b = chosen(turned, a, b);
  a = left;
}

// A triangle seen from above, its corners from left to right.
struct Triangle {
  Corner left, middle, right;
  // What lies at a column between the corners along the long edge and on the other two.
  HWY_INLINE std::pair<Floats, Floats> edges(Floats x, Floats Corner::*number) const {
    const auto whole = hn::Div(hn::Sub(x, left.column), hn::Sub(right.column, left.column));
    const auto along = hn::Add(left.*number, hn::Mul(whole, hn::Sub(right.*number, left.*number)));
    const auto before = hn::Lt(x, middle.column);
    const Corner begin = chosen(before, left, middle);
    const Corner end = chosen(before, middle, right);
    const auto part = hn::Div(hn::Sub(x, begin.column), hn::Sub(end.column, begin.column));
    return {along, hn::Add(begin.*number, hn::Mul(part, hn::Sub(end.*number, begin.*number)))};
  }
};

// What a triangle is to the radar.
struct Facet {
  Floats area;  // grid cells; more than 0: seen from above
  Floats across, ahead;
  Floats towards;                   // of the normal, to the radar
  Floats length;                    // of the normal
  Floats value, by_column, by_row;  // its plane: value + by_column * column + by_row * row
  Mask steep;
};
HWY_INLINE Facet facet_of(const Corner& a, const Corner& b, const Corner& c, const GridLimits& limits) {
  const auto c1 = hn::Sub(b.column, a.column);
  const auto c2 = hn::Sub(c.column, a.column);
  const auto r1 = hn::Sub(b.row, a.row);
  const auto r2 = hn::Sub(c.row, a.row);
  const auto z1 = hn::Sub(b.height, a.height);
  const auto z2 = hn::Sub(c.height, a.height);
  Facet facet;
  facet.area = hn::Sub(hn::Mul(c1, r2), hn::Mul(r1, c2));
  const auto right = hn::Sub(hn::Mul(r1, z2), hn::Mul(z1, r2));
  const auto out = hn::Sub(hn::Mul(z1, c2), hn::Mul(c1, z2));
  facet.across = hn::Mul(set(limits.row_height_m), right);
  facet.ahead = hn::Mul(set(limits.column_width_m), out);
  const auto upward = hn::Mul(hn::Mul(set(limits.column_width_m), set(limits.row_height_m)), facet.area);
  const auto level2 = hn::Add(hn::Mul(facet.across, facet.across), hn::Mul(facet.ahead, facet.ahead));
  const auto upward2 = hn::Mul(upward, upward);
  facet.steep = hn::Lt(upward2, hn::Mul(set(limits.wall_normal2), level2));
  facet.towards = hn::Sub(hn::Mul(upward, set(limits.sine)), hn::Mul(facet.ahead, set(limits.cosine)));
  facet.length = hn::Sqrt(hn::Add(level2, upward2));
  const auto inverse = hn::Div(set(1.0F), facet.area);
  facet.by_column = hn::Neg(hn::Mul(right, inverse));
  facet.by_row = hn::Neg(hn::Mul(out, inverse));
  facet.value = hn::Sub(hn::Sub(a.height, hn::Mul(facet.by_column, a.column)), hn::Mul(facet.by_row, a.row));
  return facet;
}

// How much more or less squarely the interpolated normals face the radar than the facet does.
HWY_INLINE Floats shading(const GridVertices& vertices, const Corner& a, const Corner& b, const Corner& c,
                          const Facet& facet) {
  const Tag d;
  if (vertices.facing == nullptr) return set(1.0F);
  const auto facing = hn::Div(facet.towards, facet.length);
  const auto off = [&](const Corner& corner) HWY_ATTR { return hn::Abs(hn::Sub(corner.facing, facing)); };
  const auto smooth =
      hn::And(hn::Gt(hn::Max(hn::Max(off(a), off(b)), off(c)), set(kSmooth)), hn::Gt(facing, hn::Zero(d)));
  const auto mean = hn::Mul(hn::Add(hn::Add(a.facing, b.facing), c.facing), set(1.0F / 3.0F));
  const auto ratio = hn::Min(hn::Max(hn::Div(mean, facing), hn::Zero(d)), set(static_cast<float>(kMostShading)));
  return hn::IfThenElse(smooth, ratio, set(1.0F));
}

HWY_INLINE Floats wall_gain(const CardinalShape& shape, const Facet& facet, Floats gamma, Floats cardinal) {
  const Tag d;
  const SignedTag di;
  const auto level = hn::Sqrt(hn::Add(hn::Mul(facet.across, facet.across), hn::Mul(facet.ahead, facet.ahead)));
  const auto sine = hn::Div(hn::Abs(facet.across), hn::Max(level, set(1.0e-20F)));
  const auto last = set(static_cast<float>(shape.share.size() - 2));
  const auto place = hn::Mul(sine, set(shape.steps_a_sine));
  const auto whole = hn::Floor(hn::Min(place, last));
  const auto i = hn::ConvertTo(di, whole);
  const auto low = hn::GatherIndex(d, shape.share.data(), i);
  const auto high = hn::GatherIndex(d, shape.share.data() + 1, i);
  const auto share =
      hn::Add(low, hn::Mul(hn::Sub(hn::Min(place, hn::Add(last, set(1.0F))), whole), hn::Sub(high, low)));
  const auto ahead = hn::Lt(facet.ahead, hn::Zero(d));  // of two sides it is the near one that is square on
  return hn::Mul(gamma, hn::Add(set(1.0F), hn::IfThenElseZero(ahead, hn::Mul(cardinal, share))));
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
    for (; !hn::AllFalse(d, active);
         column = hn::Add(column, set(1.0F)), active = hn::And(active, hn::Lt(column, end))) {
      const auto [along, beside] = triangle.edges(column, &Corner::row);
      const auto near = hn::Min(along, beside);
      const auto far = hn::Max(along, beside);
      const auto last = hn::Min(hn::Ceil(hn::Add(far, set(kSurfaceReach))), rows);
      auto row = hn::Max(hn::Ceil(hn::Sub(near, set(kSurfaceReach))), hn::Zero(d));
      auto wanted = hn::And(active, hn::Lt(row, last));
      auto at = place_on(*canvas_.grid, hn::IfThenElseZero(active, column), hn::IfThenElseZero(wanted, row));
      const auto base = hn::Add(facet.value, hn::Mul(facet.by_column, column));
      while (!hn::AllFalse(d, wanted)) {
        const auto height = hn::Add(base, hn::Mul(facet.by_row, hn::Min(hn::Max(row, near), far)));
        keep(at, height, gain, wanted);
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
    for (; !hn::AllFalse(d, active);
         column = hn::Add(column, set(1.0F)), active = hn::And(active, hn::Lt(column, end))) {
      const auto line = triangle.edges(column, &Corner::row).first;
      const auto row = hn::Ceil(hn::Sub(line, set(kSurfaceReach)));
      const auto wanted = hn::And(active, hn::And(hn::Ge(row, hn::Zero(d)), hn::Lt(row, rows)));
      if (hn::AllFalse(d, wanted)) continue;
      const auto [along, beside] = triangle.edges(column, &Corner::height);
      const auto tall = hn::Abs(hn::Sub(along, beside));
      const auto at = place_on(*canvas_.grid, hn::IfThenElseZero(wanted, column), hn::IfThenElseZero(wanted, row));
      keep_wall(at, tall, gain, wanted);
      // A fence has no roof to be seen by: it is its own. Where there is one that one is higher.
      keep(at, hn::Sub(hn::Max(along, beside), set(kUnderRoof_m)), gain, wanted);
    }
  }

  // Puts down what was kept.
  void flush() {
    const SceneArrays& to = canvas_.arrays;
    for (std::size_t i = 0; i < count_; ++i) {
      const std::size_t at = fragments_.at[i];
      const float height = fragments_.height_m[i];
      const float gain = fragments_.gain[i];
      const float there = to.gain[at];
      const bool higher = height > to.height_m[at];
      const bool stronger = height == to.height_m[at] && there < 0.0F && gain < there;
      to.height_m[at] = higher ? height : to.height_m[at];
      to.gain[at] = higher || stronger ? gain : there;
    }
    for (std::size_t i = 0; i < walls_; ++i) {
      const std::size_t at = fragments_.wall_at[i];
      to.wall_height[at] = std::min(to.wall_height[at] + fragments_.wall_height[i], kFullWall);
      to.wall_return[at] = std::min(to.wall_return[at] + fragments_.wall_return[i], kFullWall);
    }
    count_ = walls_ = 0;
  }

 private:
  void keep(Bits at, Floats height, Floats gain, Mask wanted) {
    const BitsTag db;
    if (fragments_.at.size() < count_ + kStripColumns) fragments_.grow();
    hn::CompressStore(at, hn::RebindMask(db, wanted), db, &fragments_.at[count_]);
    hn::CompressStore(height, wanted, Tag(), &fragments_.height_m[count_]);
    count_ += hn::CompressStore(hn::Neg(gain), wanted, Tag(), &fragments_.gain[count_]);
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
    hn::CompressStore(at, mask, db, &fragments_.wall_at[walls_]);
    hn::CompressStore(steps(tall), mask, db, &fragments_.wall_height[walls_]);
    walls_ += hn::CompressStore(steps(hn::Mul(tall, gain)), mask, db, &fragments_.wall_return[walls_]);
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
  for (int start = static_cast<int>(first) / lanes * lanes; start < static_cast<int>(last); start += lanes) {
    const auto column = hn::Add(iota, set(static_cast<float>(start)));
    const auto active = hn::And(hn::Ge(column, set(first)), hn::Lt(column, set(last)));
    const auto [along, beside] = triangle.edges(column, &Corner::row);
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
    const auto height = hn::Add(base, hn::Mul(facet.by_row, row));
    const auto old_height = hn::Load(d, canvas.arrays.height_m + at);
    const auto old_gain = hn::Load(d, canvas.arrays.gain + at);
    const auto higher = hn::And(wanted, hn::Gt(height, old_height));
    const auto equal = hn::And(wanted, hn::And(hn::Eq(height, old_height), hn::Lt(old_gain, hn::Zero(d))));
    const auto stronger = hn::And(equal, hn::Lt(negative, old_gain));
    hn::Store(hn::IfThenElse(higher, height, old_height), d, canvas.arrays.height_m + at);
    hn::Store(hn::IfThenElse(hn::Or(higher, stronger), negative, old_gain), d, canvas.arrays.gain + at);
  });
}

HWY_INLINE Corner corner_of(const GridVertices& vertices, std::size_t i) {
  return {set(vertices.column[i]), set(vertices.row[i]), set(vertices.height_m[i]),
          set(vertices.facing != nullptr ? vertices.facing[i] : 0.0F)};
}

HWY_INLINE Triangle ordered(Corner a, Corner b, Corner c) {
  order(a, b);
  order(b, c);
  order(a, b);
  return {a, b, c};
}

void paint_ground(std::span<const std::uint32_t> triangles, const TileSurfaces& tile, const GridVertices& vertices,
                  const Canvas& canvas) {
  const Tag d;
  for (const std::uint32_t t : triangles) {
    const auto& corners = tile.corners[t];
    const Corner a = corner_of(vertices, corners[0]);
    const Corner b = corner_of(vertices, corners[1]);
    const Corner c = corner_of(vertices, corners[2]);
    const Facet facet = facet_of(a, b, c, canvas.limits);
    if (!hn::AllTrue(d, hn::Gt(facet.area, hn::Zero(d)))) continue;
    const auto gain = hn::Mul(set(tile.gamma[tile.kind[t]]), shading(vertices, a, b, c, facet));
    fill_wide(ordered(a, b, c), canvas, 0.0F, [&](std::size_t at, Floats, Floats, Mask wanted) HWY_ATTR {
      const auto old = hn::Load(d, canvas.arrays.gain + at);
      hn::Store(hn::IfThenElse(hn::And(wanted, hn::Ge(old, hn::Zero(d))), gain, old), d, canvas.arrays.gain + at);
    });
  }
}

// A corner of a vector's triangles.
HWY_INLINE Corner gather(const GridVertices& vertices, const TileSurfaces& tile, hn::Vec<SignedTag> triangle, int k) {
  const Tag d;
  const SignedTag di;
  const auto* const numbers = reinterpret_cast<const std::int32_t*>(tile.corners);
  const auto at = hn::Add(hn::Add(triangle, hn::ShiftLeft<1>(triangle)), hn::Set(di, k));
  const auto i = hn::GatherIndex(di, numbers, at);
  return {hn::GatherIndex(d, vertices.column, i), hn::GatherIndex(d, vertices.row, i),
          hn::GatherIndex(d, vertices.height_m, i),
          vertices.facing != nullptr ? hn::GatherIndex(d, vertices.facing, i) : hn::Zero(d)};
}

// Those of a vector that are large, one by one.
void draw_wide(const std::uint32_t* triangles, const float* gain, Mask wide, const GridVertices& vertices,
               const TileSurfaces& tile, const Canvas& canvas) {
  const Tag d;
  HWY_ALIGN float which[kStripColumns];
  hn::Store(hn::IfThenElseZero(wide, set(1.0F)), d, which);
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    if (which[lane] == 0.0F) continue;
    const auto& corners = tile.corners[triangles[lane]];
    const Corner a = corner_of(vertices, corners[0]);
    const Corner b = corner_of(vertices, corners[1]);
    const Corner c = corner_of(vertices, corners[2]);
    fill_high(ordered(a, b, c), facet_of(a, b, c, canvas.limits), set(gain[lane]), canvas);
  }
}

void draw_standing(std::span<const std::uint32_t> triangles, const TileSurfaces& tile, const GridVertices& vertices,
                   const Canvas& canvas, Fragments& fragments) {
  const Tag d;
  const SignedTag di;
  const BitsTag db;
  SmallTriangles small(canvas, fragments);
  HWY_ALIGN float gamma[kStripColumns] = {};
  HWY_ALIGN float cardinal[kStripColumns] = {};
  HWY_ALIGN std::uint32_t number[kStripColumns] = {};
  const std::size_t step = hn::Lanes(d);
  for (std::size_t i = 0; i < triangles.size(); i += step) {
    const std::size_t count = std::min(step, triangles.size() - i);
    for (std::size_t lane = 0; lane < step; ++lane) {
      number[lane] = triangles[i + std::min(lane, count - 1)];
      const std::size_t kind = tile.kind[number[lane]];
      gamma[lane] = tile.gamma[kind];
      cardinal[lane] = tile.cardinal[kind];
    }
    const auto there = hn::FirstN(d, count);
    const auto numbers = hn::BitCast(di, hn::Load(db, number));
    const Corner a = gather(vertices, tile, numbers, 0);
    const Corner b = gather(vertices, tile, numbers, 1);
    const Corner c = gather(vertices, tile, numbers, 2);
    const Facet facet = facet_of(a, b, c, canvas.limits);
    const Triangle triangle = ordered(a, b, c);
    const auto wall = hn::And(there, hn::And(facet.steep, hn::Gt(facet.towards, hn::Zero(d))));
    if (!hn::AllFalse(d, wall))
      small.stand(triangle, wall_gain(canvas.cardinal, facet, hn::Load(d, gamma), hn::Load(d, cardinal)), wall);
    const auto above = hn::And(there, hn::Gt(facet.area, hn::Zero(d)));
    if (hn::AllFalse(d, above)) continue;
    const auto gain = hn::Mul(hn::Load(d, gamma), shading(vertices, a, b, c, facet));
    const auto wide = hn::And(above, hn::Gt(hn::Sub(triangle.right.column, triangle.left.column), set(kWide)));
    small.fill(triangle, facet, gain, hn::AndNot(wide, above));
    small.flush();
    if (hn::AllFalse(d, wide)) continue;
    HWY_ALIGN float gains[kStripColumns];
    hn::Store(gain, d, gains);
    draw_wide(number, gains, wide, vertices, tile, canvas);
  }
  small.flush();
}

}  // namespace yars::model::hrm::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::lanes {

HWY_EXPORT(paint_ground);
HWY_EXPORT(draw_standing);

void paint_ground(std::span<const std::uint32_t> triangles, const TileSurfaces& tile, const GridVertices& vertices,
                  const Canvas& canvas) {
  HWY_DYNAMIC_DISPATCH(paint_ground)(triangles, tile, vertices, canvas);
}
void draw_standing(std::span<const std::uint32_t> triangles, const TileSurfaces& tile, const GridVertices& vertices,
                   const Canvas& canvas, Fragments& fragments) {
  HWY_DYNAMIC_DISPATCH(draw_standing)(triangles, tile, vertices, canvas, fragments);
}

}  // namespace yars::model::hrm::lanes
#endif  // HWY_ONCE
