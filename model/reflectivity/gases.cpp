#include "model/reflectivity/gases.hpp"

#include <algorithm>
#include <cmath>

#include "model/reflectivity/gas_lines.hpp"

namespace yars::model::reflectivity {

namespace {
constexpr double kLowest_m = -1000.0, kHighest_m = 30'000.0, kStep_m = 100.0;
constexpr double kKelvin = 273.15;  // [K] of 0 degrees Celsius

// Imaginary part of the refractivity, times 10^6, by equations (2) and following.
double oxygen(double f, const Air& air, double theta, double vapour_hpa) {
  double sum = 0.0;
  for (const GasLine& line : kOxygenLines) {
    const double at = line[0];
    const double strength = line[1] * 1e-7 * air.dry_hpa * std::pow(theta, 3.0) * std::exp(line[2] * (1.0 - theta));
    const double pressed = line[3] * 1e-4 * (air.dry_hpa * std::pow(theta, 0.8 - line[4]) + 1.1 * vapour_hpa * theta);
    const double width = std::sqrt(pressed * pressed + 2.25e-6);
    const double mixing = (line[5] + line[6] * theta) * 1e-4 * (air.dry_hpa + vapour_hpa) * std::pow(theta, 0.8);
    const double shape = (width - mixing * (at - f)) / ((at - f) * (at - f) + width * width) +
                         (width - mixing * (at + f)) / ((at + f) * (at + f) + width * width);
    sum += strength * f / at * shape;
  }
  return sum;
}

// Pressure-induced nitrogen and the Debye spectrum.
double dry_continuum(double f, const Air& air, double theta, double vapour_hpa) {
  const double width = 5.6e-4 * (air.dry_hpa + vapour_hpa) * std::pow(theta, 0.8);
  const double debye = 6.14e-5 / (width * (1.0 + f / width * (f / width)));
  const double nitrogen = 1.4e-12 * air.dry_hpa * std::pow(theta, 1.5) / (1.0 + 1.9e-5 * std::pow(f, 1.5));
  return f * air.dry_hpa * theta * theta * (debye + nitrogen);
}

double vapour(double f, const Air& air, double theta, double vapour_hpa) {
  double sum = 0.0;
  for (const GasLine& line : kWaterLines) {
    const double at = line[0];
    const double strength = line[1] * 1e-1 * vapour_hpa * std::pow(theta, 3.5) * std::exp(line[2] * (1.0 - theta));
    const double pressed =
        line[3] * 1e-4 * (air.dry_hpa * std::pow(theta, line[4]) + line[5] * vapour_hpa * std::pow(theta, line[6]));
    const double width = 0.535 * pressed + std::sqrt(0.217 * pressed * pressed + 2.1316e-12 * at * at / theta);
    sum += strength * f / at *
           (width / ((at - f) * (at - f) + width * width) + width / ((at + f) * (at + f) + width * width));
  }
  return sum;
}
}  // namespace

GasAttenuation gas_attenuation(double frequency_ghz, const Air& air) {
  const double theta = 300.0 / air.temperature_k;
  const double vapour_hpa = air.water_g_m3 * air.temperature_k / 216.7;
  const double scale = 0.1820 * frequency_ghz;
  return {
      scale * (oxygen(frequency_ghz, air, theta, vapour_hpa) + dry_continuum(frequency_ghz, air, theta, vapour_hpa)),
      scale * vapour(frequency_ghz, air, theta, vapour_hpa)};
}

Air reference_air(const radar::AtmosphereConfiguration& atmosphere, double height_m) {
  constexpr double kLapse = 6.5, kUpperRise = 1.0;  // [K/km]
  constexpr double kTropopause_km = 11.0, kMiddle_km = 20.0;
  constexpr double kExponent = 34.1632;  // [K/km] of hydrostatic air
  constexpr double kWaterScale_km = 2.0;
  const double height_km = height_m / 1000.0;
  const double ground_k = atmosphere.temperature_c + kKelvin;
  const double low_k = ground_k - kLapse * std::min(height_km, kTropopause_km);
  Air air{low_k, atmosphere.pressure_hpa * std::pow(low_k / ground_k, kExponent / kLapse),
          atmosphere.water_g_m3 * std::exp(-height_km / kWaterScale_km)};
  if (height_km > kTropopause_km)
    air.dry_hpa *= std::exp(-kExponent * (std::min(height_km, kMiddle_km) - kTropopause_km) / low_k);
  if (height_km > kMiddle_km) {
    air.temperature_k = low_k + kUpperRise * (height_km - kMiddle_km);
    air.dry_hpa *= std::pow(low_k / air.temperature_k, kExponent / kUpperRise);
  }
  return air;
}

GasProfile::GasProfile(const radar::AtmosphereConfiguration& atmosphere, double frequency_ghz) {
  if (!atmosphere.gases) return;
  for (double height_m = kLowest_m; height_m <= kHighest_m; height_m += kStep_m) {
    const GasAttenuation found = gas_attenuation(frequency_ghz, reference_air(atmosphere, height_m));
    db_per_m_.push_back((found.dry + found.water) / 1000.0);
  }
}

double GasProfile::db_per_m(double height_m) const {
  const double place = std::clamp((height_m - kLowest_m) / kStep_m, 0.0, static_cast<double>(db_per_m_.size() - 1));
  const auto below = std::min(static_cast<std::size_t>(place), db_per_m_.size() - 2);
  const double share = place - static_cast<double>(below);
  return db_per_m_[below] + share * (db_per_m_[below + 1] - db_per_m_[below]);
}

}  // namespace yars::model::reflectivity
