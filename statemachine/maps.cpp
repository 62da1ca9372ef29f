#include "statemachine/maps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "databuffer/messages/derived_values.hpp"
#include "lib/radar/mission.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::statemachine {

namespace {

using databuffer::RadarState;
using radar::CursorFunction;
using radar::Mode;
using radar::Recall;

Recall recall_of(const RadarState& state) {
  return static_cast<Recall>(state.recall);
}

void put_recall(RadarState& state, Recall recall) {
  state.recall = static_cast<std::uint8_t>(recall);
}

// True if patch map is the radar mode of A/G, even while A/A or A/G ranging uses the radar.
bool on_patch(const RadarState& state) {
  return state.ground_mode == static_cast<std::uint8_t>(Mode::patch);
}

void release_stored(RadarState& state) {
  const bool is_newest = state.map_stored == state.map_newest;
  // The stored map becomes OLD, unless it is the newest.
  if (!is_newest) state.map_old = state.map_stored;
  if (recall_of(state) == Recall::store) put_recall(state, is_newest ? Recall::newest : Recall::old);
  state.map_stored = 0;
}

}  // namespace

void toggle_freeze(Step& step) {
  if (has(step.state, databuffer::kFreeze)) {
    thaw(step.state);
  } else {
    freeze(step.state);
  }
}

void flip_recall(Step& step) {
  RadarState& state = step.state;
  const bool stored = state.map_stored != 0;
  if (recall_of(state) != Recall::newest) {
    put_recall(state, Recall::newest);
  } else if (stored || state.map_old != 0) {
    put_recall(state, stored ? Recall::store : Recall::old);
  }
}

void toggle_store(Step& step) {
  RadarState& state = step.state;
  if (state.map_stored != 0) return release_stored(state);
  // A frozen HRM PPI is not a map: the newest map is stored and shown instead.
  state.map_stored = state.map_shown != 0 ? state.map_shown : state.map_newest;
  put_recall(state, Recall::store);
}

void toggle_set(Step& step) {
  RadarState& state = step.state;
  const bool on = !has(state, databuffer::kSet);
  set_flag(state, databuffer::kSet, on);
  if (!on) {
    if (master_of(state) == radar::Master::air_to_ground) thaw_on_return(state);
  } else if (state.cursor_function == static_cast<std::uint8_t>(CursorFunction::map)) {
    state.cursor_function = static_cast<std::uint8_t>(CursorFunction::update);
  }
}

void freeze(RadarState& state) {
  set_flag(state, databuffer::kFreeze, true);
  if (on_patch(state) && recall_of(state) == Recall::none) put_recall(state, Recall::newest);
}

void thaw(RadarState& state) {
  set_flag(state, databuffer::kFreeze | databuffer::kFrozenByHrmExit | databuffer::kRecalledByHrmExit, false);
  state.map_stored = 0;
  put_recall(state, Recall::none);
}

void freeze_silent_hrm(RadarState& state) {
  const Mode mode = running_mode(state);
  const bool silent = has(state, databuffer::kSniff) && (mode == Mode::hrm || mode == Mode::patch);
  if (silent) freeze(state);
}

void freeze_on_leaving(RadarState& state) {
  const Mode mode = running_mode(state);
  if (state.map_newest == 0 || (mode != Mode::hrm && mode != Mode::patch)) return;
  if (!has(state, databuffer::kFreeze)) {
    freeze(state);
    set_flag(state, databuffer::kFrozenByHrmExit, true);
  }
  if (recall_of(state) != Recall::none) return;
  put_recall(state, Recall::newest);
  set_flag(state, databuffer::kRecalledByHrmExit, true);
}

void thaw_on_return(RadarState& state) {
  if (has(state, databuffer::kSet)) return;
  // Shows the PPI again if the pilot had frozen the PPI.
  if (has(state, databuffer::kRecalledByHrmExit)) put_recall(state, Recall::none);
  set_flag(state, databuffer::kRecalledByHrmExit, false);
  if (!has(state, databuffer::kFrozenByHrmExit)) return;
  thaw(state);
  freeze_silent_hrm(state);
}

std::uint64_t map_to_show(const RadarState& state) {
  switch (recall_of(state)) {
    case Recall::newest:
      return state.map_newest;
    case Recall::old:
      return state.map_old;
    case Recall::store:
      return state.map_stored;
    case Recall::none:
      break;
  }
  return on_patch(state) ? state.map_newest : 0;
}

namespace {

using databuffer::ModelStatus;
using databuffer::PatchMap;

geo::Length range_to_cursor(const Step& step) {
  const databuffer::Ownship& ownship = step.inputs.ownship;
  return geo::geodesic_inverse({ownship.latitude_deg, ownship.longitude_deg},
                               {step.state.cursor_latitude_deg, step.state.cursor_longitude_deg})
      .distance;
}

// Window of the map to command [NM]. For a blank window: the window for the cursor range, or 0 if no window fits.
double window_to_map_nm(const Step& step) {
  if (step.state.window_nm > 0.0) return step.state.window_nm;
  const auto window = radar::window_of_blank_selection(range_to_cursor(step), step.parameters.window_limits);
  return window ? window->nautical_miles() : 0.0;
}

// Reason why no map can be made at the cursor; nullopt: a map can be made. Computed here, because the model's status is
// from the last tick and the cursor may have jumped since. While the elevation of the ground at the cursor is unknown,
// the depression of the line of sight is not checked here. The model checks that angle when the map starts.
std::optional<std::string_view> unmappable_reason(const Step& step) {
  const databuffer::Ownship& ownship = step.inputs.ownship;
  const radar::MapViewpoint from{{ownship.latitude_deg, ownship.longitude_deg},
                                 geo::AltitudeMsl::metres(ownship.altitude_msl_m),
                                 databuffer::platform_of(ownship)};
  radar::MapCentre centre{cursor_of(step.state), std::nullopt};
  if (std::isfinite(step.state.cursor_elevation_m)) centre.ground_m = step.state.cursor_elevation_m;
  return radar::map_rejection(from, centre, {geo::Length::nautical_miles(step.state.window_nm)},
                              step.parameters.map_limits);
}

// Reason that the model gives for not making a commanded map, or for stopping re-maps. Trust boundary: a text with
// non-printable characters is ignored.
std::string_view stop_reason(const ModelStatus& model) {
  const std::string_view reason = text::text_of(model.map_stopped);
  return std::ranges::all_of(reason, [](char letter) { return letter >= ' ' && letter <= '~'; }) ? reason
                                                                                                 : std::string_view();
}

// Next request number. It exceeds all request numbers in state and model, so that no old map matches after a restart.
std::uint32_t next_request(const RadarState& state, const ModelStatus& model) {
  return std::max({state.map_request, model.map_request, model.map_done_request}) + 1;
}

void take_commanded(RadarState& state, std::uint64_t id) {
  // If a map is stored, OLD is that map. Else OLD is the former newest map.
  state.map_old = state.map_stored != 0 ? state.map_stored : state.map_newest;
  state.map_newest = id;
  set_flag(state, databuffer::kMapping, false);
  if (has(state, databuffer::kFreeze)) put_recall(state, Recall::newest);
}

}  // namespace

void command_map(Step& step) {
  RadarState& state = step.state;
  if (refuses_without_cursor(step)) return;
  if (const auto reason = unmappable_reason(step)) return refuse(step, *reason);
  const double window_nm = window_to_map_nm(step);
  if (!(window_nm > 0.0)) return refuse(step, "NO WINDOW");
  state.map_request = next_request(state, step.inputs.model);
  state.map_latitude_deg = state.cursor_latitude_deg;
  state.map_longitude_deg = state.cursor_longitude_deg;
  state.map_window_nm = window_nm;
  set_flag(state, databuffer::kMapWindowBlank, state.window_nm == 0.0);
  set_flag(state, databuffer::kMapping, true);
}

void cancel_map(RadarState& state, const Inputs& inputs) {
  if (!has(state, databuffer::kMapping)) return;
  set_flag(state, databuffer::kMapping, false);
  state.map_request = next_request(state, inputs.model);
  const PatchMap* newest = map_of(inputs, state.map_newest);
  if (newest == nullptr) return;
  state.map_latitude_deg = newest->latitude_deg;
  state.map_longitude_deg = newest->longitude_deg;
  state.map_window_nm = newest->window_nm;
  set_flag(state, databuffer::kMapWindowBlank, (newest->flags & databuffer::kPatchWindowBlank) != 0);
}

bool take_map(RadarState& state, const Inputs& inputs) {
  const ModelStatus& model = inputs.model;
  // Any id that differs from the newest map's counts as new. If only greater ids counted, one erroneous large id would
  // hide all later maps.
  const bool is_new = model.map_newest != 0 && model.map_newest != state.map_newest;
  // The model answered without a map. A reason names the radar limit that forbids the map. Without a reason, the map is
  // impossible for another cause.
  if (has(state, databuffer::kMapping) && model.map_done_request == state.map_request && !is_new) {
    cancel_map(state, inputs);
    const std::string_view reason = stop_reason(model);
    show_message(state, inputs, reason.empty() ? "NO MAP" : reason);
    return false;
  }
  if (!is_new || model.map_done_request != state.map_request) return false;
  // Without its record the map's position is unknown. The map cannot be shown, and the cursor would have no frame.
  if (map_of(inputs, model.map_newest) == nullptr) return false;
  if (has(state, databuffer::kMapping)) {
    take_commanded(state, model.map_newest);
    return true;
  }
  if (power_of(state) == radar::Power::operate && running_mode(state) == Mode::patch)
    state.map_newest = model.map_newest;
  return false;
}

void show_remap_stop(RadarState& state, const Inputs& inputs) {
  const bool maps_again = power_of(state) == radar::Power::operate && running_mode(state) == radar::Mode::patch &&
                          !has(state, databuffer::kMapping | databuffer::kFreeze | databuffer::kSniff);
  const std::string_view reason = maps_again ? stop_reason(inputs.model) : std::string_view();
  const bool is_own_message = state.message_until_tick == databuffer::kUntilCauseEnds;
  // A message with an end time, caused by an event, has priority.
  if (state.message[0] != '\0' && !is_own_message) return;
  if (!is_own_message && reason.empty()) return;
  text::put_text(state.message, reason);
  state.message_until_tick = reason.empty() ? 0 : databuffer::kUntilCauseEnds;
}

const PatchMap* map_of(const Inputs& inputs, std::uint64_t id) {
  const auto* const found =
      std::find_if(inputs.maps.begin(), inputs.maps.end(), [id](const PatchMap& map) { return map.id == id; });
  return id == 0 || found == inputs.maps.end() ? nullptr : found;
}

namespace {
constexpr radar::ViewConfiguration kMapView{-0.5, 0.5, -0.5, 0.5};  // a map fills the display; its centre is 0, 0
constexpr double kDisplayUnits = 480.0;                             // along the longer edge of the display
}  // namespace

double PicturePlane::edge() const {
  return std::max(view.width_max - view.width_min, view.height_max - view.height_min);
}

DisplayPoint PicturePlane::at_fractions(double right, double down) const {
  // The display is a square. The shorter side of the visible area is centered in it.
  const double x = (view.width_min + view.width_max) / 2.0 + (right - 0.5) * edge();
  const double y = (view.height_min + view.height_max) / 2.0 + (0.5 - down) * edge();
  return {std::clamp(x, view.width_min, view.width_max), std::clamp(y, view.height_min, view.height_max)};
}

double PicturePlane::units_between(DisplayPoint a, DisplayPoint b) const {
  return std::hypot(a.x - b.x, a.y - b.y) * kDisplayUnits / edge();
}

std::optional<PicturePlane> plane_of(const databuffer::RadarState& state, const Inputs& inputs,
                                     const radar::ViewConfiguration& view) {
  PicturePlane plane{{state.frame_latitude_deg, state.frame_longitude_deg},
                     geo::Bearing::degrees(state.frame_track_deg),
                     geo::Length::nautical_miles(state.range_nm),
                     geo::Length(),
                     view};
  if (state.map_shown == 0) return plane;
  const databuffer::PatchMap* map = map_of(inputs, state.map_shown);
  if (map == nullptr) return std::nullopt;
  plane.unit = geo::Length::nautical_miles(map->window_nm);
  plane.ahead = geo::Length::metres(map->distance_m);
  plane.view = kMapView;
  return plane;
}

}  // namespace yars::statemachine
