#include "model/rbm/rain_path.hpp"

#include <algorithm>
#include <cmath>

#include "model/reflectivity/decibels.hpp"

namespace yars::model::rbm {

RainPath::RainPath(const radar::RadarConfiguration& configuration) : beam_(configuration.fidelity.beam) {
  const radar::RainConfiguration& rain = configuration.world.rain;
  const double wavelength_m = reflectivity::wavelength_m(configuration.receiver.frequency_ghz);
  for (const radar::RainCell& cell : rain.cells) {
    showers_.push_back({cell.place, cell.radius_m, cell.top_m,
                        reflectivity::rain_reflectivity(rain, cell.rate_mmh, wavelength_m),
                        reflectivity::rain_attenuation_db_per_m(rain, cell.rate_mmh)});
  }
  crossed_.reserve(showers_.size());
}

void RainPath::enter(const Look& look) {
  crossed_.clear();
  for (const Shower& shower : showers_) {
    const reflectivity::RainChord chord =
        reflectivity::rain_chord(look.apex, look.azimuth, shower.place, shower.radius_m);
    const bool ahead = chord.middle_m + chord.half_m > 0.0 && chord.middle_m - chord.half_m < look.range.metres();
    if (chord.half_m > 0.0 && ahead) crossed_.push_back({chord, &shower});
  }
}

double RainPath::two_way_loss(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m,
                              double slant_range_m) const {
  const double slope = slant_range_m / distance_m;  // length of the ray over its way over ground
  double loss_db = 0.0;
  for (const Crossing& crossing : crossed_) {
    const Stretch wet = stretch_below(earth, altitude_m, distance_m, height_m, crossing.shower->top_m);
    loss_db += 2.0 * slope * crossing.shower->attenuation_db_per_m * crossing.chord.integral_m(wet.from_m, wet.to_m);
  }
  return reflectivity::ratio(-loss_db);
}

double RainPath::power(const Receiver& receiver, const EffectiveEarth& earth, const Look& look, double distance_m,
                       double horizon_rad) const {
  double total = 0.0;
  for (const Crossing& crossing : crossed_) {
    const double profile = crossing.chord.profile(distance_m);
    if (!(profile > 0.0)) continue;
    const Sight top = earth.sight(look.altitude.metres(), distance_m, crossing.shower->top_m);
    const double lit_rad = beam_integral(beam_, receiver.elevation_beamwidth_rad, look.elevation.radians(), horizon_rad,
                                         top.elevation_rad);
    const double across_m2 = top.slant_range_m * receiver.azimuth_beamwidth_rad * top.slant_range_m * lit_rad;
    total += returned_power(crossing.shower->reflectivity * profile * across_m2 * receiver.pulse_length_m, 1.0,
                            top.slant_range_m);
  }
  return total;
}

Stretch stretch_below(const EffectiveEarth& earth, double altitude_m, double distance_m, double height_m,
                      double top_m) {
  // Height of the ray above the earth at the share s of the way: bow s^2 + fall s + altitude.
  const double bow_m = 0.5 * distance_m * distance_m * earth.curvature();
  const double fall_m = height_m - altitude_m - bow_m;
  const double above_m = altitude_m - top_m;
  double from = 0.0;
  double to = 1.0;
  if (bow_m == 0.0) {
    if (fall_m == 0.0) return above_m < 0.0 ? Stretch{0.0, distance_m} : Stretch{};
    (fall_m < 0.0 ? from : to) = -above_m / fall_m;
  } else {
    const double square = fall_m * fall_m - 4.0 * bow_m * above_m;
    if (square <= 0.0) return {};
    const double q = -0.5 * (fall_m + std::copysign(std::sqrt(square), fall_m));
    from = std::min(q / bow_m, above_m / q);
    to = std::max(q / bow_m, above_m / q);
  }
  return {std::clamp(from, 0.0, 1.0) * distance_m, std::clamp(to, 0.0, 1.0) * distance_m};
}

}  // namespace yars::model::rbm
