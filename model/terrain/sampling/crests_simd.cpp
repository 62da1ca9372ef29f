#include "model/terrain/sampling/crests_simd.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/terrain/sampling/crests_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind highway.h, or it would have no target yet.
#include "lib/simd/fused-inl.hpp"
#include "model/terrain/sampling/post_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::terrain::crests::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace fused = yars::simd::HWY_NAMESPACE;
using namespace post_lanes::HWY_NAMESPACE;

using Marks = hn::Mask<FloatLanes>;

// [m] What lies nearer before a place is the place's own ground: closer, rounding would decide which stands higher.
constexpr float kOwnGround_m = 0.5F;
constexpr float kSlopeShare = 0.1F;   // of the spacing: how far before a place its slope is taken
constexpr float kColumnShare = 0.3F;  // of the spacing: columns that close together are not all looked at

// Ways along one axis of a cell, counted in posts. Of the lines across it every `step`th is looked at.
struct Axis {
  Floats from, to, step;
  bool every = true;  // all steps are 1
};

// Lines of posts strictly between the two ends of a way.
struct Lines {
  Floats first, count;
};
HWY_INLINE Lines lines_between(const Axis& axis, float most) {
  const FloatLanes d;
  const auto one = hn::Set(d, 1.0F);
  const auto first = hn::Max(hn::Add(hn::Floor(hn::Min(axis.from, axis.to)), one), hn::Zero(d));
  const auto last = hn::Min(hn::Sub(hn::Ceil(hn::Max(axis.from, axis.to)), one), hn::Set(d, most));
  const auto between = hn::Sub(last, first);
  return {first, hn::Add(axis.every ? between : hn::Floor(hn::Div(between, axis.step)), one)};
}

HWY_INLINE Floats without_turns(Floats cells) {
  const FloatLanes d;
  constexpr float kTurn = 360.0F;
  return fused::neg_mul_add(hn::Round(hn::Mul(cells, hn::Set(d, 1.0F / kTurn))), hn::Set(d, kTurn), cells);
}

// A height between two posts; a void leaves it to the other one, two leave none.
struct Height {
  Floats height_m;
  Marks known;
};
HWY_INLINE Height between(const look_up::Grid& grid, Wholes near, Wholes far, Floats share) {
  const FloatLanes d;
  const WholeLanes di;
  auto first = near, second = far;
  auto known = hn::FirstN(d, hn::Lanes(d));
  if (grid.voids) {
    const auto hole = hn::Set(di, kVoid);
    first = hn::IfThenElse(hn::Eq(near, hole), far, near);
    second = hn::IfThenElse(hn::Eq(far, hole), near, far);
    known = hn::RebindMask(d, hn::Ne(hn::Max(near, far), hole));
  }
  const auto a = hn::ConvertTo(d, first);
  const auto posts = fused::mul_add(share, hn::Sub(hn::ConvertTo(d, second), a), a);
  return {grid.unit_m == 1.0F ? posts : hn::Mul(posts, hn::Set(d, grid.unit_m)), known};
}

// One vector of ways.
class Ways {
 public:
  HWY_INLINE Ways(const CrossedCell& cell, const Ray& ray, std::size_t i, std::size_t end)
      : grid_(cell.grid),
        blocks_(*cell.grid.posts),
        curvature_(hn::Set(FloatLanes(), ray.curvature)),
        altitude_m_(hn::Set(FloatLanes(), ray.altitude_m)),
        highest_(hn::Set(FloatLanes(), kNoTangent)) {
    const FloatLanes d;
    const auto row_intervals = hn::Set(d, static_cast<float>(grid_.rows - 1));
    const auto column_intervals = hn::Set(d, static_cast<float>(grid_.columns - 1));
    const auto along = [&](const float* cells, const float* degrees, float cell_number, Floats intervals,
                           std::size_t at) {
      const auto cells_on = hn::Sub(hn::LoadU(d, cells + at), hn::Set(d, cell_number));
      const auto on = cell.close_columns ? without_turns(cells_on) : cells_on;
      return hn::Mul(hn::Add(on, hn::LoadU(d, degrees + at)), intervals);
    };
    const auto one = hn::Set(d, 1.0F);
    rows_ = {along(ray.cells_north, ray.north_deg, cell.cells_north, row_intervals, i - 1),
             along(ray.cells_north, ray.north_deg, cell.cells_north, row_intervals, i), one};
    columns_ = {along(ray.cells_east, ray.east_deg, cell.cells_east, column_intervals, i - 1),
                along(ray.cells_east, ray.east_deg, cell.cells_east, column_intervals, i), one};
    from_m_ = hn::LoadU(d, ray.distance_m + i - 1);
    way_m_ = hn::Sub(hn::LoadU(d, ray.distance_m + i), from_m_);
    // A way of more than a cell goes past a pole: it is not straight.
    const auto straight = hn::And(hn::Lt(hn::Abs(hn::Sub(rows_.to, rows_.from)), row_intervals),
                                  hn::Lt(hn::Abs(hn::Sub(columns_.to, columns_.from)), column_intervals));
    wanted_ = hn::And(straight, hn::FirstN(d, end - i));
    if (!cell.close_columns) return;
    const auto columns = hn::Abs(hn::Sub(columns_.to, columns_.from));
    const auto wanted_lines = hn::Div(way_m_, hn::Set(d, kColumnShare * cell.spacing_m));
    columns_.step = hn::Max(hn::Floor(hn::Div(columns, hn::Max(wanted_lines, one))), one);
    columns_.every = false;
  }

  // Two posts of a row stand about each crossing.
  HWY_INLINE void cross_rows() {
    walk(rows_, columns_, grid_.rows, grid_.columns, [&](Wholes row, Wholes column) {
      const auto word = gather_word(grid_.posts->data(), blocks_.offset(row, column));
      return Posts{western(word), eastern(word)};
    });
  }
  HWY_INLINE void cross_columns() {
    walk(columns_, rows_, grid_.columns, grid_.rows, [&](Wholes column, Wholes row) {
      const Words words = gather(grid_.posts->data(), blocks_.offset(row, column));
      return Posts{western(words.south), western(words.north)};
    });
  }
  // Of the quad that the way comes through last.
  HWY_INLINE void come_near(float spacing_m) {
    const FloatLanes d;
    const auto zero = hn::Zero(d);
    const auto back_m = hn::Set(d, kSlopeShare * spacing_m);
    auto counts = hn::And(wanted_, hn::Lt(back_m, way_m_));
    if (hn::AllFalse(d, counts)) return;
    const auto share = hn::Div(hn::Sub(way_m_, back_m), hn::IfThenElse(counts, way_m_, hn::Set(d, 1.0F)));
    const auto row = fused::mul_add(share, hn::Sub(rows_.to, rows_.from), rows_.from);
    const auto column = fused::mul_add(share, hn::Sub(columns_.to, columns_.from), columns_.from);
    counts = hn::And(counts, hn::And(hn::Ge(row, zero), hn::Ge(column, zero)));
    counts = hn::And(counts, hn::And(hn::Le(row, hn::Set(d, static_cast<float>(grid_.rows - 1))),
                                     hn::Le(column, hn::Set(d, static_cast<float>(grid_.columns - 1)))));
    const auto south = hn::Min(hn::Floor(row), hn::Set(d, static_cast<float>(grid_.rows - 2)));
    const auto west = hn::Min(hn::Floor(column), hn::Set(d, static_cast<float>(grid_.columns - 2)));
    const Words words = gather(grid_.posts->data(), blocks_.offset(whole(counts, south), whole(counts, west)));
    const auto north_share = hn::Sub(row, south), east_share = hn::Sub(column, west);
    const auto lower = between(grid_, western(words.south), eastern(words.south), east_share);
    const auto upper = between(grid_, western(words.north), eastern(words.north), east_share);
    // Beside a void the lines alone decide.
    counts = hn::And(counts, hn::And(lower.known, upper.known));
    const auto height_m = fused::mul_add(north_share, hn::Sub(upper.height_m, lower.height_m), lower.height_m);
    const auto tangent = tangent_of(fused::mul_add(share, way_m_, from_m_), height_m);
    highest_ = hn::IfThenElse(counts, hn::Max(highest_, tangent), highest_);
  }
  HWY_INLINE void raise(float* tangent) const {
    const FloatLanes d;
    const auto before = hn::LoadU(d, tangent);
    hn::StoreU(hn::IfThenElse(wanted_, hn::Max(before, highest_), before), d, tangent);
  }

 private:
  struct Posts {
    Wholes near, far;
  };

  template <class PostsAt>
  HWY_INLINE void walk(const Axis& axis, const Axis& other, int lines_of_grid, int posts_of_line, PostsAt posts_at) {
    const FloatLanes d;
    const auto zero = hn::Zero(d);
    const auto one = hn::Set(d, 1.0F);
    const Lines lines = lines_between(axis, static_cast<float>(lines_of_grid - 2));
    const auto count = hn::IfThenElseZero(wanted_, lines.count);
    const int most = static_cast<int>(hn::GetLane(hn::MaxOfLanes(d, count)));
    if (most < 1) return;
    const auto run = hn::Sub(axis.to, axis.from);
    const auto inverse = hn::Div(one, hn::IfThenElse(hn::Eq(run, zero), one, run));
    const auto drift = hn::Sub(other.to, other.from);
    const auto farthest_m = hn::Sub(way_m_, hn::Set(d, kOwnGround_m));
    const auto line_end = hn::Set(d, static_cast<float>(posts_of_line - 1));
    const auto last_post = hn::Set(d, static_cast<float>(posts_of_line - 2));
    for (int i = 0; i < most; ++i) {
      const auto number = hn::Set(d, static_cast<float>(i));
      const auto line = fused::mul_add(number, axis.step, lines.first);
      const auto share = hn::Mul(hn::Sub(line, axis.from), inverse);
      const auto at = fused::mul_add(share, drift, other.from);
      const auto on_m = hn::Mul(share, way_m_);
      auto counts = hn::And(hn::Lt(number, count), hn::Lt(on_m, farthest_m));
      counts = hn::And(counts, hn::And(hn::Ge(at, zero), hn::Le(at, line_end)));
      const auto post = hn::Min(hn::Floor(at), last_post);
      const Posts posts = posts_at(whole(counts, line), whole(counts, post));
      const Height height = between(grid_, posts.near, posts.far, hn::Sub(at, post));
      const auto tangent = tangent_of(hn::Add(from_m_, on_m), height.height_m);
      highest_ = hn::IfThenElse(hn::And(counts, height.known), hn::Max(highest_, tangent), highest_);
    }
  }
  HWY_INLINE static Wholes whole(Marks counts, Floats number) {
    return hn::ConvertTo(WholeLanes(), hn::IfThenElseZero(counts, number));
  }

  // As the pass from terrain to power sees its samples (model/rbm/sweep_simd.cpp).
  HWY_INLINE Floats tangent_of(Floats distance_m, Floats height_m) const {
    const FloatLanes d;
    const auto angle = hn::Mul(distance_m, curvature_);
    const auto square = hn::Mul(angle, angle);
    const auto fall = fused::neg_mul_add(square, hn::Set(d, 0.0416666667F), hn::Set(d, 0.5F));
    const auto drop_m = hn::Mul(hn::Mul(distance_m, angle), fall);
    const auto chord_m = fused::neg_mul_add(hn::Mul(distance_m, square), hn::Set(d, 0.166666667F), distance_m);
    const auto sine = hn::Mul(chord_m, curvature_);
    const auto cosine = fused::neg_mul_add(drop_m, curvature_, hn::Set(d, 1.0F));
    return hn::Div(fused::mul_sub(height_m, cosine, hn::Add(drop_m, altitude_m_)),
                   fused::mul_add(height_m, sine, chord_m));
  }

  const look_up::Grid& grid_;
  const BlockLanes blocks_;
  Axis rows_, columns_;
  Floats from_m_, way_m_, curvature_, altitude_m_, highest_;
  Marks wanted_;
};

void raise(const CrossedCell& cell, const Ray& ray, std::size_t first, std::size_t end, float* tangent) {
  for (std::size_t i = first; i < end; i += hn::Lanes(FloatLanes())) {
    Ways ways(cell, ray, i, end);
    ways.cross_rows();
    ways.cross_columns();
    ways.come_near(cell.spacing_m);
    ways.raise(tangent + i);
  }
}

}  // namespace yars::model::terrain::crests::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::terrain::crests {

HWY_EXPORT(raise);

void raise(const CrossedCell& cell, const Ray& ray, std::size_t first, std::size_t end, float* tangent) {
  HWY_DYNAMIC_DISPATCH(raise)(cell, ray, first, end, tangent);
}

}  // namespace yars::model::terrain::crests
#endif  // HWY_ONCE
