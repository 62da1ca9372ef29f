// Draws a finished picture of the glass into the current framebuffer, one pixel of it on one pixel there.
// Needs a current context for its lifetime.
#pragma once

#include <cstdint>

#include "display/gl/framebuffer.hpp"
#include "display/gl/shader_program.hpp"

namespace yars::display::gl {

class PicturePass {
 public:
  PicturePass();
  ~PicturePass();
  PicturePass(const PicturePass&) = delete;
  PicturePass& operator=(const PicturePass&) = delete;

  // `left`, `bottom`: where its lower left pixel goes.
  void draw(const Framebuffer& picture, int left, int bottom);

 private:
  ShaderProgram program_;
  std::uint32_t vertex_array_ = 0;
  int corner_location_ = 0;
};

}  // namespace yars::display::gl
