#include "model/terrain/sampling/crests_simd.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/terrain/sampling/crests_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Must follow highway.h, which defines HWY_NAMESPACE.
#include "model/terrain/sampling/crossing_simd-inl.hpp"
#include "model/terrain/sampling/ray_piece_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::terrain::crests::HWY_NAMESPACE {

// Fractions of CrossedCell::spacing_m.
constexpr float kSlopeFraction = 0.1F;   // distance before a position at which the ground is also sampled
constexpr float kColumnFraction = 0.3F;  // columns are skipped while examined ones stay this close along the ray

// Start and end of a vector of ray steps along one axis of a cell [posts]. A line of posts is a row or column across
// the axis. `step`: number of lines from one examined line to the next.
struct Axis {
  Floats from, to, step;
  bool every = true;  // true: all values of `step` are 1
};

// Lines of posts strictly between the two ends of a ray step: index of the first, and number of those examined.
struct Lines {
  Floats first, count;
};
HWY_INLINE Lines lines_between(const Axis& axis, float max_line) {
  const FloatLanes d;
  const auto one = hn::Set(d, 1.0F);
  const auto first = hn::Max(hn::Add(hn::Floor(hn::Min(axis.from, axis.to)), one), hn::Zero(d));
  const auto last = hn::Min(hn::Sub(hn::Ceil(hn::Max(axis.from, axis.to)), one), hn::Set(d, max_line));
  const auto between = hn::Sub(last, first);
  return {first, hn::Add(axis.every ? between : hn::Floor(hn::Div(between, axis.step)), one)};
}

// Removes whole turns of 360 degrees from a difference of cell counts.
HWY_INLINE Floats without_turns(Floats cells) {
  const FloatLanes d;
  constexpr float kTurn = 360.0F;
  return fused::neg_mul_add(hn::Round(hn::Mul(cells, hn::Set(d, 1.0F / kTurn))), hn::Set(d, kTurn), cells);
}

// One vector of steps between successive positions.
class RaySteps {
 public:
  HWY_INLINE RaySteps(const CrossedCell& cell, const Ray& ray, std::size_t i, std::size_t end)
      : grid_(cell.grid),
        blocks_(*cell.grid.posts),
        observer_(ray),
        floor_(ray.floor == nullptr ? hn::Set(FloatLanes(), kNoTangent) : hn::LoadU(FloatLanes(), ray.floor + i)),
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
    step_m_ = hn::Sub(hn::LoadU(d, ray.distance_m + i), from_m_);
    // A step longer than a cell passes a pole and is not straight.
    const auto straight = hn::And(hn::Lt(hn::Abs(hn::Sub(rows_.to, rows_.from)), row_intervals),
                                  hn::Lt(hn::Abs(hn::Sub(columns_.to, columns_.from)), column_intervals));
    active_ = hn::And(straight, hn::FirstN(d, end - i));
    if (!cell.close_columns) return;
    const auto columns = hn::Abs(hn::Sub(columns_.to, columns_.from));
    const auto target_lines = hn::Div(step_m_, hn::Set(d, kColumnFraction * cell.spacing_m));
    columns_.step = hn::Max(hn::Floor(hn::Div(columns, hn::Max(target_lines, one))), one);
    columns_.every = false;
  }

  // Examines the points where steps cross rows. Each point lies between two posts of the row. cross_columns() does the
  // same for columns.
  HWY_INLINE void cross_rows() {
    cross_lines(rows_, columns_, grid_.rows, grid_.columns,
                [&](Ints row, Ints column) { return posts_of_row(grid_, blocks_, row, column); });
  }
  HWY_INLINE void cross_columns() {
    cross_lines(columns_, rows_, grid_.columns, grid_.rows,
                [&](Ints column, Ints row) { return posts_of_column(grid_, blocks_, row, column); });
  }
  // Examines the bilinear ground kSlopeFraction * spacing_m before the end of the step.
  HWY_INLINE void consider_slope(float spacing_m) {
    const FloatLanes d;
    const auto zero = hn::Zero(d);
    const auto back_m = hn::Set(d, kSlopeFraction * spacing_m);
    auto valid = hn::And(active_, hn::Lt(back_m, step_m_));
    if (hn::AllFalse(d, valid)) return;
    const auto fraction = hn::Div(hn::Sub(step_m_, back_m), hn::IfThenElse(valid, step_m_, hn::Set(d, 1.0F)));
    const auto row = fused::mul_add(fraction, hn::Sub(rows_.to, rows_.from), rows_.from);
    const auto column = fused::mul_add(fraction, hn::Sub(columns_.to, columns_.from), columns_.from);
    valid = hn::And(valid, hn::And(hn::Ge(row, zero), hn::Ge(column, zero)));
    valid = hn::And(valid, hn::And(hn::Le(row, hn::Set(d, static_cast<float>(grid_.rows - 1))),
                                   hn::Le(column, hn::Set(d, static_cast<float>(grid_.columns - 1)))));
    const auto south = hn::Min(hn::Floor(row), hn::Set(d, static_cast<float>(grid_.rows - 2)));
    const auto west = hn::Min(hn::Floor(column), hn::Set(d, static_cast<float>(grid_.columns - 2)));
    const Words words = gather(grid_.posts->data(), blocks_.offset(whole(valid, south), whole(valid, west)));
    const auto north_fraction = hn::Sub(row, south), east_fraction = hn::Sub(column, west);
    const auto lower = between(grid_, western(words.south), eastern(words.south), east_fraction);
    const auto upper = between(grid_, western(words.north), eastern(words.north), east_fraction);
    // If both southern posts or both northern posts are void, this candidate is left out.
    valid = hn::And(valid, hn::And(lower.known, upper.known));
    const auto height_m = fused::mul_add(north_fraction, hn::Sub(upper.height_m, lower.height_m), lower.height_m);
    consider(observer_.sight_of(fused::mul_add(fraction, step_m_, from_m_), height_m), valid);
  }
  // Raises the tangents of the steps to the highest tangents examined.
  HWY_INLINE void raise(float* tangent) const {
    const FloatLanes d;
    const auto before = hn::LoadU(d, tangent);
    hn::StoreU(hn::IfThenElse(active_, hn::Max(before, highest_), before), d, tangent);
  }

 private:
  // Examines the lines of posts across `axis`. `other`: axis along the lines. posts_at(line, post) returns a post of a
  // line and the next post of that line.
  template <class PostsAt>
  HWY_INLINE void cross_lines(const Axis& axis, const Axis& other, int lines_of_grid, int posts_of_line,
                              PostsAt posts_at) {
    const FloatLanes d;
    const auto zero = hn::Zero(d);
    const auto one = hn::Set(d, 1.0F);
    const Lines lines = lines_between(axis, static_cast<float>(lines_of_grid - 2));
    const auto count = hn::IfThenElseZero(active_, lines.count);
    const int max_count = static_cast<int>(hn::GetLane(hn::MaxOfLanes(d, count)));
    if (max_count < 1) return;
    const auto run = hn::Sub(axis.to, axis.from);
    const auto inverse = hn::Div(one, hn::IfThenElse(hn::Eq(run, zero), one, run));
    const auto drift = hn::Sub(other.to, other.from);
    const auto farthest_m = hn::Sub(step_m_, hn::Set(d, kOwnGround_m));
    const auto line_end = hn::Set(d, static_cast<float>(posts_of_line - 1));
    const auto last_post = hn::Set(d, static_cast<float>(posts_of_line - 2));
    for (int i = 0; i < max_count; ++i) {
      const auto number = hn::Set(d, static_cast<float>(i));
      const auto line = fused::mul_add(number, axis.step, lines.first);
      const auto fraction = hn::Mul(hn::Sub(line, axis.from), inverse);
      const auto at = fused::mul_add(fraction, drift, other.from);
      const auto on_m = hn::Mul(fraction, step_m_);
      auto valid = hn::And(hn::Lt(number, count), hn::Lt(on_m, farthest_m));
      valid = hn::And(valid, hn::And(hn::Ge(at, zero), hn::Le(at, line_end)));
      const auto post = hn::Min(hn::Floor(at), last_post);
      const Posts posts = posts_at(whole(valid, line), whole(valid, post));
      const Height height = between(grid_, posts.near, posts.far, hn::Sub(at, post));
      consider(observer_.sight_of(hn::Add(from_m_, on_m), height.height_m), hn::And(valid, height.known));
    }
  }
  HWY_INLINE void consider(const Sight& sight, Mask valid) {
    const auto reaching = hn::And(valid, reaches(sight, floor_));
    if (hn::AllFalse(FloatLanes(), reaching)) return;
    highest_ = hn::IfThenElse(reaching, hn::Max(highest_, hn::Div(sight.up_m, sight.out_m)), highest_);
  }

  const sampling::Grid& grid_;
  const BlockLanes blocks_;
  const Observer observer_;
  Axis rows_, columns_;
  Floats from_m_, step_m_, floor_, highest_;
  Mask active_;
};

void raise(const CrossedCell& cell, const Ray& ray, std::size_t first, std::size_t end, float* tangent) {
  if (ray.even_step_m > 0.0F && !cell.close_columns) return raise_by_pieces(cell, ray, first, end, tangent);
  for (std::size_t i = first; i < end; i += hn::Lanes(FloatLanes())) {
    RaySteps steps(cell, ray, i, end);
    steps.cross_rows();
    steps.cross_columns();
    steps.consider_slope(cell.spacing_m);
    steps.raise(tangent + i);
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
