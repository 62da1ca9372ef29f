#include "model/hrm/profile_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/hrm/profile_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kStripColumns>;
using SignedTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

// Where a wall stands, a step steeper than this is its face; less is ground that has buried it.
constexpr float kLeastStep = 0.2F;
// A piece seen end on still covers this share of a row: nothing is divided by zero.
constexpr float kLeastExtent = 1.0e-3F;

// A point of the profile.
struct Point {
  Floats height;  // above the map plane
  Floats up;      // against the aircraft
  Floats tangent;
  Floats row;  // where it appears
  Floats gain;
};

HWY_INLINE Point point_at(const Strip& strip, int row, std::size_t lane) {
  const Tag d;
  const auto at = static_cast<std::size_t>(row) * kStripColumns + lane;
  const auto distance = hn::Set(d, strip.distance_m[row]);
  const auto above = hn::Set(d, strip.above_m[row]);
  Point point;
  point.height = hn::Load(d, strip.height_m + at);
  point.up = hn::Sub(point.height, above);
  point.tangent = hn::Div(point.up, distance);
  point.gain = hn::Abs(hn::Load(d, strip.gain + at));
  point.row = hn::Set(d, static_cast<float>(row));
  if (strip.layover) {
    const auto level = hn::Set(d, strip.level_m[row]);
    const auto shift = hn::Mul(point.height, hn::Sub(point.height, hn::Add(level, level)));
    const auto square = hn::Add(hn::Mul(distance, distance), shift);
    const auto seen_at = hn::Sqrt(hn::Max(square, hn::Zero(d)));
    point.row = hn::Div(hn::Sub(seen_at, hn::Set(d, strip.first_distance_m)), hn::Set(d, strip.spacing_m));
  }
  return point;
}

// Adds power spread evenly from one row to another (row k reaches from k - 1/2 to k + 1/2). What falls off is lost.
HWY_INLINE void spread(const Strip& strip, std::size_t lane, Mask wanted, Floats power, Floats from, Floats to) {
  const Tag d;
  const SignedTag di;
  const auto half = hn::Set(d, 0.5F);
  const auto low = hn::Min(from, to);
  const auto extent = hn::Max(hn::Sub(hn::Max(from, to), low), hn::Set(d, kLeastExtent));
  const auto high = hn::Add(low, extent);
  const auto density = hn::Div(power, extent);
  const auto most = hn::Set(d, static_cast<float>(strip.rows - 1));
  auto row = hn::Max(hn::Floor(hn::Add(low, half)), hn::Zero(d));
  const auto last = hn::Min(hn::Floor(hn::Add(high, half)), most);
  auto active = hn::And(wanted, hn::Le(row, last));
  const auto lanes = hn::Add(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(lane)));
  while (!hn::AllFalse(d, active)) {
    const auto covered = hn::Sub(hn::Min(high, hn::Add(row, half)), hn::Max(low, hn::Sub(row, half)));
    const auto share = hn::IfThenElseZero(active, hn::Mul(density, hn::Max(covered, hn::Zero(d))));
    // Each lane writes to its own column alone; one at rest adds nothing to row 0, which every strip has.
    const auto index = hn::Add(hn::ShiftLeft<4>(hn::ConvertTo(di, hn::IfThenElseZero(active, row))), lanes);
    hn::ScatterIndex(hn::Add(hn::GatherIndex(d, strip.power, index), share), d, strip.power, index);
    row = hn::Add(row, hn::Set(d, 1.0F));
    active = hn::And(active, hn::Le(row, last));
  }
}

HWY_INLINE void cast_piece(const Strip& strip, int row, std::size_t lane, const Point& near, const Point& far,
                           Floats horizon) {
  const Tag d;
  const auto one = hn::Set(d, 1.0F);
  const auto half = hn::Set(d, 0.5F);
  const auto seen = hn::Gt(far.tangent, horizon);
  const auto at = static_cast<std::size_t>(row) * kStripColumns + lane;
  if (hn::AllFalse(d, seen)) return;
  // The horizon is never below the nearer end: where it is not above, all of the piece is seen.
  const auto whole = hn::And(seen, hn::Ge(near.tangent, horizon));
  const auto rise = hn::Max(hn::Sub(far.tangent, near.tangent), hn::Set(d, 1.0e-20F));
  const auto part = hn::Min(hn::Div(hn::Sub(far.tangent, horizon), rise), one);
  const auto share = hn::IfThenElseZero(seen, hn::IfThenElse(whole, one, part));

  const float step = strip.distance_m[row] - strip.distance_m[row - 1];
  const auto distance = hn::Set(d, 0.5F * (strip.distance_m[row] + strip.distance_m[row - 1]));
  const auto up = hn::Mul(half, hn::Add(near.up, far.up));
  const auto climb = hn::Sub(far.up, near.up);
  const auto across = hn::Sub(hn::Mul(distance, climb), hn::Mul(up, hn::Set(d, step)));
  const auto slant = hn::Sqrt(hn::Add(hn::Mul(distance, distance), hn::Mul(up, up)));
  const auto width = hn::Mul(hn::Mul(hn::Load(d, strip.arc + lane), distance), share);
  const auto area = hn::Mul(width, hn::Div(hn::Max(across, hn::Zero(d)), slant));

  const auto wall_gain = hn::Load(d, strip.wall_gain + at);
  const auto wall = hn::And(hn::Gt(wall_gain, hn::Zero(d)), hn::Gt(climb, hn::Set(d, kLeastStep * step)));
  const auto halves = hn::AndNot(wall, whole);
  const auto middle = hn::Mul(half, hn::Add(near.row, far.row));
  const auto begin = hn::Sub(far.row, hn::Mul(share, hn::Sub(far.row, near.row)));
  // Ground belongs to the nearer of two rows: half of a piece each.
  const auto half_area = hn::Mul(half, area);
  spread(strip, lane, halves, hn::Mul(half_area, near.gain), near.row, middle);
  // A wall is its climb alone; what is level of the piece is the ground before it.
  const auto face = hn::Mul(width, hn::Div(hn::Mul(distance, climb), slant));
  const auto built = hn::Add(hn::Mul(face, wall_gain), hn::Mul(hn::Max(hn::Sub(area, face), hn::Zero(d)), near.gain));
  const auto open = hn::Mul(hn::IfThenElse(halves, half_area, area), far.gain);
  spread(strip, lane, seen, hn::IfThenElse(wall, built, open), hn::IfThenElse(halves, middle, begin), far.row);
  if (strip.double_bounce > 0.0F) {
    // From wall to ground and from ground to wall: every such path is as long as to the foot.
    const auto bounce = hn::Mul(hn::Mul(face, wall_gain), hn::Set(d, strip.double_bounce));
    const auto foot = hn::And(wall, whole);
    if (!hn::AllFalse(d, foot)) spread(strip, lane, foot, bounce, near.row, near.row);
  }
}

void cast_profile(const Strip& strip) {
  const Tag d;
  for (std::size_t lane = 0; lane < kStripColumns; lane += hn::Lanes(d)) {
    Point near = point_at(strip, 0, lane);
    auto horizon = hn::Max(hn::Load(d, strip.horizon + lane), near.tangent);
    for (int row = 1; row < strip.rows; ++row) {
      const Point far = point_at(strip, row, lane);
      cast_piece(strip, row, lane, near, far, horizon);
      horizon = hn::Max(horizon, far.tangent);
      near = far;
    }
  }
}

}  // namespace yars::model::hrm::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::hrm::lanes {

HWY_EXPORT(cast_profile);

void cast_profile(const Strip& strip) {
  HWY_DYNAMIC_DISPATCH(cast_profile)(strip);
}

}  // namespace yars::model::hrm::lanes
#endif  // HWY_ONCE
