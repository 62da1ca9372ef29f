#include "statemachine/elevations.hpp"

#include <cmath>
#include <limits>

namespace yars::statemachine {

namespace {

using databuffer::RadarState;
using geo::GeoPoint;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kAnswerTicks = 20;   // 0.1 s: a model that lives has answered by then
constexpr std::int64_t kGroundTicks = 400;  // 2 s: ground that is still unknown is void, or is not loaded

GeoPoint cursor_of(const RadarState& state) {
  return {state.cursor_latitude_deg, state.cursor_longitude_deg};
}

bool is_asked(const RadarState& state, GeoPoint ground) {
  return state.asked_latitude_deg == ground.latitude_deg && state.asked_longitude_deg == ground.longitude_deg;
}

void put_elevation(RadarState& state, std::uint32_t for_whom, double elevation_m) {
  for (std::uint32_t mark = 0; mark < databuffer::kMarks; ++mark)
    if ((for_whom >> mark & 1U) != 0) state.marks[mark].elevation_m = elevation_m;
  if ((for_whom & databuffer::kAskedForTarget) != 0) state.target_elevation_m = elevation_m;
  if ((for_whom & databuffer::kAskedForCue) != 0) state.cue_elevation_m = elevation_m;
}

// Ticks since the question; time may have been set back since.
std::int64_t waited(const RadarState& state, std::int64_t tick) {
  return tick < state.asked_tick ? kGroundTicks : tick - state.asked_tick;
}

}  // namespace

std::optional<double> answered_elevation_m(const Surroundings& surroundings, GeoPoint ground) {
  const databuffer::ModelStatus& model = surroundings.model;
  const bool same =
      model.answered_latitude_deg == ground.latitude_deg && model.answered_longitude_deg == ground.longitude_deg;
  return same ? std::optional(model.answered_elevation_m) : std::nullopt;
}

void ask_elevation(Step& step, std::uint32_t for_whom) {
  RadarState& state = step.state;
  const GeoPoint ground = cursor_of(state);
  put_elevation(state, for_whom, kUnknown);
  state.asked_for &= ~for_whom;
  const auto known_m = answered_elevation_m(step.surroundings, ground);
  if (known_m && std::isfinite(*known_m)) return put_elevation(state, for_whom, *known_m);
  // Those who wait for another ground stay without.
  if (!is_asked(state, ground)) state.asked_for = 0;
  state.asked_latitude_deg = ground.latitude_deg;
  state.asked_longitude_deg = ground.longitude_deg;
  state.asked_tick = step.surroundings.tick;
  state.asked_for |= for_whom;
}

void ask_no_more(RadarState& state, std::uint32_t for_whom) {
  state.asked_for &= ~for_whom;
}

bool waits_for_elevation(const RadarState& state, const databuffer::InputEvent& event,
                         const Surroundings& surroundings) {
  using radar::CursorFunction;
  const auto function = static_cast<CursorFunction>(state.cursor_function);
  const bool designates =
      event.kind == static_cast<std::uint16_t>(databuffer::EventKind::tdc_release) &&
      (function == CursorFunction::cue || function == CursorFunction::target || function == CursorFunction::mark);
  return designates && state.asked_for != 0 && !is_asked(state, cursor_of(state)) &&
         waited(state, surroundings.tick) < kAnswerTicks;
}

void take_elevation(RadarState& state, const Surroundings& surroundings) {
  if (state.asked_for == 0) return;
  const auto answer_m = answered_elevation_m(surroundings, {state.asked_latitude_deg, state.asked_longitude_deg});
  if (answer_m && std::isfinite(*answer_m)) {
    put_elevation(state, state.asked_for, *answer_m);
    state.asked_for = 0;
  } else if (waited(state, surroundings.tick) >= kGroundTicks) {
    state.asked_for = 0;
  }
}

void ask_for_cursor(RadarState& state) {
  if (state.asked_for != 0 || !has(state, databuffer::kCursorValid)) return;
  state.asked_latitude_deg = state.cursor_latitude_deg;
  state.asked_longitude_deg = state.cursor_longitude_deg;
}

}  // namespace yars::statemachine
