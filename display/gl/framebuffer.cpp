#include "display/gl/framebuffer.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>

#include "lib/failure/require.hpp"

namespace yars::display::gl {

Framebuffer::Framebuffer(int size) {
  glGenFramebuffers(1, &framebuffer_);
  glGenRenderbuffers(1, &pixels_);
  resize(size);
}

Framebuffer::~Framebuffer() {
  glDeleteRenderbuffers(1, &pixels_);
  glDeleteFramebuffers(1, &framebuffer_);
}

void Framebuffer::resize(int size) {
  size_ = size;
  glBindRenderbuffer(GL_RENDERBUFFER, pixels_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size, size);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, pixels_);
  YARS_REQUIRE(glCheckFramebufferStatus(GL_FRAMEBUFFER), ==, static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, size_, size_);
}

imageio::Image Framebuffer::read() const {
  const std::size_t row = static_cast<std::size_t>(size_) * 3;
  std::vector<std::uint8_t> from_below(row * static_cast<std::size_t>(size_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size_, size_, GL_RGB, GL_UNSIGNED_BYTE, from_below.data());
  // OpenGL's rows run from the bottom up, an image's from the top down.
  imageio::Image image{size_, size_, 3, std::vector<std::uint8_t>(from_below.size())};
  for (std::size_t y = 0; y < static_cast<std::size_t>(size_); ++y) {
    const auto source =
        from_below.begin() + static_cast<std::ptrdiff_t>((static_cast<std::size_t>(size_) - 1 - y) * row);
    std::copy_n(source, row, image.pixels.begin() + static_cast<std::ptrdiff_t>(y * row));
  }
  return image;
}

void Framebuffer::copy_to_window(int window_width, int window_height) const {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glViewport(0, 0, window_width, window_height);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  const int left = (window_width - size_) / 2;
  const int bottom = (window_height - size_) / 2;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBlitFramebuffer(0, 0, size_, size_, left, bottom, left + size_, bottom + size_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace yars::display::gl
