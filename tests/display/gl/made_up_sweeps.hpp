// Sweeps without video and with uniform video, for tests of the display.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "databuffer/messages/model_records.hpp"
#include "lib/geo/geodesy.hpp"

namespace yars::display::testing {

inline databuffer::Sweep blank_sweep(geo::GeoPoint apex, double left_deg, double right_deg, double range_m,
                                     std::uint32_t samples) {
  databuffer::Sweep sweep{};
  sweep.apex_latitude_deg = apex.latitude_deg;
  sweep.apex_longitude_deg = apex.longitude_deg;
  sweep.azimuth_left_deg = left_deg;
  sweep.azimuth_right_deg = right_deg;
  sweep.range_m = range_m;
  sweep.samples = samples;
  return sweep;
}

inline databuffer::Sweep toned_sweep(geo::GeoPoint apex, double left_deg, double right_deg, double range_m,
                                     std::uint32_t samples, std::uint8_t tone) {
  databuffer::Sweep sweep = blank_sweep(apex, left_deg, right_deg, range_m, samples);
  std::fill_n(sweep.video, samples, tone);
  return sweep;
}

}  // namespace yars::display::testing
