// A square picture in the graphics memory that can be drawn into, read back, and drawn from as a texture.
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
  void bind() const;              // draws go here, over all of it
  void bind_for_reading() const;  // what reads pixels reads these
  void bind_texture() const;      // on the active texture unit
  imageio::Image read() const;    // RGB

 private:
  std::uint32_t framebuffer_ = 0, texture_ = 0;
  int size_ = 0;
};

}  // namespace yars::display::gl
