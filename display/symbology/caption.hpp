// Caption of a tour over the picture.
// Input: the caption; the boxes that the draw list already has. Output: a black plate with text on the layer of
// notices. Source: docs/spec/pilots_interface.md#caption
#pragma once

#include "databuffer/messages/caption.hpp"
#include "display/symbology/draw_list.hpp"

namespace yars::display {

// Draws the caption in the lower part of the picture, above the messages; in the upper part while the middle of
// the cursor is where the plate would be. A caption with step 0 draws nothing. Call it last.
void draw_caption(const databuffer::Caption& caption, DrawList& list);

}  // namespace yars::display
