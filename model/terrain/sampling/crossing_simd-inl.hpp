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
        altitude_m_(hn::Set(FloatLanes(), ray.series.altitude_m)),
        upright_(hn::Set(FloatLanes(), ray.series.upright)),
        fall_(hn::Set(FloatLanes(), ray.series.fall)),
        fall_square_(hn::Set(FloatLanes(), ray.series.fall_square)),
        tilt_(hn::Set(FloatLanes(), ray.series.tilt)),
        tilt_square_(hn::Set(FloatLanes(), ray.series.tilt_square)) {}

  // Ground at a distance and a height. angle: at the earth's centre [rad]; SightSeries. The same as in
  // model/rbm/sweep_simd.cpp.
  HWY_INLINE Sight sight_of(Floats distance_m, Floats height_m) const {
    const FloatLanes d;
    const auto angle = hn::Mul(distance_m, curvature_);
    const auto square = hn::Mul(angle, angle);
    const auto drop_m = hn::Mul(hn::Mul(distance_m, angle), fused::mul_add(square, fall_square_, fall_));
    const auto tilt = fused::neg_mul_add(square, fused::mul_add(square, tilt_square_, tilt_), upright_);
    const auto chord_m = fused::neg_mul_add(hn::Mul(distance_m, square), hn::Set(d, 0.166666667F), distance_m);
    const auto sine = hn::Mul(chord_m, curvature_);
    return {fused::mul_add(height_m, sine, chord_m), fused::mul_sub(height_m, tilt, hn::Add(drop_m, altitude_m_))};
  }

 private:
  Floats curvature_, altitude_m_, upright_, fall_, fall_square_, tilt_, tilt_square_;
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
