#include "statemachine/outputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "databuffer/records/navigation.hpp"
#include "lib/geo/frames.hpp"
#include "statemachine/steering.hpp"

namespace yars::statemachine {

namespace {

using databuffer::Outputs;
using databuffer::RadarState;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Slant range, bearing and depression as the radar sees the target: from where the aircraft is to where the video has
// it. An unknown elevation counts as sea level.
void put_ranging(Outputs& outputs, const RadarState& state, const Surroundings& surroundings) {
  const databuffer::Ownship& ownship = surroundings.ownship;
  const auto belief = databuffer::belief_in_use(ownship, surroundings.nav, state);
  const double ground_m = std::isnan(state.target_elevation_m) ? 0.0 : state.target_elevation_m;
  using geo::HeightAboveEllipsoid;
  const geo::LocalTangentFrame frame(belief.truth, HeightAboveEllipsoid::metres(ownship.altitude_msl_m));
  const auto sight = frame.enu_from_geodetic(belief.on_video({state.target_latitude_deg, state.target_longitude_deg}),
                                             HeightAboveEllipsoid::metres(ground_m));
  const double level_m = std::hypot(sight.x, sight.y);
  outputs.slant_range_m = std::hypot(level_m, sight.z);
  outputs.bearing_deg = geo::Bearing::radians(std::atan2(sight.x, sight.y)).degrees();
  outputs.depression_deg = std::atan2(-sight.z, level_m) / geo::kRadiansPerDegree;
}

}  // namespace

Outputs outputs_of(const RadarState& state, const Surroundings& surroundings) {
  Outputs outputs{};
  outputs.tick = surroundings.tick;
  outputs.sim_time_ns = surroundings.sim_time_ns;
  outputs.epoch = surroundings.epoch;
  outputs.cue_count = state.cue_count;
  outputs.cue_latitude_deg = state.cue_latitude_deg;
  outputs.cue_longitude_deg = state.cue_longitude_deg;
  outputs.cue_elevation_m = state.cue_elevation_m;
  outputs.target_count = state.target_count;
  outputs.mark_count = state.mark_count;
  std::ranges::copy(state.marks, outputs.marks);
  outputs.slant_range_m = outputs.bearing_deg = outputs.depression_deg = kNone;
  outputs.steering_deg = outputs.approach_deg = kNone;
  if (!has(state, databuffer::kTargetDesignated)) return outputs;
  outputs.target_latitude_deg = state.target_latitude_deg;
  outputs.target_longitude_deg = state.target_longitude_deg;
  outputs.target_elevation_m = state.target_elevation_m;
  std::ranges::copy(state.target_name, outputs.target_name);
  if (!surroundings.ownship_valid) return outputs;
  put_steering(outputs, state, surroundings);
  // Without its elevation a range would be that of another point.
  if ((state.asked_for & databuffer::kAskedForTarget) != 0) return outputs;
  put_ranging(outputs, state, surroundings);
  return outputs;
}

}  // namespace yars::statemachine
