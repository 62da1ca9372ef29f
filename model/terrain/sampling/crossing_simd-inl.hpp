// Ground where a ray crosses lines of posts (rows or columns): heights between two posts, and elevation angles seen by
// the observer. Vectors of the library Highway, one lane per crossing. Included once per Highway target.
#if defined(YARS_MODEL_TERRAIN_SAMPLING_CROSSING_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef YARS_MODEL_TERRAIN_SAMPLING_CROSSING_SIMD_INL
#undef YARS_MODEL_TERRAIN_SAMPLING_CROSSING_SIMD_INL
#else
#define YARS_MODEL_TERRAIN_SAMPLING_CROSSING_SIMD_INL
#endif

#include <hwy/highway.h>

#include "lib/simd/fused-inl.hpp"
#include "model/terrain/sampling/crests_simd.hpp"
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
constexpr float kLoose = 1.0e-6F;  // relative rounding of a comparison with the floor, rounded up

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

// Ground in the vertical plane of the ray, relative to the observer, with the lift by refraction.
struct Sight {
  Floats out_m, up_m;
};

// Curvature of the earth, altitude of the observer, lift by refraction.
class Observer {
 public:
  HWY_INLINE explicit Observer(const Ray& ray)
      : curvature_(hn::Set(FloatLanes(), ray.curvature)),
        altitude_m_(hn::Set(FloatLanes(), ray.altitude_m)),
        level_(all(ray.lift.level)),
        per_height_(all(ray.lift.per_height)),
        per_square_(all(ray.lift.per_square)),
        per_both_(all(ray.lift.per_both)),
        max_square_m2_(all(ray.lift.max_square_m2)) {}

  // Ground at a distance and a height. angle: at the earth's centre [rad]. drop_m and chord_m: series of (1 - cos
  // angle) and sin angle, times the radius; the same as in model/rbm/sweep_simd.cpp. Lift: RayLift::at_m().
  HWY_INLINE Sight sight_of(Floats distance_m, Floats height_m) const {
    const FloatLanes d;
    const auto angle = hn::Mul(distance_m, curvature_);
    const auto square = hn::Mul(angle, angle);
    const auto fall = fused::neg_mul_add(square, hn::Set(d, 0.0416666667F), hn::Set(d, 0.5F));
    const auto drop_m = hn::Mul(hn::Mul(distance_m, angle), fall);
    const auto chord_m = fused::neg_mul_add(hn::Mul(distance_m, square), hn::Set(d, 0.166666667F), distance_m);
    const auto sine = hn::Mul(chord_m, curvature_);
    const auto cosine = fused::neg_mul_add(drop_m, curvature_, hn::Set(d, 1.0F));
    const auto out_m = fused::mul_add(height_m, sine, chord_m);
    const auto up_m = fused::mul_sub(height_m, cosine, hn::Add(drop_m, altitude_m_));
    const auto slant_m2 = fused::mul_add(out_m, out_m, hn::Mul(up_m, up_m));
    const auto far_m2 = hn::Min(slant_m2, max_square_m2_);
    const auto here = fused::mul_add(far_m2, per_square_, level_);
    const auto per_height = fused::mul_add(far_m2, per_both_, per_height_);
    return {out_m, fused::mul_add(slant_m2, fused::mul_add(height_m, per_height, here), up_m)};
  }

 private:
  static HWY_INLINE Floats all(double value) { return hn::Set(FloatLanes(), static_cast<float>(value)); }

  Floats curvature_, altitude_m_;
  Floats level_, per_height_, per_square_, per_both_, max_square_m2_;
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

}  // namespace yars::model::terrain::crests::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
