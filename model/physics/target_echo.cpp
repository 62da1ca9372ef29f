#include "model/physics/target_echo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lib/geo/frames.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/cross_section.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/random/counter_rng.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::physics {

namespace {

constexpr std::uint64_t kTargetDraws = 0x5377657231ULL;  // sets these draws apart from the other noise of a seed

// Components of a direction along a reflector's axis, to the right of it, and upwards.
geo::Vector3 in_reflector_frame(const PointTarget& target, Aspect to_radar) {
  const double off_rad = to_radar.azimuth_rad - target.facing_deg * geo::kRadiansPerDegree;
  const double tilt_rad = target.tilt_deg * geo::kRadiansPerDegree;
  const double ahead = std::cos(to_radar.elevation_rad) * std::cos(off_rad), up = std::sin(to_radar.elevation_rad);
  return {ahead * std::cos(tilt_rad) + up * std::sin(tilt_rad), std::cos(to_radar.elevation_rad) * std::sin(off_rad),
          up * std::cos(tilt_rad) - ahead * std::sin(tilt_rad)};
}

// Equivalent flat area of a trihedral of right triangles over that on its axis, by the direction cosines with its
// edges. Two edges are level if the axis is 35.26 degrees above the horizontal; the third is in the axis' vertical
// plane.
double trihedral_area(geo::Vector3 to_radar) {
  const double along = to_radar.x / std::sqrt(3.0), side = to_radar.y / std::sqrt(2.0);
  std::array<double, 3> cosines{along + to_radar.z * std::sqrt(2.0 / 3.0), along - to_radar.z / std::sqrt(6.0) + side,
                                along - to_radar.z / std::sqrt(6.0) - side};
  std::ranges::sort(cosines);
  const auto [least, middle, greatest] = cosines;
  if (!(least > 0.0)) return 0.0;
  const double sum = least + middle + greatest;
  return std::sqrt(3.0) * (greatest <= least + middle ? sum - 2.0 / sum : 4.0 * least * middle / sum);
}

// The same for a dihedral of two squares with a level seam across the axis. Off the seam's normal the field falls as
// that of an even line as long as the seam.
double dihedral_area(geo::Vector3 to_radar, double edge_m, double wavelength_m) {
  const double across = std::max(to_radar.x - std::abs(to_radar.z), 0.0);
  const double phase_rad = 2.0 * std::numbers::pi * edge_m / wavelength_m * to_radar.y;
  return across * (std::abs(phase_rad) > 1e-6 ? std::sin(phase_rad) / phase_rad : 1.0);
}

}  // namespace

Aspect aspect_of(geo::GeoPoint target, geo::GeoPoint radar, const Sight& sight) {
  return {geo::geodesic_inverse(target, radar).azimuth_at_start.radians(),
          std::asin(std::clamp(sight.sin_grazing, -1.0, 1.0))};
}

double swerling_factor(radar::TargetEcho echo, std::uint64_t seed, std::uint32_t scan, std::uint64_t target) {
  const bool third = echo == radar::TargetEcho::swerling3;
  if (!third && echo != radar::TargetEcho::swerling1) return 1.0;
  random::CounterRng draws(
      random::splitmix64(random::splitmix64(random::splitmix64(seed ^ kTargetDraws) ^ scan) ^ target));
  const double first = -std::log1p(-draws.uniform());
  return third ? 0.5 * (first - std::log1p(-draws.uniform())) : first;
}

double reflector_gain(const PointTarget& target, double frequency_ghz, Aspect to_radar) {
  const geo::Vector3 direction = in_reflector_frame(target, to_radar);
  const double area = target.echo == radar::TargetEcho::trihedral
                          ? trihedral_area(direction)
                          : dihedral_area(direction, radar::dihedral_edge_m(target.cross_section_m2, frequency_ghz),
                                          wavelength_m(frequency_ghz));
  return area * area;
}

TargetEchoes::TargetEchoes(const RadarParameters& parameters)
    : fluctuate_(parameters.noise && parameters.algorithm != radar::Algorithm::report_1996),
      frequency_ghz_(parameters.frequency_ghz),
      seed_(parameters.seed) {}

}  // namespace yars::model::physics
