// Refraction of a sweep's rays by the exponential atmosphere (lib/geo/refraction.hpp): how much the elevation and the
// grazing angle of a point exceed those of the straight line to it.
// Lift [m]: the point's tangent of elevation is (up + lift) / out, its sine of the grazing angle (level + lift) / slant
//   range. Out, up, level and slant range are those of the straight line over the true sphere, EffectiveEarth::sight().
// Inputs: refractivity; altitude of the observer, height of the point (both above mean sea level), distance [m].
// Accuracy: LiftSeries 0.05 mrad of elevation and 0.12 mrad of grazing angle, for points up to 4 km high that are above
//   the horizon of an observer from 500 to 50,000 ft, within 200 NM. TracedLifts 0.005 mrad within 450 km.
//   (tests/model/physics/refraction_test.cpp)
// Threads: any thread may call any function.
// Source: docs/spec/physics.md#refraction.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "lib/geo/refraction.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::physics {

// Lifts from one altitude as polynomials, for the fast path.
struct LiftSeries {
  terrain::RayLift of_elevation;
  // Lift of the grazing angle: q (level + per_square q + per_height height), q the squared distance over ground.
  double level = 0.0, per_square = 0.0, per_height = 0.0;

  double of_grazing_m(double square_m2, double height_m) const {
    return square_m2 * (level + per_square * square_m2 + per_height * height_m);
  }
};

// LiftSeries in float, for vectors. a is the distance over the radius, h the height, d the distance over ground.
namespace simd {
struct Lift {
  terrain::SightSeries sight;
  // Slant range times the sine of the grazing angle: altitude + a a (level + level_square a a) - h (1 - level_height a
  // a).
  float level = 0.0F, level_square = 0.0F, level_height = 0.0F;
  // EffectiveEarth::sag_m(): d a (sag + sag_square a a + sag_height h).
  float sag = 0.5F, sag_square = 0.0F, sag_height = 0.0F;
};
}  // namespace simd
// `sight` has the observer and, as its last distance, the greatest one. Its lift is not used.
simd::Lift in_float(const LiftSeries& lift, terrain::RaySight sight);

// Lifts from one altitude, interpolated between traced rays (Chebyshev polynomials in squared distance and height).
class TracedLifts {
 public:
  TracedLifts(const geo::RefractivityProfile& air, double altitude_m);

  // The lifts divided by the squared slant range and by the squared distance. `square_m2`: squared distance. Beyond
  // 450 km and 20 km of height they are those there.
  struct Quotients {
    double of_elevation = 0.0, of_grazing = 0.0;  // [1/m]
  };
  Quotients at(double square_m2, double height_m) const;

 private:
  static constexpr std::size_t kSquares = 8, kHeights = 10;
  // By power of the squared distance: those of the elevation, then those of the grazing angle, by power of the height.
  std::array<std::array<double, 2 * kHeights>, kSquares> coefficients_{};
};

// Lifts of one atmosphere from all altitudes.
class Refraction {
 public:
  explicit Refraction(const geo::RefractivityProfile& air);
  // The last object of the thread, if it has this atmosphere, else a new one.
  static std::shared_ptr<const Refraction> of(const geo::RefractivityProfile& air);

  // `radius_m`: radius of curvature of the earth along the ray.
  LiftSeries series(double altitude_m, double radius_m) const;
  // Keeps those of the last altitude, in the same memory if nobody else uses them.
  std::shared_ptr<const TracedLifts> traced(double altitude_m) const;
  const geo::RefractivityProfile& air() const { return air_; }

 private:
  geo::RefractivityProfile air_;
  std::vector<LiftSeries> by_altitude_;
  mutable std::mutex mutex_;
  mutable double traced_altitude_m_ = 0.0;
  mutable std::shared_ptr<TracedLifts> traced_;
};

}  // namespace yars::model::physics
