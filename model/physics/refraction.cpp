#include "model/physics/refraction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace yars::model::physics {

namespace {
constexpr double kRadius_m = geo::kMeanEarthRadius_m;

// Point at a distance and a height, seen from an altitude over the sphere of the mean radius, along the straight line.
struct Straight {
  Straight(double altitude_m, double distance_m, double height_m)
      : out_m((kRadius_m + height_m) * std::sin(distance_m / kRadius_m)) {
    const double half_sine = std::sin(0.5 * distance_m / kRadius_m);
    const double versine = 2.0 * half_sine * half_sine;
    up_m = height_m - altitude_m - (kRadius_m + height_m) * versine;
    level_m = altitude_m - height_m - (kRadius_m + altitude_m) * versine;
    square_m2 = out_m * out_m + up_m * up_m;
  }
  double out_m, up_m, level_m, square_m2;
};

// ---- Lifts by first order of the refractivity ---------------------------------------------------------------------

// Nodes and weights of Gauss-Legendre quadrature with eight nodes on [0, 1]. Source: Abramowitz and Stegun 1964,
// table 25.4.
constexpr std::array<double, 8> kWayNodes{0.0198550717512319, 0.1016667612931866, 0.2372337950418355,
                                          0.4082826787521751, 0.5917173212478249, 0.7627662049581645,
                                          0.8983332387068134, 0.9801449282487681};
constexpr std::array<double, 8> kWayWeights{0.0506142681451881, 0.1111905172266872, 0.1568533229389436,
                                            0.1813418916891810, 0.1813418916891810, 0.1568533229389436,
                                            0.1111905172266872, 0.0506142681451881};

// The ray at the fraction s of the way is (1 - s) s d^2 C / 2 below the chord, C the curvature of the earth less the
// mean bending. The gradient there bends it; bending at s turns the near end by 1 - s of it and the far end by s.
TracedLifts::Quotients first_order(const geo::RefractivityProfile& air, double altitude_m, double distance_m,
                                   double height_m) {
  TracedLifts::Quotients found;
  double curvature = 1.0 / kRadius_m;
  for (int i = 0; i < 3; ++i) {
    found = {};
    for (std::size_t k = 0; k < kWayNodes.size(); ++k) {
      const double s = kWayNodes[k];
      const double up_m =
          altitude_m + s * (height_m - altitude_m) - 0.5 * s * (1.0 - s) * distance_m * distance_m * curvature;
      const double bending = -kWayWeights[k] * air.gradient_per_m(up_m);
      found.of_elevation += (1.0 - s) * bending;
      found.of_grazing += s * bending;
    }
    curvature = 1.0 / kRadius_m - (found.of_elevation + found.of_grazing);
  }
  return found;
}

// ---- Series ---------------------------------------------------------------------------------------------------------

constexpr double kUnit_m2 = 370'400.0 * 370'400.0, kKilometre_m = 1000.0;  // units of the fits: (200 NM)^2, 1 km

// Weighted least squares with N unknowns.
template <std::size_t N>
class LeastSquares {
 public:
  void add(const std::array<double, N>& row, double value, double weight) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t k = 0; k < N; ++k) matrix_[i][k] += weight * weight * row[i] * row[k];
      matrix_[i][N] += weight * weight * row[i] * value;
    }
  }
  // Gauss and Jordan, without exchange of rows: the matrix is positive definite.
  std::array<double, N> solution() {
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t row = 0; row < N; ++row) {
        if (row == i) continue;
        const double factor = matrix_[row][i] / matrix_[i][i];
        for (std::size_t k = i; k <= N; ++k) matrix_[row][k] -= factor * matrix_[i][k];
      }
    std::array<double, N> found{};
    for (std::size_t i = 0; i < N; ++i) found[i] = matrix_[i][N] / matrix_[i][i];
    return found;
  }

 private:
  std::array<std::array<double, N + 1>, N> matrix_{};
};

// True if the bent ray to a point does not dip below the lowest of sea level, observer and point on its way.
bool above_horizon(const geo::RefractivityProfile& air, double altitude_m, double height_m, const Straight& straight,
                   const TracedLifts::Quotients& lift, double distance_m) {
  const double elevation_rad = std::atan2(straight.up_m + lift.of_elevation * straight.square_m2, straight.out_m);
  const bool rises_at_the_end = straight.level_m + lift.of_grazing * distance_m * distance_m < 0.0;
  if (elevation_rad > 0.0 || !rises_at_the_end) return true;
  const double lowest_m = std::min({0.0, altitude_m, height_m});
  return air.index(altitude_m) * (kRadius_m + altitude_m) * std::cos(elevation_rad) >=
         air.index(lowest_m) * (kRadius_m + lowest_m);
}

// Distances and heights of the fit: close together near the aircraft, where rays are steep.
std::vector<double> fitted_distances_m() {
  std::vector<double> distances_m{100.0, 300.0, 600.0, 1e3, 2e3, 4e3, 7e3, 10e3};
  for (int i = 0; i < 24; ++i) distances_m.push_back(15e3 + i * (370'400.0 - 15e3) / 23.0);
  return distances_m;
}
constexpr std::array<double, 7> kFittedHeights_m{-200.0, 0.0, 500.0, 1000.0, 2000.0, 3000.0, 4000.0};

LiftSeries fitted(const geo::RefractivityProfile& air, double altitude_m) {
  LeastSquares<4> near;
  LeastSquares<3> far;
  for (const double distance_m : fitted_distances_m())
    for (const double height_m : kFittedHeights_m) {
      const Straight straight(altitude_m, distance_m, height_m);
      const TracedLifts::Quotients lift = first_order(air, altitude_m, distance_m, height_m);
      if (!above_horizon(air, altitude_m, height_m, straight, lift, distance_m)) continue;
      const double v = height_m / kKilometre_m;
      const double s = straight.square_m2 / kUnit_m2, q = distance_m * distance_m / kUnit_m2;
      // Weights make errors of the lifts errors of the angles.
      near.add({s, s * s, s * v, s * s * v}, lift.of_elevation * straight.square_m2,
               straight.out_m / straight.square_m2);
      far.add({q, q * q, q * v}, lift.of_grazing * distance_m * distance_m, 1.0 / distance_m);
    }
  const auto n = near.solution();
  const auto f = far.solution();
  return {{n[0] / kUnit_m2, n[2] / kUnit_m2 / kKilometre_m, n[1] / kUnit_m2 / kUnit_m2,
           n[3] / kUnit_m2 / kUnit_m2 / kKilometre_m, 0.0},
          f[0] / kUnit_m2,
          f[1] / kUnit_m2 / kUnit_m2,
          f[2] / kUnit_m2 / kKilometre_m};
}

constexpr double kLowestTabled_m = -1000.0, kHighestTabled_m = 20'000.0,
                 kTableStep_m = 500.0;  // altitudes of the table

LiftSeries combined(const LiftSeries& a, double weight_a, const LiftSeries& b, double weight_b) {
  const auto sum = [&](double x, double y) { return weight_a * x + weight_b * y; };
  const auto &m = a.of_elevation, &n = b.of_elevation;
  return {{sum(m.level, n.level), sum(m.per_height, n.per_height), sum(m.per_square, n.per_square),
           sum(m.per_both, n.per_both), 0.0},
          sum(a.level, b.level),
          sum(a.per_square, b.per_square),
          sum(a.per_height, b.per_height)};
}

// Squared slant range beyond which the quotient of the lift stays that there. So the tangent of level ground falls with
// distance beyond the horizon, as it does in the atmosphere.
double max_square_m2(const terrain::RayLift& lift, double radius_m) {
  constexpr double kFarthest_m = 600e3;
  const double left = 0.9 * 0.5 / radius_m - lift.level;
  return lift.per_square > 0.0 ? std::clamp(left / (3.0 * lift.per_square), 0.0, kFarthest_m * kFarthest_m)
                               : kFarthest_m * kFarthest_m;
}
}  // namespace

Refraction::Refraction(const geo::RefractivityProfile& air) : air_(air) {
  const auto steps = static_cast<int>((kHighestTabled_m - kLowestTabled_m) / kTableStep_m);
  for (int i = 0; i <= steps; ++i) by_altitude_.push_back(fitted(air, kLowestTabled_m + i * kTableStep_m));
}

std::shared_ptr<const Refraction> Refraction::of(const geo::RefractivityProfile& air) {
  // Of each thread: a lock could be held when the process forks, and the child would wait for it.
  thread_local std::shared_ptr<const Refraction> last;
  if (last == nullptr || !(last->air_ == air)) last = std::make_shared<const Refraction>(air);
  return last;
}

LiftSeries Refraction::series(double altitude_m, double radius_m) const {
  const double index =
      std::clamp((altitude_m - kLowestTabled_m) / kTableStep_m, 0.0, static_cast<double>(by_altitude_.size() - 1));
  const auto below = std::min(static_cast<std::size_t>(index), by_altitude_.size() - 2);
  const double fraction = index - static_cast<double>(below);
  LiftSeries lifts = combined(by_altitude_[below], 1.0 - fraction, by_altitude_[below + 1], fraction);
  if (altitude_m > kHighestTabled_m) {
    // The air is a part of the way that falls with the altitude, near the far end.
    const double part = kHighestTabled_m / altitude_m;
    lifts = combined({lifts.of_elevation, 0.0, 0.0, 0.0}, part * part,
                     {{}, lifts.level, lifts.per_square, lifts.per_height}, part);
  }
  // A ray's height depends on the square of the distance over the earth's radius.
  const double flatter = kRadius_m / radius_m;
  lifts.of_elevation.per_square *= flatter;
  lifts.of_elevation.per_both *= flatter;
  lifts.per_square *= flatter;
  lifts.of_elevation.max_square_m2 = max_square_m2(lifts.of_elevation, radius_m);
  return lifts;
}

std::shared_ptr<const TracedLifts> Refraction::traced(double altitude_m) const {
  const std::scoped_lock lock(mutex_);
  if (traced_ != nullptr && traced_altitude_m_ == altitude_m) return traced_;
  const TracedLifts lifts(air_, altitude_m);
  if (traced_ != nullptr && traced_.use_count() == 1)
    *traced_ = lifts;
  else
    traced_ = std::make_shared<TracedLifts>(lifts);
  traced_altitude_m_ = altitude_m;
  return traced_;
}

simd::Lift in_float(const LiftSeries& lift, terrain::RaySight sight) {
  simd::Lift found;
  sight.lift = lift.of_elevation;
  found.sight = terrain::sight_series(sight);
  if (!(sight.curvature > 0.0)) return found;
  const auto& near = lift.of_elevation;
  const double radius_m = 1.0 / sight.curvature, square_m2 = radius_m * radius_m;
  // The level falls by (radius + altitude) (1 - cos a).
  const double over_m = radius_m + sight.altitude_m;
  found.level = static_cast<float>(-0.5 * over_m + lift.level * square_m2);
  found.level_square = static_cast<float>(over_m / 24.0 + lift.per_square * square_m2 * square_m2);
  found.level_height = static_cast<float>(lift.per_height * square_m2);
  found.sag = static_cast<float>(0.5 - 0.5 * (near.level + lift.level) * radius_m);
  found.sag_square = static_cast<float>(-0.5 * (near.per_square + lift.per_square) * square_m2 * radius_m);
  found.sag_height = static_cast<float>(-0.5 * (near.per_height + lift.per_height) * radius_m);
  return found;
}

// ---- Traced rays ----------------------------------------------------------------------------------------------------

namespace {
constexpr double kTracedSquare_m2 = 450e3 * 450e3, kTracedLowest_m = -1000.0, kTracedHighest_m = 20'000.0;

// A value in [-1, 1] as a number between two limits, and the inverse.
double within(double x, double low, double high) {
  return low + 0.5 * (x + 1.0) * (high - low);
}
double fraction_of(double value, double low, double high) {
  return std::clamp(2.0 * (value - low) / (high - low) - 1.0, -1.0, 1.0);
}
double chebyshev_angle(std::size_t number, std::size_t count) {
  return std::numbers::pi * (static_cast<double>(number) + 0.5) / static_cast<double>(count);
}
// Values of the first Chebyshev polynomials.
template <std::size_t N>
std::array<double, N> chebyshev(double x) {
  std::array<double, N> t{1.0, x};
  for (std::size_t i = 2; i < N; ++i) t[i] = 2.0 * x * t[i - 1] - t[i - 2];
  return t;
}
}  // namespace

TracedLifts::TracedLifts(const geo::RefractivityProfile& air, double altitude_m) {
  for (std::size_t i = 0; i < kSquares; ++i)
    for (std::size_t k = 0; k < kHeights; ++k) {
      const double square_m2 = within(std::cos(chebyshev_angle(i, kSquares)), 0.0, kTracedSquare_m2);
      const double height_m = within(std::cos(chebyshev_angle(k, kHeights)), kTracedLowest_m, kTracedHighest_m);
      const double distance_m = std::sqrt(square_m2);
      const geo::TracedRay ray = geo::trace_ray(air, kRadius_m, altitude_m, distance_m, height_m);
      const Straight straight(altitude_m, distance_m, height_m);
      const Quotients quotients{
          (std::tan(ray.elevation_rad) * straight.out_m - straight.up_m) / straight.square_m2,
          (-std::sin(ray.end.elevation_rad) * std::sqrt(straight.square_m2) - straight.level_m) / square_m2};
      for (std::size_t m = 0; m < kSquares; ++m)
        for (std::size_t n = 0; n < kHeights; ++n) {
          const double weight = (m == 0 ? 1.0 : 2.0) * (n == 0 ? 1.0 : 2.0) / (kSquares * kHeights) *
                                std::cos(static_cast<double>(m) * chebyshev_angle(i, kSquares)) *
                                std::cos(static_cast<double>(n) * chebyshev_angle(k, kHeights));
          coefficients_[m][n] += weight * quotients.of_elevation;
          coefficients_[m][kHeights + n] += weight * quotients.of_grazing;
        }
    }
}

TracedLifts::Quotients TracedLifts::at(double square_m2, double height_m) const {
  const auto squares = chebyshev<kSquares>(fraction_of(square_m2, 0.0, kTracedSquare_m2));
  const auto heights = chebyshev<kHeights>(fraction_of(height_m, kTracedLowest_m, kTracedHighest_m));
  // The sums over the squares are independent of each other, so that the compiler uses vectors.
  std::array<double, 2 * kHeights> sums{};
  for (std::size_t m = 0; m < kSquares; ++m)
    for (std::size_t n = 0; n < sums.size(); ++n) sums[n] += squares[m] * coefficients_[m][n];
  Quotients found;
  for (std::size_t n = 0; n < kHeights; ++n) {
    found.of_elevation += heights[n] * sums[n];
    found.of_grazing += heights[n] * sums[kHeights + n];
  }
  return found;
}

}  // namespace yars::model::physics
