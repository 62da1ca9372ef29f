// Transition table of buttons and controls, and the legends beside the buttons.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "databuffer/messages/radar_state.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// The words beside the buttons. Source: docs/spec/pilots_interface.md#legends.
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

// The transition table: which button and which control does what in which mode, and which legend a button bears.
// transition_table.cpp holds it as data, in the order of docs/spec/pilots_interface.md#buttons, to be checked against
// it row by row.
//
// Columns of the table docs/spec/pilots_interface.md#buttons; a row names those in which it holds.
using Columns = std::uint16_t;
inline constexpr Columns kRbm = 1U << 0;
inline constexpr Columns kHrm = 1U << 1;    // HRM PPI
inline constexpr Columns kPatch = 1U << 2;  // HRM patch map
inline constexpr Columns kBcn = 1U << 3;
inline constexpr Columns kPvu = 1U << 4;
inline constexpr Columns kRanging = 1U << 5;  // A/A and A/G ranging
inline constexpr Columns kMenu = 1U << 6;
inline constexpr Columns kOff = 1U << 7;

// What must hold besides the column; all bits of a row together.
using Conditions = std::uint16_t;
inline constexpr Conditions kAlways = 0;
inline constexpr Conditions kThawed = 1U << 0;
inline constexpr Conditions kFrozen = 1U << 1;
inline constexpr Conditions kWithMap = 1U << 2;  // cursor function MAP
inline constexpr Conditions kSniffOff = 1U << 3;
inline constexpr Conditions kOperating = 1U << 4;  // power OPR
inline constexpr Conditions kSetOff = 1U << 5;
inline constexpr Conditions kSetOn = 1U << 6;
inline constexpr Conditions kHasMap = 1U << 7;      // one has been made
inline constexpr Conditions kMapStands = 1U << 8;   // one is on the glass
inline constexpr Conditions kWithUpdate = 1U << 9;  // cursor function UPDT
inline constexpr Conditions kWithCue = 1U << 10;
inline constexpr Conditions kWithTarget = 1U << 11;
inline constexpr Conditions kWithMark = 1U << 12;
inline constexpr Conditions kLineSlews = 1U << 13;  // the TDC turns the pattern steering line

using Action = void (*)(Step&);

// A legend is fixed, or it follows the state.
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
  Conditions live_when;
  Action action;
  Legend legend;
  Conditions shown_when;                                   // of the legend
  bool (*boxed)(const databuffer::RadarState&) = nullptr;  // whether a box is round it; none = never
};

struct ControlRow {
  databuffer::EventKind kind;
  Columns columns;
  Conditions live_when;
  Action action;
};

// The column that the bezel follows, and the one that hands-on and other controls follow.
Columns button_column(const databuffer::RadarState& state);
Columns control_column(const databuffer::RadarState& state);

bool hold(Conditions conditions, const databuffer::RadarState& state);

// What the event does in this state; nullptr when it is dead.
Action action_for(const databuffer::RadarState& state, const databuffer::InputEvent& event);

// Why the event changes nothing in this state, for people: "dead in PVU", "dead while frozen".
std::string why_without_effect(const databuffer::RadarState& state, const databuffer::InputEvent& event);

}  // namespace yars::statemachine
