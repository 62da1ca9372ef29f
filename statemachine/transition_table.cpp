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

// Source: docs/pilots_manual.md#buttons. The conditions for freeze, SET and maps are from #rule-8,
// #rule-10, #rule-20 and #rule-21.
constexpr std::array kButtons{
    ButtonRow{2, kAllGround | kRanging, kSetOff, toggle_declutter, "declutter", "DCL", kSetOff, kDeclutterOn},
    ButtonRow{3, kRbm | kBcn, kSetOff, cycle_gain, "receiver gain", gain_legend, kSetOff},
    ButtonRow{3, kBothHrm, kSetOff, toggle_looks, "looks of a map", looks_legend, kSetOff},
    ButtonRow{4, kRbm | kBcn | kPvu | kRanging, kAlways, brightness_up, "brightness up", "BRT+", kAlways},
    ButtonRow{4, kBothHrm, kFrozen, brightness_up, "brightness up", "BRT+", kFrozen},
    ButtonRow{5, kRbm | kBcn | kPvu | kRanging, kAlways, brightness_down, "brightness down", "BRT-", kAlways},
    ButtonRow{5, kBothHrm, kFrozen, brightness_down, "brightness down", "BRT-", kFrozen},
    ButtonRow{6, kAllGround, kThawed, next_mode, "next mode", mode_legend, kSetOff},
    ButtonRow{6, kMenu, kAlways, close_menu, "back to the radar", "A/G RDR", kAlways},
    ButtonRow{7, kRbm | kBothHrm | kBcn | kRanging, kAlways, next_cursor_function, "cursor function",
              cursor_function_legend, kAlways},
    ButtonRow{8, kPatch, kSetOff, toggle_stabilizing, "ground that is mapped again", stabilizing_legend, kSetOff},
    ButtonRow{9, kRbm | kHrm | kBcn, kThawed, next_scan_width, "scan width", scan_legend, kSetOff},
    ButtonRow{10, kBothHrm, kRecallable | kSetOff, flip_recall, "recalls a map", recall_legend, kRecallable | kSetOff},
    ButtonRow{11, kAllGround | kRanging, kAlways, open_menu, "main menu", "M", kAlways},
    ButtonRow{12, kAllGround | kRanging, kAlways, toggle_recorder, "starts or stops the recorder", "VTR", kAlways,
              kVtrOn},
    ButtonRow{13, kRbm | kHrm | kBcn, kRangeStepConditions, range_up, "longer range", "^", kSetOff},
    ButtonRow{14, kRbm | kHrm | kBcn, kRangeStepConditions, range_down, "shorter range", "v", kSetOff},
    ButtonRow{14, kPatch, kThawed, leave_patch, "back to the HRM PPI", "PPI", kSetOff},
    ButtonRow{15, kBothHrm, kRecallable | kSetOff, toggle_store, "keeps the map that is shown", "STO",
              kRecallable | kSetOff, stored},
    ButtonRow{16, kRbm | kBothHrm | kBcn, kSetOff, toggle_ipvu, "velocity updates between scans", "IPVU", kSetOff,
              kIpvuOn},
    ButtonRow{17, kAllGround | kRanging, kAlways, next_sequence_point, "next sequence point", sequence_point_legend,
              kAlways},
    ButtonRow{18, kAllGround, kSetOff, toggle_sniff, "listens without transmitting", "SNIFF", kSetOff, kSniffOn},
    ButtonRow{18, kAllGround, kSetOn, toggle_set, "cursor functions on this map", "SET", kSetOn, kSetIsOn},
    ButtonRow{18, kRanging, kMapShown, toggle_set, "cursor functions on this map", "SET", kMapShown, kSetIsOn},
    ButtonRow{19, kAllGround, kSetOff, next_channel, "channel", channel_legend, kSetOff},
    ButtonRow{20, kAllGround, kSetOff, next_band, "band", band_legend, kSetOff},
};

// Source: docs/pilots_manual.md#controls. The action of a TDC release depends on the cursor function.
// In A/A and ranging the display may still show a map. A TDC release acts on that map if SET is on, else it is dead.
// TDC deflection is stored in every mode with power on, so that its return to 0 is not lost.
constexpr std::array kControls{
    ControlRow{EventKind::tdc, kRadar, kAlways, deflect},
    ControlRow{EventKind::tdc_release, kRbm | kBothHrm | kPvu, kMapCommandConditions, command_map,
               "commands a map at the cursor"},
    ControlRow{EventKind::tdc_release, kModesWithCursor, kCursorIsUpdate | kOperating, accept_update,
               "moves the navigator by the errors shown"},
    ControlRow{EventKind::tdc_release, kRanging, kCursorIsUpdate | kOperating | kSetOn, accept_update,
               "moves the navigator by the errors shown"},
    ControlRow{EventKind::tdc_release, kModesWithCursor, kCursorIsCue | kOperating, cue_sensor,
               "points another sensor at the cursor"},
    ControlRow{EventKind::tdc_release, kRanging, kCursorIsCue | kOperating | kSetOn, cue_sensor,
               "points another sensor at the cursor"},
    ControlRow{EventKind::tdc_release, kModesWithCursor, kCursorIsTarget | kOperating | kLineSlews, fix_steering_line,
               "fixes the steering line"},
    ControlRow{EventKind::tdc_release, kRanging, kCursorIsTarget | kOperating | kLineSlews | kSetOn, fix_steering_line,
               "fixes the steering line"},
    ControlRow{EventKind::tdc_release, kModesWithCursor, kCursorIsTarget | kOperating, designate_target,
               "designates a target at the cursor"},
    ControlRow{EventKind::tdc_release, kRanging, kCursorIsTarget | kOperating | kSetOn, designate_target,
               "designates a target at the cursor"},
    ControlRow{EventKind::tdc_release, kModesWithCursor, kCursorIsMark | kOperating, store_mark,
               "stores the cursor's place"},
    ControlRow{EventKind::tdc_release, kRanging, kCursorIsMark | kOperating | kSetOn, store_mark,
               "stores the cursor's place"},
    ControlRow{EventKind::cursor, kModesWithCursor, kAlways, point_cursor},
    ControlRow{EventKind::cursor, kRanging, kSetOn, point_cursor},
    ControlRow{EventKind::castle_up, kRadar, kAlways, next_sequence_point},
    ControlRow{EventKind::acquisition, kAllGround, kCursorIsMap, step_window},
    ControlRow{EventKind::acquisition, kModesWithCursor, kCursorIsTarget | kOperating | kHasTarget,
               steer_by_acquisition_switch},
    ControlRow{EventKind::acquisition, kRanging, kCursorIsTarget | kOperating | kSetOn | kHasTarget,
               steer_by_acquisition_switch},
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
  // docs/pilots_manual.md#rule-18: in standby the buttons are live as in RBM, except in A/A and ranging.
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
  if (has(state, databuffer::kTargetDesignated)) present |= kHasTarget;
  return present;
}

constexpr Conditions kCursorFunctions = kCursorIsMap | kCursorIsUpdate | kCursorIsCue | kCursorIsTarget | kCursorIsMark;

// Of the rows for this event and column, takes the row with the fewest missing conditions and returns these conditions;
// nullopt if there is no such row. Of rows with as many, the row of the present cursor function is taken.
template <typename Rows, typename IsOfEvent>
std::optional<Conditions> fewest_missing(const Rows& rows, Columns column, Conditions present,
                                         const IsOfEvent& is_of_event) {
  std::optional<Conditions> fewest;
  for (const auto& row : rows) {
    if (!is_of_event(row) || (row.columns & column) == 0) continue;
    const auto missing = static_cast<Conditions>(row.live_when & ~present);
    const auto rank = [](Conditions conditions) {
      return 2 * std::popcount(conditions) + ((conditions & kCursorFunctions) != 0 ? 1 : 0);
    };
    if (!fewest || rank(missing) < rank(*fewest)) fewest = missing;
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

namespace {

bool is_button(const databuffer::InputEvent& event) {
  return event.kind == static_cast<std::uint16_t>(EventKind::push_button);
}

// The first live row of the event in this column; nullptr: none.
template <typename Rows, typename IsOfEvent>
auto live_row(const Rows& rows, Columns column, const databuffer::RadarState& state, const IsOfEvent& is_of_event) {
  const auto row = std::ranges::find_if(rows, [&](const auto& candidate) {
    return is_of_event(candidate) && (candidate.columns & column) != 0 && hold(candidate.live_when, state);
  });
  return row == rows.end() ? nullptr : &*row;
}

template <typename Rows, typename IsOfEvent>
Columns columns_in(const Rows& rows, const IsOfEvent& is_of_event) {
  Columns columns = 0;
  for (const auto& row : rows)
    if (is_of_event(row)) columns |= row.columns;
  return columns;
}

// Calls `visit` with the rows of buttons or of controls, the column that applies to them, and the test for the event.
template <typename Visit>
auto with_rows(const databuffer::RadarState& state, const databuffer::InputEvent& event, const Visit& visit) {
  if (is_button(event))
    return visit(kButtons, button_column(state),
                 [&event](const ButtonRow& row) { return row.button == event.argument; });
  return visit(kControls, control_column(state), [&event](const ControlRow& row) { return is_row_of(row, event); });
}

}  // namespace

const ButtonRow* live_button(const databuffer::RadarState& state, int button) {
  return live_row(kButtons, button_column(state), state,
                  [button](const ButtonRow& row) { return row.button == button; });
}

const ControlRow* live_control(const databuffer::RadarState& state, const databuffer::InputEvent& event) {
  return live_row(kControls, control_column(state), state,
                  [&event](const ControlRow& row) { return is_row_of(row, event); });
}

std::optional<Conditions> missing_conditions(const databuffer::RadarState& state, const databuffer::InputEvent& event) {
  const Conditions present = present_conditions(state);
  return with_rows(state, event, [present](const auto& rows, Columns column, const auto& is_of_event) {
    return fewest_missing(rows, column, present, is_of_event);
  });
}

Columns columns_of(const databuffer::InputEvent& event) {
  return with_rows({}, event,
                   [](const auto& rows, Columns, const auto& is_of_event) { return columns_in(rows, is_of_event); });
}

Action action_for(const databuffer::RadarState& state, const databuffer::InputEvent& event) {
  if (is_button(event)) {
    const ButtonRow* row = live_button(state, event.argument);
    return row == nullptr ? nullptr : row->action;
  }
  const ControlRow* row = live_control(state, event);
  return row == nullptr ? nullptr : row->action;
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
