// Square picture in graphics memory: render target, asynchronous readback, copy into another framebuffer.
// Outputs: pixels as bytes, rows from the top without padding.
// Units: sizes in pixels, times in nanoseconds of simulation time.
// Threads: every class needs a current OpenGL context for its lifetime.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "display/gl/shaders.hpp"
#include "lib/imageio/png.hpp"

namespace yars::display {

// A picture of the display as bytes, with its time.
struct Picture {
  std::int64_t tick = 0;             // of the radar state shown
  std::int64_t sim_time_ns = 0;      // of the display's last update from the session
  int size = 0;                      // [pixels] edge of the square
  std::vector<std::uint8_t> pixels;  // rows from the top without padding, red, green, blue, 255
};

}  // namespace yars::display

namespace yars::display::gl {

// A square texture that is a render target, can be read back, and can be sampled.
class Framebuffer {
 public:
  explicit Framebuffer(int size);
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  void resize(int size);
  int size() const { return size_; }
  void bind() const;              // as render target; the viewport covers all of it
  void bind_for_reading() const;  // as source of glReadPixels
  void bind_texture() const;      // on the active texture unit
  imageio::Image read() const;    // RGB

 private:
  std::uint32_t framebuffer_ = 0, texture_ = 0;
  int size_ = 0;
};

enum class WaitPolicy : std::uint8_t { none, until_ready };

// Asynchronous readback: starts a copy into a buffer object, and maps the buffer when its fence is signaled. Drawing
// does not wait. At most two copies are pending; they are taken in their order.
class Readback {
 public:
  Readback();
  ~Readback();
  Readback(const Readback&) = delete;
  Readback& operator=(const Readback&) = delete;

  // False when two copies are already pending.
  bool start(const Framebuffer& picture, std::int64_t tick, std::int64_t sim_time_ns);
  // Takes the oldest pending copy. False when there is none, when it is not ready, or when the driver failed.
  // until_ready waits at most 10 s. `picture` keeps its memory.
  bool take(Picture& picture, WaitPolicy wait);

 private:
  static constexpr std::size_t kMaxPending = 2;
  struct Copy {
    std::uint32_t buffer = 0;
    void* fence = nullptr;  // a GLsync
    int size = 0;
    std::int64_t tick = 0, sim_time_ns = 0;
  };
  static bool copy_out(const Copy& copy, Picture& picture);

  std::array<Copy, kMaxPending> copies_{};
  std::size_t first_ = 0, count_ = 0;  // of the pending copies
};

// Draws a finished picture into the current framebuffer, one pixel on one pixel.
class PicturePass {
 public:
  PicturePass();
  ~PicturePass();
  PicturePass(const PicturePass&) = delete;
  PicturePass& operator=(const PicturePass&) = delete;

  // `left`, `bottom`: position of its lower left pixel.
  void draw(const Framebuffer& picture, int left, int bottom);

 private:
  ShaderProgram program_;
  std::uint32_t vertex_array_ = 0;
  int corner_location_ = 0;
};

}  // namespace yars::display::gl
