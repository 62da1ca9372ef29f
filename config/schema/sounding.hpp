// Radiosonde ascents: the exponential profile of refractivity that fits one best.
// Inputs: a CSV file. Its first line names the columns: `height_m` [m MSL], and either `refractivity` [N-units], or
// `pressure_hpa`, `temperature_c` and one of `dewpoint_c` and `humidity_percent`. Other columns are left out, as are
// lines with an empty field in one of these. Comments begin with `#`.
// Outputs: refractivity at mean sea level [N-units] and its fall [1/km].
// Errors: of the file; fewer than five levels; heights that do not ascend; a duct, in which refractivity falls by more
// than 157 N-units per km, as fast as the earth curves: no ray of this model follows it; a profile out of the limits
// of the slots.
// Source: ITU-R P.453-14, eq. 1, 6, 9 (refractivity, vapour pressure over water); least squares of the logarithm,
// weighted by the square of the refractivity.
#pragma once

#include <string>

#include "lib/error/error.hpp"

namespace yars::config {

struct FittedProfile {
  double refractivity = 0.0, per_km = 0.0;
};
error::Expected<FittedProfile> profile_of_sounding(const std::string& path);

}  // namespace yars::config
