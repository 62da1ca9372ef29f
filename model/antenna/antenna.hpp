// Antenna servo and scan pattern: the direction of the beam in each tick of 5 ms.
// Inputs: attitude and ground track; sector to scan; commanded elevation; limits and rates of the configuration.
// Outputs: left and right edge of the tick's sweep, antenna azimuth (true bearings), elevation, phase of the scan.
// Frame: azimuths are true or relative to the nose, clockwise positive. Elevations are positive above the horizontal.
// Gimbal angles are in airframe axes. A commanded direction that is not finite is ignored. A direction out of range is
// clamped.
// Source: docs/pilots_manual.md#rule-2.
#pragma once

#include <cstdint>
#include <memory>

#include "lib/geo/quantity.hpp"
#include "lib/radar/sensor.hpp"

namespace yars::radar {
struct AntennaConfiguration;
}  // namespace yars::radar

namespace yars::model::antenna {

// Middle of a sector without offset: the ground track, limited to `drift_limit_deg` either side of the nose.
geo::Bearing scan_centre(const radar::Platform& platform, const radar::AntennaConfiguration& antenna);

// Beam azimuth and bar (elevation of one pass) as functions of the tick within the scan, so that rounding errors do not
// accumulate. A pass crosses the sector once: `sweep_ticks` ticks with one sweep each, then a turn-around of
// `turn_ticks` without sweeps. A circular scan turns clockwise without turn-around.
// The turn-around takes a tenth of the crossing time: a pass over 100 deg at 110 deg/s takes 1 s with its turn-around.
// The time of a pass is proportional to the width.
struct ScanPattern {
  double width_deg = 100.0;
  double bar_spacing_deg = 2.5;  // between elevation bars, one elevation beamwidth
  int sweep_ticks = 182;         // >= 1
  int turn_ticks = 18;           // 0 only when circular
  int bars = 1;                  // 1..4; one scan covers all bars
  bool circular = false;

  int pass_ticks() const { return sweep_ticks + turn_ticks; }
  int scan_ticks() const { return bars * pass_ticks(); }

  // Azimuth of sweep edge `index` in [0, sweep_ticks], relative to the middle of the sector, clockwise positive.
  // Sweep i lies between edges i and i + 1. A pass with direction +1 starts at the left.
  double edge_deg(int index, int direction) const;
  // Azimuth of the antenna relative to the middle of the sector, `ticks` in [0, turn_ticks] after the start of the
  // turn-around. `direction`: direction of the pass before the turn-around.
  double turn_deg(int ticks, int direction) const;
  // Elevation of a bar above the commanded elevation. Bar 0 is the highest.
  double bar_deg(int bar) const;
};

// Pattern of the configuration. `width_deg` is clamped to [1, twice the azimuth limit]; NaN gives 1. A circular scan is
// 360 deg wide.
ScanPattern make_scan_pattern(const radar::AntennaConfiguration& antenna, double width_deg);

enum class AxisMode : std::uint8_t { freeze, position };

struct AxisLimits {
  double rate_dps = 110.0;     // maximum in either direction
  double position_deg = 60.0;  // maximum on either side of zero
  double tolerance_deg = 0.1;  // maximum difference at which a commanded position counts as reached
};

// One axis of the antenna servo. Azimuth is relative to the nose, elevation to the horizon.
// Modes: `freeze` holds the position; `position` moves to a commanded position at maximum rate.
// Lag and overshoot are not modelled. Commands that are not finite are ignored.
class Axis {
 public:
  explicit Axis(const AxisLimits& limits) : limits_(limits) {}

  void freeze() { mode_ = AxisMode::freeze; }
  void command_position(double position_deg);  // clamped to the limits
  void set_position(double position_deg);      // at once, clamped to the limits; does not change the mode

  void step();  // one tick of 5 ms

  double position_deg() const { return position_deg_; }
  AxisMode mode() const { return mode_; }
  bool reached() const;  // false when frozen

 private:
  AxisLimits limits_;
  AxisMode mode_ = AxisMode::freeze;
  double position_deg_ = 0.0;
  double commanded_deg_ = 0.0;
};

// slewing: moves to the start of a scan. turning: turn-around between passes. pointing: moves to, or holds, the
// direction of point().
enum class Phase : std::uint8_t { parked, slewing, sweeping, turning, pointing };

struct AntennaStep {
  Phase phase = Phase::parked;
  geo::Bearing left;        // true bearing of the sweep's left edge; valid while sweeping
  geo::Bearing right;       // true bearing of the sweep's right edge; valid while sweeping
  geo::Bearing azimuth;     // true bearing of the antenna at the end of the tick
  geo::Angle elevation;     // above the horizontal
  int direction = 1;        // +1 clockwise, -1 counter-clockwise
  int bar = 0;              // of the current pass, 0 is the highest; in a turn-around: of the pass before it
  bool reachable = true;    // false: an edge of the sweep is outside the gimbal limits, so the sweep is blank
  bool scan_start = false;  // first sweep of the scan
  bool scan_end = false;    // last sweep of the scan
};

struct Sector {
  double width_deg = 0.0;
  double offset_deg = 0.0;  // middle of the sector, positive right of scan_centre(); finite
  double rate_dps = 0.0;    // 0: rate and bars of the configuration; above 0: azimuth rate of a scan with one bar
};

// Two-axis antenna. It slews to an edge of a sector, then scans the sector. It is stabilized: pitch and roll of the
// aircraft do not move the beam. Relative to the moving middle of the sector, sweep edges depend only on the tick
// within the scan and the direction of the pass. So they repeat exactly.
// Within a pass, a sweep ends at the edge at which the next sweep begins, also while the aircraft turns.
class Antenna {
 public:
  explicit Antenna(const radar::AntennaConfiguration& configuration);

  // Complete state, from which `resume` continues in the middle of a scan.
  struct State {
    double azimuth_deg = 0.0;    // right of the nose
    double elevation_deg = 0.0;  // above the horizontal
    double centre_deg = 0.0;     // true bearing of the sector's middle in the last tick; it moves at a limited rate
    double width_deg = 0.0;
    int tick = 0;  // within the scan
    int direction = 1;
    Phase phase = Phase::parked;
    double offset_deg = 0.0;  // commanded middle of the sector, right of scan_centre()
    double rate_dps = 0.0;    // 0: the rate of the configuration
  };
  State state() const;
  // Antenna angles and tick are clamped to their ranges; the width is limited as by make_scan_pattern(). If an antenna
  // angle is not finite, its axis does not move. Offset, rate and centre become 0 if they are not finite.
  void resume(const State& state);
  // Slews to an edge of the sector, then scans. The scan starts at the right edge if the antenna points right of the
  // sector's middle, else at the left edge. A circular scan always starts at the left edge.
  void restart(const Sector& sector);
  void restart(double width_deg) { restart(Sector{.width_deg = width_deg}); }
  // Sets the middle of the sector, positive right of scan_centre(); finite. The scan moves there at 30 deg/s at most.
  void aim(double offset_deg) { offset_deg_ = offset_deg; }
  // Holds the antenna until the next restart() or point().
  void park();
  // One tick that slews to a direction or holds it; called instead of step(). The direction is clamped to the servo's
  // limits. Returns true if both axes are within tolerance of the clamped direction. Afterwards a scan needs restart().
  bool point(const radar::Platform& platform, geo::Bearing azimuth, geo::Angle elevation);

  // One tick of slewing or scanning. While parked the antenna does not move.
  AntennaStep step(const radar::Platform& platform, geo::Angle commanded_elevation);

  bool between_scans() const { return tick_ == 0; }                   // parked, slewing, pointing, or after a scan
  double azimuth_deg() const { return azimuth_.position_deg(); }      // right of the nose
  double elevation_deg() const { return elevation_.position_deg(); }  // above the horizontal
  const ScanPattern& pattern() const { return pattern_; }

 private:
  geo::Bearing target_centre(const radar::Platform& platform) const;
  void slew(const radar::Platform& platform);
  void scan(const radar::Platform& platform, AntennaStep& step);

  std::shared_ptr<const radar::AntennaConfiguration> configuration_;
  ScanPattern pattern_;
  double offset_deg_ = 0.0;  // commanded middle of the sector, right of scan_centre()
  double rate_dps_ = 0.0;    // 0: the rate of the configuration
  Axis azimuth_;
  Axis elevation_;
  geo::Bearing centre_;  // true bearing of the sector's middle at the end of the last tick
  Phase phase_ = Phase::parked;
  int tick_ = 0;                  // within the scan
  int direction_ = 1;             // direction of the current pass, +1 clockwise
  bool direction_known_ = false;  // while slewing: true once `direction_` is chosen
};

}  // namespace yars::model::antenna
