// An OpenGL 3.3 core context that is current for its lifetime on the thread that made it.
#pragma once

#include <string>

namespace yars::display::gl {

class Context {
 public:
  virtual ~Context() = default;
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

// 33 = 3.3, of what is current on this thread; 0: nothing is, or OpenGL ES.
int opengl_version();

// What draws: "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6".
std::string renderer_name();

}  // namespace yars::display::gl
