// Configuration of one radar: all sections. Code that uses few sections includes the headers of these sections instead.
// config/schema reads the values from GUF files. The defaults are the values of the APG-70.
// Units: as the suffix of each name says.
// Source: docs/spec/physics.md#power-and-video, docs/pilots_manual.md#rule-1.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "lib/radar/devices.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/sensor.hpp"
#include "lib/radar/view.hpp"
#include "lib/radar/world.hpp"

namespace yars::radar {

struct RadarConfiguration {
  std::string name = "APG-70";
  std::vector<double> ranges_nm{4.7, 10, 20, 40, 80, 160};              // [NM] selectable ranges, ascending
  std::vector<double> scan_widths_deg{100, 50, 25};                     // [deg] FULL, HALF, QTR
  std::vector<double> windows_nm{0.67, 1.3, 3.3, 4.7, 10, 20, 40, 80};  // [NM] selectable windows of patch maps
  // [us] Pulse length of each range. The last value also applies to ranges without a value.
  std::vector<double> pulse_us{0.26, 0.5, 1, 2, 4, 6};
  AntennaConfiguration antenna;
  ViewConfiguration view;
  Fidelity fidelity;
  ReceiverConfiguration receiver;
  TerrainConfiguration terrain;
  HighResolutionConfiguration high_resolution;
  NavigationConfiguration navigation;
  WorldConfiguration world;
  std::vector<RoutePoint> route;
  std::uint64_t seed = 1;  // seed of all noise
  // [deg] Magnetic variation, east positive, used if no other source gives one. NaN: unknown.
  double magnetic_variation_deg = std::numeric_limits<double>::quiet_NaN();
  WindowLimits window_limits;
  HeightRanges height_ranges;
  std::vector<Device> devices;  // event maps of cockpit hardware; the last map that fits a device is used
};

}  // namespace yars::radar
