#include "model/physics/sea_mirror.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/radar/fidelity.hpp"
#include "lib/radar/world.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::physics {

std::complex<double> sea_reflection(radar::Polarization polarization, double sin_grazing) {
  constexpr std::complex<double> kPermittivity{65.0, -37.0};
  const std::complex<double> root = std::sqrt(kPermittivity - (1.0 - sin_grazing * sin_grazing));
  const std::complex<double> sine =
      polarization == radar::Polarization::vertical ? kPermittivity * sin_grazing : sin_grazing;
  return (sine - root) / (sine + root);
}

double sea_height_m(geo::Speed wind) {
  constexpr double kGravity = 9.80665;  // [m/s^2]
  const double wind_mps = wind.metres_per_second();
  return 0.25 * 0.21 * wind_mps * wind_mps / kGravity;
}

SeaMirror::SeaMirror(const RadarParameters& parameters)
    : works_(parameters.fidelity.sea_lobes),
      polarization_(parameters.world.sea.polarization),
      wavelength_m_(wavelength_m(parameters.frequency_ghz)),
      roughness_m_(sea_height_m(geo::Speed::metres_per_second(make_sea_return(parameters).wind_mps))) {}

double SeaMirror::lobe_factor(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m,
                              double extent_m) const {
  if (!works_ || !(height_m > 0.0)) return 1.0;
  constexpr double kBent = 4.0 / 3.0;  // over the short way from reflection to target
  const double radius_m = kBent * geo::kMeanEarthRadius_m;
  // The sea at the reflection is lower than at the target's foot, seen from the target.
  double sine = 0.0, above_m = height_m, back_m = 0.0;
  for (int i = 0; i < 3; ++i) {
    sine = earth.sight(altitude_m, distance_m - back_m, 0.0).sin_grazing;
    if (!(sine > 0.0)) return 1.0;  // below the horizon
    back_m = std::min(above_m * std::sqrt(1.0 - sine * sine) / sine, 0.5 * distance_m);
    above_m = std::max(0.0, height_m - back_m * back_m / (2.0 * radius_m));
  }
  const double rough = 2.0 * std::numbers::pi * roughness_m_ * sine / wavelength_m_;
  // 4 h1 h2 / (sum of both ways), h1 and h2 the heights of aircraft and target above the level at the reflection.
  const double rad_per_m = 4.0 * std::numbers::pi / wavelength_m_ * sine * (1.0 - back_m / distance_m);
  const std::complex<double> reflected = std::exp(-2.0 * rough * rough) * sea_reflection(polarization_, sine);
  // |1 + rho exp(j angle)|^4 = (1 + rho^2 + 2 rho cos angle)^2, and means of cosines over the angles of the extent.
  const double angle_rad = std::arg(reflected) - rad_per_m * above_m, half_rad = 0.5 * rad_per_m * extent_m;
  const auto mean_cosine = [&](double times) {
    const double half = times * half_rad;
    return std::cos(times * angle_rad) * (half > 0.0 ? std::sin(half) / half : 1.0);
  };
  const double square = std::norm(reflected), size = std::abs(reflected), sum = 1.0 + square;
  return sum * sum + 2.0 * square + 4.0 * sum * size * mean_cosine(1.0) + 2.0 * square * mean_cosine(2.0);
}

}  // namespace yars::model::physics
