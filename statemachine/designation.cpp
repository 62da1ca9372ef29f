#include "statemachine/designation.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "databuffer/messages/derived_values.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"
#include "statemachine/maps.hpp"

namespace yars::statemachine {

namespace {

using databuffer::RadarState;
using geo::GeoPoint;

constexpr std::int64_t kAnswerTicks = 20;   // 0.1 s; a running model answers within this time
constexpr std::int64_t kGiveUpTicks = 400;  // 2 s; terrain still unknown by then is void or not loaded

bool is_requested(const RadarState& state, GeoPoint ground) {
  return state.asked_latitude_deg == ground.latitude_deg && state.asked_longitude_deg == ground.longitude_deg;
}

void put_elevation(RadarState& state, std::uint32_t recipients, double elevation_m) {
  for (std::uint32_t mark = 0; mark < databuffer::kMarks; ++mark)
    if ((recipients >> mark & 1U) != 0) state.marks[mark].elevation_m = elevation_m;
  if ((recipients & databuffer::kAskedForTarget) != 0) state.target_elevation_m = elevation_m;
  if ((recipients & databuffer::kAskedForCue) != 0) state.cue_elevation_m = elevation_m;
}

// Ticks since the request; kGiveUpTicks if the time was set back, so that the request ends.
std::int64_t ticks_waited(const RadarState& state, std::int64_t tick) {
  return tick < state.asked_tick ? kGiveUpTicks : tick - state.asked_tick;
}

}  // namespace

std::optional<double> answered_elevation_m(const Inputs& inputs, GeoPoint ground) {
  const databuffer::ModelStatus& model = inputs.model;
  const bool same =
      model.answered_latitude_deg == ground.latitude_deg && model.answered_longitude_deg == ground.longitude_deg;
  return same ? std::optional(model.answered_elevation_m) : std::nullopt;
}

void request_elevation(Step& step, std::uint32_t recipients) {
  RadarState& state = step.state;
  const GeoPoint ground = cursor_of(state);
  put_elevation(state, recipients, kUnknown);
  state.asked_for &= ~recipients;
  const auto known_m = answered_elevation_m(step.inputs, ground);
  if (known_m && std::isfinite(*known_m)) return put_elevation(state, recipients, *known_m);
  // A request for another ground position is dropped, and its recipients keep an unknown elevation.
  if (!is_requested(state, ground)) state.asked_for = 0;
  state.asked_latitude_deg = ground.latitude_deg;
  state.asked_longitude_deg = ground.longitude_deg;
  state.asked_tick = step.inputs.tick;
  state.asked_for |= recipients;
}

void cancel_request(RadarState& state, std::uint32_t recipients) {
  state.asked_for &= ~recipients;
}

bool waits_for_elevation(const RadarState& state, const databuffer::InputEvent& event, const Inputs& inputs) {
  using radar::CursorFunction;
  const auto function = static_cast<CursorFunction>(state.cursor_function);
  const bool designates =
      event.kind == static_cast<std::uint16_t>(databuffer::EventKind::tdc_release) &&
      (function == CursorFunction::cue || function == CursorFunction::target || function == CursorFunction::mark);
  return designates && state.asked_for != 0 && !is_requested(state, cursor_of(state)) &&
         ticks_waited(state, inputs.tick) < kAnswerTicks;
}

void take_elevation(RadarState& state, const Inputs& inputs) {
  if (state.asked_for == 0) return;
  const auto answer_m = answered_elevation_m(inputs, {state.asked_latitude_deg, state.asked_longitude_deg});
  if (answer_m && std::isfinite(*answer_m)) {
    put_elevation(state, state.asked_for, *answer_m);
    state.asked_for = 0;
  } else if (ticks_waited(state, inputs.tick) >= kGiveUpTicks) {
    state.asked_for = 0;
  }
}

void request_cursor_elevation(RadarState& state) {
  if (state.asked_for != 0 || !has(state, databuffer::kCursorValid)) return;
  state.asked_latitude_deg = state.cursor_latitude_deg;
  state.asked_longitude_deg = state.cursor_longitude_deg;
}

namespace {

using databuffer::SteeringLine;
using geo::Bearing;

constexpr double kTurnRate_dps = 45.0;  // turn of the line at full TDC deflection: 180 deg in 4 s
constexpr double kGravity_mps2 = 9.80665;
// Decay time of the aircraft's offset from the line. Intercept angle: atan(offset / (speed * kCapture_s)).
constexpr double kCapture_s = 15.0;
constexpr double kTurn_s = 5.0;        // time constant of the turn to the wanted track
constexpr double kMaxBank_deg = 60.0;  // larger commands are clamped
constexpr double kMinSpeed_mps = 1.0;  // below this ground speed the track has no direction, and the bank is 0

SteeringLine line_of(const RadarState& state) {
  return static_cast<SteeringLine>(state.steering_line);
}

void put_line(RadarState& state, SteeringLine line) {
  state.steering_line = static_cast<std::uint8_t>(line);
}

// Geodesic from the aircraft's true position to the displayed position of the target.
geo::GeodesicInverse sight_of_target(const RadarState& state, const Inputs& inputs) {
  const auto navigator = databuffer::selected_navigator_position(inputs.ownship, inputs.nav, state);
  return geo::geodesic_inverse(navigator.truth,
                               navigator.on_video({state.target_latitude_deg, state.target_longitude_deg}));
}

// Bank angle [deg], right wing down positive, that turns the aircraft onto the line through the target with heading
// `approach`. `sight`: geodesic from the aircraft to the target.
double bank_onto_line(const geo::GeodesicInverse& sight, Bearing approach, const databuffer::Ownship& ownship) {
  const double speed_mps = std::hypot(ownship.velocity_north_mps, ownship.velocity_east_mps);
  if (speed_mps < kMinSpeed_mps) return 0.0;
  // Offset of the aircraft from the line [m], positive to the right as seen along the approach.
  const double right_m = sight.distance.metres() * std::sin((approach - sight.azimuth_at_start).radians());
  const Bearing wanted = approach - geo::Angle::radians(std::atan2(right_m, speed_mps * kCapture_s));
  const double turn_rate_radps = (wanted - databuffer::ground_track_of(ownship)).radians() / kTurn_s;
  const double bank_deg = std::atan(speed_mps * turn_rate_radps / kGravity_mps2) / geo::kRadiansPerDegree;
  return std::clamp(bank_deg, -kMaxBank_deg, kMaxBank_deg);
}

}  // namespace

void steer_by_acquisition_switch(Step& step) {
  if (step.event.argument < 0) {
    put_line(step.state, SteeringLine::slewing);
  } else if (step.event.argument > 0 && line_of(step.state) != SteeringLine::line_of_sight) {
    steer_line_of_sight(step.state, step.inputs);
  }
}

void fix_steering_line(Step& step) {
  put_line(step.state, SteeringLine::fixed);
}

bool slews_steering_line(const RadarState& state) {
  return line_of(state) == SteeringLine::slewing;
}

void steer_line_of_sight(RadarState& state, const Inputs& inputs) {
  put_line(state, SteeringLine::line_of_sight);
  if (inputs.ownship_valid) advance_steering_line(state, inputs);
}

void advance_steering_line(RadarState& state, const Inputs& inputs) {
  if (!has(state, databuffer::kTargetDesignated)) return put_line(state, SteeringLine::none);
  switch (line_of(state)) {
    case SteeringLine::line_of_sight:
      state.steering_line_deg = sight_of_target(state, inputs).azimuth_at_start.degrees();
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

void put_steering(databuffer::Outputs& outputs, const RadarState& state, const Inputs& inputs) {
  const geo::GeodesicInverse sight = sight_of_target(state, inputs);
  outputs.approach_deg = state.steering_line_deg;
  const bool fixed = line_of(state) == SteeringLine::fixed;
  outputs.steering =
      static_cast<std::uint8_t>(fixed ? databuffer::SteeringCommand::bank : databuffer::SteeringCommand::azimuth);
  outputs.steering_deg = fixed ? bank_onto_line(sight, Bearing::degrees(state.steering_line_deg), inputs.ownship)
                               : (sight.azimuth_at_start - databuffer::ground_track_of(inputs.ownship)).degrees();
}

namespace {

using radar::PointName;
using text::text_of;

// Navigator coordinates of the cursor. They are computed again, because the cursor may have jumped in this tick.
geo::GeoPoint known_cursor(const Step& step) {
  const RadarState& state = step.state;
  const auto navigator = databuffer::selected_navigator_position(step.inputs.ownship, step.inputs.nav, state);
  return navigator.coordinates_from_video(cursor_of(state));
}

void cue(RadarState& state, geo::GeoPoint known) {
  state.cue_latitude_deg = known.latitude_deg;
  state.cue_longitude_deg = known.longitude_deg;
  ++state.cue_count;
}

// [display units] Maximum distance at which a symbol counts as under the cursor. It is about the width of a drawn line:
// the display does not show a shorter distance. The cursor stays at its ground position, but a navigator error that
// drifts moves the symbols. So after a jump to a point, the point's symbol is soon some metres off the cursor.
constexpr double kUnderCursor = 2.0;

// The point of the route whose drawn symbol is under the cursor; nullptr if there is none. Of several, the selected
// point is preferred, then the point nearest to the cursor.
const radar::RoutePoint* route_point_under_cursor(const Step& step) {
  const RadarState& state = step.state;
  const auto plane = plane_of(state, step.inputs, step.parameters.view);
  if (!plane) return nullptr;
  const auto navigator = databuffer::selected_navigator_position(step.inputs.ownship, step.inputs.nav, state);
  const DisplayPoint cursor = plane->display_from_ground(cursor_of(state));
  const radar::RoutePoint* nearest = nullptr;
  double least = kUnderCursor;
  for (const databuffer::DrawnPoint& drawn : std::span(state.points, state.points_drawn)) {
    const auto point = std::ranges::find(step.parameters.route, text_of(drawn.name), &radar::RoutePoint::name);
    if (point == step.parameters.route.end()) continue;
    const DisplayPoint symbol = plane->display_from_ground(navigator.on_video(point->position));
    const double off = plane->units_between(symbol, cursor);
    if (off > kUnderCursor) continue;
    if (drawn.selected != 0) return &*point;
    if (off > least) continue;
    nearest = &*point;
    least = off;
  }
  return nearest;
}

bool is_of_route(std::string_view name, const Parameters& parameters) {
  return std::ranges::find(parameters.route, name, &radar::RoutePoint::name) != parameters.route.end();
}

// True if a point of the route, target or not, has the number of `wanted`. If `wanted` is an offset: true if a target
// of the route has both the number and the offset.
bool is_taken(PointName wanted, const Parameters& parameters) {
  return std::any_of(parameters.route.begin(), parameters.route.end(), [wanted](const auto& point) {
    const auto name = radar::point_name(point.name);
    if (!name || name->number != wanted.number) return false;
    return wanted.offset == 0 || (name->target && name->offset == wanted.offset);
  });
}

// Name of a new target: the lowest free offset if a target of the route is selected, else the lowest free number.
// nullopt: no free name.
std::optional<PointName> next_free(const RadarState& state, const Parameters& parameters) {
  const auto selected = radar::point_name(text_of(state.sequence_point));
  // A designated target that is not a point of the route gets no offsets, because the new target replaces it.
  const bool of_route = selected && is_taken({selected->number, 0, true}, parameters);
  if (selected && selected->target && of_route) {
    for (int offset = 1; offset <= radar::kMaxPointOffset; ++offset)
      if (!is_taken({selected->number, offset, true}, parameters)) return PointName{selected->number, offset, true};
    return std::nullopt;
  }
  for (int number = 1; number <= radar::kMaxPointNumber; ++number)
    if (!is_taken({number, 0, true}, parameters)) return PointName{number, 0, true};
  return std::nullopt;
}

// Stores target and cue. `adopted`: point of the route that becomes the target, with its own position and elevation;
// nullptr: the target is at the cursor.
void put_target(Step& step, const radar::RoutePoint* adopted) {
  constexpr std::uint32_t both = databuffer::kAskedForTarget | databuffer::kAskedForCue;
  RadarState& state = step.state;
  const geo::GeoPoint position = adopted ? adopted->position : known_cursor(step);
  state.target_latitude_deg = position.latitude_deg;
  state.target_longitude_deg = position.longitude_deg;
  cue(state, position);
  if (adopted && !std::isnan(adopted->elevation_m)) {
    cancel_request(state, both);
    state.target_elevation_m = state.cue_elevation_m = adopted->elevation_m;
  } else {
    request_elevation(step, both);
  }
}

}  // namespace

void cue_sensor(Step& step) {
  if (refuses_without_cursor(step)) return;
  cue(step.state, known_cursor(step));
  request_elevation(step, databuffer::kAskedForCue);
}

void designate_target(Step& step) {
  RadarState& state = step.state;
  if (refuses_without_cursor(step)) return;
  const radar::RoutePoint* const adopted = route_point_under_cursor(step);
  const auto free = adopted ? std::nullopt : next_free(state, step.parameters);
  if (!adopted && !free) return refuse(step, "NO FREE NUMBER");
  // If the old target is the selected sequence point, the new target is selected. A point of the route stays selected.
  const std::string_view old_name = text_of(state.target_name);
  const bool moves_selection = has(state, databuffer::kTargetDesignated) && text_of(state.sequence_point) == old_name &&
                               !is_of_route(old_name, step.parameters);
  text::put_text(state.target_name, adopted ? adopted->name : radar::text_of(*free));
  if (moves_selection) std::ranges::copy(state.target_name, state.sequence_point);
  put_target(step, adopted);
  ++state.target_count;
  set_flag(state, databuffer::kTargetDesignated, true);
  steer_line_of_sight(state, step.inputs);
}

void store_mark(Step& step) {
  RadarState& state = step.state;
  if (refuses_without_cursor(step)) return;
  // If the list is full, the oldest mark is dropped. Marks and the bits of their open requests move down by one.
  if (state.mark_count >= databuffer::kMarks) {
    constexpr std::uint32_t every_mark = (1U << databuffer::kMarks) - 1;
    std::rotate(std::begin(state.marks), std::begin(state.marks) + 1, std::end(state.marks));
    state.mark_count = databuffer::kMarks - 1;
    state.asked_for = (state.asked_for & ~every_mark) | (state.asked_for & every_mark) >> 1U;
  }
  const geo::GeoPoint known = known_cursor(step);
  const unsigned number = state.mark_count++;
  state.marks[number] = {known.latitude_deg, known.longitude_deg, 0.0, step.inputs.sim_time_ns};
  request_elevation(step, 1U << number);
  show_message(state, step.inputs, "MARK " + std::to_string(state.mark_count));
}

void move_target_with_route(RadarState& state, std::span<const radar::RoutePoint> before,
                            const Parameters& parameters) {
  if (!has(state, databuffer::kTargetDesignated)) return;
  const std::string_view name = text_of(state.target_name);
  const auto old_point = std::ranges::find(before, name, &radar::RoutePoint::name);
  const auto new_point = std::ranges::find(parameters.route, name, &radar::RoutePoint::name);
  if (old_point == before.end() || new_point == parameters.route.end()) return;
  if (GeoPoint{state.target_latitude_deg, state.target_longitude_deg} != old_point->position) return;
  const bool is_moved = new_point->position != old_point->position;
  if (!is_moved && std::isnan(new_point->elevation_m)) return;  // the target may have the elevation of the ground
  state.target_latitude_deg = new_point->position.latitude_deg;
  state.target_longitude_deg = new_point->position.longitude_deg;
  state.target_elevation_m = new_point->elevation_m;
  cancel_request(state, databuffer::kAskedForTarget);
}

std::optional<radar::RoutePoint> designated_point(const RadarState& state) {
  if (!has(state, databuffer::kTargetDesignated)) return std::nullopt;
  const std::string_view name = text_of(state.target_name);
  const auto parts = radar::point_name(name);
  const bool offset = parts && parts->offset > 0;
  return radar::RoutePoint{std::string(name),
                           offset ? radar::PointKind::target_offset : radar::PointKind::target,
                           {state.target_latitude_deg, state.target_longitude_deg},
                           state.target_elevation_m};
}

}  // namespace yars::statemachine
