#include "model/terrain/sampling/crests_simd.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/terrain/sampling/crests_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Must follow highway.h, which defines HWY_NAMESPACE.
#include "lib/simd/fused-inl.hpp"
#include "model/terrain/sampling/post_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::terrain::crests::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace fused = yars::simd::HWY_NAMESPACE;
using namespace post_simd::HWY_NAMESPACE;

using Mask = hn::Mask<FloatLanes>;

// [m] A crossing closer than this to the step's end is left out. With a smaller value, rounding would decide whether
// the ground at the crossing or at the end is higher.
constexpr float kOwnGround_m = 0.5F;
constexpr float kMaxPiece_m = 40000.0F;  // [m] maximum length of a RayPiece: 0.2 m off the ray
constexpr float kMinPiece_m = 3000.0F;   // [m] length of a piece that is used even if it is not straight: 0.4 m off
// Fractions of CrossedCell::spacing_m.
constexpr float kSlopeFraction = 0.1F;   // distance before a position at which the ground is also sampled
constexpr float kLoose = 1.0e-6F;        // relative rounding of a comparison with the floor, rounded up
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

// Height interpolated between two posts. If one post is void: the height of the other. If both are void: not known.
struct Height {
  Floats height_m;
  Mask known;
};
HWY_INLINE Height between(const sampling::Grid& grid, Ints near, Ints far, Floats fraction) {
  const FloatLanes d;
  const IntLanes di;
  auto first = near, second = far;
  auto known = hn::FirstN(d, hn::Lanes(d));
  if (grid.voids) {
    const auto hole = hn::Set(di, kVoid);
    first = hn::IfThenElse(hn::Eq(near, hole), far, near);
    second = hn::IfThenElse(hn::Eq(far, hole), near, far);
    known = hn::RebindMask(d, hn::Ne(hn::Max(near, far), hole));
  }
  const auto a = hn::ConvertTo(d, first);
  const auto posts = fused::mul_add(fraction, hn::Sub(hn::ConvertTo(d, second), a), a);
  return {grid.unit_m == 1.0F ? posts : hn::Mul(posts, hn::Set(d, grid.unit_m)), known};
}

// Ground in the vertical plane of the ray, relative to the observer.
struct Sight {
  Floats out_m, up_m;
};

// Curvature of the earth and altitude of the observer.
class Observer {
 public:
  HWY_INLINE explicit Observer(const Ray& ray)
      : curvature_(hn::Set(FloatLanes(), ray.curvature)), altitude_m_(hn::Set(FloatLanes(), ray.altitude_m)) {}

  // Ground at a distance and a height. angle: at the earth's centre [rad]. drop_m and chord_m: series of (1 - cos
  // angle) and sin angle, times the radius; the same as in model/rbm/sweep_simd.cpp.
  HWY_INLINE Sight sight_of(Floats distance_m, Floats height_m) const {
    const FloatLanes d;
    const auto angle = hn::Mul(distance_m, curvature_);
    const auto square = hn::Mul(angle, angle);
    const auto fall = fused::neg_mul_add(square, hn::Set(d, 0.0416666667F), hn::Set(d, 0.5F));
    const auto drop_m = hn::Mul(hn::Mul(distance_m, angle), fall);
    const auto chord_m = fused::neg_mul_add(hn::Mul(distance_m, square), hn::Set(d, 0.166666667F), distance_m);
    const auto sine = hn::Mul(chord_m, curvature_);
    const auto cosine = fused::neg_mul_add(drop_m, curvature_, hn::Set(d, 1.0F));
    return {fused::mul_add(height_m, sine, chord_m), fused::mul_sub(height_m, cosine, hn::Add(drop_m, altitude_m_))};
  }

 private:
  Floats curvature_, altitude_m_;
};

// True where the tangent of `sight` may reach the floor. The product needs no division, and is loose by more than the
// rounding of both sides.
HWY_INLINE Mask reaches(const Sight& sight, Floats floor) {
  const FloatLanes d;
  const auto above = fused::neg_mul_add(floor, sight.out_m, sight.up_m);
  return hn::Ge(above, hn::Mul(hn::Abs(sight.up_m), hn::Set(d, -kLoose)));
}

struct Posts {
  Ints near, far;
};
HWY_INLINE Posts posts_of_row(const sampling::Grid& grid, const BlockLanes& blocks, Ints row, Ints column) {
  const auto word = gather_word(grid.posts->data(), blocks.offset(row, column));
  return {western(word), eastern(word)};
}
HWY_INLINE Posts posts_of_column(const sampling::Grid& grid, const BlockLanes& blocks, Ints row, Ints column) {
  const Words words = gather(grid.posts->data(), blocks.offset(row, column));
  return {western(words.south), western(words.north)};
}
HWY_INLINE Ints whole(Mask valid, Floats number) {
  return hn::ConvertTo(IntLanes(), hn::IfThenElseZero(valid, number));
}

// Whole numbers from 0 to 2^23 as integers.
HWY_INLINE Ints integer(Floats number) {
  constexpr float kIntegerBias = 8388608.0F;  // 2^23: the sum has the integer in its lowest mantissa bits
  const IntLanes di;
  return hn::Sub(hn::BitCast(di, hn::Add(number, hn::Set(FloatLanes(), kIntegerBias))), hn::Set(di, 0x4b000000));
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

// Ground on lines of posts that may reach the floor. Collected without branches, because whether a line reaches it
// cannot be predicted.
class Summits {
 public:
  HWY_INLINE void add(Floats distance_m, Floats height_m, Mask reaching) {
    const FloatLanes d;
    // A copy, because the compiler must assume that the stores change count_.
    const std::size_t count = count_;
    hn::StoreU(hn::Compress(distance_m, reaching), d, distance_m_ + count);
    hn::StoreU(hn::Compress(height_m, reaching), d, height_m_ + count);
    count_ = count + hn::CountTrue(d, reaching);
  }
  bool full() const { return count_ + kRunSlack > kCapacity; }

  // Raises the tangents of the steps, and empties the collection.
  HWY_INLINE void raise(const Observer& observer, const Ray& ray, float* tangent) {
    const FloatLanes d;
    const float first_m = ray.distance_m[0], steps_per_m = 1.0F / ray.even_step_m;
    const float own_steps = kOwnGround_m * steps_per_m;
    for (std::size_t i = 0; i < count_; i += hn::Lanes(d)) {
      const Sight sight = observer.sight_of(hn::LoadU(d, distance_m_ + i), hn::LoadU(d, height_m_ + i));
      hn::StoreU(hn::Div(sight.up_m, sight.out_m), d, height_m_ + i);
    }
    for (std::size_t i = 0; i < count_; ++i) {
      const float on_steps = (distance_m_[i] - first_m) * steps_per_m;
      const float end = std::floor(on_steps) + 1.0F;
      // The ground at the end of a step is the step's own.
      if (end - on_steps <= own_steps) continue;
      float& highest = tangent[static_cast<std::size_t>(end)];
      highest = std::max(highest, height_m_[i]);
    }
    count_ = 0;
  }

 private:
  static constexpr std::size_t kCapacity = 256;
  std::size_t count_ = 0;
  HWY_ALIGN float distance_m_[kCapacity];
  HWY_ALIGN float height_m_[kCapacity];
};

// A piece of a ray with evenly spaced positions. Latitude and longitude are quadratic along the piece. All lines of
// posts that it crosses are examined, a vector of successive lines at a time.
class RayPiece {
 public:
  // The piece leads from position `start` to position `stop`.
  HWY_INLINE RayPiece(const CrossedCell& cell, const Ray& ray, float* tangent, std::size_t start, std::size_t stop)
      : ray_(ray),
        grid_(cell.grid),
        tangent_(tangent),
        start_(start),
        steps_(static_cast<float>(stop - start)),
        from_m_(ray.distance_m[start]),
        piece_m_(ray.distance_m[stop] - from_m_) {
    const auto row = [&](std::size_t i) {
      return ((ray.cells_north[i] - cell.cells_north) + ray.north_deg[i]) * static_cast<float>(grid_.rows - 1);
    };
    const auto column = [&](std::size_t i) {
      return ((ray.cells_east[i] - cell.cells_east) + ray.east_deg[i]) * static_cast<float>(grid_.columns - 1);
    };
    rows_ = span_of(start, stop, row);
    columns_ = span_of(start, stop, column);
  }
  // True if the piece is nearly straight, so that the first step of Newton's method finds its crossings.
  HWY_INLINE bool straight() const {
    const auto slight = [](const Span& span) {
      const float bend = std::abs(span.bend);
      return bend * bend <= kMaxBend_posts * std::abs(span.to - span.from) || bend <= kMinBend_posts;
    };
    return slight(rows_) && slight(columns_);
  }

  // Adds the ground on the rows (columns) of posts that the piece crosses and where it may reach the floor.
  HWY_INLINE void cross_rows(const Observer& observer, const BlockLanes& blocks, Summits& summits) const {
    cross_lines({rows_, columns_, grid_.rows, grid_.columns}, observer, summits,
                [&](Ints row, Ints column) { return posts_of_row(grid_, blocks, row, column); });
  }
  HWY_INLINE void cross_columns(const Observer& observer, const BlockLanes& blocks, Summits& summits) const {
    cross_lines({columns_, rows_, grid_.columns, grid_.rows}, observer, summits,
                [&](Ints column, Ints row) { return posts_of_column(grid_, blocks, row, column); });
  }
  // True if the whole piece lies in the shadow of nearer positions, and none of its ground reaches the floor.
  HWY_INLINE bool hidden() const { return dark(0.0F, 1.0F) && below_floor(0.0F, 1.0F); }

 private:
  static constexpr float kMaxBend_posts = 0.1F;   // [posts] of bend^2 / way: a crossing is 0.01 posts off at most
  static constexpr float kMinBend_posts = 0.01F;  // [posts] four times the distance from a straight piece
  static constexpr float kPartPosts = 13.0F;      // [posts] length within the reach of one ceiling
  static_assert(kPartPosts / 2 + 1.5F <= Ceilings::kReach);
  // Positions along one axis [posts]: from + f (to - from) + f (1 - f) bend at the fraction f of the piece.
  struct Span {
    float from, to, bend;
  };
  template <class PositionAt>
  HWY_INLINE static Span span_of(std::size_t start, std::size_t stop, PositionAt position_at) {
    const std::size_t middle = (start + stop) / 2;
    const float from = position_at(start), to = position_at(stop);
    if (middle == start) return {from, to, 0.0F};
    const float f = static_cast<float>(middle - start) / static_cast<float>(stop - start);
    return {from, to, (position_at(middle) - from - f * (to - from)) / (f * (1.0F - f))};
  }
  // Lines of posts across one axis. `other`: axis along the lines.
  struct LinesAcross {
    Span axis, other;
    int lines_of_grid, posts_of_line;
  };
  struct Interval {
    float first, last;
  };

  // True if no position between two fractions of the piece raises the floor: as a rule, all lie in shadow.
  HWY_INLINE bool dark(float from, float to) const {
    const float* const floor = ray_.floor + start_;
    return floor[static_cast<int>(std::max(0.0F, from * steps_))] ==
           floor[static_cast<int>(std::min(steps_, to * steps_ + 1.0F))];
  }
  // True if no ground between two fractions of the piece reaches the floor.
  HWY_INLINE bool below_floor(float from, float to) const {
    const float rows = rows_.to - rows_.from, columns = columns_.to - columns_.from;
    const float posts = std::max(std::abs(rows), std::abs(columns)) * (to - from);
    const int parts = 1 + static_cast<int>(posts * (1.0F / kPartPosts));
    const float part = (to - from) / static_cast<float>(parts);
    int highest = kVoid;
    for (int i = 0; i < parts; ++i) {
      const float middle = from + (static_cast<float>(i) + 0.5F) * part;
      highest =
          std::max<int>(highest, grid_.ceilings->around(rows_.from + middle * rows, columns_.from + middle * columns));
    }
    const float near_m = from_m_ + from * piece_m_, far_m = from_m_ + to * piece_m_;
    const float floor = ray_.floor[start_ + static_cast<std::size_t>(std::max(0.0F, from * steps_))];
    // The drop of the earth's surface is that at the near end, less a thousandth for the series and rounding.
    const float up_m =
        static_cast<float>(highest) * grid_.unit_m - 0.4995F * near_m * near_m * ray_.curvature - ray_.altitude_m;
    const float out_m = up_m < 0.0F ? far_m * 1.01F : near_m * 0.99F;
    return up_m + 1.0F < floor * out_m;
  }

  // The lines strictly between the ends of the piece, where the piece is inside the cell. Empty if last < first.
  HWY_INLINE Interval lines_within(const LinesAcross& lines) const {
    float from = lines.axis.from, to = lines.axis.to;
    const float end = static_cast<float>(lines.posts_of_line - 1);
    const float drift = lines.other.to - lines.other.from;
    if (std::min(lines.other.from, lines.other.to) < 0.0F || std::max(lines.other.from, lines.other.to) > end) {
      const float south = -lines.other.from / drift, north = (end - lines.other.from) / drift;
      const float run = to - from;
      to = from + std::min(1.0F, std::max(south, north)) * run;
      from = from + std::max(0.0F, std::min(south, north)) * run;
    }
    return {std::max(std::floor(std::min(from, to)) + 1.0F, 0.0F),
            std::min(std::ceil(std::max(from, to)) - 1.0F, static_cast<float>(lines.lines_of_grid - 2))};
  }

  template <class PostsAt>
  HWY_INLINE void cross_lines(const LinesAcross& lines, const Observer& observer, Summits& summits,
                              PostsAt posts_at) const {
    const FloatLanes d;
    const Interval within = lines_within(lines);
    if (!(within.last >= within.first)) return;
    const float inverse = 1.0F / (lines.axis.to - lines.axis.from);
    const auto last_line = hn::Set(d, within.last);
    const auto last_post = hn::Set(d, static_cast<float>(lines.posts_of_line - 2));
    const auto last_step = hn::Set(d, steps_ - 1.0F);
    const auto axis_bend = hn::Set(d, lines.axis.bend * inverse), other_bend = hn::Set(d, lines.other.bend);
    const auto other_run = hn::Set(d, lines.other.to - lines.other.from);
    const auto bow = [](Floats f) { return fused::neg_mul_add(f, f, f); };  // f (1 - f)
    const auto lanes = static_cast<float>(hn::Lanes(d));
    for (float begin = within.first; begin <= within.last; begin += lanes) {
      const float begin_on = (begin - lines.axis.from) * inverse;
      const float end_on = (std::min(begin + lanes - 1.0F, within.last) - lines.axis.from) * inverse;
      const float from = std::min(begin_on, end_on), to = std::max(begin_on, end_on);
      if (dark(from, to) && below_floor(from, to)) continue;
      // The lanes after the last line repeat it.
      const auto line = hn::Min(hn::Add(hn::Set(d, begin), hn::Iota(d, 0.0F)), last_line);
      const auto straight = hn::Mul(hn::Sub(line, hn::Set(d, lines.axis.from)), hn::Set(d, inverse));
      const auto fraction = fused::neg_mul_add(bow(straight), axis_bend, straight);
      const auto along = fused::mul_add(fraction, other_run, hn::Set(d, lines.other.from));
      const auto at = fused::mul_add(bow(fraction), other_bend, along);
      const auto post = hn::Min(hn::Max(hn::Floor(at), hn::Zero(d)), last_post);
      const Posts posts = posts_at(integer(line), integer(post));
      const Height height = between(grid_, posts.near, posts.far, hn::Sub(at, post));
      const auto distance_m = fused::mul_add(fraction, hn::Set(d, piece_m_), hn::Set(d, from_m_));
      const auto step = hn::Min(hn::Max(hn::Floor(hn::Mul(fraction, hn::Set(d, steps_))), hn::Zero(d)), last_step);
      const auto floor = hn::GatherIndex(d, ray_.floor + start_ + 1, integer(step));
      const auto reaching = hn::And(reaches(observer.sight_of(distance_m, height.height_m), floor), height.known);
      summits.add(distance_m, height.height_m, reaching);
      if (summits.full()) summits.raise(observer, ray_, tangent_);
    }
  }

  const Ray& ray_;
  const sampling::Grid& grid_;
  float* tangent_;
  std::size_t start_;
  float steps_, from_m_, piece_m_;
  Span rows_{}, columns_{};
};

void raise_by_pieces(const CrossedCell& cell, const Ray& ray, std::size_t first, std::size_t end, float* tangent) {
  const auto steps_in = [&](float length_m) {
    return static_cast<std::size_t>(std::max(1.0F, length_m / ray.even_step_m));
  };
  const std::size_t min_steps = steps_in(kMinPiece_m);
  std::size_t steps = steps_in(kMaxPiece_m);
  const Observer observer(ray);
  const BlockLanes blocks(*cell.grid.posts);
  Summits summits;
  for (std::size_t start = first - 1; start + 1 < end;) {
    const std::size_t stop = std::min(start + steps, end - 1);
    const RayPiece piece(cell, ray, tangent, start, stop);
    if (!piece.straight() && stop - start > min_steps) {
      steps = std::max(min_steps, (stop - start) / 2);
      continue;
    }
    start = stop;
    if (piece.hidden()) continue;
    piece.cross_rows(observer, blocks, summits);
    piece.cross_columns(observer, blocks, summits);
  }
  summits.raise(observer, ray, tangent);
}

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
