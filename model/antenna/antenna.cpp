#include "model/antenna/antenna.hpp"

#include <algorithm>
#include <cmath>

#include "lib/radar/limits.hpp"

namespace yars::model::antenna {

using geo::Angle;
using geo::Bearing;

namespace {
// How fast the scan centre follows a jump of the ground track [deg/s]: faster than aircraft turn, slower than the
// scan, so that a sweep never runs backwards.
constexpr double kCentreRateDps = 30.0;

AxisLimits azimuth_limits(const radar::AntennaConfiguration& antenna) {
  return {antenna.azimuth_rate_dps, antenna.circular_scan ? 180.0 : antenna.azimuth_limit_deg, antenna.tolerance_deg};
}

// A sector with a rate of its own has one bar: its beam follows what it looks at.
ScanPattern pattern_of(radar::AntennaConfiguration antenna, double width_deg, double rate_dps) {
  if (rate_dps > 0.0) {
    antenna.azimuth_rate_dps = rate_dps;
    antenna.scan_bars = 1;
  }
  return make_scan_pattern(antenna, width_deg);
}

AxisLimits elevation_limits(const radar::AntennaConfiguration& antenna) {
  return {antenna.elevation_rate_dps, antenna.elevation_limit_deg, antenna.tolerance_deg};
}
}  // namespace

Antenna::Antenna(const radar::AntennaConfiguration& configuration)
    : configuration_(configuration),
      pattern_(make_scan_pattern(configuration, 0.0)),
      azimuth_(azimuth_limits(configuration)),
      elevation_(elevation_limits(configuration)) {
  azimuth_.place(configuration.start_azimuth_deg);
  elevation_.place(configuration.start_elevation_deg);
}

Antenna::Memory Antenna::memory() const {
  return {azimuth_.position_deg(),
          elevation_.position_deg(),
          centre_.degrees(),
          pattern_.width_deg,
          tick_,
          direction_,
          phase_,
          offset_deg_,
          rate_dps_};
}

void Antenna::resume(const Memory& memory) {
  offset_deg_ = std::isfinite(memory.offset_deg) ? memory.offset_deg : 0.0;
  rate_dps_ = std::isfinite(memory.rate_dps) ? memory.rate_dps : 0.0;
  pattern_ = pattern_of(configuration_, memory.width_deg, rate_dps_);
  azimuth_.place(memory.azimuth_deg);
  elevation_.place(memory.elevation_deg);
  centre_ = Bearing::degrees(std::isfinite(memory.centre_deg) ? memory.centre_deg : 0.0);
  tick_ = std::clamp(memory.tick, 0, pattern_.scan_ticks() - 1);
  direction_ = memory.direction < 0 && !pattern_.circular ? -1 : 1;
  phase_ = memory.phase;
  direction_known_ = true;
}

void Antenna::restart(const Sector& sector) {
  offset_deg_ = sector.offset_deg;
  rate_dps_ = sector.rate_dps;
  pattern_ = pattern_of(configuration_, sector.width_deg, rate_dps_);
  phase_ = Phase::slewing;
  tick_ = 0;
  direction_known_ = false;
}

void Antenna::park() {
  phase_ = Phase::parked;
  tick_ = 0;
  azimuth_.freeze();
  elevation_.freeze();
}

bool Antenna::point(const Platform& platform, Bearing azimuth, Angle elevation) {
  phase_ = Phase::pointing;
  tick_ = 0;
  azimuth_.command_position((azimuth - platform.heading).degrees());
  elevation_.command_position(elevation.degrees());
  azimuth_.step();
  elevation_.step();
  return azimuth_.reached() && elevation_.reached();
}

AntennaStep Antenna::step(const Platform& platform, Angle commanded_elevation) {
  AntennaStep step;
  step.phase = phase_;
  step.bar = tick_ / pattern_.pass_ticks();
  if (phase_ != Phase::parked) {
    // The dish steps to the next bar while it turns round.
    const bool turning = tick_ % pattern_.pass_ticks() >= pattern_.sweep_ticks;
    const int bar = turning ? (step.bar + 1) % pattern_.bars : step.bar;
    elevation_.command_position(commanded_elevation.degrees() + pattern_.bar_deg(bar));
    elevation_.step();
  }
  step.elevation = Angle::degrees(elevation_.position_deg());
  if (phase_ == Phase::slewing)
    slew(platform);
  else if (phase_ != Phase::parked)
    scan(platform, step);
  step.azimuth = platform.heading + Angle::degrees(azimuth_.position_deg());
  return step;
}

Bearing Antenna::wanted_centre(const Platform& platform) const {
  return scan_centre(platform, configuration_) + Angle::degrees(offset_deg_);
}

void Antenna::slew(const Platform& platform) {
  const double centre_deg = (wanted_centre(platform) - platform.heading).degrees();
  if (!direction_known_) direction_ = azimuth_.position_deg() > centre_deg && !pattern_.circular ? -1 : 1;
  direction_known_ = true;
  azimuth_.command_position(centre_deg + pattern_.edge_deg(0, direction_));
  azimuth_.step();
  // From a beam far below the scan the way in elevation may be the longer one. An elevation that was never a number is
  // not waited for.
  const bool elevation_there = elevation_.mode() != AxisMode::position || elevation_.reached();
  if (!azimuth_.reached() || !elevation_there) return;
  phase_ = Phase::sweeping;
  centre_ = wanted_centre(platform);
}

void Antenna::scan(const Platform& platform, AntennaStep& step) {
  const Bearing centre_before = centre_;
  const double lag_deg = (wanted_centre(platform) - centre_).degrees();
  const double most_deg = kCentreRateDps * radar::kTickSeconds;
  centre_ = centre_ + Angle::degrees(std::clamp(lag_deg, -most_deg, most_deg));

  const int in_pass = tick_ % pattern_.pass_ticks();
  const int next = in_pass + 1;
  step.direction = direction_;
  Bearing pointing;
  if (in_pass < pattern_.sweep_ticks) {
    step.phase = Phase::sweeping;
    const Bearing from = centre_before + Angle::degrees(pattern_.edge_deg(in_pass, direction_));
    pointing = centre_ + Angle::degrees(pattern_.edge_deg(next, direction_));
    step.left = direction_ > 0 ? from : pointing;
    step.right = direction_ > 0 ? pointing : from;
    step.reachable = within_gimbal(platform, configuration_, from, step.elevation) &&
                     within_gimbal(platform, configuration_, pointing, step.elevation);
    step.scan_start = tick_ == 0;
    step.scan_end = in_pass == pattern_.sweep_ticks - 1 && step.bar == pattern_.bars - 1;
  } else {
    step.phase = Phase::turning;
    pointing = centre_ + Angle::degrees(pattern_.turn_deg(next - pattern_.sweep_ticks, direction_));
  }
  azimuth_.place((pointing - platform.heading).degrees());

  if (next == pattern_.pass_ticks() && !pattern_.circular) direction_ = -direction_;
  tick_ = (tick_ + 1) % pattern_.scan_ticks();
  phase_ = tick_ % pattern_.pass_ticks() < pattern_.sweep_ticks ? Phase::sweeping : Phase::turning;
}

}  // namespace yars::model::antenna
