#include "model/physics/ray_simd.hpp"

#include <algorithm>

#include "model/terrain/sampling/terrain_view.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "model/physics/ray_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Included after highway.h, which defines the vector target.
#include "lib/simd/fused-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace yars::model::physics::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace fused = yars::simd::HWY_NAMESPACE;

constexpr std::size_t kGroup = 8;  // pieces processed together, as many as the largest vector has doubles
using DoubleTag = hn::CappedTag<double, kGroup>;
using NarrowTag = hn::Rebind<float, DoubleTag>;
using FloatTag = hn::CappedTag<float, terrain::kRunSlack>;

// Cubic of each piece of a group: cell + base + (rest + s (slope + s (bend + s twist))) [deg].
// s is the distance from the piece's middle [m]. At s = 0 the position is `cell` whole degrees plus the fraction
// `base`. `rest` is the rounding error of `base`. slope, bend and twist are the coefficients of s, s^2 and s^3.
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
    // Horner's scheme for the value and its first three derivatives, each divided by its factorial.
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

HWY_INLINE void store_position(const Pieces& pieces, std::size_t piece, hn::Vec<FloatTag> s, float* cells,
                               float* degrees) {
  const FloatTag d;
  auto offset = fused::mul_add(hn::Set(d, pieces.twist[piece]), s, hn::Set(d, pieces.bend[piece]));
  offset = fused::mul_add(offset, s, hn::Set(d, pieces.slope[piece]));
  offset = fused::mul_add(offset, s, hn::Set(d, pieces.rest[piece]));
  const auto position = hn::Add(offset, hn::Set(d, pieces.base[piece]));
  const auto whole = hn::Floor(position);
  hn::StoreU(hn::Add(whole, hn::Set(d, pieces.cell[piece])), d, cells);
  hn::StoreU(hn::Sub(position, whole), d, degrees);
}

void positions_on_curves(std::size_t count, std::size_t piece_size, const float* distance_m, const Curves& input,
                         const PositionSpans& positions) {
  const FloatTag d;
  // With a local copy the compiler need not reload the coefficients after each store.
  const Curves curves = input;
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
        store_position(north, piece, s, positions.cells_north + i, positions.north_deg + i);
        store_position(east, piece, s, positions.cells_east + i, positions.east_deg + i);
      }
    }
  }
}

HWY_INLINE void store_degrees(hn::Vec<DoubleTag> degrees, float* cells, float* within) {
  const NarrowTag df;
  const auto cell = hn::Floor(degrees);
  hn::StoreU(hn::DemoteTo(df, cell), df, cells);
  hn::StoreU(hn::DemoteTo(df, hn::Sub(degrees, cell)), df, within);
}

HWY_INLINE void store_value(const Curve& curve, hn::Vec<DoubleTag> x, float* cells, float* degrees) {
  const DoubleTag d;
  auto value = hn::Set(d, curve.coefficient[curve.terms - 1]);
  for (std::size_t k = curve.terms - 1; k-- > 0;) value = fused::mul_add(value, x, hn::Set(d, curve.coefficient[k]));
  store_degrees(value, cells, degrees);
}

// A ray of few samples: the polynomials are evaluated in double at each sample.
void positions_of_few(std::size_t count, const float* distance_m, const Curves& input, const PositionSpans& positions) {
  const DoubleTag d;
  const NarrowTag df;
  const Curves curves = input;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto x = fused::mul_sub(hn::PromoteTo(d, hn::LoadU(df, distance_m + i)), hn::Set(d, curves.scale),
                                  hn::Set(d, curves.shift));
    store_value(curves.north, x, positions.cells_north + i, positions.north_deg + i);
    store_value(curves.east, x, positions.cells_east + i, positions.east_deg + i);
  }
}

using Doubles = hn::Vec<DoubleTag>;

// Angle [rad] in (-pi, pi] of the direction (x, y); 0 if both are 0. Error 1e-12. Coefficients: Chebyshev interpolation
// on the reduced interval.
HWY_INLINE Doubles arctangent(Doubles y, Doubles x) {
  const DoubleTag d;
  constexpr double kHalfPi = 1.5707963267948966, kPi = 3.141592653589793, kTanPiBy8 = 0.41421356237309503;
  constexpr double kCoefficients[] = {0.069742085005920981, -0.08992554733325249, 0.1110345699688494,
                                      -0.14285386547576151, 0.19999993052852441,  -0.33333333276904076,
                                      0.99999999999924361};
  const auto ay = hn::Abs(y), ax = hn::Abs(x);
  const auto small = hn::Min(ay, ax), large = hn::Max(hn::Max(ay, ax), hn::Set(d, 1e-300));
  const auto folded = hn::Gt(small, hn::Mul(large, hn::Set(d, kTanPiBy8)));
  const auto t = hn::Div(hn::IfThenElse(folded, hn::Sub(small, large), small),
                         hn::IfThenElse(folded, hn::Add(small, large), large));
  const auto s = hn::Mul(t, t);
  auto p = hn::Set(d, -0.037655320648088311);
  for (const double coefficient : kCoefficients) p = fused::mul_add(p, s, hn::Set(d, coefficient));
  const auto reduced = fused::mul_add(p, t, hn::IfThenElseZero(folded, hn::Set(d, 0.5 * kHalfPi)));
  const auto first = hn::IfThenElse(hn::Lt(ay, ax), reduced, hn::Sub(hn::Set(d, kHalfPi), reduced));
  const auto upper = hn::IfThenElse(hn::Lt(x, hn::Zero(d)), hn::Sub(hn::Set(d, kPi), first), first);
  return hn::IfThenElse(hn::Lt(y, hn::Zero(d)), hn::Neg(upper), upper);
}

void positions_by_vector(std::size_t count, const float* distance_m, const VectorCurves& input,
                         const PositionSpans& positions) {
  const DoubleTag d;
  const NarrowTag df;
  const VectorCurves curves = input;
  const auto to_deg = hn::Set(d, 57.29577951308232);
  const auto apex_deg = hn::Set(d, curves.apex_east_deg);
  const auto turn_deg = hn::Set(d, 360.0);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto t =
        fused::mul_sub(hn::PromoteTo(d, hn::LoadU(df, distance_m + i)), hn::Set(d, curves.scale), hn::Set(d, 1.0));
    Doubles x = hn::Set(d, curves.difference[0][curves.knots - 1]);
    Doubles y = hn::Set(d, curves.difference[1][curves.knots - 1]);
    Doubles z = hn::Set(d, curves.difference[2][curves.knots - 1]);
    for (std::size_t k = curves.knots - 1; k-- > 0;) {
      const auto step = hn::Sub(t, hn::Set(d, curves.knot[k]));
      x = fused::mul_add(x, step, hn::Set(d, curves.difference[0][k]));
      y = fused::mul_add(y, step, hn::Set(d, curves.difference[1][k]));
      z = fused::mul_add(z, step, hn::Set(d, curves.difference[2][k]));
    }
    const auto from_axis = hn::Sqrt(fused::mul_add(x, x, hn::Mul(y, y)));
    const auto north_deg = hn::Mul(arctangent(z, from_axis), to_deg);
    // Difference from the apex, in [-180, 180): continuous across the antimeridian. At the pole any longitude is
    // correct.
    auto east_deg = hn::Sub(hn::Mul(arctangent(y, x), to_deg), apex_deg);
    const auto turns = hn::Floor(hn::Div(hn::Add(east_deg, hn::Set(d, 180.0)), turn_deg));
    east_deg = fused::neg_mul_add(turns, turn_deg, east_deg);
    east_deg = hn::IfThenElseZero(hn::Gt(from_axis, hn::Zero(d)), east_deg);
    store_degrees(hn::Sub(north_deg, hn::Set(d, curves.south_deg)), positions.cells_north + i, positions.north_deg + i);
    store_degrees(hn::Sub(hn::Add(apex_deg, east_deg), hn::Set(d, curves.west_deg)), positions.cells_east + i,
                  positions.east_deg + i);
  }
}

}  // namespace yars::model::physics::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace yars::model::physics::simd {

HWY_EXPORT(positions_on_curves);
HWY_EXPORT(positions_of_few);
HWY_EXPORT(positions_by_vector);

// Samples per piece; 0: too few samples for pieces. A piece has whole vectors of samples and is at most a twelfth of
// the ray, because a cubic in float follows a longer piece less closely.
static std::size_t piece_samples(std::size_t count) {
  constexpr std::size_t kShort = terrain::kRunSlack, kLong = 2 * kShort, kPieces = 12;
  return count >= kPieces * kLong ? kLong : count >= kPieces * kShort ? kShort : 0;
}

void positions_on_curves(std::size_t count, const float* distance_m, const Curves& curves,
                         const PositionSpans& positions) {
  if (const std::size_t piece = piece_samples(count); piece > 0)
    HWY_DYNAMIC_DISPATCH(positions_on_curves)(count, piece, distance_m, curves, positions);
  else
    HWY_DYNAMIC_DISPATCH(positions_of_few)(count, distance_m, curves, positions);
}

void positions_by_vector(std::size_t count, const float* distance_m, const VectorCurves& curves,
                         const PositionSpans& positions) {
  HWY_DYNAMIC_DISPATCH(positions_by_vector)(count, distance_m, curves, positions);
}

}  // namespace yars::model::physics::simd
#endif  // HWY_ONCE
