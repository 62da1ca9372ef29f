// A context without a display: EGL on Mesa's surfaceless platform, else on the default display with a pixel buffer
// of one pixel. Pictures go to a framebuffer object and are read back.
#pragma once

#include <memory>

#include "display/gl/context.hpp"
#include "lib/failure/error.hpp"

namespace yars::display::gl {

failure::Expected<std::unique_ptr<Context>> open_headless();

}  // namespace yars::display::gl
