#include "model/physics/ray_simd.hpp"

#include <algorithm>

#include "model/terrain/sampling/terrain_view.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/physics/ray_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind highway.h, or it would have no target yet.
#include "lib/simd/fused-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::physics::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace fused = yars::simd::HWY_NAMESPACE;

constexpr std::size_t kGroup = 8;  // pieces worked on at once: a vector of doubles
using DoubleTag = hn::CappedTag<double, kGroup>;
using NarrowTag = hn::Rebind<float, DoubleTag>;
using FloatTag = hn::CappedTag<float, terrain::kRunSlack>;

// A curve about the middles of a group's pieces: cell + base + (rest + s (slope + s (bend + s twist))), s [m] from the
// middle. The rest keeps what float drops of the base.
struct Pieces {
  HWY_ALIGN float cell[kGroup];
  HWY_ALIGN float base[kGroup];
  HWY_ALIGN float rest[kGroup];
  HWY_ALIGN float slope[kGroup];
  HWY_ALIGN float bend[kGroup];
  HWY_ALIGN float twist[kGroup];
};

HWY_INLINE void expand(const Curve& curve, double scale, double shift, const float* middle_m, Pieces& pieces) {
  const DoubleTag d;
  const NarrowTag df;
  const auto unit = hn::Set(d, scale);
  const auto store = [&](auto value, float* to) { hn::StoreU(hn::DemoteTo(df, value), df, to); };
  for (std::size_t i = 0; i < kGroup; i += hn::Lanes(d)) {
    const auto x = fused::mul_sub(hn::PromoteTo(d, hn::LoadU(df, middle_m + i)), unit, hn::Set(d, shift));
    auto value = hn::Set(d, curve.coefficient[curve.terms - 1]);
    auto slope = hn::Zero(d);
    auto bend = hn::Zero(d);
    auto twist = hn::Zero(d);
    // Horner's scheme, four times over: the value and its derivatives over their factorials.
    for (std::size_t k = curve.terms - 1; k-- > 0;) {
      twist = fused::mul_add(twist, x, bend);
      bend = fused::mul_add(bend, x, slope);
      slope = fused::mul_add(slope, x, value);
      value = fused::mul_add(value, x, hn::Set(d, curve.coefficient[k]));
    }
    const auto cell = hn::Floor(value);
    const auto within = hn::Sub(value, cell);
    const auto base = hn::DemoteTo(df, within);
    store(cell, pieces.cell + i);
    hn::StoreU(base, df, pieces.base + i);
    store(hn::Sub(within, hn::PromoteTo(d, base)), pieces.rest + i);
    store(hn::Mul(slope, unit), pieces.slope + i);
    store(hn::Mul(hn::Mul(bend, unit), unit), pieces.bend + i);
    store(hn::Mul(hn::Mul(hn::Mul(twist, unit), unit), unit), pieces.twist + i);
  }
}

HWY_INLINE void put(const Pieces& pieces, std::size_t piece, hn::Vec<FloatTag> s, float* cells, float* degrees) {
  const FloatTag d;
  auto way = fused::mul_add(hn::Set(d, pieces.twist[piece]), s, hn::Set(d, pieces.bend[piece]));
  way = fused::mul_add(way, s, hn::Set(d, pieces.slope[piece]));
  way = fused::mul_add(way, s, hn::Set(d, pieces.rest[piece]));
  const auto place = hn::Add(way, hn::Set(d, pieces.base[piece]));
  const auto whole = hn::Floor(place);
  hn::StoreU(hn::Add(whole, hn::Set(d, pieces.cell[piece])), d, cells);
  hn::StoreU(hn::Sub(place, whole), d, degrees);
}

void along_curves(std::size_t count, std::size_t piece_size, const float* distance_m, const Curves& given,
                  const Places& places) {
  const FloatTag d;
  // A copy, so that no store could be one to a coefficient.
  const Curves curves = given;
  Pieces north, east;
  HWY_ALIGN float middle_m[kGroup];
  for (std::size_t start = 0; start < count; start += kGroup * piece_size) {
    for (std::size_t piece = 0; piece < kGroup; ++piece) {
      const std::size_t first = std::min(start + piece * piece_size, count - 1);
      const std::size_t last = std::min(first + piece_size, count) - 1;
      middle_m[piece] = 0.5F * (distance_m[first] + distance_m[last]);
    }
    expand(curves.north, curves.scale, curves.shift, middle_m, north);
    expand(curves.east, curves.scale, curves.shift, middle_m, east);
    std::size_t i = start;
    for (std::size_t piece = 0; piece < kGroup && i < count; ++piece) {
      const auto middle = hn::Set(d, middle_m[piece]);
      const std::size_t end = std::min(i + piece_size, count);
      for (; i < end; i += hn::Lanes(d)) {
        const auto s = hn::Sub(hn::LoadU(d, distance_m + i), middle);
        put(north, piece, s, places.cells_north + i, places.north_deg + i);
        put(east, piece, s, places.cells_east + i, places.east_deg + i);
      }
    }
  }
}

}  // namespace yars::model::physics::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::physics::simd {

HWY_EXPORT(along_curves);

std::size_t piece_samples(std::size_t count) {
  // Whole vectors; a piece is at most a twelfth of the ray.
  constexpr std::size_t kShort = terrain::kRunSlack, kLong = 2 * kShort, kPieces = 12;
  return count >= kPieces * kLong ? kLong : count >= kPieces * kShort ? kShort : 0;
}

void along_curves(std::size_t count, std::size_t piece, const float* distance_m, const Curves& curves,
                  const Places& places) {
  HWY_DYNAMIC_DISPATCH(along_curves)(count, piece, distance_m, curves, places);
}

}  // namespace yars::model::physics::simd
#endif  // HWY_ONCE
