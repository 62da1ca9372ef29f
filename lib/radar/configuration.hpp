// Configuration of one radar: antenna, receiver, fidelity, maps, navigation errors, route, display.
// Inputs: none; config/schema fills it from GUF files. The defaults are those of the APG-70.
// Outputs: plain values, which every role reads. The named fidelity presets.
// Units: as the suffix of each name says; a comment [..] repeats the unit where it matters.
// Threads: values without shared state.
// Source: docs/spec/physics.md#power-and-video, docs/spec/pilots_interface.md#rule-1 and the sections cited below.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/devices.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/world.hpp"

namespace yars::radar {

// Colour of the display in sRGB. The background is always black.
struct Rgb {
  double red = 0.0, green = 0.0, blue = 0.0;  // [1] 0 to 1
};

enum class ColorPreset : std::uint8_t { green = 0, gray = 1, night = 2 };

struct ColorConfiguration {
  ColorPreset preset = ColorPreset::green;  // the preset that was applied first
  Rgb video{0.30, 0.95, 0.42};              // brightest video; its grays are fractions of it
  Rgb symbols{0.72, 1.0, 0.76};             // brighter than the brightest video
  Rgb lines{0.22, 0.55, 0.28};              // range arcs and lines, drawn below the symbols
};

// The colours of a preset: green phosphor, neutral grays, or dim red for the night.
ColorConfiguration color_preset(ColorPreset preset);

// RGB of a hue [deg] in [0, 360] (red 0, green 120, blue 240), and saturation and value in [0, 1].
Rgb rgb_from_hsv(double hue_deg, double saturation, double value);

// Antenna: gimbal, servo, beam and scan. Source: tables of the 1996 report and docs/spec/pilots_interface.md#rule-2.
struct AntennaConfiguration {
  double azimuth_rate_dps = 110.0;       // [deg/s] scan rate; FULL (100 deg) takes 0.91 s + turn-around = 1 s
  double elevation_rate_dps = 110.0;     // [deg/s]
  double azimuth_limit_deg = 60.0;       // [deg] gimbal limit, either side of the nose
  double elevation_limit_deg = 60.0;     // [deg] gimbal limit, up and down
  double tolerance_deg = 0.1;            // [deg] a commanded position counts as reached within this
  double drift_limit_deg = 10.0;         // [deg] the scan follows the ground track up to this drift
  double azimuth_beamwidth_deg = 2.5;    // [deg] one-way 3 dB
  double elevation_beamwidth_deg = 2.5;  // [deg] one-way 3 dB
  bool circular_scan = false;            // rotates continuously instead of scanning back and forth
  int scan_bars = 1;                     // elevation bars of the real beam map, 1 to 4
  double start_azimuth_deg = 0.0;        // [deg] relative to the nose, before the first scan
  double start_elevation_deg = 0.0;      // [deg] relative to the horizon, before the first scan and at power-up
};

// Radar display: visible area, size, range arcs and colours. Filled by the GUF forms RbmDisplay and Window.
struct ViewConfiguration {
  double width_min = -0.6, width_max = 0.6;    // [selected ranges] left and right edge; the aircraft is at 0
  double height_min = -0.1, height_max = 1.1;  // [selected ranges] bottom and top edge; the aircraft is at 0
  int size_pixels = 480;                       // edge of the square display
  // [NM] spacing of the range arcs for each range; the last value holds for further ranges. Empty: arcs at 25, 50, 75
  // and 100 % of the range.
  std::vector<double> arc_spacing_nm{};
  ColorConfiguration colors{};
};

enum class EarthModel : std::uint8_t { flat = 0, sphere = 1, ellipsoid = 2 };
enum class BeamPattern : std::uint8_t { hard_edge = 0, gaussian = 1, cosecant_squared = 2 };
enum class Interpolation : std::uint8_t { nearest = 0, bilinear = 1, cubic = 2 };
enum class Algorithm : std::uint8_t { standard = 0, reference = 1, report_1996 = 2 };

inline constexpr int kMaxSubBeams = 15;  // bounds the work of one sweep

// Trade of speed against accuracy: a named preset, or each parameter alone.
struct Fidelity {
  std::string name = "standard";
  bool automatic = false;    // live, the finest preset within core_share; the parameters below are the initial ones
  double core_share = 0.25;  // share of one processor core, (0, 1]
  Algorithm algorithm = Algorithm::standard;
  EarthModel earth = EarthModel::ellipsoid;
  double earth_radius_factor = 4.0 / 3.0;  // effective earth radius factor k; 1 = no refraction
  int samples = 480;                       // range samples of a sweep, 1 to 4096
  // Exact geodesic positions of a sweep, 2 to 9; the other positions are interpolated. With 5 or more, a Taylor series
  // replaces the interpolation where it is as accurate. 0: every position is exact.
  int geodesic_knots = 5;
  Interpolation interpolation = Interpolation::bilinear;
  // Maximum number of terrain posts between two samples. With more posts a coarser terrain level is read. 0: always the
  // finest level.
  double posts_per_sample = 16.0;
  int sub_beams = 1;               // rays across the beam in azimuth, weighted by its pattern; 1 = the centre only
  bool slant_range = false;        // samples at equal steps of slant range instead of ground range
  bool cross_track_slope = false;  // the angle of incidence includes the slope across the sweep
  bool noise = true;               // thermal noise, speckle and texture
  bool azimuth_smear = true;       // smear over the beam width
  bool pulse_smear = true;         // smear over the pulse length
  BeamPattern beam = BeamPattern::cosecant_squared;
  // Patch maps:
  int map_size = 480;              // [pixels] edge of the map, 16 to 1024
  int map_oversampling = 1;        // profiles and heights for each pixel, in both directions, 1 to 4
  bool map_layover = true;         // slant range geometry with layover; false: orthographic
  bool map_response = true;        // impulse response with sidelobes
  bool map_detail = true;          // synthetic texture finer than the posts
  bool map_smooth_ground = true;   // smooth ground between posts where pixels are finer; false: facets
  bool map_double_bounce = false;  // reflection between walls and ground
  double map_noise = 0.10;         // preset 1996 only: random share of the brightness, [0, 1]
};

// Receiver, and the return of land; docs/spec/physics.md#power-and-video.
struct ReceiverConfiguration {
  double frequency_ghz = 9.6;
  double stc_exponent = 3.0;       // n of the sensitivity time control (R/R0)^n
  double dynamic_range_db = 45.0;  // [dB] logarithmic receiver, black to white at gain 3
  double gain_step_db = 8.0;       // [dB] one step of GAIN 3 to 0
  double noise_floor_db = -42.0;   // [dB] thermal noise relative to full scale
  double land_gamma_db = -14.0;    // [dB] land without culture: sigma0 = gamma sin(grazing angle)
  int looks = 4;                   // independent looks that average the speckle of land and sea
};

// Patch maps and the Doppler beam sharpened scan (HRM PPI); docs/spec/physics.md#hrm.
struct HighResolutionConfiguration {
  std::vector<double> looks{2, 3};  // looks averaged at ML1 and ML2; ML2 takes 1.5 times as long
  double broadening = 1.2;          // k of the weighting: width of the response relative to 1 / bandwidth
  double sidelobe_db = -35.0;       // [dB] sidelobes of the Taylor weighting
  double formation_cap_s = 60.0;    // [s] upper bound of the formation time
  double blind_zone_deg = 8.0;      // [deg] either side of the ground track
  double sector_time_s = 18.0;      // [s] HRM PPI scan of FULL width
  double dwell_s = 0.5;             // [s] dwell of the HRM PPI on each direction
  double sector_step_deg = 0.125;   // [deg] between sweeps of the HRM PPI
  double dynamic_range_db = 45.0;   // [dB] logarithmic receiver, black to white
  double brightest_gamma_db = 8.0;  // [dB] gamma of level ground that is drawn white
  double noise_gamma_db = -34.0;    // [dB] gamma of level ground equal to thermal noise at 20 NM, window 0.67 NM
  double double_bounce_db = 6.0;    // [dB] return of a wall's foot relative to the wall, both facing the radar
  int default_material = 2;         // material code of scene faces without one; 2 = part metal
  double detail_contrast = 0.5;     // standard deviation of the synthetic detail, relative to its mean
};

// Errors of the navigators at the start, and their updates by the radar; docs/spec/physics.md#navigation-errors.
struct NavigationConfiguration {
  double error_north_m = 0.0;       // [m] position error when the session begins
  double error_east_m = 0.0;        // [m] position error when the session begins
  double drift_north_mps = 0.0;     // [m/s] velocity error when the session begins
  double drift_east_mps = 0.0;      // [m/s] velocity error when the session begins
  double drift_down_mps = 0.0;      // [m/s] velocity error when the session begins
  double walk_mps = 0.0;            // [m/s] random walk of the velocity error: standard deviation after one hour
  double update_validity_s = 30.0;  // [s] validity of a cursor designation for an INS update
  double velocity_period_s = 60.0;  // [s] between velocity updates
  double velocity_noise_mps = 0.1;  // [m/s] standard deviation of one measured horizontal component; 1/3 ft/s
  std::string magnetic_model;       // model of the earth's field, as "wmm2020"; empty: default of GeographicLib
  std::string magnetic_folder;      // folder of its data; empty: default of GeographicLib
  double magnetic_year = 2025.0;    // [year] epoch of the field; a session has no calendar date
  // Beams of a velocity measurement, in the order of the dish. In level flight the gimbal reaches the defaults at any
  // bank angle.
  std::vector<double> beam_azimuths_deg{-30, 30, 30, -30};   // [deg] relative to the ground track, right positive
  std::vector<double> beam_depressions_deg{15, 15, 45, 45};  // [deg] below the horizon; as many as azimuths
  double beam_dwell_s = 0.4;                                 // [s] on each beam
};

struct TerrainConfiguration {
  std::string directory;            // folder of the elevation files; empty: built-in analytic hills
  bool missing_cell_is_sea = true;  // a cell without a file is sea at 0 m; false: void
};

// Sequence point of the route; names as in docs/spec/pilots_interface.md#rule-11.
struct RoutePoint {
  std::string name;  // "2", "2.", "2.1", "2.01"
  PointKind kind = PointKind::steer;
  geo::GeoPoint position;
  double elevation_m = 0.0;  // [m] above mean sea level; NaN = unknown
};

// Cursor range limits of each display window, and the windows that a blank selection stands for.
// Source: docs/spec/pilots_interface.md#rule-4.
struct WindowLimits {
  std::vector<double> windows_nm{0.67, 1.3, 3.3, 4.7, 10, 20, 40, 80};   // [NM] side of the square, ascending
  std::vector<double> min_range_nm{4.7, 4.7, 4.7, 4.7, 10, 20, 40, 80};  // [NM] minimum cursor range of each window
  std::vector<double> max_range_nm{20, 40, 50, 80, 160, 160, 160, 160};  // [NM] maximum cursor range
  double blank_min_range_nm = 2.7;                      // [NM] minimum cursor range of a blank selection
  std::vector<double> blank_windows_nm{3.3, 4.7, 10};   // [NM] windows of a blank selection ...
  std::vector<double> blank_max_range_nm{50, 80, 150};  // [NM] ... and the maximum cursor range of each, ascending
  double power_up_nm = 4.7;                             // [NM] window selected at power-up
};

// Range that the radar selects by height above the surface. Source: docs/spec/pilots_interface.md#rule-1.
struct HeightRanges {
  std::vector<double> heights_ft{500, 1000};  // [ft] ascending; a height equal to a limit has the shorter range
  std::vector<double> ranges_nm{10, 20, 40};  // [NM] one more than heights; the last holds above all heights
};

struct RadarConfiguration {
  std::string name = "APG-70";
  std::vector<double> ranges_nm{4.7, 10, 20, 40, 80, 160};              // [NM] selectable, ascending
  std::vector<double> scan_widths_deg{100, 50, 25};                     // [deg] FULL, HALF, QTR
  std::vector<double> windows_nm{0.67, 1.3, 3.3, 4.7, 10, 20, 40, 80};  // [NM] selectable windows of patch maps
  std::vector<double> pulse_us{0.26, 0.5, 1, 2, 4, 6};  // [us] pulse length of each range; the last for further ranges
  AntennaConfiguration antenna;
  ViewConfiguration view;
  Fidelity fidelity;
  ReceiverConfiguration receiver;
  TerrainConfiguration terrain;
  HighResolutionConfiguration high_resolution;
  NavigationConfiguration navigation;
  WorldConfiguration world;
  std::vector<RoutePoint> route;
  std::uint64_t seed = 1;               // of all noise
  double magnetic_variation_deg = 0.0;  // [deg] east positive
  WindowLimits window_limits;
  HeightRanges height_ranges;
  std::vector<Device> devices;  // maps of cockpit hardware; the last one that matches a device is used
};

// Names of the presets: "1996", "draft", "standard", "fine", "reference", in ascending order of work.
std::span<const std::string_view> fidelity_names();

// The preset of a name, as in the GUF slot `preset` and the option `--fidelity`. nullopt: no such preset.
std::optional<Fidelity> fidelity_preset(std::string_view name);

}  // namespace yars::radar
