// Crests of a ray with evenly spaced positions (crests_simd.hpp). The ray is divided into pieces of up to 40 km. The
// lines of posts that a piece crosses are examined in their order, a vector of lines at a time.
// Inputs: positions of a ray [deg], their distances [m] and floors [tangents]; one grid of a cell.
// Outputs: raised tangents of the steps. Ground below Ray::floor is left out.
// Accuracy: crossings within 0.5 m of the ray. Every vector width gives the same bits.
// Included once per Highway target.
#if defined(YARS_MODEL_TERRAIN_SAMPLING_RAY_PIECE_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef YARS_MODEL_TERRAIN_SAMPLING_RAY_PIECE_SIMD_INL
#undef YARS_MODEL_TERRAIN_SAMPLING_RAY_PIECE_SIMD_INL
#else
#define YARS_MODEL_TERRAIN_SAMPLING_RAY_PIECE_SIMD_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "model/terrain/sampling/crossing_simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::terrain::crests::HWY_NAMESPACE {

constexpr float kMaxPiece_m = 40000.0F;  // [m] maximum length of a RayPiece: 0.2 m off the ray
constexpr float kMinPiece_m = 3000.0F;   // [m] length of a piece that is used even if it is not straight: 0.4 m off

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
    // The drop of the earth's surface is that at the near end, less a thousandth for the series and rounding. The lift
    // of the highest ground is the greatest height: a lower point is lifted more, but by less than it is lower.
    const float height_m = static_cast<float>(highest) * grid_.unit_m;
    const float fall = ray_.least_fall - ray_.lift_per_height * height_m - ray_.lift_per_square * far_m * far_m;
    const float up_m = height_m * ray_.series.upright - near_m * near_m * fall - ray_.series.altitude_m;
    const float out_m = up_m < 0.0F ? far_m * 1.01F : near_m * 0.99F;
    return up_m + 1.0F < floor * out_m;
  }

  // The lines strictly between the ends of the piece, where the piece is inside the cell. Empty if last < first.
  HWY_INLINE Interval lines_within(const LinesAcross& lines) const {
    float from = lines.axis.from, to = lines.axis.to;
    const float end = static_cast<float>(lines.posts_of_line - 1);
    const float drift = lines.other.to - lines.other.from;
    if (std::min(lines.other.from, lines.other.to) < 0.0F || std::max(lines.other.from, lines.other.to) > end) {
      const float at_first = -lines.other.from / drift, at_last = (end - lines.other.from) / drift;
      const float run = to - from;
      to = from + std::min(1.0F, std::max(at_first, at_last)) * run;
      from = from + std::max(0.0F, std::min(at_first, at_last)) * run;
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

}  // namespace yars::model::terrain::crests::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
