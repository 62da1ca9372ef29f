#include "model/hrm/profile_simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/profile_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kStripColumns>;
using SignedTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

// Minimum climb of a piece (the profile between two rows) with a wall, as a fraction of the row spacing. With a smaller
// climb the heights do not show the wall, and the wall is ignored.
constexpr float kMinStep = 0.2F;
// [rows] minimum apparent extent of a piece. Prevents a division by zero for a piece at constant slant range.
constexpr float kMinExtent = 1.0e-3F;
// [rows] shorter intervals are added row by row, longer ones by gather and scatter (vector access with one address per
// lane). Affects only speed.
constexpr int kMaxRows = 8;

// Points of the profiles at one row, one column per lane.
struct Point {
  Floats height_m;  // above the map plane
  Floats up_m;      // height above the aircraft's horizontal plane, negative below it
  Floats tangent;   // of the elevation angle against that plane
  Floats gamma;
  Floats row;  // apparent row, set by with_image_row()
};

HWY_INLINE Point point_at(const Strip& strip, int row, std::size_t lane) {
  const Tag d;
  const auto at = static_cast<std::size_t>(row) * kStripColumns + lane;
  Point point;
  Floats gamma;
  hn::LoadInterleaved2(d, &strip.surface[at].gamma, gamma, point.height_m);
  point.up_m = hn::Sub(point.height_m, hn::Set(d, strip.above_plane_m[row]));
  point.tangent = hn::Mul(point.up_m, hn::Set(d, strip.inverse_m[row]));
  point.gamma = hn::Abs(gamma);
  return point;
}

// Raises a point to the line of sight over the crest before it, if that line is higher. The near side of the crest is
// visible and returns at the point's row.
HWY_INLINE Point raised_to_crest(const Strip& strip, int row, std::size_t lane, Point point) {
  if (strip.crest_m == nullptr) return point;
  const Tag d;
  const auto crest = hn::Load(d, strip.crest_m + static_cast<std::size_t>(row) * kStripColumns + lane);
  point.up_m = hn::Max(point.up_m, hn::Sub(crest, hn::Set(d, strip.above_plane_m[row])));
  point.tangent = hn::Mul(point.up_m, hn::Set(d, strip.inverse_m[row]));
  return point;
}

// Sets the apparent row of a point: the row of the map plane at the point's slant range.
HWY_INLINE Point with_image_row(const Strip& strip, int row, Point point) {
  const Tag d;
  point.row = hn::Set(d, static_cast<float>(row));
  if (!strip.layover) return point;
  const auto distance_m = hn::Set(d, strip.distance_m[row]);
  const auto level_m = hn::Set(d, strip.above_level_m[row]);
  const auto shift = hn::Mul(point.height_m, hn::Sub(point.height_m, hn::Add(level_m, level_m)));
  const auto square = hn::Add(hn::Mul(distance_m, distance_m), shift);
  const auto seen_at = hn::Sqrt(hn::Max(square, hn::Zero(d)));
  point.row = hn::Mul(hn::Sub(seen_at, hn::Set(d, strip.first_distance_m)), hn::Set(d, 1.0F / strip.spacing_m));
  return point;
}

// Power spread evenly over an interval of rows. Row k extends from k - 1/2 to k + 1/2. Power outside the strip is lost.
struct RowInterval {
  Floats low, high;
  Floats density;  // power per row; 0: none
  int source;      // row of the surface point that returns it, for labels
};

HWY_INLINE Floats power_in_row(const RowInterval& interval, Floats row) {
  const Tag d;
  const auto half = hn::Set(d, 0.5F);
  const auto covered = hn::Sub(hn::Min(interval.high, hn::Add(row, half)), hn::Max(interval.low, hn::Sub(row, half)));
  return hn::Mul(interval.density, hn::Max(covered, hn::Zero(d)));
}

// Updates the labels of 16 cells, or of as many as a vector has lanes, with the power of an interval in their row.
// `cell`: entry of the first cell. `row_power` is 0 in lanes without the interval.
HWY_INLINE void label_row(const Strip& strip, std::size_t cell, const RowInterval& interval, Floats row,
                          Floats row_power) {
  const Tag d;
  const SignedTag di;
  const auto before = hn::Load(d, strip.strength + cell);
  const auto stronger = hn::Gt(row_power, before);
  hn::Store(hn::Max(row_power, before), d, strip.strength + cell);
  hn::BlendedStore(hn::Set(di, interval.source), hn::RebindMask(di, stronger), di, strip.shown_row + cell);
  const auto here =
      hn::And(hn::Gt(interval.density, hn::Zero(d)), hn::And(hn::Le(interval.low, row), hn::Lt(row, interval.high)));
  const auto count = hn::Load(di, strip.layers + cell);
  hn::Store(hn::Sub(count, hn::VecFromMask(di, hn::RebindMask(di, here))), di, strip.layers + cell);
}

// The same for cells of different rows: `index` has the entry of each lane's cell. Lanes without power have index 0.
HWY_INLINE void label_cells(const Strip& strip, hn::Vec<SignedTag> index, const RowInterval& interval, Floats row,
                            Floats row_power) {
  const Tag d;
  const SignedTag di;
  const auto before = hn::GatherIndex(d, strip.strength, index);
  const auto stronger = hn::RebindMask(di, hn::Gt(row_power, before));
  hn::ScatterIndex(hn::Max(row_power, before), d, strip.strength, index);
  const auto shown = hn::GatherIndex(di, strip.shown_row, index);
  hn::ScatterIndex(hn::IfThenElse(stronger, hn::Set(di, interval.source), shown), di, strip.shown_row, index);
  const auto here =
      hn::And(hn::Gt(row_power, hn::Zero(d)), hn::And(hn::Le(interval.low, row), hn::Lt(row, interval.high)));
  const auto count = hn::GatherIndex(di, strip.layers, index);
  hn::ScatterIndex(hn::Sub(count, hn::VecFromMask(di, hn::RebindMask(di, here))), di, strip.layers, index);
}

// Adds an interval to strip.power by gather and scatter. Each lane writes to its own column. An inactive lane adds 0 to
// row 0.
template <bool kLabels>
HWY_INLINE void add_by_lane(const Strip& strip, std::size_t lane, const RowInterval& interval) {
  const Tag d;
  const SignedTag di;
  const auto half = hn::Set(d, 0.5F);
  const auto last_row = hn::Set(d, static_cast<float>(strip.rows - 1));
  auto row = hn::Max(hn::Floor(hn::Add(interval.low, half)), hn::Zero(d));
  const auto last = hn::Min(hn::Floor(hn::Add(interval.high, half)), last_row);
  auto active = hn::And(hn::Gt(interval.density, hn::Zero(d)), hn::Le(row, last));
  const auto lanes = hn::Add(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(lane)));
  while (!hn::AllFalse(d, active)) {
    const auto row_power = hn::IfThenElseZero(active, power_in_row(interval, row));
    const auto index = hn::Add(hn::ShiftLeft<4>(hn::ConvertTo(di, hn::IfThenElseZero(active, row))), lanes);
    hn::ScatterIndex(hn::Add(hn::GatherIndex(d, strip.power, index), row_power), d, strip.power, index);
    if constexpr (kLabels) label_cells(strip, index, interval, row, row_power);
    row = hn::Add(row, hn::Set(d, 1.0F));
    active = hn::And(active, hn::Le(row, last));
  }
}

// Adds two intervals to strip.power. `wanted`: lanes whose intervals have power. Neighbouring columns are similar, so
// the intervals of all lanes together usually cover few rows.
template <bool kLabels>
HWY_INLINE void add(const Strip& strip, std::size_t lane, Mask wanted, const RowInterval& first,
                    const RowInterval& second) {
  const Tag d;
  const auto half = hn::Set(d, 0.5F);
  const auto last_row = hn::Set(d, static_cast<float>(strip.rows - 1));
  const auto nowhere = hn::Set(d, static_cast<float>(strip.rows));
  const auto low = hn::IfThenElse(wanted, hn::Min(first.low, second.low), nowhere);
  const auto high = hn::IfThenElse(wanted, hn::Max(first.high, second.high), hn::Neg(nowhere));
  const auto begin = hn::Max(hn::Floor(hn::Add(hn::MinOfLanes(d, low), half)), hn::Zero(d));
  const auto end = hn::Min(hn::Floor(hn::Add(hn::MaxOfLanes(d, high), half)), last_row);
  const float rows = hn::GetLane(hn::Sub(end, begin));
  if (rows >= static_cast<float>(kMaxRows)) {
    add_by_lane<kLabels>(strip, lane, first);
    add_by_lane<kLabels>(strip, lane, second);
    return;
  }
  auto row = begin;
  float* power = strip.power + static_cast<std::size_t>(hn::GetLane(begin)) * kStripColumns + lane;
  const int count = rows >= 0.0F ? static_cast<int>(rows) + 1 : 0;
  for (int i = 0; i < count; ++i) {
    const auto first_power = power_in_row(first, row);
    const auto second_power = power_in_row(second, row);
    hn::Store(hn::Add(hn::Add(hn::Load(d, power), first_power), second_power), d, power);
    if constexpr (kLabels) {
      const auto cell = static_cast<std::size_t>(power - strip.power);
      label_row(strip, cell, first, row, first_power);
      label_row(strip, cell, second, row, second_power);
    }
    row = hn::Add(row, hn::Set(d, 1.0F));
    power += kStripColumns;
  }
}

// Walls between two points of the profile.
struct Walls {
  Mask present;
  Floats fraction;  // fraction of the climb between the points that is wall
  Floats gamma;
  Floats facing_gamma;  // the part of gamma that the cardinal effect adds
};

HWY_INLINE Walls walls_at(const Strip& strip, std::size_t at, Floats climb_m, float step_m) {
  const Tag d;
  const SignedTag di;
  const auto one = hn::Set(d, 1.0F);
  if (strip.walls == nullptr) return {hn::Lt(one, one), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  const hn::RebindToUnsigned<Tag> db;
  hn::Vec<decltype(db)> steps_returned, steps_high, steps_facing;
  hn::LoadInterleaved3(db, &strip.walls[at].returned_steps, steps_returned, steps_high, steps_facing);
  const auto height = hn::ConvertTo(d, hn::BitCast(di, steps_high));
  const auto present = hn::And(hn::Gt(height, hn::Zero(d)), hn::Gt(climb_m, hn::Set(d, kMinStep * step_m)));
  if (hn::AllFalse(d, present)) return {present, hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  const auto sum = hn::ConvertTo(d, hn::BitCast(di, steps_returned));
  const auto facing = hn::ConvertTo(d, hn::BitCast(di, steps_facing));
  const auto wall_steps = hn::IfThenElse(present, height, one);
  const auto fraction =
      hn::Min(hn::Div(hn::Mul(wall_steps, hn::Set(d, kWallStep_m)), hn::IfThenElse(present, climb_m, one)), one);
  return {present, fraction, hn::Div(sum, wall_steps), hn::Div(facing, wall_steps)};
}

HWY_INLINE Floats gas_transmission(const GasRow& gas, Floats height_m) {
  const Tag d;
  const auto within = hn::Min(hn::Max(height_m, hn::Set(d, gas.lowest_m)), hn::Set(d, gas.highest_m));
  const auto slope = hn::Add(hn::Set(d, gas.slope), hn::Mul(within, hn::Set(d, gas.bend)));
  return hn::Add(hn::Set(d, gas.constant), hn::Mul(within, slope));
}

// Adds the power of the visible part of the piece from `near` to `far`. `row`: row of `far`. `horizon`: greatest
// tangent up to `near`. `seen`: lanes in which `far` is above the horizon.
template <bool kLabels>
HWY_INLINE void cast_piece(const Strip& strip, int row, std::size_t lane, const Point& near, const Point& far,
                           Mask seen, Floats horizon) {
  const Tag d;
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0F);
  const auto half = hn::Set(d, 0.5F);
  // The horizon is at least near.tangent. If both are equal, the whole piece is visible.
  const auto fully_visible = hn::And(seen, hn::Ge(near.tangent, horizon));
  auto visible = hn::IfThenElseZero(seen, one);
  if (!hn::AllTrue(d, hn::Or(fully_visible, hn::Not(seen)))) {
    const auto rise = hn::Max(hn::Sub(far.tangent, near.tangent), hn::Set(d, 1.0e-20F));
    const auto part = hn::Min(hn::Div(hn::Sub(far.tangent, horizon), rise), one);
    visible = hn::IfThenElseZero(seen, hn::IfThenElse(fully_visible, one, part));
  }

  const float step_m = strip.distance_m[row] - strip.distance_m[row - 1];
  const auto distance_m = hn::Set(d, 0.5F * (strip.distance_m[row] + strip.distance_m[row - 1]));
  const auto up_m = hn::Mul(half, hn::Add(near.up_m, far.up_m));
  const auto climb_m = hn::Sub(far.up_m, near.up_m);
  const auto across = hn::Sub(hn::Mul(distance_m, climb_m), hn::Mul(up_m, hn::Set(d, step_m)));
  const auto slant_m = hn::Sqrt(hn::Add(hn::Mul(distance_m, distance_m), hn::Mul(up_m, up_m)));
  auto width = hn::Div(hn::Mul(hn::Mul(hn::Load(d, strip.arc + lane), distance_m), visible), slant_m);
  if (strip.gas != nullptr) width = hn::Mul(width, gas_transmission(strip.gas[row], far.height_m));
  const auto area_m2 = hn::Mul(width, hn::Max(across, zero));

  const Walls walls = walls_at(strip, static_cast<std::size_t>(row) * kStripColumns + lane, climb_m, step_m);
  const auto halves = hn::AndNot(walls.present, fully_visible);
  const auto middle = hn::Mul(half, hn::Add(near.row, far.row));
  const auto begin = hn::Sub(far.row, hn::Mul(visible, hn::Sub(far.row, near.row)));
  // A wall accounts for its fraction of the climb. The rest of the piece returns like the ground before the wall.
  const auto face = hn::Mul(hn::Mul(width, hn::Mul(distance_m, climb_m)), walls.fraction);
  const auto built = hn::Add(hn::Mul(face, walls.gamma), hn::Mul(hn::Max(hn::Sub(area_m2, face), zero), near.gamma));
  // On ground without walls, each half of a fully visible piece has the gamma of its end. If a piece is only partly
  // visible, its visible part has far.gamma.
  const auto half_area_m2 = hn::Mul(half, area_m2);
  const auto open = hn::Mul(hn::IfThenElse(halves, half_area_m2, area_m2), far.gamma);
  // A wall belongs to the farther point, one row beyond the nearer point. Its foot has the nearer point's height and
  // thus appears at the nearer point's row plus 1.
  const auto foot_row = hn::IfThenElse(hn::And(walls.present, fully_visible), hn::Add(begin, one), begin);
  const auto start = hn::IfThenElse(halves, middle, foot_row);
  const auto extent = hn::Max(hn::Abs(hn::Sub(far.row, start)), hn::Set(d, kMinExtent));
  const auto rows_inverse = hn::Div(one, extent);
  RowInterval first, second;
  first.source = row - 1;
  second.source = row;
  first.low = hn::Min(near.row, middle);
  first.high = hn::Add(first.low, extent);
  first.density = hn::IfThenElseZero(halves, hn::Mul(hn::Mul(half_area_m2, near.gamma), rows_inverse));
  second.low = hn::Min(start, far.row);
  second.high = hn::Add(second.low, extent);
  second.density = hn::IfThenElseZero(seen, hn::Mul(hn::IfThenElse(walls.present, built, open), rows_inverse));
  add<kLabels>(strip, lane, seen, first, second);

  if (!(strip.double_bounce > 0.0F)) return;
  const auto foot = hn::And(walls.present, fully_visible);
  if (hn::AllFalse(d, foot)) return;
  // The double bounce path over wall and ground is as long as the path to the wall's foot and back. It has the aspect
  // of the cardinal effect.
  const auto bounce = hn::Mul(hn::Mul(face, walls.facing_gamma), hn::Set(d, strip.double_bounce / kMinExtent));
  add_by_lane<false>(strip, lane,
                     {foot_row, hn::Add(foot_row, hn::Set(d, kMinExtent)), hn::IfThenElseZero(foot, bounce), row});
}

// Sets the walls of a row to zero for the next map. Rows without walls, the majority, are not written, which saves
// memory bandwidth.
HWY_INLINE void clear_walls(const Strip& strip, int row, std::size_t lane) {
  if (strip.walls == nullptr) return;
  const hn::RebindToUnsigned<Tag> db;
  const auto at = static_cast<std::size_t>(row) * kStripColumns + lane;
  std::uint32_t* const first = &strip.walls[at].returned_steps;
  std::uint32_t* const second = first + hn::Lanes(db);
  std::uint32_t* const third = second + hn::Lanes(db);
  const auto any = hn::Or(hn::Or(hn::Load(db, first), hn::Load(db, second)), hn::Load(db, third));
  if (hn::AllTrue(db, hn::Eq(any, hn::Zero(db)))) return;
  hn::Store(hn::Zero(db), db, first);
  hn::Store(hn::Zero(db), db, second);
  hn::Store(hn::Zero(db), db, third);
}

template <bool kLabels>
HWY_INLINE void cast_columns(const Strip& strip) {
  const Tag d;
  for (std::size_t lane = 0; lane < kStripColumns; lane += hn::Lanes(d)) {
    Point near = point_at(strip, 0, lane);
    auto horizon = hn::Max(hn::Load(d, strip.horizon + lane), near.tangent);
    bool near_has_row = false;
    clear_walls(strip, 0, lane);
    for (int row = 1; row < strip.rows; ++row) {
      Point far = point_at(strip, row, lane);
      Point top = raised_to_crest(strip, row, lane, far);
      const auto seen = hn::Gt(top.tangent, horizon);
      const bool any = !hn::AllFalse(d, seen);
      if (any) {
        if (!near_has_row) near = with_image_row(strip, row - 1, near);
        far = with_image_row(strip, row, far);
        top.row = far.row;
        cast_piece<kLabels>(strip, row, lane, near, top, seen, horizon);
      }
      clear_walls(strip, row, lane);
      near_has_row = any;
      horizon = hn::Max(horizon, top.tangent);
      near = far;
    }
  }
}

void cast_profile(const Strip& given) {
  const Strip strip = given;  // a copy, so that the compiler knows that stores of power do not change it
  if (strip.strength == nullptr)
    cast_columns<false>(strip);
  else
    cast_columns<true>(strip);
}

}  // namespace yars::model::hrm::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::simd {

HWY_EXPORT(cast_profile);

void cast_profile(const Strip& strip) {
  HWY_DYNAMIC_DISPATCH(cast_profile)(strip);
}

}  // namespace yars::model::hrm::simd
#endif  // HWY_ONCE
