#include "model/rbm/ground_lanes.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/rbm/ground_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind highway.h, or it would have no target yet.
#include "model/rbm/ground_lanes-inl.hpp"
#include "model/rbm/polynomials-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::rbm::lanes::HWY_NAMESPACE {

namespace polynomials = rbm::HWY_NAMESPACE;

void reflect(std::size_t count, const GroundInputs& ground, const float* sin_grazing, float* land, float* sea) {
  const GroundTag d;
  GroundLanes known(ground);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto sine = hn::LoadU(d, sin_grazing + i);
    const GroundReturn found = ground_return(ground, known, i, sine, [&] { return sine; });
    hn::StoreU(found.land, d, land + i);
    hn::StoreU(found.sea, d, sea + i);
  }
}

bool any_positive(std::size_t count, const float* values) {
  const GroundTag d;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d))
    if (!hn::AllFalse(d, hn::Gt(hn::LoadU(d, values + i), hn::Zero(d)))) return true;
  return std::any_of(values + i, values + count, [](float value) { return value > 0.0F; });
}

std::size_t next_in(std::size_t count, std::uint32_t codes, const std::int32_t* material, std::size_t from) {
  const GroundTag d;
  const hn::RebindToSigned<GroundTag> di;
  for (std::size_t i = from; i < count; i += hn::Lanes(d)) {
    const auto inside = in_set(codes, hn::LoadU(di, material + i));
    if (hn::AllFalse(d, inside)) continue;
    return std::min(count, i + static_cast<std::size_t>(hn::FindFirstTrue(d, inside)));
  }
  return count;
}

void fill_sigma0(const reflectivity::SeaTable& table, float cosine, float* sigma0) {
  const GroundTag d;
  // The last entry stands alone behind whole vectors: sixteen divide the others.
  constexpr std::size_t kEntries = reflectivity::SeaTable::kPieces;
  static_assert(kEntries % terrain::kRunSlack == 0);
  const auto octaves_at = [&](std::size_t i) {
    return hn::Add(hn::LoadU(d, table.across.data() + i),
                   hn::Mul(hn::Set(d, cosine), hn::LoadU(d, table.upwind.data() + i)));
  };
  for (std::size_t i = 0; i < kEntries; i += hn::Lanes(d))
    hn::StoreU(polynomials::exp2(d, octaves_at(i)), d, sigma0 + i);
  const float last = table.across[kEntries] + cosine * table.upwind[kEntries];
  hn::StoreU(polynomials::exp2(d, hn::Set(d, last)), d, sigma0 + kEntries);
}

}  // namespace yars::model::rbm::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::rbm::lanes {

HWY_EXPORT(reflect);
HWY_EXPORT(any_positive);
HWY_EXPORT(next_in);
HWY_EXPORT(fill_sigma0);

void reflect(std::size_t count, const GroundInputs& ground, const float* sin_grazing, float* land, float* sea) {
  HWY_DYNAMIC_DISPATCH(reflect)(count, ground, sin_grazing, land, sea);
}
bool any_positive(std::size_t count, const float* values) {
  return HWY_DYNAMIC_DISPATCH(any_positive)(count, values);
}
std::size_t next_in(std::size_t count, std::uint32_t codes, const std::int32_t* material, std::size_t from) {
  return HWY_DYNAMIC_DISPATCH(next_in)(count, codes, material, from);
}
void fill_sigma0(const reflectivity::SeaTable& table, float cosine, float* sigma0) {
  HWY_DYNAMIC_DISPATCH(fill_sigma0)(table, cosine, sigma0);
}

TextureDegree texture_degree(const GroundInputs& ground, float cells_north, float cells_east) {
  const terrain::CellPlace corner = ground.places.corner;
  const double north_deg = std::clamp(corner.south_deg + 90.0 + static_cast<double>(cells_north), 0.0, 180.0);
  const double turns = (corner.west_deg + static_cast<double>(cells_east)) / 360.0 + 0.5;
  const auto band = static_cast<std::size_t>(std::min(north_deg, 179.0));
  const double round = ground.grid->columns[band];
  const double row = north_deg * ground.grid->rows_per_degree;
  const double column = (turns - std::floor(turns)) * round;
  return {static_cast<std::int32_t>(row),
          static_cast<std::int32_t>(column),
          static_cast<float>(row - std::floor(row)),
          static_cast<float>(column - std::floor(column)),
          static_cast<float>(ground.grid->rows_per_degree),
          static_cast<float>(round / 360.0)};
}

}  // namespace yars::model::rbm::lanes
#endif  // HWY_ONCE
