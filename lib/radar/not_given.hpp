// Value of a slot that a configuration does not set. What follows from it stands at the slot's field.
#pragma once

#include <limits>

namespace yars::radar {

inline constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();

}  // namespace yars::radar
