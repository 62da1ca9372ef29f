// Power ratios and decibels.
#pragma once

#include <cmath>

namespace yars::model::reflectivity {

inline double ratio(double decibels) {
  return std::pow(10.0, 0.1 * decibels);
}

inline constexpr double kSpeedOfLight = 299792458.0;  // [m/s] exact

inline double wavelength_m(double frequency_ghz) {
  return kSpeedOfLight / (frequency_ghz * 1e9);
}

}  // namespace yars::model::reflectivity
