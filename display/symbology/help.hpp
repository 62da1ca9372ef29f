// Help over the picture: each button with its number, key, legend and what it does now; the other keys.
// Inputs: DisplayInput, with the words of PilotAdvice; the table of keys (databuffer/messages/key_map.hpp).
// Outputs: texts on Layer::cover of a draw list, on a black plate that leaves the legends visible.
// Units: display units.
// Source: docs/pilots_manual.md#help
#pragma once

#include <string>

#include "display/symbology/draw_list.hpp"
#include "display/symbology/plan_view.hpp"

namespace yars::display {

void draw_help(const DisplayInput& input, DrawList& list);

// What a button does now or why it is dead, with its remedy: "longer range: 80 NM". `button`: 1..20. Without advice
// from the state machine the text says so.
std::string words_of_button(const DisplayInput& input, int button);

// Text about the window above the legend of PB 8: the selected window, the events that change it, and what a blank
// window is.
std::string words_of_window(const DisplayInput& input);

// Number and key of a button: "PB 13, KEY D"; "PB 1" for a button without a key.
std::string name_of_button(int button);

}  // namespace yars::display
