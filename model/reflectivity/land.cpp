#include "model/reflectivity/land.hpp"

#include <cmath>
#include <numbers>

#include "model/reflectivity/decibels.hpp"

namespace yars::model::reflectivity {

double frequency_term_db(const radar::LandConfiguration& land, double frequency_ghz) {
  return land.frequency_slope_db * std::log10(frequency_ghz / land.reference_frequency_ghz);
}

LandReturn make_land_return(const radar::RadarConfiguration& configuration) {
  const radar::LandConfiguration& land = configuration.world.land;
  const double frequency_db = frequency_term_db(land, configuration.receiver.frequency_ghz);
  LandReturn made;
  made.street_width_deg = land.street_width_deg;
  made.gamma.fill(ratio(configuration.receiver.land_gamma_db + frequency_db));
  for (const radar::Material& material : land.materials) {
    const auto code = static_cast<std::size_t>(material.code);
    if (code >= made.gamma.size()) continue;
    made.gamma[code] = ratio(material.gamma_db + frequency_db);
    made.cardinal[code] = ratio(material.cardinal_db) - 1.0;
  }
  return made;
}

double off_street_deg(double look_deg, double street_deg) {
  constexpr double kQuarterTurn = 90.0;  // walls stand along and across the streets
  const double turn = look_deg - street_deg;
  return turn - kQuarterTurn * std::floor(turn / kQuarterTurn + 0.5);
}

double cardinal_gain(double cardinal, double off_deg, double width_deg) {
  const double share = off_deg / width_deg;
  return 1.0 + cardinal * std::exp(-4.0 * std::numbers::ln2 * share * share);
}

}  // namespace yars::model::reflectivity
