#include "model/rbm/scene_simd.hpp"

#include <cstddef>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/rbm/scene_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Included after highway.h, which defines the vector target (instruction set).
#include "lib/simd/fused-inl.hpp"
#include "model/physics/polynomials-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::rbm::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace fused = yars::simd::HWY_NAMESPACE;
namespace polynomials = physics::HWY_NAMESPACE;

using SceneTag = hn::CappedTag<float, scene::kFacingSlack>;
using SceneFloats = hn::Vec<SceneTag>;
using SceneInts = hn::Vec<hn::RebindToSigned<SceneTag>>;

// Second byte of a facing's last word: Facing::wall. The first is Facing::material.
constexpr std::int32_t kWallByte = 0xff00;

// Gamma of walls with the cardinal effect. `across` and `towards`: components of the horizontal normal.
HWY_INLINE SceneFloats wall_gain(const SceneTables& tables, SceneInts code, SceneFloats across, SceneFloats towards) {
  const SceneTag d;
  const auto widths = hn::Mul(polynomials::angle(d, hn::Abs(across), towards), hn::Set(d, tables.widths_per_rad));
  // exp(-4 ln 2 x^2) = 2^(-4 x^2)
  const auto effect = polynomials::exp2(d, hn::Mul(hn::Mul(widths, widths), hn::Set(d, -4.0F)));
  return fused::mul_add(hn::GatherIndex(d, tables.cardinal, code), effect, hn::Set(d, 1.0F));
}

// Contributions of the facings of one vector.
HWY_INLINE SceneFloats facing_m2(const scene::Facing* facings, const SceneTables& tables, const SceneView& view) {
  const SceneTag d;
  const hn::RebindToSigned<SceneTag> di;
  SceneInts e, n, u, word;
  hn::LoadInterleaved4(di, reinterpret_cast<const std::int32_t*>(facings), e, n, u, word);
  const auto east_m2 = hn::BitCast(d, e), north_m2 = hn::BitCast(d, n), up_m2 = hn::BitCast(d, u);
  const auto east = hn::Set(d, view.east), north = hn::Set(d, view.north);
  const auto zero = hn::Zero(d);
  const auto towards = fused::mul_add(east_m2, east, hn::Mul(north_m2, north));
  const auto area = fused::mul_add(towards, hn::Set(d, view.cos_grazing), hn::Mul(up_m2, hn::Set(d, view.sin_grazing)));
  const auto code = hn::And(word, hn::Set(di, radar::kMaterials - 1));
  auto gamma = hn::GatherIndex(d, tables.gamma, code);
  const auto across = fused::mul_sub(north_m2, east, hn::Mul(east_m2, north));
  const auto is_wall = hn::RebindMask(d, hn::Ne(hn::And(word, hn::Set(di, kWallByte)), hn::Zero(di)));
  const auto facing =
      hn::And(hn::Gt(towards, zero), hn::Le(hn::Abs(across), hn::Mul(hn::Set(d, tables.cutoff_tangent), towards)));
  const auto cardinal = hn::And(is_wall, facing);
  if (!hn::AllFalse(d, cardinal))
    gamma = hn::IfThenElse(cardinal, hn::Mul(gamma, wall_gain(tables, code, across, towards)), gamma);
  return hn::IfThenElseZero(hn::Gt(area, zero), hn::Mul(area, gamma));
}

// The sum has kFacingSlack parts on every target, so that its rounding does not depend on the width of vectors.
float cross_section_m2(std::span<const scene::Facing> facings, const SceneTables& tables, const SceneView& view) {
  constexpr std::size_t kParts = scene::kFacingSlack;
  const SceneTag d;
  HWY_ALIGN float sum[kParts] = {};
  for (std::size_t first = 0; first < facings.size(); first += kParts)
    for (std::size_t part = 0; part < kParts && first + part < facings.size(); part += hn::Lanes(d)) {
      const std::size_t i = first + part;
      const auto counted = hn::FirstN(d, facings.size() - i);
      const auto found = hn::IfThenElseZero(counted, facing_m2(facings.data() + i, tables, view));
      hn::Store(hn::Add(hn::Load(d, sum + part), found), d, sum + part);
    }
  for (std::size_t width = kParts / 2; width > 0; width /= 2)
    for (std::size_t part = 0; part < width; ++part) sum[part] += sum[part + width];
  return sum[0];
}

}  // namespace yars::model::rbm::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::rbm::simd {

static_assert(sizeof(scene::Facing) == 16 && offsetof(scene::Facing, material) == 12 &&
              offsetof(scene::Facing, wall) == 13);
static_assert(radar::kMaterials == 32);

SceneTables::SceneTables(const physics::SceneSurface& surface)
    : cutoff_tangent(static_cast<float>(surface.cutoff_tangent())),
      widths_per_rad(static_cast<float>(1.0 / (surface.street_width_deg() * geo::kRadiansPerDegree))) {
  for (std::size_t code = 0; code < radar::kMaterials; ++code) {
    gamma[code] = static_cast<float>(surface.gamma(code));
    cardinal[code] = static_cast<float>(surface.cardinal(code));
  }
}

HWY_EXPORT(cross_section_m2);

float cross_section_m2(std::span<const scene::Facing> facings, const SceneTables& tables, const SceneView& view) {
  return HWY_DYNAMIC_DISPATCH(cross_section_m2)(facings, tables, view);
}

}  // namespace yars::model::rbm::simd
#endif  // HWY_ONCE
