#include "display/gl/panel.hpp"

#include <epoxy/gl.h>

namespace yars::display::gl {

void PanelPass::draw(const DrawList& list, const ColorScheme& colors, const Square& square, float units) {
  glViewport(square.left, square.bottom, square.edge, square.edge);
  overlay_.draw(list, colors, {}, {static_cast<float>(square.edge) / units, units});
}

}  // namespace yars::display::gl
