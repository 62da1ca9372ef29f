#include "statemachine/transition_table.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <optional>

#include "statemachine/cursor.hpp"
#include "statemachine/designation.hpp"
#include "statemachine/maps.hpp"
#include "statemachine/modes.hpp"
#include "statemachine/navigation_errors.hpp"
#include "statemachine/settings.hpp"

namespace yars::statemachine {

namespace {

// The text at `index`; empty beyond the end.
template <std::size_t N>
std::string_view nth(const std::array<std::string_view, N>& words, std::size_t index) {
  return index < N ? words[index] : std::string_view();
}

constexpr std::array<std::string_view, 4> kGainLegends{"GAIN 0", "GAIN 1", "GAIN 2", "GAIN 3"};
constexpr std::array<std::string_view, 9> kChannelLegends{"", "1", "2", "3", "4", "5", "6", "7", "8"};
constexpr std::array<std::string_view, 5> kBandLegends{"A", "B", "C", "D", "E"};

}  // namespace

std::string_view gain_legend(const databuffer::RadarState& state) {
  return nth(kGainLegends, state.gain);
}

std::string_view looks_legend(const databuffer::RadarState& state) {
  return has(state, databuffer::kMultiLook2) ? "ML2" : "ML1";
}

std::string_view mode_legend(const databuffer::RadarState& state) {
  // A patch map has the legend of HRM.
  const radar::Mode mode = running_mode(state);
  return name_of(mode == radar::Mode::patch ? radar::Mode::hrm : mode);
}

std::string_view cursor_function_legend(const databuffer::RadarState& state) {
  return name_of(static_cast<radar::CursorFunction>(state.cursor_function));
}

std::string_view stabilizing_legend(const databuffer::RadarState& state) {
  return has(state, databuffer::kProgressive) ? "PROG" : "STAB";
}

std::string_view recall_legend(const databuffer::RadarState& state) {
  switch (static_cast<radar::Recall>(state.recall)) {
    case radar::Recall::old:
      return "OLD";
    case radar::Recall::store:
      return "STORE";
    default:
      return "NEW";  // a frozen HRM PPI also has this legend, because the next press shows the newest map
  }
}

std::string_view scan_legend(const databuffer::RadarState& state) {
  return name_of(static_cast<radar::ScanWidth>(state.scan));
}

std::string_view sequence_point_legend(const databuffer::RadarState& state) {
  return state.sequence_point;
}
std::string_view channel_legend(const databuffer::RadarState& state) {
  return nth(kChannelLegends, state.channel);
}
std::string_view band_legend(const databuffer::RadarState& state) {
  return nth(kBandLegends, state.band);
}

namespace {

using databuffer::EventKind;
using databuffer::RadarState;

constexpr Columns kBothHrm = kHrm | kPatch;
constexpr Columns kModesWithCursor = kRbm | kBothHrm | kBcn;
constexpr Columns kAllGround = kRbm | kHrm | kPatch | kBcn | kPvu;
constexpr Columns kRadar = kAllGround | kRanging;  // all modes with power on; kMenu is a column of buttons only
constexpr Conditions kRangeStepConditions = kThawed | kCursorIsMap;
constexpr Conditions kRecallable = kFrozen | kHasMap;
// Conditions for commanding a map. A map needs the transmitter. While SET is on, the TDC acts on the frozen map.
constexpr Conditions kMapCommandConditions = kCursorIsMap | kOperating | kSniffOff | kSetOff;

template <std::uint32_t Flag>
bool on(const RadarState& state) {
  return has(state, Flag);
}
constexpr auto kDeclutterOn = on<databuffer::kDeclutter>;
constexpr auto kVtrOn = on<databuffer::kVtr>;
constexpr auto kIpvuOn = on<databuffer::kIpvu>;
constexpr auto kSniffOn = on<databuffer::kSniff>;
constexpr auto kSetIsOn = on<databuffer::kSet>;

bool stored(const RadarState& state) {
  return state.map_stored != 0;
}

// Source: docs/spec/pilots_interface.md#buttons. The conditions for freeze, SET and maps are from #rule-8,
// #rule-10, #rule-20 and #rule-21.
constexpr std::array kButtons{
    ButtonRow{2, kAllGround | kRanging, kSetOff, toggle_declutter, "DCL", kAlways, kDeclutterOn},
    ButtonRow{3, kRbm | kBcn, kSetOff, cycle_gain, gain_legend, kAlways},
    ButtonRow{3, kBothHrm, kSetOff, toggle_looks, looks_legend, kAlways},
    ButtonRow{4, kRbm | kBcn | kPvu | kRanging, kAlways, brightness_up, "BRT+", kAlways},
    ButtonRow{4, kBothHrm, kFrozen, brightness_up, "BRT+", kFrozen},
    ButtonRow{5, kRbm | kBcn | kPvu | kRanging, kAlways, brightness_down, "BRT-", kAlways},
    ButtonRow{5, kBothHrm, kFrozen, brightness_down, "BRT-", kFrozen},
    ButtonRow{6, kAllGround, kThawed, next_mode, mode_legend, kAlways},
    ButtonRow{6, kMenu, kAlways, close_menu, "A/G RDR", kAlways},
    ButtonRow{7, kRbm | kBothHrm | kBcn | kRanging, kAlways, next_cursor_function, cursor_function_legend, kAlways},
    ButtonRow{8, kPatch, kSetOff, toggle_stabilizing, stabilizing_legend, kAlways},
    ButtonRow{9, kRbm | kHrm | kBcn, kThawed, next_scan_width, scan_legend, kAlways},
    ButtonRow{10, kBothHrm, kRecallable | kSetOff, flip_recall, recall_legend, kRecallable},
    ButtonRow{11, kAllGround | kRanging, kAlways, open_menu, "M", kAlways},
    ButtonRow{12, kAllGround | kRanging, kAlways, toggle_recorder, "VTR", kAlways, kVtrOn},
    ButtonRow{13, kRbm | kHrm | kBcn, kRangeStepConditions, range_up, "^", kAlways},
    ButtonRow{14, kRbm | kHrm | kBcn, kRangeStepConditions, range_down, "v", kAlways},
    ButtonRow{14, kPatch, kThawed, leave_patch, "PPI", kAlways},
    ButtonRow{15, kBothHrm, kRecallable | kSetOff, toggle_store, "STO", kRecallable, stored},
    ButtonRow{16, kRbm | kBothHrm | kBcn, kSetOff, toggle_ipvu, "IPVU", kAlways, kIpvuOn},
    ButtonRow{17, kAllGround | kRanging, kAlways, next_sequence_point, sequence_point_legend, kAlways},
    ButtonRow{18, kAllGround, kSetOff, toggle_sniff, "SNIFF", kSetOff, kSniffOn},
    ButtonRow{18, kAllGround, kSetOn, toggle_set, "SET", kSetOn, kSetIsOn},
    ButtonRow{18, kRanging, kMapShown, toggle_set, "SET", kMapShown, kSetIsOn},
    ButtonRow{19, kAllGround, kSetOff, next_channel, channel_legend, kAlways},
    ButtonRow{20, kAllGround, kSetOff, next_band, band_legend, kAlways},
};

// Source: docs/spec/pilots_interface.md#controls. The action of a TDC release depends on the cursor function.
// In A/A and ranging the display may still show a map. A TDC release acts on that map if SET is on, else it is dead.
// TDC deflection is stored in every mode with power on, so that its return to 0 is not lost.
constexpr std::array kControls{
    ControlRow{EventKind::tdc, kRadar, kAlways, deflect},
    ControlRow{EventKind::tdc_release, kRbm | kBothHrm | kPvu, kMapCommandConditions, command_map},
    ControlRow{EventKind::tdc_release, kModesWithCursor, kCursorIsUpdate | kOperating, accept_update},
    ControlRow{EventKind::tdc_release, kRanging, kCursorIsUpdate | kOperating | kSetOn, accept_update},
    ControlRow{EventKind::tdc_release, kModesWithCursor, kCursorIsCue | kOperating, cue_sensor},
    ControlRow{EventKind::tdc_release, kRanging, kCursorIsCue | kOperating | kSetOn, cue_sensor},
    ControlRow{EventKind::tdc_release, kModesWithCursor, kCursorIsTarget | kOperating | kLineSlews, fix_steering_line},
    ControlRow{EventKind::tdc_release, kRanging, kCursorIsTarget | kOperating | kLineSlews | kSetOn, fix_steering_line},
    ControlRow{EventKind::tdc_release, kModesWithCursor, kCursorIsTarget | kOperating, designate_target},
    ControlRow{EventKind::tdc_release, kRanging, kCursorIsTarget | kOperating | kSetOn, designate_target},
    ControlRow{EventKind::tdc_release, kModesWithCursor, kCursorIsMark | kOperating, store_mark},
    ControlRow{EventKind::tdc_release, kRanging, kCursorIsMark | kOperating | kSetOn, store_mark},
    ControlRow{EventKind::castle_up, kRadar, kAlways, next_sequence_point},
    ControlRow{EventKind::acquisition, kAllGround, kCursorIsMap, step_window},
    ControlRow{EventKind::acquisition, kModesWithCursor, kCursorIsTarget | kOperating, steer_by_acquisition_switch},
    ControlRow{EventKind::acquisition, kRanging, kCursorIsTarget | kOperating | kSetOn, steer_by_acquisition_switch},
    ControlRow{EventKind::freeze, kRbm | kBcn, kAlways, toggle_freeze},
    ControlRow{EventKind::freeze, kBothHrm, kSniffOff | kSetOff, toggle_freeze},
    ControlRow{EventKind::elevation, kRbm | kBcn | kPvu | kRanging, kSetOff, set_elevation},
    ControlRow{EventKind::elevation_step, kRbm | kBcn | kPvu | kRanging, kSetOff, step_elevation},
    ControlRow{EventKind::master_mode, kRadar, kAlways, select_master},
    ControlRow{EventKind::radar_mode, kAllGround, kThawed, select_mode},
    ControlRow{EventKind::power, kRadar | kOff, kAlways, switch_power},
    ControlRow{EventKind::navigator, kRadar, kAlways, select_navigator},
    ControlRow{EventKind::sequence_point, kRadar, kAlways, select_sequence_point},
    ControlRow{EventKind::altimeter, kRadar, kAlways, switch_altimeter},
    ControlRow{EventKind::contrast, kRadar, kAlways, step_contrast},
    ControlRow{EventKind::navigator_error, kRadar | kOff, kAlways, put_position_error},
    ControlRow{EventKind::navigator_drift, kRadar | kOff, kAlways, put_drift},
};

Columns column_of(radar::Mode mode) {
  switch (mode) {
    case radar::Mode::rbm:
      return kRbm;
    case radar::Mode::hrm:
      return kHrm;
    case radar::Mode::patch:
      return kPatch;
    case radar::Mode::beacon:
      return kBcn;
    case radar::Mode::pvu:
      return kPvu;
    case radar::Mode::air_to_air:
    case radar::Mode::ranging:
      return kRanging;
    case radar::Mode::menu:
      return kMenu;
  }
  return kOff;
}

Conditions condition_of(radar::CursorFunction function) {
  switch (function) {
    case radar::CursorFunction::map:
      return kCursorIsMap;
    case radar::CursorFunction::update:
      return kCursorIsUpdate;
    case radar::CursorFunction::cue:
      return kCursorIsCue;
    case radar::CursorFunction::target:
      return kCursorIsTarget;
    case radar::CursorFunction::mark:
      return kCursorIsMark;
  }
  return kAlways;
}

}  // namespace

Columns button_column(const databuffer::RadarState& state) {
  if (power_of(state) == radar::Power::off) return kOff;
  if (has(state, databuffer::kMenu)) return kMenu;
  const Columns column = column_of(running_mode(state));
  // docs/spec/pilots_interface.md#rule-18: in standby the buttons are live as in RBM, except in A/A and ranging.
  return power_of(state) == radar::Power::standby && column != kRanging ? kRbm : column;
}

Columns control_column(const databuffer::RadarState& state) {
  return power_of(state) == radar::Power::off ? kOff : column_of(running_mode(state));
}

namespace {

Conditions present_conditions(const databuffer::RadarState& state) {
  const bool frozen = has(state, databuffer::kFreeze);
  Conditions present = frozen ? kFrozen : kThawed;
  present |= condition_of(static_cast<radar::CursorFunction>(state.cursor_function));
  if (slews_steering_line(state)) present |= kLineSlews;
  if (!has(state, databuffer::kSniff)) present |= kSniffOff;
  if (power_of(state) == radar::Power::operate) present |= kOperating;
  present |= has(state, databuffer::kSet) ? kSetOn : kSetOff;
  if (state.map_newest != 0) present |= kHasMap;
  if (state.map_shown != 0) present |= kMapShown;
  return present;
}

// Reason given for an event that is dead because `condition` is not true. Of several missing conditions, the first in
// kMissing gives the reason.
struct MissingCondition {
  Conditions condition;
  const char* words;
};
constexpr std::array kMissing{MissingCondition{kOperating, "dead in STBY"},
                              MissingCondition{kThawed, "dead while frozen"},
                              MissingCondition{kFrozen, "dead unless frozen"},
                              MissingCondition{kSniffOff, "dead while SNIFF is on"},
                              MissingCondition{kSetOff, "dead while SET is on"},
                              MissingCondition{kSetOn, "dead without SET"},
                              MissingCondition{kHasMap, "dead without a map"},
                              MissingCondition{kMapShown, "dead without a map on the display"},
                              MissingCondition{kCursorIsMap, "dead unless the cursor function is MAP"}};

// Of the rows for this event and column, takes the row with the fewest missing conditions and returns these conditions;
// nullopt if there is no such row.
template <typename Rows, typename IsOfEvent>
std::optional<Conditions> fewest_missing(const Rows& rows, Columns column, Conditions present,
                                         const IsOfEvent& is_of_event) {
  std::optional<Conditions> fewest;
  for (const auto& row : rows) {
    if (!is_of_event(row) || (row.columns & column) == 0) continue;
    const auto missing = static_cast<Conditions>(row.live_when & ~present);
    if (!fewest || std::popcount(missing) < std::popcount(*fewest)) fewest = missing;
  }
  return fewest;
}

}  // namespace

bool hold(Conditions conditions, const databuffer::RadarState& state) {
  return (conditions & ~present_conditions(state)) == 0;
}

bool is_press(const databuffer::InputEvent& event) {
  return event.kind == static_cast<std::uint16_t>(EventKind::tdc_press);
}

bool is_for_tour(const databuffer::InputEvent& event) {
  return event.kind == static_cast<std::uint16_t>(EventKind::next);
}

namespace {
bool is_row_of(const ControlRow& row, const databuffer::InputEvent& event) {
  return row.kind == (is_press(event) ? EventKind::tdc_release : static_cast<EventKind>(event.kind));
}
}  // namespace

std::string reason_without_effect(const databuffer::RadarState& state, const databuffer::InputEvent& event) {
  if (action_for(state, event)) return "changed nothing: already at this value or at its limit";
  if (power_of(state) == radar::Power::off) return "dead while the power is OFF";
  const Conditions present = present_conditions(state);
  const bool button = event.kind == static_cast<std::uint16_t>(EventKind::push_button);
  const auto missing = button ? fewest_missing(kButtons, button_column(state), present,
                                               [&event](const ButtonRow& row) { return row.button == event.argument; })
                              : fewest_missing(kControls, control_column(state), present,
                                               [&event](const ControlRow& row) { return is_row_of(row, event); });
  const auto mode = button ? static_cast<radar::Mode>(state.mode) : running_mode(state);
  std::string in_mode = "dead in " + std::string(name_of(mode));
  if (!missing) return in_mode;
  const auto first = std::ranges::find_if(
      kMissing, [missing](const MissingCondition& one) { return (*missing & one.condition) != 0; });
  return first == kMissing.end() ? in_mode + " with this cursor function" : first->words;
}

Action action_for(const databuffer::RadarState& state, const databuffer::InputEvent& event) {
  const auto live_in = [&state](Columns column) {
    return [&state, column](const auto& row) { return (row.columns & column) != 0 && hold(row.live_when, state); };
  };
  if (event.kind == static_cast<std::uint16_t>(EventKind::push_button)) {
    const auto live = live_in(button_column(state));
    const auto row = std::find_if(kButtons.begin(), kButtons.end(), [&](const ButtonRow& candidate) {
      return candidate.button == event.argument && live(candidate);
    });
    return row == kButtons.end() ? nullptr : row->action;
  }
  const auto live = live_in(control_column(state));
  const auto row = std::find_if(kControls.begin(), kControls.end(), [&](const ControlRow& candidate) {
    return is_row_of(candidate, event) && live(candidate);
  });
  return row == kControls.end() ? nullptr : row->action;
}

void write_legends(databuffer::RadarState& state) {
  std::memset(state.legends, 0, sizeof(state.legends));
  state.boxed = 0;
  const Columns column = button_column(state);
  for (const ButtonRow& row : kButtons) {
    if ((row.columns & column) == 0 || !hold(row.shown_when, state)) continue;
    auto& legend = state.legends[row.button];
    row.legend.of(state).copy(legend, sizeof(legend) - 1);
    if (row.boxed && row.boxed(state)) state.boxed |= 1U << row.button;
  }
}

}  // namespace yars::statemachine
