// Draws the surround of a picture: bezel, tooltip, notice.
// Inputs: a draw list in panel units (display/symbology/bezel.hpp).
// Outputs: pixels in the current framebuffer.
// Threads: objects need a current OpenGL context for their lifetime.
#pragma once

#include "display/gl/passes.hpp"
#include "display/symbology/draw_list.hpp"

namespace yars::display::gl {

class PanelPass {
 public:
  // Draws the list into the target, over what is there.
  void draw(const DrawList& list, const ColorScheme& colors, const OverlayPass::Target& target);

 private:
  OverlayPass overlay_;
};

}  // namespace yars::display::gl
