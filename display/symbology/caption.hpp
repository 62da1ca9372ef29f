// Caption of a tour over the picture.
// Inputs: the caption; the boxes that the draw list already has.
// Outputs: a black plate with text on the layer of notices.
// Source: docs/pilots_manual.md#caption
#pragma once

#include "databuffer/messages/caption.hpp"
#include "display/symbology/draw_list.hpp"

namespace yars::display {

// Draws the caption on a plate as wide as its longest line. The plate is low in the picture, above the messages. If it
// would cover a text, a symbol or a line on the ground there, it is at the top, or where it covers least. A caption
// with step 0 draws nothing. Call it last.
void draw_caption(const databuffer::Caption& caption, DrawList& list);

}  // namespace yars::display
