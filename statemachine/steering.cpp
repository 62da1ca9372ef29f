#include "statemachine/steering.hpp"

#include <algorithm>
#include <cmath>

#include "databuffer/records/navigation.hpp"
#include "lib/geo/geodesic.hpp"

namespace yars::statemachine {

namespace {

using databuffer::RadarState;
using databuffer::SteeringLine;
using geo::Bearing;

constexpr double kTurnRate_dps = 45.0;  // [deg/s] of the line at full deflection: half round in 4 s
constexpr double kGravity_mps2 = 9.80665;
constexpr double kCapture_s = 15.0;  // [s] of flight in which half the distance to the line is to be gone
constexpr double kTurn_s = 5.0;      // [s] in which an error of track is to be turned away
constexpr double kMostBank_deg = 60.0;
constexpr double kLeastSpeed_mps = 1.0;  // below, a track has no direction and a bank no effect

SteeringLine line_of(const RadarState& state) {
  return static_cast<SteeringLine>(state.steering_line);
}

void put_line(RadarState& state, SteeringLine line) {
  state.steering_line = static_cast<std::uint8_t>(line);
}

// From the aircraft to the target as the glass shows them.
geo::GeodesicInverse sight_of_target(const RadarState& state, const Surroundings& surroundings) {
  const auto belief = databuffer::belief_in_use(surroundings.ownship, surroundings.nav, state);
  return geo::geodesic_inverse(belief.truth, belief.on_video({state.target_latitude_deg, state.target_longitude_deg}));
}

// [deg] right wing down: toward the line through the target along the approach, then along it.
double bank_onto_line(const geo::GeodesicInverse& sight, Bearing approach, const databuffer::Ownship& ownship) {
  const double speed_mps = std::hypot(ownship.velocity_north_mps, ownship.velocity_east_mps);
  if (speed_mps < kLeastSpeed_mps) return 0.0;
  // Right of the line, seen along the approach.
  const double right_m = sight.distance.metres() * std::sin((approach - sight.azimuth_at_start).radians());
  const Bearing wanted = approach - geo::Angle::radians(std::atan2(right_m, speed_mps * kCapture_s));
  const double turn_rate = (wanted - databuffer::ground_track_of(ownship)).radians() / kTurn_s;
  const double bank_deg = std::atan(speed_mps * turn_rate / kGravity_mps2) / geo::kRadiansPerDegree;
  return std::clamp(bank_deg, -kMostBank_deg, kMostBank_deg);
}

}  // namespace

void steer_slewing(Step& step) {
  if (!has(step.state, databuffer::kTargetDesignated)) return;
  if (step.event.argument < 0) {
    put_line(step.state, SteeringLine::slewing);
  } else if (step.event.argument > 0 && line_of(step.state) != SteeringLine::line_of_sight) {
    lead_along_line_of_sight(step.state, step.surroundings);
  }
}

void fix_steering_line(Step& step) {
  put_line(step.state, SteeringLine::fixed);
}

bool slews_steering_line(const RadarState& state) {
  return line_of(state) == SteeringLine::slewing;
}

void lead_along_line_of_sight(RadarState& state, const Surroundings& surroundings) {
  put_line(state, SteeringLine::line_of_sight);
  if (surroundings.ownship_valid) advance_steering_line(state, surroundings);
}

void advance_steering_line(RadarState& state, const Surroundings& surroundings) {
  if (!has(state, databuffer::kTargetDesignated)) return put_line(state, SteeringLine::none);
  switch (line_of(state)) {
    case SteeringLine::line_of_sight:
      state.steering_line_deg = sight_of_target(state, surroundings).azimuth_at_start.degrees();
      return;
    case SteeringLine::slewing: {
      const auto turn = geo::Angle::degrees(state.tdc_x * kTurnRate_dps * radar::kTickSeconds);
      state.steering_line_deg = (Bearing::degrees(state.steering_line_deg) + turn).degrees();
      return;
    }
    case SteeringLine::none:
    case SteeringLine::fixed:
      return;
  }
}

void put_steering(databuffer::Outputs& outputs, const RadarState& state, const Surroundings& surroundings) {
  const geo::GeodesicInverse sight = sight_of_target(state, surroundings);
  outputs.approach_deg = state.steering_line_deg;
  const bool fixed = line_of(state) == SteeringLine::fixed;
  outputs.steering =
      static_cast<std::uint8_t>(fixed ? databuffer::SteeringCommand::bank : databuffer::SteeringCommand::azimuth);
  outputs.steering_deg = fixed ? bank_onto_line(sight, Bearing::degrees(state.steering_line_deg), surroundings.ownship)
                               : (sight.azimuth_at_start - databuffer::ground_track_of(surroundings.ownship)).degrees();
}

}  // namespace yars::statemachine
