// Ratio of two powers in decibels.
#pragma once

#include <cmath>

namespace yars::model {

inline double decibels(double ratio) {
  return 10.0 * std::log10(ratio);
}

}  // namespace yars::model
