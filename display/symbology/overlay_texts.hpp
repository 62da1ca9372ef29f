// Texts over the picture: help (each button with its number, key, legend and what it does now; the other keys), and the
// caption of a tour.
// Inputs: DisplayInput, with the words of PilotAdvice; the table of keys (databuffer/messages/key_map.hpp); a caption.
// Outputs: help on Layer::cover of a draw list, on a black plate that leaves the legends visible; a caption on a black
//   plate on the layer of notices, clear of the boxes that the list already has where that is possible.
// Units: display units.
// Source: docs/pilots_manual.md#help, docs/pilots_manual.md#caption
#pragma once

#include <string>

#include "databuffer/messages/caption.hpp"
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

// Draws the caption on a plate as wide as its longest line. The plate is low in the picture, above the messages. If it
// would cover a text, a symbol or a line on the ground there, it is at the top, or where it covers least. A caption
// with step 0 draws nothing. Call it last.
void draw_caption(const databuffer::Caption& caption, DrawList& list);

}  // namespace yars::display
