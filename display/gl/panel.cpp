#include "display/gl/panel.hpp"

#include <epoxy/gl.h>

namespace yars::display::gl {

void PanelPass::draw(const DrawList& list, const ColorScheme& colors, const OverlayPass::Target& target) {
  overlay_.draw(list, colors, {}, target);
}

}  // namespace yars::display::gl
