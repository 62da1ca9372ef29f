// Objects in GPU memory: shader programs, textures for video and for the light table (light 0..1 of each 8-bit video
// level), and a square picture with render target, asynchronous readback and copy into another framebuffer.
// Outputs: pixels as bytes, rows from the top without padding.
// Units: sizes in pixels, sim time in nanoseconds.
// Errors: a shader that does not compile or link ends the process with the driver's log.
// Threads: all functions need a current OpenGL context; objects need it for their lifetime.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "display/symbology/draw_list.hpp"
#include "lib/imageio/png.hpp"

namespace yars::display::gl {

// Makes and binds a 2D texture with linear filter and clamped edges, and sets the unpack alignment to 1 byte.
std::uint32_t new_texture();

// Light table of the video as a texture, shared by all passes that draw video.
class LightTexture {
 public:
  LightTexture();
  ~LightTexture();
  LightTexture(const LightTexture&) = delete;
  LightTexture& operator=(const LightTexture&) = delete;

  void set(const std::array<float, 256>& light);  // index: video level
  void bind(int unit) const;                      // binds the texture, 256 texels wide, 1 high

 private:
  std::uint32_t texture_ = 0;
};

class ShaderProgram {
 public:
  ShaderProgram(const char* name, const char* vertex_source, const char* fragment_source);
  ~ShaderProgram();
  ShaderProgram(const ShaderProgram&) = delete;
  ShaderProgram& operator=(const ShaderProgram&) = delete;

  void use() const;
  int uniform(const char* name) const;  // location of a uniform variable

 private:
  std::uint32_t program_ = 0;
};

}  // namespace yars::display::gl

namespace yars::display {

// A picture of the display as bytes, with its time.
struct Picture {
  std::int64_t tick = 0;             // tick of the radar state shown
  std::int64_t sim_time_ns = 0;      // sim time of the session data shown
  int size = 0;                      // [pixels] side of the square
  std::vector<std::uint8_t> pixels;  // RGBA, alpha 255; rows from the top without padding
};

}  // namespace yars::display

namespace yars::display::gl {

// Framebuffer object with a square color texture, which can be read back and sampled. Above the square there may be
// further rows, as room for a picture that moves down.
class Framebuffer {
 public:
  explicit Framebuffer(int size, int rows_above = 0);
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  void resize(int size);
  int size() const { return size_; }
  int rows_above() const { return rows_above_; }
  void bind() const;  // binds as render target; sets the viewport to the square
  void bind_with_rows_above() const;
  void bind_for_reading() const;  // binds as source of glReadPixels
  void bind_texture() const;      // binds to the active texture unit
  imageio::Image read() const;    // RGB, of the square
  // Copies a square of another framebuffer of this size, whose lowest row is `first_row`.
  void copy_from(const Framebuffer& other, int first_row) const;

 private:
  std::uint32_t framebuffer_ = 0, texture_ = 0;
  int size_ = 0, rows_above_ = 0;
};

// Asynchronous readback into pixel buffer objects. start() begins a copy. take_if_ready() reads the buffer only after
// the GPU has finished the copy, so it never blocks. At most two copies are pending, first in, first out.
class Readback {
 public:
  Readback();
  ~Readback();
  Readback(const Readback&) = delete;
  Readback& operator=(const Readback&) = delete;

  // Begins a copy. Returns false if two copies are already pending.
  bool start(const Framebuffer& picture, std::int64_t tick, std::int64_t sim_time_ns);
  // Both move the oldest pending copy to `picture`, whose memory is reused. take_when_ready() waits at most 10 s.
  // False: no copy is pending, the copy is not ready yet (take_if_ready() only), or the driver failed. A failed copy is
  // discarded; `picture` is then unspecified.
  bool take_if_ready(Picture& picture);
  bool take_when_ready(Picture& picture);

 private:
  static constexpr std::size_t kMaxPending = 2;
  struct Copy {
    std::uint32_t buffer = 0;
    void* fence = nullptr;  // a GLsync: signaled when the GPU has finished the copy
    int size = 0;
    std::int64_t tick = 0, sim_time_ns = 0;
  };
  bool take(Picture& picture, std::uint64_t max_wait_ns);
  static bool copy_out(const Copy& copy, Picture& picture);

  std::array<Copy, kMaxPending> copies_{};
  std::size_t first_ = 0, count_ = 0;  // index of the oldest pending copy; number of pending copies
};

// Copies the content of a Framebuffer, or parts of it, into the current framebuffer without scaling.
class PicturePass {
 public:
  PicturePass();
  ~PicturePass();
  PicturePass(const PicturePass&) = delete;
  PicturePass& operator=(const PicturePass&) = delete;

  // `picture`: source. `left`, `bottom`: lower left corner of the copy in the current framebuffer [pixels].
  // `parts`: from the upper left corner of the square [pixels]. `first_row`: lowest row of the square to copy.
  void draw(const Framebuffer& picture, int left, int bottom, std::span<const Rect> parts, int first_row = 0);

 private:
  ShaderProgram program_;
  std::uint32_t vertex_array_ = 0, parts_ = 0;
  int corner_location_ = 0, edge_location_ = 0;
};

}  // namespace yars::display::gl
