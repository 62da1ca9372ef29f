#include "model/physics/clutter_simd.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/physics/clutter_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// These headers need the target (instruction set) that highway.h defines.
#include "lib/simd/fused-inl.hpp"
#include "model/physics/clutter_simd-inl.hpp"
#include "model/physics/polynomials-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::physics::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace fused = yars::simd::HWY_NAMESPACE;
namespace polynomials = physics::HWY_NAMESPACE;

void reflect(std::size_t count, const GroundInputs& ground, const float* sin_grazing, float* land, float* sea) {
  const GroundTag d;
  GroundCache cache(ground);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto sine = hn::LoadU(d, sin_grazing + i);
    const GroundReturn found = ground_return(ground, cache, i, sine, [&] { return sine; });
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

std::size_t next_sample_with_material(std::size_t count, std::uint32_t codes, const std::int32_t* material,
                                      std::size_t from) {
  const GroundTag d;
  const hn::RebindToSigned<GroundTag> di;
  for (std::size_t i = from; i < count; i += hn::Lanes(d)) {
    const auto inside = in_set(codes, hn::LoadU(di, material + i));
    if (hn::AllFalse(d, inside)) continue;
    return std::min(count, i + static_cast<std::size_t>(hn::FindFirstTrue(d, inside)));
  }
  return count;
}

void sigma0_at_azimuth(const SeaTable& table, float cosine, float* sigma0) {
  const GroundTag d;
  // All entries but the last fill whole vectors.
  constexpr std::size_t kEntries = SeaTable::kPieces;
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

constexpr std::size_t kMaxLanes = 16;
using Tag = hn::CappedTag<float, kMaxLanes>;
using SignedTag = hn::RebindToSigned<Tag>;
using BitsTag = hn::RebindToUnsigned<Tag>;
using Floats = hn::Vec<Tag>;

constexpr float kDecibelsPerOctave = 3.01029996F;  // 10 log10(2)

void speckle(std::size_t count, NoiseState state, const float* levels, SpeckleCells cells, float* variate) {
  const Tag d;
  const SignedTag di;
  const BitsTag db;
  // The lane numbers are made outside the loop, because Iota loads them from memory.
  const auto lane = hn::Iota(d, 0.5F);
  const auto after = [&](Floats along, float start) { return hn::ConvertTo(di, hn::Add(along, hn::Set(d, start))); };
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto sample = hn::Add(lane, hn::Set(d, static_cast<float>(static_cast<std::int32_t>(i))));
    const auto along = hn::Mul(sample, hn::Set(d, cells.per_sample));
    const auto cell = hn::BitCast(db, hn::Add(after(along, cells.first), after(along, cells.second)));
    const auto level = hn::BitCast(di, hn::ShiftRight<32 - static_cast<int>(kSpeckleBits)>(noise_bits(state, cell)));
    hn::StoreU(hn::GatherIndex(d, levels, level), d, variate + i);
  }
}

// Loads a vector. Lanes from `remaining` on are 0, and no entry is read for them.
HWY_INLINE Floats load(const float* from, std::size_t remaining) {
  const Tag d;
  if (remaining >= hn::Lanes(d)) return hn::LoadU(d, from);
  HWY_ALIGN float entries[kMaxLanes] = {};
  std::copy_n(from, remaining, entries);
  return hn::Load(d, entries);
}

// Nearest integer of a value between -2^21 and 2^21. The last mantissa bit of value + 1.5 * 2^23 has the weight 1.
// 0x4b400000 is 1.5 * 2^23 as bits.
HWY_INLINE hn::Vec<SignedTag> rounded(Floats value) {
  constexpr float kRoundingOffset = 12582912.0F;  // 1.5 * 2^23
  const SignedTag di;
  return hn::Sub(hn::BitCast(di, hn::Add(value, hn::Set(Tag(), kRoundingOffset))), hn::Set(di, 0x4b400000));
}

void form_video(std::size_t count, const VideoInputs& inputs, std::uint8_t* video) {
  const Tag d;
  const hn::Rebind<std::uint8_t, Tag> d8;
  // With a local copy the compiler need not reload the inputs after each store.
  const VideoInputs in = inputs;
  const auto first = hn::Set(d, in.weights[0]);
  const auto second = hn::Set(d, in.weights[1]);
  const auto third = hn::Set(d, in.weights[2]);
  const auto noise = hn::Set(d, in.noise);
  const auto slope = hn::Set(d, 255.0F * kDecibelsPerOctave / in.dynamic_range_db);
  const auto base = hn::Set(d, 255.0F * (1.0F + in.gain_db / in.dynamic_range_db));
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const std::size_t remaining = count - i;
    const auto received = in.time_control == nullptr ? noise : hn::Mul(noise, load(in.time_control + i, remaining));
    auto power = fused::mul_add(first, load(in.before + i, remaining), received);
    power = fused::mul_add(second, load(in.centre + i, remaining), power);
    power = fused::mul_add(third, load(in.after + i, remaining), power);
    if (in.variate != nullptr) power = hn::Mul(power, hn::LoadU(d, in.variate + i));
    // The lower limit keeps the logarithm's argument a normal float.
    const auto level = fused::mul_add(slope, polynomials::rough_log2(d, hn::Max(power, hn::Set(d, 1.0e-30F))), base);
    // Conversion to bytes saturates, which clips the video.
    const auto bytes = hn::DemoteTo(d8, rounded(level));
    if (remaining >= hn::Lanes(d)) {
      hn::StoreU(bytes, d8, video + i);
    } else {
      HWY_ALIGN std::uint8_t last[kMaxLanes];
      hn::StoreU(bytes, d8, last);
      std::copy_n(last, remaining, video + i);
    }
  }
}

}  // namespace yars::model::physics::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::physics::simd {

HWY_EXPORT(reflect);
HWY_EXPORT(any_positive);
HWY_EXPORT(next_sample_with_material);
HWY_EXPORT(sigma0_at_azimuth);

void reflect(std::size_t count, const GroundInputs& ground, const float* sin_grazing, float* land, float* sea) {
  HWY_DYNAMIC_DISPATCH(reflect)(count, ground, sin_grazing, land, sea);
}
bool any_positive(std::size_t count, const float* values) {
  return HWY_DYNAMIC_DISPATCH(any_positive)(count, values);
}
std::size_t next_sample_with_material(std::size_t count, std::uint32_t codes, const std::int32_t* material,
                                      std::size_t from) {
  return HWY_DYNAMIC_DISPATCH(next_sample_with_material)(count, codes, material, from);
}
void sigma0_at_azimuth(const SeaTable& table, float cosine, float* sigma0) {
  HWY_DYNAMIC_DISPATCH(sigma0_at_azimuth)(table, cosine, sigma0);
}

TextureDegree texture_degree(const GroundInputs& ground, const TextureDrift& drift, float cells_north,
                             float cells_east) {
  const terrain::CellCorner corner = ground.positions.corner;
  const double north_deg = std::clamp(corner.south_deg + 90.0 + static_cast<double>(cells_north), 0.0, 180.0);
  const double turns = (corner.west_deg + static_cast<double>(cells_east)) / 360.0 + 0.5;
  const auto degree = static_cast<std::size_t>(std::min(north_deg, 179.0));
  const double columns = ground.grid->columns[degree];
  const double row = north_deg * ground.grid->rows_per_degree + drift.row_part;
  const double column = (turns - std::floor(turns)) * columns + drift.column_part;
  return {static_cast<std::int32_t>(row) + drift.row,
          static_cast<std::int32_t>(column) + drift.column,
          static_cast<float>(row - std::floor(row)),
          static_cast<float>(column - std::floor(column)),
          static_cast<float>(ground.grid->rows_per_degree),
          static_cast<float>(columns / 360.0),
          static_cast<std::int32_t>(columns) / static_cast<std::int32_t>(kPartsPerCell),
          std::max(90.0 - north_deg, north_deg - 89.0) > kPolar_deg};
}

void polar_bits(const GroundInputs& ground, const TextureDrift& drift, std::size_t first, std::size_t count,
                std::int32_t* bits) {
  for (std::size_t i = first; i < first + count; ++i) {
    const geo::GeoPoint position = terrain::position_of(ground.positions, i);
    const bool known = std::isfinite(position.latitude_deg) && std::isfinite(position.longitude_deg);
    bits[i - first] = known ? std::bit_cast<std::int32_t>(drifted_bits(*ground.grid, position, drift)) : 0;
  }
}

HWY_EXPORT(speckle);
HWY_EXPORT(form_video);

void speckle(std::size_t count, NoiseState state, int looks, SpeckleCells cells, float* variate) {
  HWY_DYNAMIC_DISPATCH(speckle)(count, state, speckle_levels(looks).data(), cells, variate);
}
void form_video(std::size_t count, const VideoInputs& inputs, std::uint8_t* video) {
  HWY_DYNAMIC_DISPATCH(form_video)(count, inputs, video);
}

}  // namespace yars::model::physics::simd
#endif  // HWY_ONCE
