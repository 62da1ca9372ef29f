// Configuration of a mission (errors of the navigators, points of the route, tables of cursor and selected ranges), and
// rules of mapping: range by height, windows of patch maps, formation time, limits of the position of a map.
// A window is the square of ground that a patch map shows, or its side length. With a blank selection the pilot has
// selected no window, and the cursor range (ground range from the aircraft to the cursor) determines the window.
// config/schema reads the values from GUF files; units are as the suffix of each name says. Inputs of the rules: the
// tables; ranges, angles and speeds as quantities.
// Source: docs/spec/physics.md#navigation-errors, #formation-time; docs/pilots_manual.md#rule-1 to #rule-5, #rule-11.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/sensor.hpp"
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

// Range that the radar selects for a height above ground or sea. A height equal to a limit of the table gives the
// shorter range. NaN gives the range above all limits. Source: docs/pilots_manual.md#rule-1.
geo::Length range_by_height(geo::Length height, const HeightRanges& table);

// Index of the shortest range that is at least `wanted`, or of the last range if all are shorter. `ranges_nm` is in
// ascending order and not empty.
std::size_t range_index_for(geo::Length wanted, std::span<const double> ranges_nm);

// Minimum and maximum cursor range at which a window can be mapped, both included.
struct CursorLimits {
  geo::Length min;
  geo::Length max;
  bool contains(geo::Length range) const { return min <= range && range <= max; }
};

// Cursor limits of a window; nullopt if the table has no window of this size.
// Source: docs/pilots_manual.md#rule-4 (tables 1 to 3 of the 1996 report).
std::optional<CursorLimits> cursor_limits(geo::Length window, const WindowLimits& table);

// Index of the largest window that does not exceed `range`; nullopt if all exceed `range`. `windows_nm` ascends.
std::optional<std::size_t> largest_window_that_fits(geo::Length range, std::span<const double> windows_nm);

// Window of a blank selection at a cursor range; nullopt if no map is possible.
std::optional<geo::Length> window_of_blank_selection(geo::Length cursor_range, const WindowLimits& table);

// Resolution cells along one edge of every window. A change of this value changes resolution and formation time.
inline constexpr int kMapCells = 480;

// Edge of a resolution cell: the window divided by kMapCells.
geo::Length map_resolution(geo::Length window);

// Number of strips, each one beam wide at the slant range, that cover the window: 1 to 1000.
int map_strips(geo::Length window, geo::Length slant_range, geo::Angle azimuth_beamwidth);

struct MapGeometry {
  geo::Length slant_range;
  geo::Length window;
  geo::Angle squint;  // horizontal angle between the ground track and the map's centre
  geo::Speed ground_speed;
  int looks = 1;
};

// Parameters that determine azimuth resolution and formation time of a synthetic array. The object copies the values.
struct SyntheticArray {
  // Converts from a configuration with the sections receiver, antenna and high_resolution, such as RadarConfiguration.
  template <class Configuration>
    requires requires(const Configuration& whole) { whole.high_resolution; }
  SyntheticArray(const Configuration& whole)
      : frequency_ghz(whole.receiver.frequency_ghz),
        azimuth_beamwidth_deg(whole.antenna.azimuth_beamwidth_deg),
        broadening(whole.high_resolution.broadening),
        max_formation_time_s(whole.high_resolution.max_formation_time_s),
        dwell_s(whole.high_resolution.dwell_s) {}

  double frequency_ghz;
  double azimuth_beamwidth_deg;  // [deg] one-way 3 dB, of the real beam
  double broadening;             // k of the weighting: half-power width of the response times the bandwidth
  double max_formation_time_s;   // [s] upper bound of the formation time
  double dwell_s;                // [s] dwell of the HRM PPI on each direction
};

// Formation time of a map, at most the configured cap: k lambda R / (2 V rho sin(squint)) for each look and each strip.
// k: broadening of the response by the weighting (a taper that lowers sidelobes); lambda: wavelength; R: slant range;
// V: ground speed; rho: azimuth resolution, equal to map_resolution().
// Source: docs/spec/physics.md#formation-time; Carrara, Goodman, Majewski, "Spotlight Synthetic Aperture Radar", 2.3.
// Example: 480 kt, 9.6 GHz, resolution 8.5 ft, slant range 20 NM and squint 90 degrees give 1.1 s for one look.
geo::Duration formation_time(const MapGeometry& geometry, const SyntheticArray& array);

// True if the line of sight is in the blind zone, which lies about the ground track ahead and astern. There the Doppler
// spread is too small for a map. Source: docs/pilots_manual.md#rule-3.
bool in_blind_zone(geo::Angle squint, double blind_zone_deg);

// Azimuth resolution of the Doppler beam sharpened scan: lambda / (2 V T sin(squint)), at most the real beam width.
// lambda: wavelength; V: ground speed; T: dwell. If the result is the real beam width, the scan is not sharpened.
geo::Angle dbs_beamwidth(geo::Angle squint, geo::Speed ground_speed, const SyntheticArray& array);

// Elevation angle from an altitude to the ground at a distance, positive above the horizontal, on a flat earth.
// `ground_m` is MSL; NaN counts as sea level.
geo::Angle elevation_to_ground(geo::AltitudeMsl altitude, geo::Length distance, double ground_m);

// Position and attitude of the aircraft.
struct MapViewpoint {
  geo::GeoPoint aircraft;
  geo::AltitudeMsl altitude;
  Platform platform;
};

// Centre of a patch map. `ground_m`: terrain elevation [m MSL]; NaN: void, counts as sea level; nullopt: not known yet;
// then only the azimuth relative to the heading is checked against the gimbal.
struct MapCentre {
  geo::GeoPoint position;
  std::optional<double> ground_m;
};

struct MapWindow {
  geo::Length size;  // zero: the pilot has selected BLANK and the window is not determined yet
  // true: window_of_blank_selection() has determined `size`. The map is then possible if the cursor limits of `size`
  // permit its range, or if a blank selection gives `size` at that range.
  bool blank = false;
};

// Limits of the position of a patch map. Antenna and table of windows must outlive this object.
struct MapLimits {
  // Converts from a configuration with the sections antenna, high_resolution and window_limits, such as
  // RadarConfiguration.
  template <class Configuration>
    requires requires(const Configuration& whole) { whole.window_limits; }
  MapLimits(const Configuration& whole)
      : antenna(whole.antenna), blind_zone_deg(whole.high_resolution.blind_zone_deg), windows(whole.window_limits) {}

  const AntennaConfiguration& antenna;
  double blind_zone_deg;  // [deg] either side of the ground track
  const WindowLimits& windows;
};

// Message of the display if a patch map about `centre` is not possible; nullopt if the map is possible. The limits of a
// re-map are the same. A position that is not finite gives "NO CURSOR". Azimuth and elevation have to be within the
// limits twice: relative to true heading and horizon, and in airframe axes. Else the message is "GIMBAL".
// Source: docs/pilots_manual.md#rule-2, #rule-3, #rule-4, #rule-5; tables 3 and 4 of the 1996 report.
std::optional<std::string_view> map_rejection(const MapViewpoint& from, const MapCentre& centre,
                                              const MapWindow& window, const MapLimits& limits);

}  // namespace yars::radar
