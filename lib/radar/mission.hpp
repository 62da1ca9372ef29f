// Configuration of a mission: errors of the navigators, points of the route, limits of the cursor range for each window
// of a patch map, selected range by height.
// config/schema reads the values from GUF files.
// Units: as the suffix of each name says.
// Source: docs/spec/physics.md#navigation-errors, docs/pilots_manual.md#rule-1 and the sections cited below.
#pragma once

#include <string>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/modes.hpp"
#include "lib/values/defaults.hpp"

namespace yars::radar {

// Errors of both navigators, and their corrections by the radar. The errors are added to the navigators' positions and
// velocities; north, east and down are positive.
// Source: docs/spec/physics.md#navigation-errors.
struct NavigationConfiguration {
  double error_north_m = 0.0;       // [m] position error when the session begins
  double error_east_m = 0.0;        // [m] position error when the session begins
  double drift_north_mps = 0.0;     // [m/s] velocity error when the session begins
  double drift_east_mps = 0.0;      // [m/s] velocity error when the session begins
  double drift_down_mps = 0.0;      // [m/s] velocity error when the session begins
  double walk_mps = 0.0;            // [m/s] random walk of the velocity error: standard deviation after one hour
  double update_validity_s = 30.0;  // [s] time after a cursor move in which the cursor can update the INS
  double velocity_period_s = 60.0;  // [s] time between velocity updates
  double velocity_noise_mps = 0.1;  // [m/s] standard deviation of each measured horizontal component; about 1/3 ft/s
  std::string magnetic_model;       // model of the magnetic field, such as "wmm2020"; empty: default of GeographicLib
  std::string magnetic_folder;      // folder of the model's data; empty: default of GeographicLib
  double magnetic_year = 2025.0;    // [year] date of the magnetic field; needed, because a session has no date
  // Beams of a velocity measurement (PVU), in the order of measurement. At zero pitch and zero drift the gimbal reaches
  // the default beams at any bank angle.
  std::vector<double> beam_azimuths_deg{-30, 30, 30, -30};   // [deg] relative to the ground track, right positive
  std::vector<double> beam_depressions_deg{15, 15, 45, 45};  // [deg] below the horizontal, one for each azimuth
  double beam_dwell_s = 0.4;                                 // [s] dwell on each beam
};

// Sequence point of the route; names as in docs/pilots_manual.md#rule-11.
struct RoutePoint {
  using Values = values::WorldPoint;  // lib/values/fields.hpp
  std::string name;                   // "2", "2.", "2.1", "2.01"
  PointKind kind = PointKind::steer;
  geo::GeoPoint position;
  double elevation_m = 0.0;  // [m] above mean sea level; NaN = unknown
};

// Limits of the cursor range for each window of a patch map, and the windows of a blank selection.
// Source: docs/pilots_manual.md#rule-4.
struct WindowLimits {
  std::vector<double> windows_nm{0.67, 1.3, 3.3, 4.7, 10, 20, 40, 80};   // [NM] side of the square, ascending
  std::vector<double> min_range_nm{4.7, 4.7, 4.7, 4.7, 10, 20, 40, 80};  // [NM] minimum cursor range of each window
  std::vector<double> max_range_nm{20, 40, 50, 80, 160, 160, 160, 160};  // [NM] maximum cursor range of each window
  double blank_min_range_nm = 2.7;                      // [NM] minimum cursor range of a blank selection
  std::vector<double> blank_windows_nm{3.3, 4.7, 10};   // [NM] windows that a blank selection can give
  std::vector<double> blank_max_range_nm{50, 80, 150};  // [NM] maximum cursor range of each of these windows, ascending
  double power_up_nm = 4.7;                             // [NM] window selected at power-up
};

// Range that the radar selects by height above the surface. Source: docs/pilots_manual.md#rule-1.
struct HeightRanges {
  std::vector<double> heights_ft{500, 1000};  // [ft] ascending; a height equal to an entry has the shorter range
  std::vector<double> ranges_nm{10, 20, 40};  // [NM] range up to each height; the last value applies above all heights
};

}  // namespace yars::radar
