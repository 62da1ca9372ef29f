#include "display/gl/context.hpp"

#include <epoxy/gl.h>

namespace yars::display::gl {

namespace {

std::string text_of(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? "?" : reinterpret_cast<const char*>(text);
}

}  // namespace

int opengl_version() {
  const int version = epoxy_gl_version();  // 0 without a context
  return version != 0 && epoxy_is_desktop_gl() ? version : 0;
}

std::string renderer_name() {
  return text_of(GL_RENDERER) + ", " + text_of(GL_VERSION);
}

}  // namespace yars::display::gl
