// A picture in graphics memory: drawn into, read back without waiting, drawn into another framebuffer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "display/gl/shaders.hpp"
#include "lib/imageio/png.hpp"

namespace yars::display {

// A picture of the glass as bytes, with the moment that it shows.
struct Picture {
  std::int64_t tick = 0;             // of the radar state that is on it
  std::int64_t sim_time_ns = 0;      // [ns] of the glass's last look at the session
  int size = 0;                      // [pixels] to the edge of the square
  std::vector<std::uint8_t> pixels;  // rows from the top without padding, red, green, blue, 255
};

}  // namespace yars::display

namespace yars::display::gl {

// A square picture in the graphics memory that can be drawn into, read back, and drawn from as a texture.
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

// Gets pictures out of the graphics memory without holding up who draws: the copy into a buffer object is only
// ordered, and taken when its fence says that it is there. Two may be under way, given out in their order.
// Needs a current context for its lifetime.
enum class WaitPolicy : std::uint8_t { none, until_it_is_there };

class Readback {
 public:
  Readback();
  ~Readback();
  Readback(const Readback&) = delete;
  Readback& operator=(const Readback&) = delete;

  // False: two are under way already.
  bool start(const Framebuffer& picture, std::int64_t tick, std::int64_t sim_time_ns);
  // The oldest under way. False: there is none, or it is not there yet. `picture` keeps its memory.
  bool take(Picture& picture, WaitPolicy patience);

 private:
  static constexpr std::size_t kUnderWay = 2;
  struct Copy {
    std::uint32_t buffer = 0;
    void* fence = nullptr;  // a GLsync
    int size = 0;
    std::int64_t tick = 0, sim_time_ns = 0;
  };
  static bool copy_out(const Copy& copy, Picture& picture);

  std::array<Copy, kUnderWay> copies_{};
  std::size_t first_ = 0, count_ = 0;  // those under way
};

// Draws a finished picture of the glass into the current framebuffer, one pixel of it on one pixel there.
// Needs a current context for its lifetime.
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
