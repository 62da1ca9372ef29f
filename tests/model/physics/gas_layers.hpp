// Gas attenuation along a ray, summed over short segments with the air at the middle of each. Tests compare the radar's
// integrals with this sum.
#pragma once

#include <cmath>

#include "lib/radar/configuration.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/sweep_geometry.hpp"

namespace yars::test {

// One-way attenuation [dB] from an aircraft at `altitude_m` to a point at `distance_m` over ground and `height_m`.
// `radius_m`: radius of the effective earth, on which rays are straight.
inline double gases_in_layers_db(const radar::RadarConfiguration& configuration, double radius_m, double altitude_m,
                                 double distance_m, double height_m) {
  constexpr int kSegments = 2000;
  const double length_m =
      model::physics::EffectiveEarth(radius_m).sight(altitude_m, distance_m, height_m).slant_range_m;
  // Both ends of the ray, a and b, relative to the earth's centre.
  const double angle = distance_m / radius_m;
  const double ax = 0.0, ay = radius_m + altitude_m;
  const double bx = (radius_m + height_m) * std::sin(angle), by = (radius_m + height_m) * std::cos(angle);
  double sum_db = 0.0;
  for (int segment = 0; segment < kSegments; ++segment) {
    const double fraction = (segment + 0.5) / kSegments;
    const double above_m = std::hypot(ax + fraction * (bx - ax), ay + fraction * (by - ay)) - radius_m;
    const auto db_per_km = model::physics::gas_attenuation(
        configuration.receiver.frequency_ghz, model::physics::reference_air(configuration.world.atmosphere, above_m));
    sum_db += (db_per_km.dry + db_per_km.water) / 1000.0 * length_m / kSegments;
  }
  return sum_db;
}

}  // namespace yars::test
