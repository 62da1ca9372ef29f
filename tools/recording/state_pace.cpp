#include "tools/recording/state_pace.hpp"

#include <cstring>

namespace yars::tools::recording {

namespace {

using databuffer::RadarState;

// A field that is not named here counts as a switch: recorded too often rather than too late.
RadarState without_what_moves(RadarState state) {
  state.tick = 0;
  state.events_applied = 0;  // events are recorded themselves
  state.cursor_latitude_deg = state.cursor_longitude_deg = state.cursor_elevation_m = 0.0;
  state.cursor_bearing_deg = state.cursor_range_nm = 0.0;
  state.tdc_x = state.tdc_y = 0.0;
  state.cursor_believed_latitude_deg = state.cursor_believed_longitude_deg = 0.0;
  state.cursor_moved_tick = 0;
  state.asked_latitude_deg = state.asked_longitude_deg = 0.0;
  state.update_north_m = state.update_east_m = 0.0;
  state.mission = state.ins = {};
  state.velocity_along_mps = state.velocity_across_mps = state.velocity_vertical_mps = 0.0;
  state.steering_line_deg = state.magnetic_variation_deg = 0.0;
  state.frame_latitude_deg = state.frame_longitude_deg = state.frame_track_deg = 0.0;
  for (databuffer::DrawnPoint& point : state.points) point.latitude_deg = point.longitude_deg = point.elevation_m = 0.0;
  return state;
}

}  // namespace

bool switched(const RadarState& before, const RadarState& after) {
  const RadarState a = without_what_moves(before), b = without_what_moves(after);
  return std::memcmp(&a, &b, sizeof a) != 0;
}

bool StatePace::takes(const RadarState& state, std::int64_t tick) {
  if (last_) {
    if (std::memcmp(&*last_, &state, sizeof state) == 0) return false;
    if (!pace_.is_due(tick) && !switched(*last_, state)) return false;
  }
  pace_.taken(tick);
  last_ = state;
  return true;
}

}  // namespace yars::tools::recording
