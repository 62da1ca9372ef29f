// Configuration of the sensor: antenna, receiver, patch maps and Doppler beam sharpening. Directions in airframe axes,
// and the limits of the antenna's gimbal.
// config/schema reads the values from GUF files. The defaults are those of the APG-70.
// Inputs of directions: attitude of the aircraft; true azimuth and elevation above the horizontal.
// Units: as the suffix of each name says.
// Source: docs/spec/physics.md#power-and-video, docs/spec/physics.md#hrm, docs/pilots_manual.md#rule-2.
#pragma once

#include <vector>

#include "lib/geo/quantity.hpp"
#include "lib/radar/modes.hpp"

namespace yars::radar {

// Antenna: gimbal, servo, beam and scan. Source: tables of the 1996 report and docs/pilots_manual.md#rule-2.
struct AntennaConfiguration {
  double azimuth_rate_dps = 110.0;       // [deg/s] scan rate; FULL (100 deg) takes 0.91 s + turn-around = 1 s
  double elevation_rate_dps = 110.0;     // [deg/s]
  double azimuth_limit_deg = 60.0;       // [deg] gimbal limit, either side of the nose
  double elevation_limit_deg = 60.0;     // [deg] gimbal limit, up and down
  double tolerance_deg = 0.1;            // [deg] maximum servo error at which a position counts as reached
  double drift_limit_deg = 10.0;         // [deg] the scan centre follows the ground track up to this angle off the nose
  double azimuth_beamwidth_deg = 2.5;    // [deg] one-way 3 dB
  double elevation_beamwidth_deg = 2.5;  // [deg] one-way 3 dB
  bool circular_scan = false;            // true: the antenna rotates continuously; false: it scans back and forth
  int scan_bars = 1;                     // elevation bars of the real beam map, 1 to 4
  double start_azimuth_deg = 0.0;        // [deg] relative to the nose, before the first scan
  double start_elevation_deg = 0.0;      // [deg] relative to the horizon, before the first scan and at power-up
};

// Receiver, and the return of land; docs/spec/physics.md#power-and-video.
struct ReceiverConfiguration {
  double frequency_ghz = 9.6;  // [GHz]
  // n of the sensitivity time control (R / 40 NM)^n, R: slant range. kNotGiven: that which makes flat land even in
  // range with the beam of the fidelity.
  double stc_exponent = kNotGiven;
  bool automatic_gain = true;      // level land at half the selected range has one brightness from every altitude
  double dynamic_range_db = 45.0;  // [dB] power ratio of white to black at gain 3, logarithmic receiver
  double gain_step_db = 8.0;       // [dB] gain change between neighbouring settings GAIN 3, 2, 1, 0
  double noise_floor_db = -55.0;   // [dB] thermal noise relative to full scale, with the pulse of 40 NM
  double land_gamma_db = -14.0;    // [dB] gamma of land without culture: sigma0 = gamma sin(grazing angle)
  int looks = 0;                   // independent looks averaged in each sample; 0: by the Doppler spread in the beam
};

// Patch maps and the Doppler beam sharpened scan (HRM PPI); docs/spec/physics.md#hrm.
struct HighResolutionConfiguration {
  std::vector<double> looks{2, 3};     // looks averaged at ML1 and ML2; ML2 takes 1.5 times as long
  double broadening = 1.2;             // k of the weighting: half-power width of the response times the bandwidth
  double sidelobe_db = -35.0;          // [dB] level of the highest sidelobes of the Taylor weighting
  double max_formation_time_s = 60.0;  // [s] upper bound of the formation time
  double blind_zone_deg = 8.0;         // [deg] blind zone either side of the ground track, ahead and astern
  double sector_time_s = 18.0;         // [s] duration of an HRM PPI scan of FULL width
  double dwell_s = 0.5;                // [s] dwell of the HRM PPI on each direction
  double sector_step_deg = 0.125;      // [deg] azimuth between sweeps of the HRM PPI
  double dynamic_range_db = 45.0;      // [dB] power ratio of white to black, logarithmic receiver
  double brightest_gamma_db = 8.0;     // [dB] gamma of level ground that is drawn white
  double noise_gamma_db = -34.0;       // [dB] thermal noise at 20 NM, window 0.67 NM, as the gamma of level ground
  double double_bounce_db = 6.0;       // [dB] double reflection by wall and ground, relative to the cardinal effect
  int default_material = 2;            // material code of scene faces without one; 2 = part metal
  double detail_contrast = 0.5;        // standard deviation of the natural logarithm of the ground texture's factor
};

// Attitude and ground track of the aircraft. Heading and track are true. Pitch is positive with the nose up, roll with
// the right wing down.
struct Platform {
  geo::Bearing heading;
  geo::Angle pitch;
  geo::Angle roll;
  geo::Bearing ground_track;  // equals the heading at ground speeds below 1 m/s
};

struct GimbalAngles {
  geo::Angle azimuth;    // positive right of the nose
  geo::Angle elevation;  // positive above the wing plane
};
// Rotates a direction (true azimuth, elevation above the horizontal) into airframe axes.
GimbalAngles gimbal_from_space(const Platform& platform, geo::Bearing azimuth, geo::Angle elevation);

// True if the direction is within the gimbal limits plus the servo's tolerance. A circular scan has no azimuth limit.
bool within_gimbal(const Platform& platform, const AntennaConfiguration& antenna, geo::Bearing azimuth,
                   geo::Angle elevation);

}  // namespace yars::radar
