#include "lib/geo/quantity.hpp"

#include <cmath>

namespace yars::geo {

Decibels Decibels::from_ratio(double power_ratio) {
  return Decibels(10.0 * std::log10(power_ratio));
}

double Decibels::ratio() const {
  return std::pow(10.0, si_ / 10.0);
}

}  // namespace yars::geo
