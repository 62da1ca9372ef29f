// Draws the surround of a picture: bezel, tooltip, notice; and a square render target for the panel as a whole.
// Inputs: a draw list in panel units (display/symbology/bezel.hpp).
// Outputs: pixels in the current framebuffer.
// Threads: objects need a current OpenGL context for their lifetime.
#pragma once

#include "display/gl/passes.hpp"
#include "display/symbology/draw_list.hpp"

namespace yars::display::gl {

// Square of the current framebuffer [pixels], from its lower left corner.
struct Square {
  int left = 0, bottom = 0, edge = 0;
};

class PanelPass {
 public:
  // Draws the list into the square, over what is there. `units`: edge of the panel [panel units].
  void draw(const DrawList& list, const ColorScheme& colors, const Square& square, float units);

 private:
  OverlayPass overlay_;
};

}  // namespace yars::display::gl
