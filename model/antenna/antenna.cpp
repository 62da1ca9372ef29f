#include "model/antenna/antenna.hpp"

#include <algorithm>
#include <cmath>

#include "lib/radar/modes.hpp"
#include "lib/radar/sensor.hpp"

namespace yars::model::antenna {

using geo::Angle;
using geo::Bearing;

Bearing scan_centre(const radar::Platform& platform, const radar::AntennaConfiguration& antenna) {
  const double drift_deg = (platform.ground_track - platform.heading).degrees();
  const double followed_deg = std::clamp(drift_deg, -antenna.drift_limit_deg, antenna.drift_limit_deg);
  return platform.heading + Angle::degrees(followed_deg);
}

namespace {
// Ratio of the turn-around time to the time in which a pass crosses the sector. With 0.1, a pass over 100 deg takes 1 s
// at 110 deg/s, with its turn-around.
constexpr double kTurnFraction = 0.1;
constexpr double kMinWidth_deg = 1.0;  // a narrower sector would have one or two sweeps a pass at 110 deg/s
constexpr double kMinRate_dps = 1.0;   // a lower rate is taken for a mistake: a scan would take minutes
constexpr int kMaxBars = 4;
// [ticks] Subtracted from a quotient before ceil(). Without it, a quotient that rounding leaves just above a whole
// number would add a tick.
constexpr double kTickTolerance = 1e-9;
}  // namespace

double ScanPattern::edge_deg(int index, int direction) const {
  return direction * (width_deg * index / sweep_ticks - 0.5 * width_deg);
}

double ScanPattern::turn_deg(int ticks, int direction) const {
  if (turn_ticks == 0) return edge_deg(sweep_ticks, direction);
  // The rate changes linearly from +rate to -rate, so the azimuth beyond the sector's edge is a parabola over time.
  const double fraction = static_cast<double>(ticks) / turn_ticks;
  const double degrees_per_tick = width_deg / sweep_ticks;
  return edge_deg(sweep_ticks, direction) + direction * degrees_per_tick * turn_ticks * fraction * (1.0 - fraction);
}

double ScanPattern::bar_deg(int bar) const {
  return (0.5 * (bars - 1) - bar) * bar_spacing_deg;
}

ScanPattern make_scan_pattern(const radar::AntennaConfiguration& antenna, double width_deg) {
  ScanPattern pattern;
  const double rate_dps = std::max(antenna.azimuth_rate_dps, kMinRate_dps);
  pattern.circular = antenna.circular_scan;
  pattern.bars = std::clamp(antenna.scan_bars, 1, kMaxBars);
  pattern.bar_spacing_deg = antenna.elevation_beamwidth_deg;
  const double widest_deg = pattern.circular ? 360.0 : 2.0 * antenna.azimuth_limit_deg;
  // std::max with the constant first returns kMinWidth_deg for a NaN width.
  pattern.width_deg = pattern.circular ? 360.0 : std::min(std::max(kMinWidth_deg, width_deg), widest_deg);
  const double sweeping_ticks = pattern.width_deg / rate_dps / radar::kTickSeconds;
  pattern.sweep_ticks = std::max(1, static_cast<int>(std::ceil(sweeping_ticks - kTickTolerance)));
  const auto period_ticks = static_cast<int>(std::lround((1.0 + kTurnFraction) * sweeping_ticks));
  pattern.turn_ticks = pattern.circular ? 0 : std::max(1, period_ticks - pattern.sweep_ticks);
  return pattern;
}

void Axis::command_position(double position_deg) {
  if (!std::isfinite(position_deg)) return;
  mode_ = AxisMode::position;
  commanded_deg_ = std::clamp(position_deg, -limits_.position_deg, limits_.position_deg);
}

void Axis::set_position(double position_deg) {
  if (!std::isfinite(position_deg)) return;
  position_deg_ = std::clamp(position_deg, -limits_.position_deg, limits_.position_deg);
}

void Axis::step() {
  if (mode_ == AxisMode::freeze) return;
  const double distance_deg = commanded_deg_ - position_deg_;
  const double step_deg = limits_.rate_dps * radar::kTickSeconds;
  // The last step sets the position to the commanded value, so that no rounding error remains.
  if (std::abs(distance_deg) <= step_deg)
    position_deg_ = commanded_deg_;
  else
    set_position(position_deg_ + std::copysign(step_deg, distance_deg));
}

bool Axis::reached() const {
  return mode_ == AxisMode::position && std::abs(commanded_deg_ - position_deg_) <= limits_.tolerance_deg;
}

namespace {
// Maximum rate [deg/s] at which the sector's middle follows the ground track and aim(). It exceeds the turn rate of
// aircraft. If a scan is slower than the movement of this middle, the beam can move against the scan's direction.
constexpr double kMaxCentreRate_dps = 30.0;

AxisLimits azimuth_limits(const radar::AntennaConfiguration& antenna) {
  return {antenna.azimuth_rate_dps, antenna.circular_scan ? 180.0 : antenna.azimuth_limit_deg, antenna.tolerance_deg};
}

// A `rate_dps` above 0 replaces the configured azimuth rate. The scan then has one bar.
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
    : configuration_(std::make_shared<const radar::AntennaConfiguration>(configuration)),
      pattern_(make_scan_pattern(configuration, 0.0)),
      azimuth_(azimuth_limits(configuration)),
      elevation_(elevation_limits(configuration)) {
  azimuth_.set_position(configuration.start_azimuth_deg);
  elevation_.set_position(configuration.start_elevation_deg);
}

Antenna::State Antenna::state() const {
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

void Antenna::resume(const State& state) {
  offset_deg_ = std::isfinite(state.offset_deg) ? state.offset_deg : 0.0;
  rate_dps_ = std::isfinite(state.rate_dps) ? state.rate_dps : 0.0;
  pattern_ = pattern_of(*configuration_, state.width_deg, rate_dps_);
  azimuth_.set_position(state.azimuth_deg);
  elevation_.set_position(state.elevation_deg);
  centre_ = Bearing::degrees(std::isfinite(state.centre_deg) ? state.centre_deg : 0.0);
  tick_ = std::clamp(state.tick, 0, pattern_.scan_ticks() - 1);
  direction_ = state.direction < 0 && !pattern_.circular ? -1 : 1;
  phase_ = state.phase;
  direction_known_ = true;
}

void Antenna::restart(const Sector& sector) {
  offset_deg_ = sector.offset_deg;
  rate_dps_ = sector.rate_dps;
  pattern_ = pattern_of(*configuration_, sector.width_deg, rate_dps_);
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

bool Antenna::point(const radar::Platform& platform, Bearing azimuth, Angle elevation) {
  phase_ = Phase::pointing;
  tick_ = 0;
  azimuth_.command_position((azimuth - platform.heading).degrees());
  elevation_.command_position(elevation.degrees());
  azimuth_.step();
  elevation_.step();
  return azimuth_.reached() && elevation_.reached();
}

AntennaStep Antenna::step(const radar::Platform& platform, Angle commanded_elevation) {
  AntennaStep step;
  step.phase = phase_;
  step.bar = tick_ / pattern_.pass_ticks();
  if (phase_ != Phase::parked) {
    // During the turn-around the antenna moves to the elevation of the next bar.
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

Bearing Antenna::target_centre(const radar::Platform& platform) const {
  return scan_centre(platform, *configuration_) + Angle::degrees(offset_deg_);
}

void Antenna::slew(const radar::Platform& platform) {
  const double centre_deg = (target_centre(platform) - platform.heading).degrees();
  if (!direction_known_) direction_ = azimuth_.position_deg() > centre_deg && !pattern_.circular ? -1 : 1;
  direction_known_ = true;
  azimuth_.command_position(centre_deg + pattern_.edge_deg(0, direction_));
  azimuth_.step();
  // The scan starts when azimuth and elevation are reached. If no finite elevation has been commanded, the scan does
  // not wait for the elevation.
  const bool elevation_reached = elevation_.mode() != AxisMode::position || elevation_.reached();
  if (!azimuth_.reached() || !elevation_reached) return;
  phase_ = Phase::sweeping;
  centre_ = target_centre(platform);
}

void Antenna::scan(const radar::Platform& platform, AntennaStep& step) {
  const Bearing centre_before = centre_;
  const double lag_deg = (target_centre(platform) - centre_).degrees();
  const double max_step_deg = kMaxCentreRate_dps * radar::kTickSeconds;
  centre_ = centre_ + Angle::degrees(std::clamp(lag_deg, -max_step_deg, max_step_deg));

  const int pass_tick = tick_ % pattern_.pass_ticks();
  const int next = pass_tick + 1;
  step.direction = direction_;
  Bearing pointing;
  if (pass_tick < pattern_.sweep_ticks) {
    step.phase = Phase::sweeping;
    const Bearing from = centre_before + Angle::degrees(pattern_.edge_deg(pass_tick, direction_));
    pointing = centre_ + Angle::degrees(pattern_.edge_deg(next, direction_));
    const bool rightward = (pointing - from).degrees() >= 0.0;
    step.left = rightward ? from : pointing;
    step.right = rightward ? pointing : from;
    step.reachable = radar::within_gimbal(platform, *configuration_, from, step.elevation) &&
                     radar::within_gimbal(platform, *configuration_, pointing, step.elevation);
    step.scan_start = tick_ == 0;
    step.scan_end = pass_tick == pattern_.sweep_ticks - 1 && step.bar == pattern_.bars - 1;
  } else {
    step.phase = Phase::turning;
    pointing = centre_ + Angle::degrees(pattern_.turn_deg(next - pattern_.sweep_ticks, direction_));
  }
  azimuth_.set_position((pointing - platform.heading).degrees());

  if (next == pattern_.pass_ticks() && !pattern_.circular) direction_ = -direction_;
  tick_ = (tick_ + 1) % pattern_.scan_ticks();
  phase_ = tick_ % pattern_.pass_ticks() < pattern_.sweep_ticks ? Phase::sweeping : Phase::turning;
}

}  // namespace yars::model::antenna
