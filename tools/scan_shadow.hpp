// Light and shadow of a scan as text: a row for every sample of every sweep, for whoever checks it by other means.
#pragma once

#include <ostream>
#include <span>

#include "model/kernel/sweep_record.hpp"
#include "tools/trade/ray_samples.hpp"

namespace yars::tools {

// CSV with a header: sweep, azimuth_deg [0, 360) true at the aircraft, ground_range_m over ground, latitude_deg,
// longitude_deg, elevation_m MSL, lit: 1, 0 in shadow, `-` where the terrain is void or not loaded. Elevation is `-`
// there too, and the range where slant range has nothing that near. As many samples for each place.
void write_shadow(std::ostream& out, std::span<const model::kernel::SweepPlace> places,
                  std::span<const trade::RaySample> samples);

}  // namespace yars::tools
