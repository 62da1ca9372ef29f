// The dish: goes to an edge of its sector, then scans it, held in space about the ground track. Pure: one call a
// tick of 5 ms, the platform and the commanded elevation in, what the beam swept during the tick out. The pointing
// within a scan comes from the tick number alone and is exactly periodic; edges of neighbouring sweeps are equal,
// also while the aircraft turns, so that wedges tile without gaps.
#pragma once

#include <cstdint>

#include "lib/radar/configuration.hpp"
#include "model/antenna/axis.hpp"
#include "model/antenna/scan_pattern.hpp"
#include "model/antenna/stabilization.hpp"

namespace yars::model::antenna {

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
