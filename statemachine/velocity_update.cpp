#include "statemachine/velocity_update.hpp"

#include <cmath>

#include "databuffer/records/inspection.hpp"
#include "databuffer/records/navigation.hpp"

namespace yars::statemachine {

namespace {

using databuffer::ModelStatus;
using databuffer::RadarState;

constexpr std::int64_t kShownTicks = 2'000;  // 10 s: three numbers to read, gone before the next update
// [m/s] A measurement further off than this is none: the border would refuse the state that took it up.
constexpr double kMostDifference_mps = 2'000.0;

struct Difference {
  double north_mps = 0.0;
  double east_mps = 0.0;
  double down_mps = 0.0;
};

bool continuous(const RadarState& state) {
  return running_mode(state) == radar::Mode::pvu && power_of(state) == radar::Power::operate;
}

// Radar less navigator.
Difference difference(const RadarState& state, const Surroundings& surroundings) {
  const ModelStatus& model = surroundings.model;
  const databuffer::Nav& nav = surroundings.nav;
  return {model.velocity_north_mps - (nav.velocity_north_mps + state.mission.velocity_north_mps),
          model.velocity_east_mps - (nav.velocity_east_mps + state.mission.velocity_east_mps),
          model.velocity_down_mps - (nav.velocity_down_mps + state.mission.velocity_down_mps)};
}

// Neither the measurement nor what the navigator's error would be then; written so that NaN fails.
bool believable(const Difference& difference, const databuffer::NavigatorError& mission) {
  const auto small = [](double part_mps, double error_mps) {
    return std::abs(part_mps) <= kMostDifference_mps && std::abs(error_mps + part_mps) <= databuffer::kLargestSpeed;
  };
  return small(difference.north_mps, mission.velocity_north_mps) &&
         small(difference.east_mps, mission.velocity_east_mps) && small(difference.down_mps, mission.velocity_down_mps);
}

void show(RadarState& state, const Difference& difference, const Surroundings& surroundings) {
  const double track_rad = databuffer::ground_track_of(surroundings.ownship).radians();
  state.velocity_along_mps = difference.north_mps * std::cos(track_rad) + difference.east_mps * std::sin(track_rad);
  state.velocity_across_mps = difference.east_mps * std::cos(track_rad) - difference.north_mps * std::sin(track_rad);
  state.velocity_vertical_mps = -difference.down_mps;
  state.velocity_shown_until_tick = surroundings.tick + kShownTicks;
  set_flag(state, databuffer::kVelocityShown, true);
}

bool update_is_due(const RadarState& state, std::int64_t tick, double period_s) {
  if (state.velocity_updated_tick < 0 || tick < state.velocity_updated_tick) return true;
  return static_cast<double>(tick - state.velocity_updated_tick) * radar::kTickSeconds >= period_s;
}

void correct(databuffer::NavigatorError& mission, const Difference& difference) {
  mission.velocity_north_mps += difference.north_mps;
  mission.velocity_east_mps += difference.east_mps;
  mission.velocity_down_mps += difference.down_mps;
}

}  // namespace

void advance_velocity_update(RadarState& state, const Surroundings& surroundings,
                             const radar::RadarConfiguration& configuration) {
  const bool measures = continuous(state) || has(state, databuffer::kIpvu);
  const bool outdated = !continuous(state) && surroundings.tick >= state.velocity_shown_until_tick;
  if (!measures || outdated) set_flag(state, databuffer::kVelocityShown, false);
  if (surroundings.model.velocity_count == state.velocity_taken) return;
  state.velocity_taken = surroundings.model.velocity_count;
  const Difference measured = difference(state, surroundings);
  if (!measures || !believable(measured, state.mission)) return;
  show(state, measured, surroundings);
  // IPVU measures when an update is due, a scan's end earlier or later; PVU all the time.
  if (continuous(state) && !update_is_due(state, surroundings.tick, configuration.navigation.velocity_period_s)) return;
  state.velocity_updated_tick = surroundings.tick;
  correct(state.mission, measured);
}

}  // namespace yars::statemachine
