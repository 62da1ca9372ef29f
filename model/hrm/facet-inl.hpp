// Scene triangles on the polar grid, one per vector lane: corners, planes, orientation towards the radar.
// Included once for each target (instruction set) of the library Highway.
#if defined(YARS_MODEL_HRM_FACET_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef YARS_MODEL_HRM_FACET_INL
#undef YARS_MODEL_HRM_FACET_INL
#else
#define YARS_MODEL_HRM_FACET_INL
#endif

#include <hwy/highway.h>

#include <utility>

#include "model/hrm/patch_geometry.hpp"
#include "model/hrm/scene_raster_simd.hpp"
#include "model/physics/reflectivity.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::hrm::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kStripColumns>;
using SignedTag = hn::RebindToSigned<Tag>;
using BitsTag = hn::RebindToUnsigned<Tag>;
using Floats = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

// Facing is the cosine of the angle between a normal and the direction to the radar. shading() differs from 1 only if
// the facing of a vertex differs from the facing of the facet by more than this.
constexpr float kSmooth = 0.02F;

HWY_INLINE Floats set(float value) {
  return hn::Set(Tag(), value);
}

// Corner of a triangle: fractional column and row of the polar grid, height above the map plane [m].
struct Corner {
  Floats column, row, height;
};
// By lane: a where `first` is true, else b.
HWY_INLINE Corner chosen(Mask first, const Corner& a, const Corner& b) {
  return {hn::IfThenElse(first, a.column, b.column), hn::IfThenElse(first, a.row, b.row),
          hn::IfThenElse(first, a.height, b.height)};
}
// Swaps the corners in the lanes in which b lies left of a.
HWY_INLINE void order(Corner& a, Corner& b) {
  const auto swapped = hn::Lt(b.column, a.column);
  const Corner left = chosen(swapped, b, a);
  b = chosen(swapped, a, b);
  a = left;
}

// Triangle seen from above, corners from left to right.
struct Triangle {
  Corner left, middle, right;
  // Clamps a height to the corners' heights, because rounding errors dominate the plane of a nearly vertical triangle.
  HWY_INLINE Floats within(Floats height) const {
    const auto min = hn::Min(hn::Min(left.height, middle.height), right.height);
    const auto max = hn::Max(hn::Max(left.height, middle.height), right.height);
    return hn::Min(hn::Max(height, min), max);
  }
};

// Interpolates one coordinate (row or height) along the edges of a triangle, as a function of the column.
class Edges {
 public:
  HWY_INLINE Edges(const Triangle& triangle, Floats Corner::* coordinate)
      : triangle_(triangle),
        coordinate_(coordinate),
        long_slope_(slope(triangle.left, triangle.right)),
        left_slope_(slope(triangle.left, triangle.middle)),
        right_slope_(slope(triangle.middle, triangle.right)) {}

  // Values at column x: on the edge left-right, then on the edge left-middle or middle-right, whichever crosses x.
  HWY_INLINE std::pair<Floats, Floats> at(Floats x) const {
    const auto from_left = hn::Sub(x, triangle_.left.column);
    const auto left = triangle_.left.*coordinate_;
    const auto before = hn::Lt(x, triangle_.middle.column);
    const auto from = hn::IfThenElse(before, from_left, hn::Sub(x, triangle_.middle.column));
    const auto begin = hn::IfThenElse(before, left, triangle_.middle.*coordinate_);
    return {hn::Add(left, hn::Mul(from_left, long_slope_)),
            hn::Add(begin, hn::Mul(from, hn::IfThenElse(before, left_slope_, right_slope_)))};
  }

 private:
  // Change per column. NaN or infinite for an edge of constant column, which at() does not use if x is at least the
  // left corner's column and less than the right corner's.
  HWY_INLINE Floats slope(const Corner& begin, const Corner& end) const {
    return hn::Div(hn::Sub(end.*coordinate_, begin.*coordinate_), hn::Sub(end.column, begin.column));
  }

  const Triangle& triangle_;
  Floats Corner::* coordinate_;
  Floats long_slope_, left_slope_, right_slope_;
};

// Plane and orientation of a triangle. The normal is the cross product of two edges [m^2].
struct Facet {
  Floats area;                      // twice the area seen from above [grid cells]; positive: the triangle faces up
  Floats across, ahead;             // horizontal components of the normal: to the right, away from the radar
  Floats towards;                   // component of the normal towards the radar
  Floats length;                    // length of the normal [m^2]
  Floats value, by_column, by_row;  // plane: height [m] = value + by_column * column + by_row * row
  Mask steep;                       // true for walls
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
  facet.across = hn::Mul(set(limits.row_spacing_m), right);
  facet.ahead = hn::Mul(set(limits.column_width_m), out);
  const auto upward = hn::Mul(hn::Mul(set(limits.column_width_m), set(limits.row_spacing_m)), facet.area);
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

// Factor on gamma: mean of `a`, `b`, `c`, the facings of the vertex normals, divided by the facing of the facet. It is
// clamped to [0, physics::kMaxShading]. It is 1 for a facet that faces away from the radar, and for a facet whose
// facing differs little from those of its vertices (kSmooth).
HWY_INLINE Floats shading(Floats a, Floats b, Floats c, const Facet& facet) {
  const Tag d;
  const auto facing = hn::Div(facet.towards, facet.length);
  const auto off = [&](Floats corner) HWY_ATTR { return hn::Abs(hn::Sub(corner, facing)); };
  const auto smooth =
      hn::And(hn::Gt(hn::Max(hn::Max(off(a), off(b)), off(c)), set(kSmooth)), hn::Gt(facing, hn::Zero(d)));
  const auto mean = hn::Mul(hn::Add(hn::Add(a, b), c), set(1.0F / 3.0F));
  const auto ratio =
      hn::Min(hn::Max(hn::Div(mean, facing), hn::Zero(d)), set(static_cast<float>(physics::kMaxShading)));
  return hn::IfThenElse(smooth, ratio, set(1.0F));
}

// Gamma of walls: all of it, and the part that the cardinal effect adds.
struct WallGamma {
  Floats all, facing;
};

// Gamma of walls, raised by the cardinal effect (stronger return of walls that face the radar). The effect depends on
// the horizontal angle between the normal of a wall and the line of sight. `cardinal`: effect at angle 0, relative to
// gamma.
HWY_INLINE WallGamma wall_gamma(const CardinalShape& shape, const Facet& facet, Floats gamma, Floats cardinal) {
  const Tag d;
  const SignedTag di;
  const auto level = hn::Sqrt(hn::Add(hn::Mul(facet.across, facet.across), hn::Mul(facet.ahead, facet.ahead)));
  const auto sine = hn::Div(hn::Abs(facet.across), hn::Max(level, set(1.0e-20F)));
  const auto last = set(static_cast<float>(shape.effect.size() - 2));
  const auto position = hn::Mul(sine, set(shape.steps_per_sine));
  const auto floored = hn::Floor(hn::Min(position, last));
  const auto i = hn::ConvertTo(di, floored);
  const auto low = hn::GatherIndex(d, shape.effect.data(), i);
  const auto high = hn::GatherIndex(d, shape.effect.data() + 1, i);
  const auto effect =
      hn::Add(low, hn::Mul(hn::Sub(hn::Min(position, hn::Add(last, set(1.0F))), floored), hn::Sub(high, low)));
  // Walls that face away from the radar get no cardinal effect.
  const auto faces_radar = hn::Lt(facet.ahead, hn::Zero(d));
  const auto added = hn::IfThenElseZero(faces_radar, hn::Mul(cardinal, effect));
  return {hn::Mul(gamma, hn::Add(set(1.0F), added)), hn::Mul(gamma, added)};
}

}  // namespace yars::model::hrm::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
