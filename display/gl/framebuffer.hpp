// A square picture in the graphics memory that can be drawn into, read back and copied to a window.
#pragma once

#include <cstdint>

#include "lib/imageio/png.hpp"

namespace yars::display::gl {

class Framebuffer {
 public:
  explicit Framebuffer(int size);
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  void resize(int size);
  int size() const { return size_; }
  void bind() const;  // draws go here, over all of it
  imageio::Image read() const;
  void copy_to_window(int window_width, int window_height) const;

 private:
  std::uint32_t framebuffer_ = 0, pixels_ = 0;
  int size_ = 0;
};

}  // namespace yars::display::gl
