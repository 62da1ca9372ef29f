#include "model/reflectivity/sea.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "model/reflectivity/decibels.hpp"

namespace yars::model::reflectivity {

namespace {
constexpr double kGreatestState = 6.0;                          // of the model
constexpr double kSteepestRad = 60.0 * geo::kRadiansPerDegree;  // of the model

// Greatest wind [kt] of Beaufort forces 1 to 6, and the WMO state of the sea that goes with each; then state 6.
struct Force {
  double greatest_kt;
  double state;
};
constexpr std::array<Force, 6> kForces{{{3, 1}, {6, 2}, {10, 2}, {16, 3}, {21, 4}, {27, 5}}};

SeaCoefficients coefficients_of(const std::vector<double>& given) {
  SeaCoefficients coefficients{};
  std::copy_n(given.begin(), std::min(given.size(), coefficients.size()), coefficients.begin());
  return coefficients;
}
}  // namespace

double nrl_sigma0_db(const SeaCoefficients& c, double grazing_deg, double frequency_ghz, double sea_state) {
  const double a = grazing_deg;
  const double sine = std::sin(a * geo::kRadiansPerDegree);
  return c[0] + c[1] * std::log10(sine) + (27.5 + c[2] * a) * std::log10(frequency_ghz) / (1.0 + 0.95 * a) +
         c[3] * std::pow(1.0 + sea_state, 1.0 / (2.0 + 0.085 * a + 0.033 * sea_state)) + c[4] * a * a;
}

double sea_state_of_wind(geo::Speed wind) {
  const double wind_kt = std::round(wind.knots());  // the scale is one of whole knots
  if (wind_kt < 1.0) return 0.0;
  for (const Force& force : kForces) {
    if (wind_kt <= force.greatest_kt) return force.state;
  }
  return kGreatestState;
}

double upwind_db(double factor, double wavelength_m, double grazing_rad) {
  const double steepness = std::max(0.0, 1.0 - 2.8 * grazing_rad);
  return 10.0 * std::numbers::log10e * factor * steepness * std::pow(wavelength_m + 0.015, -0.4);
}

SeaReturn make_sea_return(const radar::RadarConfiguration& configuration) {
  const radar::SeaConfiguration& given = configuration.world.sea;
  SeaReturn sea;
  const bool horizontal = given.polarization == radar::Polarization::horizontal;
  sea.coefficients = coefficients_of(horizontal ? given.horizontal : given.vertical);
  sea.frequency_ghz = configuration.receiver.frequency_ghz;
  sea.wavelength_m = wavelength_m(sea.frequency_ghz);
  const double state =
      std::isnan(given.state) ? sea_state_of_wind(geo::Speed::metres_per_second(given.wind_speed_mps)) : given.state;
  sea.state = std::clamp(state, 0.0, kGreatestState);
  sea.wind_factor = given.wind_factor;
  sea.wind_from = geo::Bearing::degrees(given.wind_from_deg);
  return sea;
}

double sea_sigma0(const SeaReturn& sea, double sin_grazing, geo::Bearing look) {
  if (!(sin_grazing > 0.0)) return 0.0;
  const double grazing_rad = std::min(std::asin(std::min(sin_grazing, 1.0)), kSteepestRad);
  const double isotropic_db =
      nrl_sigma0_db(sea.coefficients, grazing_rad / geo::kRadiansPerDegree, sea.frequency_ghz, sea.state);
  const double upwind = upwind_db(sea.wind_factor, sea.wavelength_m, grazing_rad);
  return ratio(isotropic_db + upwind * std::cos((look - sea.wind_from).radians()));
}

}  // namespace yars::model::reflectivity
