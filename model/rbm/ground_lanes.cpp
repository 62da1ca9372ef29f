#include "model/rbm/ground_lanes.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/rbm/ground_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind highway.h, or it would have no target yet.
#include "model/rbm/polynomials-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::rbm::lanes::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace polynomials = rbm::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, terrain::kRunSlack>;
using WholeTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;

bool any_positive(std::size_t count, const float* values) {
  const Tag d;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d))
    if (!hn::AllFalse(d, hn::Gt(hn::LoadU(d, values + i), hn::Zero(d)))) return true;
  return std::any_of(values + i, values + count, [](float value) { return value > 0.0F; });
}

void fill_sigma0(const reflectivity::SeaTable& table, float cosine, float* sigma0) {
  const Tag d;
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

// mixed() of ground_grid.cpp.
template <class V>
HWY_INLINE V mixed(V x) {
  const hn::DFromV<V> d;
  x = hn::Xor(x, hn::ShiftRight<16>(x));
  x = hn::Mul(x, hn::Set(d, 0x7feb352dU));
  x = hn::Xor(x, hn::ShiftRight<15>(x));
  x = hn::Mul(x, hn::Set(d, 0x846ca68bU));
  return hn::Xor(x, hn::ShiftRight<16>(x));
}

using DoubleTag = hn::CappedTag<double, terrain::kRunSlack / 2>;

// Columns round the earth of the row that each place lies in: by its whole degree, mostly one for the whole vector.
HWY_INLINE hn::Vec<DoubleTag> columns_of(const reflectivity::GroundGrid& grid, const terrain::PlaceRun& places,
                                         std::size_t i) {
  const DoubleTag d;
  const hn::Rebind<float, DoubleTag> df;
  const auto band_of = [&](float cells_north) {
    return static_cast<std::size_t>(std::clamp(places.corner.south_deg + 90 + static_cast<int>(cells_north), 0, 179));
  };
  const float* const cells_north = places.cells_north.data() + i;
  if (hn::AllTrue(df, hn::Eq(hn::LoadU(df, cells_north), hn::Set(df, cells_north[0]))))
    return hn::Set(d, grid.columns[band_of(cells_north[0])]);
  HWY_ALIGN double columns[terrain::kRunSlack];
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) columns[lane] = grid.columns[band_of(cells_north[lane])];
  return hn::Load(d, columns);
}

void texture_levels(std::size_t count, const reflectivity::GroundGrid& grid, const terrain::PlaceRun& places,
                    const float* wanted, std::int32_t* level) {
  const DoubleTag d;
  const hn::Rebind<float, decltype(d)> df;
  const hn::Rebind<std::int32_t, decltype(d)> di;
  const hn::Rebind<std::uint32_t, decltype(d)> du;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    if (hn::AllFalse(df, hn::Gt(hn::LoadU(df, wanted + i), hn::Zero(df)))) {
      hn::StoreU(hn::Zero(di), di, level + i);
      continue;
    }
    const auto degrees = [&](const float* cells, const float* within, double corner) {
      const auto whole = hn::Add(hn::PromoteTo(d, hn::LoadU(df, cells + i)), hn::Set(d, corner));
      return hn::Add(whole, hn::PromoteTo(d, hn::LoadU(df, within + i)));
    };
    const auto north = degrees(places.cells_north.data(), places.north_deg.data(), places.corner.south_deg + 90.0);
    const auto east = degrees(places.cells_east.data(), places.east_deg.data(), places.corner.west_deg);
    const auto turns = hn::Add(hn::Mul(east, hn::Set(d, 1.0 / 360.0)), hn::Set(d, 0.5));
    const auto columns = columns_of(grid, places, i);
    const auto row = hn::DemoteTo(di, hn::Max(hn::Mul(north, hn::Set(d, grid.rows_per_degree)), hn::Zero(d)));
    const auto column = hn::DemoteTo(di, hn::Mul(hn::Sub(turns, hn::Floor(turns)), columns));
    const auto bits = mixed(hn::Xor(mixed(hn::BitCast(du, row)), hn::BitCast(du, column)));
    hn::StoreU(hn::BitCast(di, hn::ShiftRight<24>(bits)), di, level + i);
  }
}

void sea_return(std::size_t count, const float* sigma0, const float* water, const float* sin_grazing,
                const float* texture, const std::int32_t* level, float* sea) {
  using Table = reflectivity::SeaTable;
  const Tag d;
  const WholeTag di;
  const auto zero = hn::Zero(d);
  const auto first = hn::Set(di, static_cast<std::int32_t>(Table::kFirst));
  const auto least = hn::BitCast(d, first);
  const auto last_piece = hn::Set(di, static_cast<std::int32_t>(Table::kPieces - 1));
  constexpr float kStep = 1.0F / static_cast<float>(1U << Table::kShift);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto share_of_water = hn::LoadU(d, water + i);
    const auto sine = hn::LoadU(d, sin_grazing + i);
    const auto wet = hn::And(hn::Gt(share_of_water, zero), hn::Gt(sine, zero));
    if (hn::AllFalse(d, wet)) {
      hn::StoreU(zero, d, sea + i);
      continue;
    }
    const auto steep = hn::Gt(sine, least);
    const auto inside = hn::IfThenElse(steep, sine, least);
    const auto place = hn::Sub(hn::BitCast(di, inside), first);
    const auto piece = hn::Min(hn::ShiftRight<static_cast<int>(Table::kShift)>(place), last_piece);
    const auto rest = hn::Sub(place, hn::ShiftLeft<static_cast<int>(Table::kShift)>(piece));
    const auto share = hn::Mul(hn::ConvertTo(d, rest), hn::Set(d, kStep));
    const auto low = hn::GatherIndex(d, sigma0, piece);
    const auto high = hn::GatherIndex(d, sigma0 + 1, piece);
    auto value = hn::Add(low, hn::Mul(share, hn::Sub(high, low)));
    value = hn::IfThenElse(steep, value, hn::Div(hn::Mul(value, sine), least));
    if (level != nullptr) value = hn::Mul(value, hn::GatherIndex(d, texture, hn::LoadU(di, level + i)));
    hn::StoreU(hn::IfThenElseZero(wet, hn::Mul(share_of_water, value)), d, sea + i);
  }
}

bool settle_materials(std::size_t count, std::int32_t* material, float* water) {
  const WholeTag di;
  const Tag d;
  auto all = hn::Zero(di);
  for (std::size_t i = 0; i < count; i += hn::Lanes(di)) {
    const auto given = hn::LoadU(di, material + i);
    const auto code = hn::IfThenElseZero(hn::Lt(given, hn::Set(di, radar::kMaterials)), given);
    const auto wet = hn::RebindMask(d, hn::Eq(code, hn::Set(di, radar::kWaterMaterial)));
    hn::StoreU(code, di, material + i);
    hn::StoreU(hn::IfThenElse(wet, hn::Set(d, 1.0F), hn::LoadU(d, water + i)), d, water + i);
    all = hn::Or(all, count - i >= hn::Lanes(di) ? code : hn::IfThenElseZero(hn::FirstN(di, count - i), code));
  }
  return !hn::AllTrue(di, hn::Eq(all, hn::Zero(di)));
}

std::size_t next_in(std::size_t count, std::uint32_t codes, const std::int32_t* material, std::size_t from) {
  const WholeTag di;
  const hn::RebindToUnsigned<WholeTag> du;
  const auto set = hn::Set(du, codes);
  std::size_t i = from;
  for (; i + hn::Lanes(di) <= count; i += hn::Lanes(di)) {
    const auto bit = hn::Shr(set, hn::BitCast(du, hn::LoadU(di, material + i)));
    const auto inside = hn::Ne(hn::And(bit, hn::Set(du, 1U)), hn::Zero(du));
    if (!hn::AllFalse(du, inside)) return i + static_cast<std::size_t>(hn::FindFirstTrue(du, inside));
  }
  while (i < count && (codes >> static_cast<std::uint32_t>(material[i]) & 1U) == 0) ++i;
  return i;
}

void land_return(std::size_t count, const MaterialTables& tables, const std::int32_t* material, const float* water,
                 const std::int32_t* level, float* gamma) {
  const Tag d;
  const WholeTag di;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto code = hn::And(hn::LoadU(di, material + i), hn::Set(di, radar::kMaterials - 1));
    auto value = hn::GatherIndex(d, tables.gamma.data(), code);
    if (level != nullptr) {
      const auto entry = hn::Add(hn::ShiftLeft<8>(code), hn::LoadU(di, level + i));
      value = hn::Mul(value, hn::GatherIndex(d, tables.texture.data(), entry));
    }
    hn::StoreU(hn::Mul(hn::Sub(hn::Set(d, 1.0F), hn::LoadU(d, water + i)), value), d, gamma + i);
  }
}

}  // namespace yars::model::rbm::lanes::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::rbm::lanes {

HWY_EXPORT(any_positive);
HWY_EXPORT(fill_sigma0);
HWY_EXPORT(texture_levels);
HWY_EXPORT(sea_return);
HWY_EXPORT(settle_materials);
HWY_EXPORT(next_in);
HWY_EXPORT(land_return);

bool any_positive(std::size_t count, const float* values) {
  return HWY_DYNAMIC_DISPATCH(any_positive)(count, values);
}
void fill_sigma0(const reflectivity::SeaTable& table, float cosine, float* sigma0) {
  HWY_DYNAMIC_DISPATCH(fill_sigma0)(table, cosine, sigma0);
}
void texture_levels(std::size_t count, const reflectivity::GroundGrid& grid, const terrain::PlaceRun& places,
                    const float* wanted, std::int32_t* level) {
  HWY_DYNAMIC_DISPATCH(texture_levels)(count, grid, places, wanted, level);
}
void sea_return(std::size_t count, const float* sigma0, const float* water, const float* sin_grazing,
                const float* texture, const std::int32_t* level, float* sea) {
  HWY_DYNAMIC_DISPATCH(sea_return)(count, sigma0, water, sin_grazing, texture, level, sea);
}
bool settle_materials(std::size_t count, std::int32_t* material, float* water) {
  return HWY_DYNAMIC_DISPATCH(settle_materials)(count, material, water);
}
std::size_t next_in(std::size_t count, std::uint32_t codes, const std::int32_t* material, std::size_t from) {
  return HWY_DYNAMIC_DISPATCH(next_in)(count, codes, material, from);
}
void land_return(std::size_t count, const MaterialTables& tables, const std::int32_t* material, const float* water,
                 const std::int32_t* level, float* gamma) {
  HWY_DYNAMIC_DISPATCH(land_return)(count, tables, material, water, level, gamma);
}

}  // namespace yars::model::rbm::lanes
#endif  // HWY_ONCE
