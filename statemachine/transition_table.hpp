// Transition table: the action of each button and control by mode and condition, and the legends of the buttons.
// Inputs: radar state, event.
// Outputs: the action of an event; legends and boxes of the radar state.
// Source: docs/pilots_manual.md#buttons. The button rows in transition_table.cpp have the order of that table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "databuffer/messages/radar_state.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// Legends that depend on the state. Source: docs/pilots_manual.md#legends.
std::string_view gain_legend(const databuffer::RadarState& state);
std::string_view looks_legend(const databuffer::RadarState& state);
std::string_view mode_legend(const databuffer::RadarState& state);
std::string_view cursor_function_legend(const databuffer::RadarState& state);
std::string_view stabilizing_legend(const databuffer::RadarState& state);
std::string_view recall_legend(const databuffer::RadarState& state);
std::string_view scan_legend(const databuffer::RadarState& state);
std::string_view sequence_point_legend(const databuffer::RadarState& state);
std::string_view channel_legend(const databuffer::RadarState& state);
std::string_view band_legend(const databuffer::RadarState& state);

// Fills `legends` and `boxed` from the transition table.
void write_legends(databuffer::RadarState& state);

// Modes of the column "live in" of the table docs/pilots_manual.md#buttons. A row applies in the modes of its mask.
using Columns = std::uint16_t;
inline constexpr Columns kRbm = 1U << 0;
inline constexpr Columns kHrm = 1U << 1;    // HRM PPI
inline constexpr Columns kPatch = 1U << 2;  // HRM patch map
inline constexpr Columns kBcn = 1U << 3;
inline constexpr Columns kPvu = 1U << 4;
inline constexpr Columns kRanging = 1U << 5;  // mode A/A, and mode A/G ranging
inline constexpr Columns kMenu = 1U << 6;
inline constexpr Columns kOff = 1U << 7;

// Conditions besides the column. All conditions in the mask of a row must be true.
using Conditions = std::uint16_t;
inline constexpr Conditions kAlways = 0;
inline constexpr Conditions kThawed = 1U << 0;       // FREEZE off
inline constexpr Conditions kFrozen = 1U << 1;       // FREEZE on
inline constexpr Conditions kCursorIsMap = 1U << 2;  // cursor function MAP
inline constexpr Conditions kSniffOff = 1U << 3;
inline constexpr Conditions kOperating = 1U << 4;  // power OPR
inline constexpr Conditions kSetOff = 1U << 5;     // SET function (cursor functions on a frozen map) off
inline constexpr Conditions kSetOn = 1U << 6;
inline constexpr Conditions kHasMap = 1U << 7;          // a patch map has been made
inline constexpr Conditions kMapShown = 1U << 8;        // the display shows a patch map
inline constexpr Conditions kCursorIsUpdate = 1U << 9;  // cursor function UPDT
inline constexpr Conditions kCursorIsCue = 1U << 10;
inline constexpr Conditions kCursorIsTarget = 1U << 11;
inline constexpr Conditions kCursorIsMark = 1U << 12;
inline constexpr Conditions kLineSlews = 1U << 13;  // the TDC turns the steering line that ends at the target
inline constexpr Conditions kHasTarget = 1U << 14;  // a target is designated

using Action = void (*)(Step&);

// Legend of a button: a fixed text, or a function of the state.
struct Legend {
  constexpr Legend(const char* text) : fixed(text) {}
  constexpr Legend(std::string_view (*text)(const databuffer::RadarState&)) : changing(text) {}
  std::string_view of(const databuffer::RadarState& state) const { return changing ? changing(state) : fixed; }
  std::string_view fixed;
  std::string_view (*changing)(const databuffer::RadarState&) = nullptr;
};

struct ButtonRow {
  int button;  // 1..20
  Columns columns;
  Conditions live_when;  // the button has an effect while these conditions are true
  Action action;
  const char* does;  // what a press does, for advice.hpp: "scan width"
  Legend legend;
  Conditions shown_when;                                   // the legend is shown while these conditions are true
  bool (*boxed)(const databuffer::RadarState&) = nullptr;  // true: the legend has a box; null = never
};

struct ControlRow {
  databuffer::EventKind kind;
  Columns columns;
  Conditions live_when;  // the control has an effect while these conditions are true
  Action action;
  const char* does = nullptr;  // what the TDC's switch does, for advice.hpp; other controls: null
};

// The column that applies in this state: for the buttons, and for all other controls.
Columns button_column(const databuffer::RadarState& state);
Columns control_column(const databuffer::RadarState& state);

// True if all of the conditions are true in this state.
bool hold(Conditions conditions, const databuffer::RadarState& state);

// True for the press of the TDC. The caller does not run the action of a press, because the TDC acts on release.
bool is_press(const databuffer::InputEvent& event);

// True for `next`, which a tour reads among the applied events. It changes nothing in the radar, in any state.
bool is_for_tour(const databuffer::InputEvent& event);

// Action of the event in this state; nullptr: the event has no effect (is dead). For a press of the TDC it is the
// action of the release, which only tells whether the press is dead.
Action action_for(const databuffer::RadarState& state, const databuffer::InputEvent& event);

// Row of the event in this state; nullptr: the event has no effect (is dead).
const ButtonRow* live_button(const databuffer::RadarState& state, int button);
const ControlRow* live_control(const databuffer::RadarState& state, const databuffer::InputEvent& event);

// Conditions that keep the event from an effect: of the rows for the event and the present column, the row with the
// fewest missing conditions. 0: the event is live. nullopt: no row of the event applies in this column.
std::optional<Conditions> missing_conditions(const databuffer::RadarState& state, const databuffer::InputEvent& event);

// Columns in which the event has a row.
Columns columns_of(const databuffer::InputEvent& event);

}  // namespace yars::statemachine
