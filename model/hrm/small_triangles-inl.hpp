// Rasteriser of scene triangles, one per lane: surfaces of up to 12 columns as seen from above, walls of any width.
// Drawn grid points are collected as fragments (struct Fragments) and stored in batches.
// Included once for each target (instruction set) of the library Highway.
#if defined(YARS_MODEL_HRM_SMALL_TRIANGLES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef YARS_MODEL_HRM_SMALL_TRIANGLES_INL
#undef YARS_MODEL_HRM_SMALL_TRIANGLES_INL
#else
#define YARS_MODEL_HRM_SMALL_TRIANGLES_INL
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "model/hrm/facet-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Bits = hn::Vec<BitsTag>;

constexpr std::size_t kFlushCount = 1024;    // fragments collected before they are stored
constexpr std::size_t kPrefetchPoints = 24;  // distance of the prefetch [fragments]
constexpr float kUnderRoof_m = 0.02F;        // [m] lowers the top of a wall, so that a roof on the wall is higher
// [steps of kWallStep_m] limit of one wall's height and return, which keeps the conversion to int32 defined.
constexpr float kMaxWall = 1.0e9F;
constexpr std::uint32_t kFullWall = 0x7fffffffU;  // upper limit of the sums in WallPoint, so that they do not wrap

// Converts a SurfacePoint (height in the upper half, gamma in the lower half) to an integer for comparison. The greater
// height has the greater integer. At equal height a standing scene surface has a greater integer than the ground,
// because its gamma is negated, which sets the highest bit of the lower half. Of two standing surfaces at equal height,
// the one with the greater gamma has the greater integer. The function is its own inverse.
static_assert(std::endian::native == std::endian::little);
HWY_INLINE std::int64_t ordered_bits(std::int64_t point) {
  constexpr std::int64_t kHeight = 0x7fffffff00000000;
  return point ^ ((point >> 63) & kHeight);
}
// Replaces negative zero by positive zero, because ordered_bits() distinguishes them.
HWY_INLINE Floats without_negative_zero(Floats height) {
  return hn::Add(height, hn::Zero(Tag()));
}
// Upper half of ordered_bits(point), for a vector of heights.
HWY_INLINE Bits ordered_bits(Floats height) {
  const BitsTag db;
  const auto bits = hn::BitCast(SignedTag(), height);
  const auto turned = hn::And(hn::ShiftRight<31>(bits), hn::Set(SignedTag(), 0x7fffffff));
  return hn::BitCast(db, hn::Xor(bits, turned));
}

// PolarGrid::at() for vectors of columns and rows. Lanes outside the sector get any number.
HWY_INLINE Bits index_on(const PolarGrid& grid, Floats column, Floats row) {
  const SignedTag di;
  const BitsTag db;
  const auto i = hn::BitCast(db, hn::ConvertTo(di, column));
  const auto held = hn::Sub(hn::ShiftRight<4>(i), hn::Set(db, static_cast<std::uint32_t>(grid.first_strip)));
  const auto strip = hn::Mul(held, hn::Set(db, static_cast<std::uint32_t>(grid.strip_size())));
  const auto line = hn::ShiftLeft<4>(hn::BitCast(db, hn::ConvertTo(di, row)));
  return hn::Add(hn::Add(strip, line), hn::And(i, hn::Set(db, kStripColumns - 1U)));
}

// Draws triangles, one per lane, into fragments, and stores these in batches.
class SmallTriangles {
 public:
  SmallTriangles(const Canvas& canvas, Fragments& fragments) : canvas_(canvas), fragments_(fragments) {}

  // Draws surfaces. In each column a surface is extended at both ends by half a row (kSurfaceReach). The first and the
  // last grid point drawn in a column are then on average as far apart as the edges.
  // `label`: surface labels of the triangles, by lane; used if the canvas has labels.
  void draw_surfaces(const Triangle& triangle, const Facet& facet, Floats gamma, const std::uint32_t* label,
                     Mask active) {
    const Tag d;
    const auto rows = set(static_cast<float>(canvas_.grid->rows));
    const auto end = hn::Min(hn::Ceil(triangle.right.column), set(canvas_.limits.last_column));
    auto column = hn::Max(hn::Ceil(triangle.left.column), set(canvas_.limits.first_column));
    active = hn::And(active, hn::Lt(column, end));
    const Edges rows_at(triangle, &Corner::row);
    for (; !hn::AllFalse(d, active);
         column = hn::Add(column, set(1.0F)), active = hn::And(active, hn::Lt(column, end))) {
      const auto [on_long_edge, on_short_edge] = rows_at.at(column);
      const auto near = hn::Min(on_long_edge, on_short_edge);
      const auto far = hn::Max(on_long_edge, on_short_edge);
      const auto last = hn::Min(hn::Ceil(hn::Add(far, set(kSurfaceReach))), rows);
      auto row = hn::Max(hn::Ceil(hn::Sub(near, set(kSurfaceReach))), hn::Zero(d));
      auto wanted = hn::And(active, hn::Lt(row, last));
      auto at = index_on(*canvas_.grid, hn::IfThenElseZero(active, column), hn::IfThenElseZero(wanted, row));
      const auto base = hn::Add(facet.value, hn::Mul(facet.by_column, column));
      while (!hn::AllFalse(d, wanted)) {
        const auto height = hn::Add(base, hn::Mul(facet.by_row, hn::Min(hn::Max(row, near), far)));
        add_fragment(at, triangle.within(height), gamma, label, wanted);
        at = hn::Add(at, hn::Set(BitsTag(), static_cast<std::uint32_t>(kStripColumns)));
        row = hn::Add(row, set(1.0F));
        wanted = hn::And(wanted, hn::Lt(row, last));
      }
    }
  }

  // Draws walls. Seen from above a wall is the line between its leftmost and rightmost corners. In each column the wall
  // is stored at the first grid point that a roof on the far side of the line (away from the radar) would cover. There
  // the column's profile (profile_simd.hpp) steps up. `gamma` of the wall is scaled by width / number of columns
  // crossed. A wall narrower than a column is not scaled: the probability that it crosses the centre of a column equals
  // its width in columns.
  void draw_walls(const Triangle& triangle, WallGamma gamma, const std::uint32_t* label, Mask active) {
    const Tag d;
    const auto width = hn::Sub(triangle.right.column, triangle.left.column);
    const auto columns = hn::Sub(hn::Ceil(triangle.right.column), hn::Ceil(triangle.left.column));
    const auto scale = hn::IfThenElse(hn::Lt(width, set(1.0F)), set(1.0F), hn::Div(width, columns));
    gamma = {hn::Mul(gamma.all, scale), hn::Mul(gamma.facing, scale)};
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
      const auto [on_long_edge, on_short_edge] = heights_at.at(column);
      const auto wall_height_m = hn::Abs(hn::Sub(on_long_edge, on_short_edge));
      const auto at = index_on(*canvas_.grid, hn::IfThenElseZero(wanted, column), hn::IfThenElseZero(wanted, row));
      add_wall_fragment(at, wall_height_m, gamma, wanted);
      // The top of a wall is drawn as a surface, for walls without a roof. A roof is higher and replaces this surface.
      add_fragment(at, hn::Sub(hn::Max(on_long_edge, on_short_edge), set(kUnderRoof_m)), gamma.all, label, wanted);
    }
  }

  // Stores all fragments if there are at least kFlushCount of surfaces or of walls, or if `all` is true.
  void flush(bool all) {
    if (!all && count_ < kFlushCount && walls_ < kFlushCount) return;
    for (std::size_t i = 0; i < count_; ++i) {
      hwy::Prefetch(canvas_.arrays.surface + fragments_.at[std::min(i + kPrefetchPoints, count_ - 1)]);
      SurfacePoint& point = canvas_.arrays.surface[fragments_.at[i]];
      const std::uint64_t height = fragments_.height[i];
      const auto fragment = static_cast<std::int64_t>(height << 32 | std::bit_cast<std::uint32_t>(fragments_.gamma[i]));
      const std::int64_t before = ordered_bits(std::bit_cast<std::int64_t>(point));
      point = std::bit_cast<SurfacePoint>(ordered_bits(std::max(before, fragment)));
      if (canvas_.arrays.label != nullptr && fragment > before)
        canvas_.arrays.label[fragments_.at[i]] = fragments_.label[i];
    }
    for (std::size_t i = 0; i < walls_; ++i) {
      hwy::Prefetch(canvas_.arrays.walls + fragments_.wall_at[std::min(i + kPrefetchPoints, walls_ - 1)]);
      WallPoint& point = canvas_.arrays.walls[fragments_.wall_at[i]];
      point.height_steps += fragments_.wall_height[i];
      point.returned_steps += fragments_.wall_return[i];
      point.facing_steps += fragments_.wall_facing[i];
      if (((point.height_steps | point.returned_steps | point.facing_steps) & ~kFullWall) == 0) [[likely]]
        continue;
      point.height_steps = std::min(point.height_steps, kFullWall);
      point.returned_steps = std::min(point.returned_steps, kFullWall);
      point.facing_steps = std::min(point.facing_steps, kFullWall);
    }
    count_ = walls_ = 0;
  }

 private:
  void add_fragment(Bits at, Floats height, Floats gamma, const std::uint32_t* label, Mask wanted) {
    const BitsTag db;
    if (fragments_.at.size() < count_ + kStripColumns) fragments_.grow();
    const auto mask = hn::RebindMask(db, wanted);
    hn::StoreU(hn::Compress(at, mask), db, &fragments_.at[count_]);
    hn::StoreU(hn::Compress(ordered_bits(without_negative_zero(height)), mask), db, &fragments_.height[count_]);
    hn::StoreU(hn::Compress(hn::Neg(gamma), wanted), Tag(), &fragments_.gamma[count_]);
    if (canvas_.arrays.label != nullptr)
      hn::StoreU(hn::Compress(hn::Load(db, label), mask), db, &fragments_.label[count_]);
    count_ += hn::CountTrue(Tag(), wanted);
  }
  void add_wall_fragment(Bits at, Floats wall_height_m, WallGamma gamma, Mask wanted) {
    const BitsTag db;
    const SignedTag di;
    if (fragments_.wall_at.size() < walls_ + kStripColumns) fragments_.grow_walls();
    const auto steps = [&](Floats number) HWY_ATTR {
      const auto clamped = hn::Min(hn::Mul(number, set(1.0F / kWallStep_m)), set(kMaxWall));
      return hn::BitCast(db, hn::ConvertTo(di, hn::Add(clamped, set(0.5F))));
    };
    const auto mask = hn::RebindMask(db, wanted);
    hn::StoreU(hn::Compress(at, mask), db, &fragments_.wall_at[walls_]);
    hn::StoreU(hn::Compress(steps(wall_height_m), mask), db, &fragments_.wall_height[walls_]);
    hn::StoreU(hn::Compress(steps(hn::Mul(wall_height_m, gamma.all)), mask), db, &fragments_.wall_return[walls_]);
    hn::StoreU(hn::Compress(steps(hn::Mul(wall_height_m, gamma.facing)), mask), db, &fragments_.wall_facing[walls_]);
    walls_ += hn::CountTrue(Tag(), wanted);
  }

  const Canvas& canvas_;
  Fragments& fragments_;
  std::size_t count_ = 0, walls_ = 0;
};

}  // namespace yars::model::hrm::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
