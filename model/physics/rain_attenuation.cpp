#include "model/physics/rain_attenuation.hpp"

#include <cmath>
#include <numbers>
#include <span>

#include "lib/radar/world.hpp"

namespace yars::model::physics {

namespace {

// A term a exp(-((lg f - b) / c)^2) of a curve over the frequency f [GHz].
struct Bell {
  double a, b, c;
};

struct Curve {
  std::span<const Bell> bells;
  double slope, constant;  // of a line over lg f

  double at(double log_frequency) const {
    double sum = slope * log_frequency + constant;
    for (const Bell& bell : bells) sum += bell.a * std::exp(-std::pow((log_frequency - bell.b) / bell.c, 2.0));
    return sum;
  }
};

// Source: ITU-R P.838-3, tables 1 to 4, for equations (2) and (3).
constexpr Bell kFactorHorizontal[] = {{-5.33980, -0.10008, 1.13098},
                                      {-0.35351, 1.26970, 0.45400},
                                      {-0.23789, 0.86036, 0.15354},
                                      {-0.94158, 0.64552, 0.16817}};
constexpr Bell kFactorVertical[] = {{-3.80595, 0.56934, 0.81061},
                                    {-3.44965, -0.22911, 0.51059},
                                    {-0.39902, 0.73042, 0.11899},
                                    {0.50167, 1.07319, 0.27195}};
constexpr Bell kExponentHorizontal[] = {{-0.14318, 1.82442, -0.55187},
                                        {0.29591, 0.77564, 0.19822},
                                        {0.32177, 0.63773, 0.13164},
                                        {-5.37610, -0.96230, 1.47828},
                                        {16.1721, -3.29980, 3.43990}};
constexpr Bell kExponentVertical[] = {{-0.07771, 2.33840, -0.76284},
                                      {0.56727, 0.95545, 0.54039},
                                      {-0.20238, 1.14520, 0.26809},
                                      {-48.2991, 0.791669, 0.116226},
                                      {48.5833, 0.791459, 0.116479}};
constexpr Curve kLogFactorHorizontal{kFactorHorizontal, -0.18961, 0.71147};
constexpr Curve kLogFactorVertical{kFactorVertical, -0.16398, 0.63297};
constexpr Curve kExponentOfHorizontal{kExponentHorizontal, 0.67849, -1.95537};
constexpr Curve kExponentOfVertical{kExponentVertical, -0.053739, 0.83433};

}  // namespace

// Source: ITU-R P.838-3, equations (4) and (5).
RainLaw rain_law(double frequency_ghz, double tilt_rad, double elevation_rad) {
  const double log_frequency = std::log10(frequency_ghz);
  const double k_h = std::pow(10.0, kLogFactorHorizontal.at(log_frequency));
  const double k_v = std::pow(10.0, kLogFactorVertical.at(log_frequency));
  const double k_alpha_h = k_h * kExponentOfHorizontal.at(log_frequency);
  const double k_alpha_v = k_v * kExponentOfVertical.at(log_frequency);
  const double share = std::pow(std::cos(elevation_rad), 2.0) * std::cos(2.0 * tilt_rad);
  const double factor = 0.5 * (k_h + k_v + (k_h - k_v) * share);
  return {factor, 0.5 * (k_alpha_h + k_alpha_v + (k_alpha_h - k_alpha_v) * share) / factor};
}

RainLaw configured_rain_law(const RadarParameters& parameters) {
  const radar::RainConfiguration& rain = parameters.world.rain;
  const bool horizontal = parameters.world.sea.polarization == radar::Polarization::horizontal;
  RainLaw law = rain_law(parameters.frequency_ghz, horizontal ? 0.0 : 0.5 * std::numbers::pi, 0.0);
  if (!std::isnan(rain.attenuation_factor)) law.factor = rain.attenuation_factor;
  if (!std::isnan(rain.attenuation_exponent)) law.exponent = rain.attenuation_exponent;
  return law;
}

double rain_attenuation_db_per_m(const RainLaw& law, double rate_mmh) {
  return law.factor * std::pow(rate_mmh, law.exponent) / 1000.0;
}

}  // namespace yars::model::physics
