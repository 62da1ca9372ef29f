// Ground reflectivity of one vector of samples: land by material, with texture and walls; sea by grazing angle.
// Results are equal on all targets (instruction sets) of the library Highway, and do not depend on the other samples of
// a vector.
// Included once for each target.
#if defined(YARS_MODEL_PHYSICS_CLUTTER_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef YARS_MODEL_PHYSICS_CLUTTER_SIMD_INL
#undef YARS_MODEL_PHYSICS_CLUTTER_SIMD_INL
#else
#define YARS_MODEL_PHYSICS_CLUTTER_SIMD_INL
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstdint>

#include "lib/random/counter_rng-inl.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/physics/polynomials-inl.hpp"
#include "model/physics/texture.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::physics::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using GroundTag = hn::CappedTag<float, terrain::kRunSlack>;
using GroundInts = hn::Vec<hn::RebindToSigned<GroundTag>>;
using GroundFloats = hn::Vec<GroundTag>;

// Mask of the lanes with a material code in `set` (one bit per code).
HWY_INLINE hn::Mask<GroundTag> in_set(std::uint32_t set, GroundInts code) {
  const hn::RebindToUnsigned<GroundTag> du;
  const auto bits = hn::Shr(hn::Set(du, set), hn::BitCast(du, code));
  return hn::RebindMask(GroundTag(), hn::TestBit(bits, hn::Set(du, 1U)));
}

// Entry of a table for the material code of each lane. The table has radar::kMaterials entries.
HWY_INLINE GroundFloats by_code(const float* table, GroundInts code) {
  const GroundTag d;
#if HWY_CAP_GE512
  static_assert(radar::kMaterials == 32);
  const hn::RebindToSigned<GroundTag> di;
  const auto index = hn::IndicesFromVec(d, hn::And(code, hn::Set(di, 15)));
  const auto low = hn::TableLookupLanes(hn::LoadU(d, table), index);
  const auto high = hn::TableLookupLanes(hn::LoadU(d, table + 16), index);
  return hn::IfThenElse(hn::RebindMask(d, hn::Lt(code, hn::Set(di, 16))), low, high);
#else
  return hn::GatherIndex(d, table, code);
#endif
}

// noise_bits() of clutter.hpp for a vector of cells.
template <class V>
HWY_INLINE V noise_bits(NoiseState state, V cell) {
  const hn::DFromV<V> d;
  static_assert(kCellStride == 8);
  const auto bits = random::HWY_NAMESPACE::lowbias32(hn::Xor(hn::ShiftLeft<3>(cell), hn::Set(d, state.first)));
  const auto keyed = hn::Mul(hn::Xor(bits, hn::Set(d, state.second)), hn::Set(d, kGoldenSection));
  return hn::Xor(keyed, hn::ShiftRight<15>(keyed));
}

// Number [0, 255] of the texture level of the ground cell at each sample: the upper 8 bits of ground_bits(). Cells are
// found in float from the south-west corner of each one-degree square. Within a centimetre of the edge of a part of a
// cell (GroundGrid) the level may be that of the neighbouring part.
class TextureCells {
 public:
  TextureCells(const GroundInputs& in, const TextureDrift& drift) : in_(in), drift_(drift) {}

  HWY_INLINE GroundInts levels(std::size_t i) {
    const GroundTag d;
    const auto north = hn::LoadU(d, in_.positions.cells_north.data() + i);
    const auto east = hn::LoadU(d, in_.positions.cells_east.data() + i);
    const auto in_degree = [&] { return hn::And(hn::Eq(north, hn::Set(d, north_)), hn::Eq(east, hn::Set(d, east_))); };
    // Usual case: all samples are in the one-degree square of the previous vector.
    if (hn::AllTrue(d, in_degree())) return levels_in_degree(i);
    auto found = hn::Zero(hn::RebindToSigned<GroundTag>());
    // Samples with NaN positions have level number 0.
    auto remaining = hn::And(hn::Eq(north, north), hn::Eq(east, east));
    while (!hn::AllFalse(d, remaining)) {
      const auto lane = static_cast<std::size_t>(hn::FindFirstTrue(d, remaining));
      use_degree(in_.positions.cells_north[i + lane], in_.positions.cells_east[i + lane]);
      const auto inside = in_degree();
      found = hn::IfThenElse(hn::RebindMask(hn::RebindToSigned<GroundTag>(), inside), levels_in_degree(i), found);
      remaining = hn::AndNot(inside, remaining);
    }
    return found;
  }

 private:
  HWY_INLINE void use_degree(float cells_north, float cells_east) {
    north_ = cells_north;
    east_ = cells_east;
    degree_ = texture_degree(in_, drift_, cells_north, cells_east);
  }

  HWY_INLINE GroundInts levels_in_degree(std::size_t i) const {
    const GroundTag d;
    const hn::RebindToSigned<GroundTag> di;
    const hn::RebindToUnsigned<GroundTag> du;
    static_assert(kPartsPerCell == 4);
    if (degree_.polar) {
      HWY_ALIGN std::int32_t bits[terrain::kRunSlack];
      polar_bits(in_, drift_, i, hn::Lanes(d), bits);
      return hn::BitCast(di, hn::ShiftRight<24>(hn::BitCast(du, hn::Load(di, bits))));
    }
    const auto part_of = [&](const float* within, float per_degree, float offset, std::int32_t first) {
      const auto on = hn::Add(hn::Mul(hn::LoadU(d, within + i), hn::Set(d, per_degree)), hn::Set(d, offset));
      return hn::BitCast(du, hn::Add(hn::ConvertTo(di, on), hn::Set(di, first)));
    };
    const auto row = part_of(in_.positions.north_deg.data(), degree_.rows, degree_.row_offset, degree_.row);
    const auto column = part_of(in_.positions.east_deg.data(), degree_.columns, degree_.column_offset, degree_.column);
    // The last step of lowbias32 does not change the upper half of the bits.
    const auto mixed = [&](auto north, auto east, std::uint32_t key) {
      const auto number = hn::Add(hn::Mul(north, hn::Set(du, kGoldenSection)), east);
      return random::HWY_NAMESPACE::lowbias32_rounds(hn::Xor(number, hn::Set(du, key)));
    };
    const auto part = mixed(row, column, kPartKey);
    const auto cell_row = hn::ShiftRight<2>(hn::Add(row, hn::ShiftRight<30>(part)));
    auto cell_column = hn::Add(column, hn::And(hn::ShiftRight<28>(part), hn::Set(du, 3U)));
    cell_column = hn::ShiftRight<2>(cell_column);
    const auto around = hn::Eq(cell_column, hn::Set(du, static_cast<std::uint32_t>(degree_.cells_around)));
    if (!drift_.moves) {
      const auto bits = mixed(cell_row, hn::IfThenZeroElse(around, cell_column), 0U);
      return hn::BitCast(di, hn::ShiftRight<24>(bits));
    }
    const auto phase = hn::ShiftRight<24>(mixed(cell_row, cell_column, kLifeSection));
    const auto life = hn::ShiftRight<8>(hn::Add(phase, hn::Set(du, drift_.age)));
    const auto number = hn::Add(cell_column, hn::Mul(life, hn::Set(du, kLifeSection)));
    return hn::BitCast(di, hn::ShiftRight<24>(mixed(cell_row, number, 0U)));
  }

  const GroundInputs& in_;
  const TextureDrift drift_;
  float north_ = NAN, east_ = NAN;  // one-degree square of degree_, as in positions.cells_north and cells_east
  TextureDegree degree_;
};

// Sigma0 of the sea from the table of sigma0_at_azimuth(), which SeaTable describes. `sine`: sine of the grazing angle,
// > 0.
HWY_INLINE GroundFloats sea_sigma0(const float* sigma0, GroundFloats sine) {
  using Table = SeaTable;
  const GroundTag d;
  const hn::RebindToSigned<GroundTag> di;
  constexpr int kShift = static_cast<int>(Table::kShift);
  constexpr float kStep = 1.0F / static_cast<float>(1U << Table::kShift);
  const auto first = hn::Set(di, static_cast<std::int32_t>(Table::kFirst));
  const auto lowest = hn::BitCast(d, first);
  const auto steep = hn::Gt(sine, lowest);
  const auto offset = hn::Sub(hn::BitCast(di, hn::IfThenElse(steep, sine, lowest)), first);
  const auto last_piece = hn::Set(di, static_cast<std::int32_t>(Table::kPieces - 1));
  const auto piece = hn::Min(hn::ShiftRight<kShift>(offset), last_piece);
  const auto fraction = hn::Mul(hn::ConvertTo(d, hn::Sub(offset, hn::ShiftLeft<kShift>(piece))), hn::Set(d, kStep));
  const auto low = hn::GatherIndex(d, sigma0, piece);
  const auto high = hn::GatherIndex(d, sigma0 + 1, piece);
  const auto value = hn::Add(low, hn::Mul(fraction, hn::Sub(high, low)));
  return hn::IfThenElse(steep, value, hn::Div(hn::Mul(value, sine), lowest));
}

// Sigma0 table of one sweep, computed at the first use.
class SeaCache {
 public:
  explicit SeaCache(const GroundInputs& in) : in_(in) {}

  HWY_INLINE const float* sigma0() {
    if (!filled_) simd::sigma0_at_azimuth(*in_.sea, in_.upwind, in_.sigma0);
    filled_ = true;
    return in_.sigma0;
  }

 private:
  const GroundInputs& in_;
  bool filled_ = false;
};

// Values that the vectors of one sweep reuse.
struct GroundCache {
  explicit GroundCache(const GroundInputs& in) : texture(in, {}), sea_texture(in, in.drift), sea(in) {}
  TextureCells texture, sea_texture;
  SeaCache sea;
};

// Reflectivity of one vector of samples, as in reflect().
struct GroundReturn {
  GroundFloats land;  // (1 - water) * gamma * texture * wall gain
  GroundFloats sea;   // water * sigma0 * texture, >= 0
  bool wet;           // false: `sea` is 0 in every lane
};

// First entry of the texture's levels of land.
HWY_INLINE GroundInts land_entry(const GroundInputs& in, std::size_t i, GroundInts code) {
  const hn::RebindToSigned<GroundTag> di;
  const auto of_set = [&](std::uint32_t set) { return hn::RebindMask(di, in_set(set, code)); };
  auto entry = hn::LoadU(di, in.rural + i);
  if (in.material == nullptr && (in.configured & 1U) == 0) return entry;
  entry = hn::IfThenElse(of_set(in.even_kinds), hn::LoadU(di, in.even + i), entry);
  return hn::IfThenElse(of_set(in.configured), hn::GatherIndex(di, in.tables->entry.data(), code), entry);
}

// First entry of the texture's levels of the sea.
HWY_INLINE GroundInts sea_entry(const GroundInputs& in, std::size_t i) {
  const GroundTag d;
  const hn::RebindToSigned<GroundTag> di;
  if (in.sea_steps == nullptr) return hn::Set(di, in.sea_entry);
  const auto step = hn::Add(hn::LoadU(d, in.sea_steps + i), hn::Set(d, in.sea_turn + 0.5F));
  constexpr auto kLast = static_cast<float>(TextureSteps::kNone);
  return hn::ShiftLeft<8>(hn::ConvertTo(di, hn::Min(hn::Max(step, hn::Zero(d)), hn::Set(d, kLast))));
}

// specular_sigma0() of reflectivity.hpp.
HWY_INLINE GroundFloats glint(const GroundInputs& in, GroundFloats sine) {
  const GroundTag d;
  const auto one = hn::Set(d, 1.0F);
  const auto held = hn::Max(hn::Min(sine, one), hn::Set(d, kGlintSine));
  const auto square = hn::Mul(held, held);
  const auto tangent2 = hn::Div(hn::Sub(one, square), square);
  const auto share = hn::Min(one, hn::Mul(hn::Sub(held, hn::Set(d, kGlintSine)), hn::Set(d, kGlintRise)));
  const auto lobe = physics::HWY_NAMESPACE::exp2(d, hn::Neg(hn::Mul(tangent2, hn::Set(d, in.glint_octaves))));
  return hn::Div(hn::Mul(hn::Mul(share, lobe), hn::Set(d, in.glint)), hn::Mul(square, square));
}

constexpr std::uint32_t kWaterBit = 1U << static_cast<unsigned>(radar::kWaterMaterial);

// Ground return of the vector of samples that begins at `i`. `level_sine` is the sine of the grazing angle on level
// ground, times any positive factor: only its sign is used. `sin_grazing()` returns the sine itself. It is called only
// if a sample has water.
template <class Sine>
HWY_INLINE GroundReturn ground_return(const GroundInputs& in, GroundCache& cache, std::size_t i,
                                      GroundFloats level_sine, const Sine& sin_grazing) {
  const GroundTag d;
  const hn::RebindToSigned<GroundTag> di;
  const auto one = hn::Set(d, 1.0F);
  const auto zero = hn::Zero(d);
  const auto code = in.material == nullptr ? hn::Zero(di) : hn::LoadU(di, in.material + i);
  auto water = hn::LoadU(d, in.water + i);
  const bool special = !hn::AllFalse(d, in_set(in.textured | in.walled | kWaterBit, code));
  if (special) water = hn::IfThenElse(in_set(kWaterBit, code), one, water);
  const auto wet = hn::And(hn::Gt(water, zero), hn::Gt(level_sine, zero));
  const bool textured_land = special && !hn::AllFalse(d, in_set(in.textured, code));
  const bool some_wet = !hn::AllFalse(d, wet);
  const bool textured_sea = in.textured_sea && some_wet;
  auto level = hn::Zero(di);
  if (textured_land) level = cache.texture.levels(i);
  auto gamma = by_code(in.tables->gamma.data(), code);
  if (textured_land) gamma = hn::Mul(gamma, hn::GatherIndex(d, in.levels, hn::Add(land_entry(in, i, code), level)));
  if (special) {
    const auto walled = in_set(in.walled, code);
    if (!hn::AllFalse(d, walled)) gamma = hn::Mul(gamma, hn::IfThenElse(walled, hn::LoadU(d, in.wall_gain + i), one));
  }
  GroundReturn result{hn::Mul(hn::Sub(one, water), gamma), zero, some_wet};
  if (!result.wet) return result;
  const auto sine = sin_grazing();
  auto value = sea_sigma0(cache.sea.sigma0(), sine);
  if (in.glint > 0.0F && !hn::AllFalse(d, hn::Gt(sine, hn::Set(d, kGlintSine))))
    value = hn::Add(value, glint(in, sine));
  if (textured_sea) {
    level = cache.sea_texture.levels(i);
    value = hn::Mul(value, hn::GatherIndex(d, in.levels, hn::Add(sea_entry(in, i), level)));
  }
  result.sea = hn::IfThenElseZero(wet, hn::Mul(water, value));
  return result;
}

}  // namespace yars::model::physics::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
