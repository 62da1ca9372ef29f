// Gas attenuation along a ray, summed over short segments with the air at the middle of each. Reference for the radar's
// integrals.
#pragma once

#include <cmath>

#include "lib/radar/configuration.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::test {

inline double gases_in_layers_db(const radar::RadarConfiguration& configuration, double radius_m, double altitude_m,
                                 double distance_m, double height_m) {
  constexpr int kPieces = 2000;
  const double length_m =
      model::physics::EffectiveEarth(radius_m).sight(altitude_m, distance_m, height_m).slant_range_m;
  // From the middle of the earth: the ends, and what lies between on a straight line.
  const double angle = distance_m / radius_m;
  const double ax = 0.0, ay = radius_m + altitude_m;
  const double bx = (radius_m + height_m) * std::sin(angle), by = (radius_m + height_m) * std::cos(angle);
  double sum_db = 0.0;
  for (int piece = 0; piece < kPieces; ++piece) {
    const double share = (piece + 0.5) / kPieces;
    const double above_m = std::hypot(ax + share * (bx - ax), ay + share * (by - ay)) - radius_m;
    const auto found = model::physics::gas_attenuation(
        configuration.receiver.frequency_ghz, model::physics::reference_air(configuration.world.atmosphere, above_m));
    sum_db += (found.dry + found.water) / 1000.0 * length_m / kPieces;
  }
  return sum_db;
}

}  // namespace yars::test
