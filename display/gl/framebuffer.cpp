#include "display/gl/framebuffer.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>

#include "lib/failure/require.hpp"

namespace yars::display::gl {

Framebuffer::Framebuffer(int size) {
  glGenFramebuffers(1, &framebuffer_);
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  // Shown pixel by pixel; and a texture whose levels are not all there counts as none.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  resize(size);
}

Framebuffer::~Framebuffer() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &texture_);
}

void Framebuffer::resize(int size) {
  size_ = size;
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size, size, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  YARS_REQUIRE(glCheckFramebufferStatus(GL_FRAMEBUFFER), ==, static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, size_, size_);
}

void Framebuffer::bind_for_reading() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
}

void Framebuffer::bind_texture() const {
  glBindTexture(GL_TEXTURE_2D, texture_);
}

imageio::Image Framebuffer::read() const {
  const std::size_t row = static_cast<std::size_t>(size_) * 3;
  std::vector<std::uint8_t> from_below(row * static_cast<std::size_t>(size_));
  bind_for_reading();
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

}  // namespace yars::display::gl
