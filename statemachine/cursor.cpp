#include "statemachine/cursor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "databuffer/messages/derived_values.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/view.hpp"
#include "lib/text/plain_text.hpp"
#include "statemachine/designation.hpp"
#include "statemachine/maps.hpp"

namespace yars::statemachine {

namespace {

using databuffer::PatchMap;
using databuffer::RadarState;
using geo::GeoPoint;

constexpr double kCrossing_s = 2.0;  // edge-to-edge time at full TDC deflection; docs/pilots_manual.md#tdc

GeoPoint aircraft_of(const Inputs& inputs) {
  return {inputs.ownship.latitude_deg, inputs.ownship.longitude_deg};
}

void put_cursor(RadarState& state, GeoPoint position, std::int64_t tick) {
  if (position.latitude_deg != state.cursor_latitude_deg || position.longitude_deg != state.cursor_longitude_deg)
    state.cursor_elevation_m = kUnknown;
  state.cursor_latitude_deg = position.latitude_deg;
  state.cursor_longitude_deg = position.longitude_deg;
  state.cursor_moved_tick = tick;
  set_flag(state, databuffer::kCursorValid, true);
}

void update_frame_from_aircraft(RadarState& state, const Inputs& inputs) {
  // A frozen picture keeps the frame of its last sweep. After the command FREEZE the radar completes the scan first.
  const bool frozen = has(state, databuffer::kFreeze) && (inputs.model.flags & databuffer::kModelFrozen) != 0;
  if (frozen) return;
  const databuffer::Ownship& ownship = inputs.ownship;
  state.frame_latitude_deg = ownship.latitude_deg;
  state.frame_longitude_deg = ownship.longitude_deg;
  state.frame_track_deg = databuffer::ground_track_of(ownship).degrees();
}

void update_frame(RadarState& state, const Inputs& inputs) {
  if (state.map_shown == 0) return update_frame_from_aircraft(state, inputs);
  const PatchMap* map = map_of(inputs, state.map_shown);
  if (map == nullptr) return;
  state.frame_latitude_deg = map->apex_latitude_deg;
  state.frame_longitude_deg = map->apex_longitude_deg;
  state.frame_track_deg = map->up_deg;
}

void place_cursor(RadarState& state, const PicturePlane& plane, const Inputs& inputs, const Parameters& parameters) {
  const DisplayPoint middle{0.0, state.map_shown == 0 ? 0.5 : 0.0};
  GeoPoint position = plane.ground_from_display(middle);
  if (const auto point = selected_point(state, parameters)) {
    const GeoPoint seen =
        databuffer::selected_navigator_position(inputs.ownship, inputs.nav, state).on_video(point->position);
    if (plane.shows(plane.display_from_ground(seen))) position = seen;
  }
  put_cursor(state, position, inputs.tick);
}

void slew(RadarState& state, const PicturePlane& plane, std::int64_t tick) {
  // The cursor stands still while the TDC turns the pattern steering line.
  if (!shows_cursor(state) || slews_steering_line(state)) return;
  if (state.tdc_x == 0.0 && state.tdc_y == 0.0) return;
  const double fraction = radar::kTickSeconds / kCrossing_s;
  const auto& view = plane.view;
  const DisplayPoint from = plane.display_from_ground(cursor_of(state));
  const double x = from.x + state.tdc_x * fraction * (view.width_max - view.width_min);
  const double y = from.y + state.tdc_y * fraction * (view.height_max - view.height_min);
  const DisplayPoint to{std::clamp(x, view.width_min, view.width_max), std::clamp(y, view.height_min, view.height_max)};
  put_cursor(state, plane.ground_from_display(to), tick);
}

void put_readouts(RadarState& state, const Inputs& inputs) {
  const auto inverse = geo::geodesic_inverse(aircraft_of(inputs), cursor_of(state));
  state.cursor_bearing_deg = (inverse.azimuth_at_start - geo::Angle::degrees(state.magnetic_variation_deg)).degrees();
  state.cursor_range_nm = inverse.distance.nautical_miles();
  if (const auto elevation_m = answered_elevation_m(inputs, cursor_of(state))) state.cursor_elevation_m = *elevation_m;
  const auto navigator = databuffer::selected_navigator_position(inputs.ownship, inputs.nav, state);
  const GeoPoint believed = navigator.coordinates_from_video(cursor_of(state));
  state.cursor_believed_latitude_deg = believed.latitude_deg;
  state.cursor_believed_longitude_deg = believed.longitude_deg;
}

}  // namespace

void deflect(Step& step) {
  if (!std::isfinite(step.event.x) || !std::isfinite(step.event.y)) return;
  step.state.tdc_x = std::clamp(step.event.x, -1.0, 1.0);
  step.state.tdc_y = std::clamp(step.event.y, -1.0, 1.0);
}

void point_cursor(Step& step) {
  const databuffer::InputEvent& event = step.event;
  if (!std::isfinite(event.x) || !std::isfinite(event.y) || !step.inputs.ownship_valid) return;
  if (!shows_cursor(step.state) || slews_steering_line(step.state)) return;
  const auto plane = plane_of(step.state, step.inputs, step.parameters.view);
  if (plane)
    put_cursor(step.state, plane->ground_from_display(plane->at_fractions(event.x, event.y)), step.inputs.tick);
}

void next_cursor_function(Step& step) {
  constexpr int kFunctions = 5;
  constexpr auto kMap = static_cast<std::uint8_t>(radar::CursorFunction::map);
  std::uint8_t& function = step.state.cursor_function;
  do {
    function = static_cast<std::uint8_t>((function + 1) % kFunctions);
  } while (function == kMap && has(step.state, databuffer::kSet));
  // Leaving TGT ends the slewing of the steering line, so that the TDC moves the cursor again.
  if (slews_steering_line(step.state)) steer_line_of_sight(step.state, step.inputs);
}

void jump_cursor(RadarState& state, GeoPoint known, const Inputs& inputs) {
  const auto navigator = databuffer::selected_navigator_position(inputs.ownship, inputs.nav, state);
  put_cursor(state, inputs.ownship_valid ? navigator.on_video(known) : known, inputs.tick);
}

bool shows_cursor(const RadarState& state) {
  const radar::Mode mode = running_mode(state);
  const bool without_picture = mode == radar::Mode::air_to_air || mode == radar::Mode::ranging;
  return mode != radar::Mode::pvu && (!without_picture || has(state, databuffer::kSet));
}

void advance_cursor(RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  update_frame(state, inputs);
  if (const auto plane = plane_of(state, inputs, parameters.view)) {
    if (!has(state, databuffer::kCursorValid)) place_cursor(state, *plane, inputs, parameters);
    slew(state, *plane, inputs.tick);
  }
  if (has(state, databuffer::kCursorValid)) put_readouts(state, inputs);
}

namespace {

using databuffer::DrawnPoint;
using radar::RoutePoint;
using text::text_of;

constexpr std::size_t kMaxDrawn = 5;  // points; docs/pilots_manual.md#rule-11. The record has space for more
static_assert(kMaxDrawn <= radar::kMaxPointsDrawn);

// Point of the route, or designated target, with this name; nullopt if there is none.
std::optional<RoutePoint> find_point(std::string_view name, const RadarState& state, const Parameters& parameters) {
  const auto found = std::find_if(parameters.route.begin(), parameters.route.end(),
                                  [name](const RoutePoint& point) { return point.name == name; });
  if (found != parameters.route.end()) return *found;
  const auto target = designated_point(state);
  return target && target->name == name ? target : std::nullopt;
}

bool survives_declutter(const RoutePoint& point) {
  return point.kind == radar::PointKind::target || point.kind == radar::PointKind::target_offset;
}

void select(Step& step, const std::optional<RoutePoint>& point) {
  if (!point) return;
  text::put_text(step.state.sequence_point, point->name);
  jump_cursor(step.state, point->position, step.inputs);
}

// The kMaxDrawn nearest points, sorted by distance. Points that are always drawn are added with distance 0.
class Nearest {
 public:
  void take(const RoutePoint* point, geo::Length distance) {
    if (!point) return;
    const auto end = entries_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto slot =
        std::find_if(entries_.begin(), end, [distance](const Entry& entry) { return distance < entry.distance; });
    if (slot == entries_.end()) return;
    std::move_backward(slot, count_ < kMaxDrawn ? end : end - 1, count_ < kMaxDrawn ? end + 1 : end);
    *slot = {point, distance};
    count_ = std::min(count_ + 1, kMaxDrawn);
  }

  struct Entry {
    const RoutePoint* point = nullptr;
    geo::Length distance;
  };
  std::span<Entry> entries() { return {entries_.data(), count_}; }

 private:
  std::array<Entry, kMaxDrawn> entries_{};
  std::size_t count_ = 0;
};

// True if the point is an offset of an initial point.
bool is_of_initial_point(const RoutePoint& point, std::span<const RoutePoint> route) {
  if (point.kind != radar::PointKind::steer_offset) return false;
  const auto offset = radar::point_name(point.name);
  return offset && std::ranges::any_of(route, [&offset](const RoutePoint& other) {
           const auto name = radar::point_name(other.name);
           return other.kind == radar::PointKind::initial && name && name->number == offset->number;
         });
}

DrawnPoint drawn(const RoutePoint& point, std::string_view selected, std::span<const RoutePoint> route) {
  DrawnPoint entry{};
  entry.latitude_deg = point.position.latitude_deg;
  entry.longitude_deg = point.position.longitude_deg;
  entry.elevation_m = point.elevation_m;
  text::put_text(entry.name, point.name);
  entry.kind = static_cast<std::uint8_t>(point.kind);
  entry.selected = point.name == selected ? 1 : 0;
  entry.of_initial_point = is_of_initial_point(point, route) ? 1 : 0;
  return entry;
}

}  // namespace

void next_sequence_point(Step& step) {
  const std::span points(step.state.points, step.state.points_drawn);
  if (points.empty()) return;
  const std::string_view present = text_of(step.state.sequence_point);
  const auto after = std::find_if(points.begin(), points.end(), [present](const DrawnPoint& point) {
    return radar::precedes(present, text_of(point.name));
  });
  const DrawnPoint& next = after == points.end() ? points.front() : *after;
  select(step, find_point(text_of(next.name), step.state, step.parameters));
}

std::string no_such_point(std::string_view name) {
  return "NO POINT " + std::string(name);
}

void select_sequence_point(Step& step) {
  const std::string_view name = text_of(step.event.text);
  const auto point = find_point(name, step.state, step.parameters);
  if (!point) return refuse(step, no_such_point(name));
  select(step, point);
}

void select_first_sequence_point(RadarState& state, const Parameters& parameters) {
  const auto first =
      std::min_element(parameters.route.begin(), parameters.route.end(),
                       [](const RoutePoint& a, const RoutePoint& b) { return radar::precedes(a.name, b.name); });
  text::put_text(state.sequence_point, first == parameters.route.end() ? std::string_view() : first->name);
}

std::optional<RoutePoint> selected_point(const RadarState& state, const Parameters& parameters) {
  return find_point(text_of(state.sequence_point), state, parameters);
}

void draw_points(RadarState& state, const Inputs& inputs, const Parameters& parameters) {
  const std::string_view selected = text_of(state.sequence_point);
  const std::optional<RoutePoint> target = designated_point(state);
  Nearest nearest;
  if (target) nearest.take(&*target, geo::Length());
  const auto is_target = [&target](const RoutePoint& point) { return target && point.name == target->name; };
  const GeoPoint aircraft = aircraft_of(inputs);
  const geo::Length range = geo::Length::nautical_miles(state.range_nm);
  for (const RoutePoint& point : parameters.route) {
    if (is_target(point)) continue;  // the target is already in the list
    if (point.name == selected) {
      nearest.take(&point, geo::Length());
      continue;
    }
    if (!inputs.ownship_valid) continue;
    if (has(state, databuffer::kDeclutter) && !survives_declutter(point)) continue;
    const geo::Length distance = geo::geodesic_inverse(aircraft, point.position).distance;
    if (distance <= range) nearest.take(&point, distance);
  }

  // Insertion sort by number.
  const auto entries = nearest.entries();
  const auto precedes = [](const auto& a, const auto& b) { return radar::precedes(a.point->name, b.point->name); };
  for (auto next = entries.begin(); next != entries.end(); ++next)
    std::rotate(std::upper_bound(entries.begin(), next, *next, precedes), next, next + 1);
  std::fill(std::begin(state.points), std::end(state.points), DrawnPoint{});
  std::transform(entries.begin(), entries.end(), state.points,
                 [&](const auto& entry) { return drawn(*entry.point, selected, parameters.route); });
  state.points_drawn = static_cast<std::uint8_t>(entries.size());
}

}  // namespace yars::statemachine
