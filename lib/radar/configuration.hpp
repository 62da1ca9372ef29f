// Configuration of one radar: colours, antenna, receiver, maps, fidelity and its presets.
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

// Colours of the glass: what a configuration may choose. The ground is black, as on any tube.
struct Rgb {
  double red = 0.0, green = 0.0, blue = 0.0;  // [1] 0 to 1, as the display takes them (sRGB)
};

enum class ColorPreset : std::uint8_t { green = 0, gray = 1, night = 2 };

struct ColorConfiguration {
  ColorPreset preset = ColorPreset::green;  // what the colours began as
  Rgb video{0.30, 0.95, 0.42};              // full light; grays are fractions of it
  Rgb symbols{0.72, 1.0, 0.76};             // stand out from the brightest video
  Rgb lines{0.22, 0.55, 0.28};              // arcs and lines below the symbols
};

// Green phosphor; neutral grays; a dim red that spares the eyes at night.
ColorConfiguration color_preset(ColorPreset preset);

// Hue [deg] 0 to 360, red at 0 and green at 120; saturation and value [1] 0 to 1.
Rgb rgb_from_hsv(double hue_deg, double saturation, double value);

// What a configuration file settles about one radar: pure values, defaults are the APG-70's. config/ fills it
// from GUF; every role reads the same structure.

// Servo of the dish. Source: tables of the 1996 report and docs/spec/pilots_interface.md#rule-2.
struct AntennaConfiguration {
  double azimuth_rate_dps = 110.0;       // [deg/s] scanning; FULL (100 deg) then takes 0.91 s + turn-around = 1 s
  double elevation_rate_dps = 110.0;     // [deg/s]
  double azimuth_limit_deg = 60.0;       // [deg] gimbal, either side of the nose
  double elevation_limit_deg = 60.0;     // [deg] gimbal
  double tolerance_deg = 0.1;            // [deg] a commanded position counts as reached within this
  double drift_limit_deg = 10.0;         // [deg] the scan follows the ground track up to this drift
  double azimuth_beamwidth_deg = 2.5;    // [deg] one-way 3 dB
  double elevation_beamwidth_deg = 2.5;  // [deg] one-way 3 dB
  bool circular_scan = false;            // goes round instead of back and forth
  int scan_bars = 1;                     // 1-4 elevation bars of the real beam map
  double start_azimuth_deg = 0.0;        // [deg] against the nose, before the first scan
  double start_elevation_deg = 0.0;      // [deg] against the horizon, before the first scan and at power-up
};

// The glass: its edges in fractions of the selected range, its size, rings and colours. Slots of RbmDisplay and Window.
struct ViewConfiguration {
  double width_min = -0.6, width_max = 0.6;
  double height_min = -0.1, height_max = 1.1;
  int size_pixels = 480;
  // [NM] between the range arcs, by range, the last serving whatever lies beyond; empty: at 25, 50, 75 and 100 %.
  std::vector<double> arc_spacing_nm{};
  ColorConfiguration colors{};
};

enum class EarthModel : std::uint8_t { flat = 0, sphere = 1, ellipsoid = 2 };
enum class BeamPattern : std::uint8_t { hard_edge = 0, gaussian = 1, cosecant_squared = 2 };
enum class Interpolation : std::uint8_t { nearest = 0, bilinear = 1, cubic = 2 };
enum class Algorithm : std::uint8_t { standard = 0, reference = 1, report_1996 = 2 };

inline constexpr int kMaxSubBeams = 15;

// The trade of speed against accuracy, by name or knob by knob.
struct Fidelity {
  std::string name = "standard";
  bool automatic = false;    // the finest preset that holds the share below; the knobs are what it begins with
  double core_share = 0.25;  // of one core, (0, 1]
  Algorithm algorithm = Algorithm::standard;
  EarthModel earth = EarthModel::ellipsoid;
  double earth_radius_factor = 4.0 / 3.0;  // k; 1 = no refraction
  int samples = 480;                       // a sweep, 1..4096
  // Exact points a sweep, 2..9, between which places are interpolated; from 5 on a series stands in where it is as
  // good; 0 = all exact.
  int geodesic_knots = 5;
  Interpolation interpolation = Interpolation::bilinear;
  // Posts that one sample steps over at most: where the finest level has more, a coarser one serves. 0: always the
  // finest.
  double posts_per_sample = 16.0;
  int sub_beams = 1;         // rays across the beam, joined by its pattern; 1 = the middle alone
  bool slant_range = false;  // samples even in slant instead of ground range
  bool cross_track_slope = false;
  bool noise = true;
  bool azimuth_smear = true;
  bool pulse_smear = true;
  BeamPattern beam = BeamPattern::cosecant_squared;
  // Of patch maps.
  int map_size = 480;             // [pixels] on an edge, 16..1024
  int map_oversampling = 1;       // profiles and heights a pixel, along and across, 1..4
  bool map_layover = true;        // slant geometry; else orthographic
  bool map_response = true;       // impulse response with its sidelobes
  bool map_detail = true;         // made-up texture below the spacing of the posts
  bool map_smooth_ground = true;  // slopes between posts where pixels are finer; else facets
  bool map_double_bounce = false;
  double map_noise = 0.10;  // of the 1996 algorithm: random part of the brightness, [0, 1]
};

// Receiver and land/sea return; docs/spec/physics.md#power-and-video.
struct ReceiverConfiguration {
  double frequency_ghz = 9.6;
  double stc_exponent = 3.0;       // sensitivity time control (R/R0)^n
  double dynamic_range_db = 45.0;  // [dB] of the log receiver, black to white at gain 3
  double gain_step_db = 8.0;       // [dB] a step of GAIN 3..0
  double noise_floor_db = -42.0;   // [dB] thermal noise below full scale
  double land_gamma_db = -14.0;    // [dB] sigma0 = gamma sin(psi)
  int looks = 4;                   // of land and sea speckle
};

// The high resolution map; docs/spec/physics.md#hrm.
struct HighResolutionConfiguration {
  std::vector<double> looks{2, 3};  // averaged at ML1, ML2: ML2 takes half as long again
  double broadening = 1.2;          // k of the weighting: how much wider than 1 / bandwidth the response is
  double sidelobe_db = -35.0;       // [dB] of the Taylor weighting
  double formation_cap_s = 60.0;    // [s] no map takes longer
  double blind_zone_deg = 8.0;      // [deg] either side of the ground track
  double sector_time_s = 18.0;      // [s] of a Doppler beam sharpened scan of FULL width
  double dwell_s = 0.5;             // [s] for which each direction of that scan is looked at
  double sector_step_deg = 0.125;   // [deg] between its sweeps
  double dynamic_range_db = 45.0;   // [dB] of the log receiver, black to white
  double brightest_gamma_db = 8.0;  // [dB] gamma of level ground that is white
  double noise_gamma_db = -34.0;    // [dB] gamma of level ground that thermal noise at 20 NM, window 0.67 NM, is worth
  double double_bounce_db = 6.0;    // [dB] of a wall's foot against the wall, where both face the radar
  int plain_material = 2;           // code of a scene's faces that have none: part metal
  double detail_contrast = 0.5;     // standard deviation of the made-up detail below the posts, as a share
};

// What the navigators have wrong from the start, and how the radar puts it right;
// docs/spec/physics.md#navigation-errors.
struct NavigationConfiguration {
  double error_north_m = 0.0;       // [m] of position when the session begins
  double error_east_m = 0.0;        // [m]
  double drift_north_mps = 0.0;     // [m/s] of velocity when the session begins
  double drift_east_mps = 0.0;      // [m/s]
  double drift_down_mps = 0.0;      // [m/s]
  double walk_mps = 0.0;            // [m/s] random walk of the velocity error: standard deviation after an hour
  double update_validity_s = 30.0;  // [s] for which a cursor placed serves an INS update
  double velocity_period_s = 60.0;  // [s] between velocity updates
  double velocity_noise_mps =
      0.1;  // [m/s] standard deviation of a horizontal component that the radar measures: a third of a ft/s
  std::string magnetic_model;  // of the earth's field, "wmm2020"; empty: the library's own choice, if its data is there
  std::string magnetic_folder;    // where its data lies; empty: the system's
  double magnetic_year = 2025.0;  // [year] the field drifts; a session has no date of its own
  // The beams of a measurement, in the order in which the dish takes them. In level flight the gimbal reaches these in
  // any bank.
  std::vector<double> beam_azimuths_deg{-30, 30, 30, -30};   // [deg] against the ground track, right positive
  std::vector<double> beam_depressions_deg{15, 15, 45, 45};  // [deg] below the horizon; as many
  double beam_dwell_s = 0.4;                                 // [s] on each beam
};

struct TerrainConfiguration {
  std::string directory;            // empty: the built-in analytic hills
  bool missing_cell_is_sea = true;  // an absent cell is sea at 0 m; false: void
};

// One point of the route; names as in docs/spec/pilots_interface.md#rule-11.
struct RoutePoint {
  std::string name;  // "2", "2.", "2.1", "2.01"
  PointKind kind = PointKind::steer;
  geo::GeoPoint place;
  double elevation_m = 0.0;  // [m] MSL; NaN = unknown
};

// Where the cursor may be for each display window, and what a blank window stands for.
// Source: docs/spec/pilots_interface.md#rule-4.
struct WindowLimits {
  std::vector<double> windows_nm{0.67, 1.3, 3.3, 4.7, 10, 20, 40, 80};  // [NM] side of the square, ascending
  std::vector<double> least_nm{4.7, 4.7, 4.7, 4.7, 10, 20, 40, 80};     // [NM] cursor range, a number a window
  std::vector<double> greatest_nm{20, 40, 50, 80, 160, 160, 160, 160};  // [NM]
  double blank_least_nm = 2.7;                                          // [NM] nearer, a blank window is rejected
  std::vector<double> blank_windows_nm{3.3, 4.7, 10};                   // [NM] what it stands for ...
  std::vector<double> blank_up_to_nm{50, 80, 150};                      // [NM] ... up to this cursor range, ascending
  double power_up_nm = 4.7;                                             // [NM] selected at power-up
};

// Low over ground a short range, high up a long one. Source: docs/spec/pilots_interface.md#rule-1.
struct HeightRanges {
  std::vector<double> heights_ft{500, 1000};  // [ft] ascending; each belongs to the lower range
  std::vector<double> ranges_nm{10, 20, 40};  // [NM] one more than heights; the last holds above all of them
};

struct RadarConfiguration {
  std::string name = "APG-70";
  std::vector<double> ranges_nm{4.7, 10, 20, 40, 80, 160};
  std::vector<double> scan_widths_deg{100, 50, 25};  // FULL, HALF, QTR
  std::vector<double> windows_nm{0.67, 1.3, 3.3, 4.7, 10, 20, 40, 80};
  std::vector<double> pulse_us{0.26, 0.5, 1, 2, 4, 6};  // by range; the last serves whatever lies beyond
  AntennaConfiguration antenna;
  ViewConfiguration view;
  Fidelity fidelity;
  ReceiverConfiguration receiver;
  TerrainConfiguration terrain;
  HighResolutionConfiguration high_resolution;
  NavigationConfiguration navigation;
  WorldConfiguration world;
  std::vector<RoutePoint> route;
  std::uint64_t seed = 1;
  double magnetic_variation_deg = 0.0;  // [deg] east positive
  WindowLimits window_limits;
  HeightRanges height_ranges;
  std::vector<Device> devices;  // maps of cockpit hardware, the last that fits wins
};

// The named settings of the trade of speed against accuracy; slot `preset` of GUF and `--fidelity` of the tools.

// "1996", "draft", "standard", "fine", "reference": from least to most work.
std::span<const std::string_view> fidelity_names();

std::optional<Fidelity> fidelity_preset(std::string_view name);

}  // namespace yars::radar
