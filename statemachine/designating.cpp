#include "statemachine/designating.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>

#include "databuffer/records/navigation.hpp"
#include "databuffer/records/plain_text.hpp"
#include "lib/geo/geodesic.hpp"
#include "lib/radar/point_name.hpp"
#include "statemachine/elevations.hpp"
#include "statemachine/steering.hpp"
#include "statemachine/switches.hpp"

namespace yars::statemachine {

namespace {

using databuffer::RadarState;
using databuffer::text_of;
using radar::PointName;

constexpr int kGreatestNumber = 100;  // docs/spec/pilots_interface.md#rule-11
constexpr int kGreatestOffset = 99;

bool has_cursor(const Step& step) {
  return step.surroundings.ownship_valid && has(step.state, databuffer::kCursorValid);
}

// The cursor's point as the navigator has it at this moment: the state's own field is of the tick before, and the
// cursor may have jumped since.
geo::GeoPoint known_cursor(const Step& step) {
  const RadarState& state = step.state;
  const auto belief = databuffer::belief_in_use(step.surroundings.ownship, step.surroundings.nav, state);
  return belief.known_from_video({state.cursor_latitude_deg, state.cursor_longitude_deg});
}

void cue(RadarState& state, geo::GeoPoint known) {
  state.cue_latitude_deg = known.latitude_deg;
  state.cue_longitude_deg = known.longitude_deg;
  ++state.cue_count;
}

// The route's point on which this place lies; nullptr when there is none. One that is within a metre is the same: a
// place has gone through the navigator's geodesics.
const radar::RoutePoint* route_point_at(geo::GeoPoint known, const radar::RadarConfiguration& configuration) {
  const geo::Length same = geo::Length::metres(1.0);
  const auto found = std::ranges::find_if(configuration.route, [&](const radar::RoutePoint& point) {
    return geo::geodesic_inverse(known, point.place).distance <= same;
  });
  return found == configuration.route.end() ? nullptr : &*found;
}

bool is_of_route(std::string_view name, const radar::RadarConfiguration& configuration) {
  return std::ranges::find(configuration.route, name, &radar::RoutePoint::name) != configuration.route.end();
}

// A point of the route with this number: an offset matters to offsets alone, and "2" and "2." are one number.
bool is_taken(PointName wanted, const radar::RadarConfiguration& configuration) {
  return std::any_of(configuration.route.begin(), configuration.route.end(), [wanted](const auto& point) {
    const auto name = radar::point_name(point.name);
    if (!name || name->number != wanted.number) return false;
    return wanted.offset == 0 || (name->target && name->offset == wanted.offset);
  });
}

// With a target selected the next free offset of it, else the next free number; nothing when all are taken.
std::optional<PointName> next_free(const RadarState& state, const radar::RadarConfiguration& configuration) {
  const auto selected = radar::point_name(text_of(state.sequence_point));
  // A target that was designated itself makes way for the next one.
  const bool of_route = selected && is_taken({selected->number, 0, true}, configuration);
  if (selected && selected->target && of_route) {
    for (int offset = 1; offset <= kGreatestOffset; ++offset)
      if (!is_taken({selected->number, offset, true}, configuration)) return PointName{selected->number, offset, true};
    return std::nullopt;
  }
  for (int number = 1; number <= kGreatestNumber; ++number)
    if (!is_taken({number, 0, true}, configuration)) return PointName{number, 0, true};
  return std::nullopt;
}

// "4." or "4.01".
std::string text_of(PointName name) {
  std::array<char, 16> text{};
  const char* const form = name.offset == 0 ? "%d." : "%d.%02d";
  std::snprintf(text.data(), text.size(), form, name.number, name.offset);
  return text.data();
}

void put_target_name(RadarState& state, std::string_view name) {
  std::memset(state.target_name, 0, sizeof state.target_name);
  name.copy(state.target_name, sizeof state.target_name - 1);
}

// A point that exists keeps its name, its place and, where it has one, its elevation.
void put_target(Step& step, geo::GeoPoint known, const radar::RoutePoint* adopted) {
  constexpr std::uint32_t both = databuffer::kAskedForTarget | databuffer::kAskedForCue;
  RadarState& state = step.state;
  const geo::GeoPoint place = adopted ? adopted->place : known;
  state.target_latitude_deg = place.latitude_deg;
  state.target_longitude_deg = place.longitude_deg;
  cue(state, place);
  if (adopted && !std::isnan(adopted->elevation_m)) {
    ask_no_more(state, both);
    state.target_elevation_m = state.cue_elevation_m = adopted->elevation_m;
  } else {
    ask_elevation(step, both);
  }
}

}  // namespace

void cue_sensor(Step& step) {
  if (!has_cursor(step)) return;
  cue(step.state, known_cursor(step));
  ask_elevation(step, databuffer::kAskedForCue);
}

void designate_target(Step& step) {
  RadarState& state = step.state;
  if (!has_cursor(step)) return;
  const geo::GeoPoint known = known_cursor(step);
  const radar::RoutePoint* const adopted = route_point_at(known, step.configuration);
  const auto free = adopted ? std::nullopt : next_free(state, step.configuration);
  if (!adopted && !free) return refuse(step, "NO FREE NUMBER");
  // The selection goes with a target whose old name is nobody's from now on.
  const std::string_view old_name = text_of(state.target_name);
  const bool moves_selection = has(state, databuffer::kTargetDesignated) && text_of(state.sequence_point) == old_name &&
                               !is_of_route(old_name, step.configuration);
  put_target_name(state, adopted ? adopted->name : text_of(*free));
  if (moves_selection) std::ranges::copy(state.target_name, state.sequence_point);
  put_target(step, known, adopted);
  ++state.target_count;
  set_flag(state, databuffer::kTargetDesignated, true);
  lead_along_line_of_sight(state, step.surroundings);
}

void store_mark(Step& step) {
  RadarState& state = step.state;
  if (!has_cursor(step)) return;
  if (state.mark_count >= databuffer::kMarks) {
    constexpr std::uint32_t every_mark = (1U << databuffer::kMarks) - 1;
    std::rotate(std::begin(state.marks), std::begin(state.marks) + 1, std::end(state.marks));
    state.mark_count = databuffer::kMarks - 1;
    state.asked_for = (state.asked_for & ~every_mark) | (state.asked_for & every_mark) >> 1U;
  }
  const geo::GeoPoint known = known_cursor(step);
  const unsigned number = state.mark_count++;
  state.marks[number] = {known.latitude_deg, known.longitude_deg, 0.0, step.surroundings.sim_time_ns};
  ask_elevation(step, 1U << number);
  show_message(state, step.surroundings, "MARK " + std::to_string(state.mark_count));
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
