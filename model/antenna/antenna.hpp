// Antenna servo: stabilization, scan pattern, one axis, and the antenna that joins them.
#pragma once

#include <cstdint>

#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::model::antenna {

// How a scan is held in space: which way its centre points, and whether the gimbal can point the dish there.

// What the servo knows of the aircraft. Heading and track true; pitch nose up, roll right wing down positive.
struct Platform {
  geo::Bearing heading;
  geo::Angle pitch;
  geo::Angle roll;
  geo::Bearing ground_track;  // the heading where the aircraft hardly moves
};

// The scan centre: the ground track, but not further from the nose than the drift limit.
geo::Bearing scan_centre(const Platform& platform, const radar::AntennaConfiguration& antenna);

// A direction in space as the gimbal sees it: azimuth and elevation in the axes of the airframe.
struct GimbalAngles {
  geo::Angle azimuth;    // right of the nose positive
  geo::Angle elevation;  // above the wing plane positive
};
GimbalAngles gimbal_from_space(const Platform& platform, geo::Bearing azimuth, geo::Angle elevation);

// True if the gimbal reaches the direction, within the servo's tolerance. A circular scan has no azimuth limit.
bool within_gimbal(const Platform& platform, const radar::AntennaConfiguration& antenna, geo::Bearing azimuth,
                   geo::Angle elevation);

// The course of one scan over its ticks: pure numbers, derived from the tick within the scan, so that no error adds
// up however long the radar runs. A sector scan goes from one edge to the other in `sweep_ticks` ticks (one sweep
// each), then turns round, blanked, in `turn_ticks`. A circular scan goes round clockwise and never turns.
// Source: docs/spec/pilots_interface.md#rule-2. 100 deg at 110 deg/s and a turn-around of a tenth of that make 1 s;
// others in proportion.
struct ScanPattern {
  double width_deg = 100.0;
  double bar_spacing_deg = 2.5;  // [deg] between elevation bars: one beam width
  int sweep_ticks = 182;         // >= 1
  int turn_ticks = 18;           // 0 only when circular
  int bars = 1;                  // 1..4; a scan is all of them
  bool circular = false;

  int pass_ticks() const { return sweep_ticks + turn_ticks; }
  int scan_ticks() const { return bars * pass_ticks(); }

  // Edge `index` in [0, sweep_ticks] of the sweeps of a pass [deg] against the scan centre, clockwise positive.
  // Direction +1 starts at the left. Sweep i lies between edges i and i + 1.
  double edge_deg(int index, int direction) const;
  // Where the dish is in the turn-around after `ticks` in [0, turn_ticks] of it [deg]: it brakes and comes back evenly.
  double turn_deg(int ticks, int direction) const;
  // Elevation of a bar against the commanded one [deg]: bars are stepped from the top down.
  double bar_deg(int bar) const;
};

ScanPattern make_scan_pattern(const radar::AntennaConfiguration& antenna, double width_deg);

enum class AxisMode : std::uint8_t { freeze, rate, position };

struct AxisLimits {
  double rate_dps = 110.0;     // [deg/s] greatest, either way
  double position_deg = 60.0;  // [deg] either side of zero
  double tolerance_deg = 0.1;  // [deg] a commanded position counts as reached within this
};

// One axis of the dish's servo: position, rate, limits, in degrees against the nose (azimuth) or the horizon
// (elevation). Modes: freeze holds, rate turns at a commanded rate, position goes to a commanded place at full
// rate. A step is one tick of 5 ms; no lag and no overshoot is modelled. Inputs that are not finite are ignored.
class Axis {
 public:
  explicit Axis(const AxisLimits& limits) : limits_(limits) {}

  void freeze() { mode_ = AxisMode::freeze; }
  void command_rate(double rate_dps);
  void command_position(double position_deg);  // clamped to the limits
  void place(double position_deg);             // sets the position: a pattern drives the axis, or a restart resumes it

  // Advances by one tick.
  void step();

  double position_deg() const { return position_deg_; }
  AxisMode mode() const { return mode_; }
  bool reached() const;  // in position mode, within the tolerance

 private:
  void move(double rate_dps);

  AxisLimits limits_;
  AxisMode mode_ = AxisMode::freeze;
  double position_deg_ = 0.0;
  double commanded_ = 0.0;  // [deg/s] or [deg], by mode
};

enum class Phase : std::uint8_t { parked, slewing, sweeping, turning, pointing };

// What happened in one tick.
struct AntennaStep {
  Phase phase = Phase::parked;
  geo::Bearing left;  // of the sweep, true; meaningful while sweeping
  geo::Bearing right;
  geo::Bearing azimuth;  // where the dish points at the end of the tick, true
  geo::Angle elevation;  // against the horizon
  int direction = 1;     // +1 clockwise
  int bar = 0;
  bool reachable = true;    // false: the gimbal cannot point there, the sweep is blank
  bool scan_start = false;  // first sweep of the scan
  bool scan_end = false;    // last sweep of the scan
};

// What is scanned: about the ground track, or so far to the right of it.
struct Sector {
  double width_deg = 0.0;
  double offset_deg = 0.0;
  double rate_dps = 0.0;  // 0: the configuration's
};

// The dish: goes to an edge of its sector, then scans it, held in space about the ground track. Pure: one call a
// tick of 5 ms, the platform and the commanded elevation in, what the beam swept during the tick out. The pointing
// within a scan comes from the tick number alone and is exactly periodic; edges of neighbouring sweeps are equal,
// also while the aircraft turns, so that wedges tile without gaps.
class Antenna {
 public:
  explicit Antenna(const radar::AntennaConfiguration& configuration);

  // All that a successor needs to go on in the middle of a scan.
  struct Memory {
    double azimuth_deg = 0.0;    // against the nose
    double elevation_deg = 0.0;  // against the horizon
    double centre_deg = 0.0;     // of the scan, true
    double width_deg = 0.0;
    int tick = 0;  // within the scan
    int direction = 1;
    Phase phase = Phase::parked;
    double offset_deg = 0.0;  // of the sector's middle
    double rate_dps = 0.0;    // 0: the configuration's
  };
  Memory memory() const;
  // Values outside their range are taken as the nearest inside.
  void resume(const Memory& memory);
  // Goes to the nearer edge of a sector and scans from there.
  void restart(const Sector& sector);
  void restart(double width_deg) { restart(Sector{.width_deg = width_deg}); }
  // Moves the middle of the sector; the scan follows it no faster than it turns with the aircraft.
  void aim(double offset_deg) { offset_deg_ = offset_deg; }
  // Holds still until the next restart.
  void park();
  // A tick on the way to a direction that is held, until the next restart; as far as the servo's limits let it. True
  // once it is there.
  bool point(const Platform& platform, geo::Bearing azimuth, geo::Angle elevation);

  AntennaStep step(const Platform& platform, geo::Angle commanded_elevation);

  bool between_scans() const { return tick_ == 0; }                   // parked, slewing, or a scan has just ended
  double azimuth_deg() const { return azimuth_.position_deg(); }      // [deg] against the nose
  double elevation_deg() const { return elevation_.position_deg(); }  // [deg] against the horizon
  const ScanPattern& pattern() const { return pattern_; }

 private:
  geo::Bearing wanted_centre(const Platform& platform) const;
  void slew(const Platform& platform);
  void scan(const Platform& platform, AntennaStep& step);

  radar::AntennaConfiguration configuration_;
  ScanPattern pattern_;
  double offset_deg_ = 0.0;  // of the sector's middle against the ground track
  double rate_dps_ = 0.0;    // 0: the configuration's
  Axis azimuth_;
  Axis elevation_;
  geo::Bearing centre_;  // of the scan, true, at the end of the last tick
  Phase phase_ = Phase::parked;
  int tick_ = 0;                  // within the scan
  int direction_ = 1;             // of the pass under way
  bool direction_known_ = false;  // slewing: towards which edge
};

}  // namespace yars::model::antenna
