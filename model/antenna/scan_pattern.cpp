#include "model/antenna/scan_pattern.hpp"

#include <algorithm>
#include <cmath>

#include "lib/radar/configuration.hpp"
#include "lib/radar/limits.hpp"

namespace yars::model::antenna {

namespace {
// Share of the sweeping time that a turn-around takes; makes FULL 1 s at 110 deg/s. Another value changes the period.
constexpr double kTurnShare = 0.1;
constexpr double kLeastWidthDeg = 1.0;  // [deg] a narrower sector would be all turn-around
constexpr double kLeastRateDps = 1.0;   // [deg/s] below it a scan takes minutes: a mistake in the configuration
constexpr int kMostBars = 4;
// A quotient that should be whole may come out a rounding error above: without this, ceil() adds a tick.
constexpr double kWholeSlack = 1e-9;
}  // namespace

double ScanPattern::edge_deg(int index, int direction) const {
  return direction * (width_deg * index / sweep_ticks - 0.5 * width_deg);
}

double ScanPattern::turn_deg(int ticks, int direction) const {
  if (turn_ticks == 0) return edge_deg(sweep_ticks, direction);
  // Constant deceleration from +rate to -rate: a parabola beyond the edge.
  const double share = static_cast<double>(ticks) / turn_ticks;
  const double degrees_per_tick = width_deg / sweep_ticks;
  return edge_deg(sweep_ticks, direction) + direction * degrees_per_tick * turn_ticks * share * (1.0 - share);
}

double ScanPattern::bar_deg(int bar) const {
  return (0.5 * (bars - 1) - bar) * bar_spacing_deg;
}

ScanPattern make_scan_pattern(const radar::AntennaConfiguration& antenna, double width_deg) {
  ScanPattern pattern;
  const double rate_dps = std::max(antenna.azimuth_rate_dps, kLeastRateDps);
  pattern.circular = antenna.circular_scan;
  pattern.bars = std::clamp(antenna.scan_bars, 1, kMostBars);
  pattern.bar_spacing_deg = antenna.elevation_beamwidth_deg;
  const double widest_deg = pattern.circular ? 360.0 : 2.0 * antenna.azimuth_limit_deg;
  // min and max in this order also take a width that is not a number to the least.
  pattern.width_deg = pattern.circular ? 360.0 : std::min(std::max(kLeastWidthDeg, width_deg), widest_deg);
  const double sweeping_ticks = pattern.width_deg / rate_dps / radar::kTickSeconds;
  pattern.sweep_ticks = std::max(1, static_cast<int>(std::ceil(sweeping_ticks - kWholeSlack)));
  const auto period_ticks = static_cast<int>(std::lround((1.0 + kTurnShare) * sweeping_ticks));
  pattern.turn_ticks = pattern.circular ? 0 : std::max(1, period_ticks - pattern.sweep_ticks);
  return pattern;
}

}  // namespace yars::model::antenna
