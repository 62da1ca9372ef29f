#include "statemachine/maps.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "lib/radar/windows.hpp"
#include "statemachine/modes.hpp"
#include "statemachine/switches.hpp"

namespace yars::statemachine {

namespace {

using databuffer::ModelStatus;
using databuffer::PatchMap;
using databuffer::RadarState;

// [NM] of the map to command; 0 when a blank window stands for none at this range.
double window_to_map_nm(const RadarState& state, const radar::RadarConfiguration& configuration) {
  if (state.window_nm > 0.0) return state.window_nm;
  const auto window =
      radar::window_while_blank(geo::Length::nautical_miles(state.cursor_range_nm), configuration.window_limits);
  return window ? window->nautical_miles() : 0.0;
}

// The model's word goes onto the glass and into a record that must stay readable, whoever wrote it.
std::string_view reason_of(const ModelStatus& model) {
  const auto* const end = std::find(std::begin(model.why_not), std::end(model.why_not), '\0');
  const bool readable =
      std::all_of(std::begin(model.why_not), end, [](char letter) { return letter >= ' ' && letter <= '~'; });
  if (!readable) return {};
  return {model.why_not, static_cast<std::size_t>(end - std::begin(model.why_not))};
}

// Above every request that either side knows of: a state that began anew must not take an old map for an answer.
std::uint32_t next_request(const RadarState& state, const ModelStatus& model) {
  return std::max({state.map_request, model.map_request, model.map_done_request}) + 1;
}

void take_commanded(RadarState& state, std::uint64_t id) {
  // A stored map keeps the OLD place.
  state.map_old = state.map_stored != 0 ? state.map_stored : state.map_newest;
  state.map_newest = id;
  set_flag(state, databuffer::kMapping, false);
  if (has(state, databuffer::kFreeze)) state.recall = static_cast<std::uint8_t>(radar::Recall::newest);
  enter_patch(state);
}

}  // namespace

void command_map(Step& step) {
  RadarState& state = step.state;
  const ModelStatus& model = step.surroundings.model;
  if (!step.surroundings.ownship_valid || !has(state, databuffer::kCursorValid)) return;
  if (model.mappable == 0) {
    if (const auto reason = reason_of(model); !reason.empty()) show_message(step, reason);
    return;
  }
  const double window_nm = window_to_map_nm(state, step.configuration);
  if (!(window_nm > 0.0)) return show_message(step, "NO WINDOW");
  state.map_request = next_request(state, model);
  state.map_latitude_deg = state.cursor_latitude_deg;
  state.map_longitude_deg = state.cursor_longitude_deg;
  state.map_window_nm = window_nm;
  set_flag(state, databuffer::kMapping, true);
}

void cancel_map(RadarState& state, const Surroundings& surroundings) {
  if (!has(state, databuffer::kMapping)) return;
  set_flag(state, databuffer::kMapping, false);
  state.map_request = next_request(state, surroundings.model);
  const PatchMap* newest = map_of(surroundings, state.map_newest);
  if (newest == nullptr) return;
  state.map_latitude_deg = newest->latitude_deg;
  state.map_longitude_deg = newest->longitude_deg;
  state.map_window_nm = newest->window_nm;
}

void take_map(RadarState& state, const Surroundings& surroundings) {
  const ModelStatus& model = surroundings.model;
  // Another, not a greater id: one that cannot be would stand for ever.
  const bool is_new = model.map_newest != 0 && model.map_newest != state.map_newest;
  // Answered without a map: the aircraft has come too near, or was put elsewhere, since the command.
  if (has(state, databuffer::kMapping) && model.map_done_request == state.map_request && !is_new) {
    cancel_map(state, surroundings);
    return show_message(state, surroundings, "NO MAP");
  }
  if (!is_new || model.map_done_request != state.map_request) return;
  // Without its record nobody knows where it lies: there is nothing to show, and no frame for the cursor.
  if (map_of(surroundings, model.map_newest) == nullptr) return;
  if (has(state, databuffer::kMapping)) {
    take_commanded(state, model.map_newest);
  } else if (power_of(state) == radar::Power::operate && running_mode(state) == radar::Mode::patch) {
    state.map_newest = model.map_newest;
  }
}

const PatchMap* map_of(const Surroundings& surroundings, std::uint64_t id) {
  const auto* const found = std::find_if(surroundings.maps.begin(), surroundings.maps.end(),
                                         [id](const PatchMap& map) { return map.id == id; });
  return id == 0 || found == surroundings.maps.end() ? nullptr : found;
}

}  // namespace yars::statemachine
