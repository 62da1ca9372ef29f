#include "statemachine/freezing.hpp"

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

// Also while A/A or ranging has the radar.
bool on_patch(const RadarState& state) {
  return state.ground_mode == static_cast<std::uint8_t>(Mode::patch);
}

void give_up_stored(RadarState& state) {
  const bool is_newest = state.map_stored == state.map_newest;
  // It has had the OLD place, and stays there.
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
  if (state.map_stored != 0) return give_up_stored(state);
  // On a frozen HRM PPI, which is no map, the newest one comes up.
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
  // A PPI that the pilot had frozen stands again.
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

}  // namespace yars::statemachine
