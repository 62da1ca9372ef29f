#include "display/gl/readback.hpp"

#include <epoxy/gl.h>

#include <cstring>

namespace yars::display::gl {

namespace {

constexpr GLuint64 kLongest_ns = 10'000'000'000;  // [ns] a driver that has not copied by then never will

std::size_t row_bytes(int size) {
  return static_cast<std::size_t>(size) * 4;
}

}  // namespace

Readback::Readback() {
  for (Copy& copy : copies_) glGenBuffers(1, &copy.buffer);
}

Readback::~Readback() {
  for (const Copy& copy : copies_) {
    glDeleteSync(static_cast<GLsync>(copy.fence));
    glDeleteBuffers(1, &copy.buffer);
  }
}

bool Readback::start(const Framebuffer& picture, std::int64_t tick, std::int64_t sim_time_ns) {
  if (count_ == kUnderWay) return false;
  Copy& copy = copies_[(first_ + count_) % kUnderWay];
  ++count_;
  glBindBuffer(GL_PIXEL_PACK_BUFFER, copy.buffer);
  if (copy.size != picture.size()) {
    const std::size_t bytes = row_bytes(picture.size()) * static_cast<std::size_t>(picture.size());
    glBufferData(GL_PIXEL_PACK_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_READ);
  }
  copy.size = picture.size();
  copy.tick = tick;
  copy.sim_time_ns = sim_time_ns;
  picture.bind_for_reading();
  glReadPixels(0, 0, copy.size, copy.size, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  copy.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  // What nobody sends on its way is never there.
  glFlush();
  return true;
}

bool Readback::take(Picture& picture, Patience patience) {
  if (count_ == 0) return false;
  Copy& copy = copies_[first_];
  const GLuint64 wait_ns = patience == Patience::none ? 0 : kLongest_ns;
  const GLenum outcome = glClientWaitSync(static_cast<GLsync>(copy.fence), 0, wait_ns);
  if (outcome == GL_TIMEOUT_EXPIRED && patience == Patience::none) return false;
  glDeleteSync(static_cast<GLsync>(copy.fence));
  copy.fence = nullptr;
  first_ = (first_ + 1) % kUnderWay;
  --count_;
  if (outcome != GL_ALREADY_SIGNALED && outcome != GL_CONDITION_SATISFIED) return false;
  return copy_out(copy, picture);
}

// False: the driver has lost its memory.
bool Readback::copy_out(const Copy& copy, Picture& picture) {
  const std::size_t row = row_bytes(copy.size);
  const auto rows = static_cast<std::size_t>(copy.size);
  picture.tick = copy.tick;
  picture.sim_time_ns = copy.sim_time_ns;
  picture.size = copy.size;
  picture.pixels.resize(row * rows);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, copy.buffer);
  const void* mapped = glMapBufferRange(GL_PIXEL_PACK_BUFFER, 0, static_cast<GLsizeiptr>(row * rows), GL_MAP_READ_BIT);
  if (mapped != nullptr) {
    // OpenGL's rows run from the bottom up, the picture's from the top down.
    const auto* from_below = static_cast<const std::uint8_t*>(mapped);
    for (std::size_t y = 0; y < rows; ++y)
      std::memcpy(picture.pixels.data() + y * row, from_below + (rows - 1 - y) * row, row);
    glUnmapBuffer(GL_PIXEL_PACK_BUFFER);
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  return mapped != nullptr;
}

}  // namespace yars::display::gl
