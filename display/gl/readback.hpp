// Gets pictures out of the graphics memory without holding up who draws: the copy into a buffer object is only
// ordered, and taken when its fence says that it is there. Two may be under way, given out in their order.
// Needs a current context for its lifetime.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "display/gl/framebuffer.hpp"
#include "display/picture.hpp"

namespace yars::display::gl {

enum class Patience : std::uint8_t { none, until_it_is_there };

class Readback {
 public:
  Readback();
  ~Readback();
  Readback(const Readback&) = delete;
  Readback& operator=(const Readback&) = delete;

  // False: two are under way already.
  bool start(const Framebuffer& picture, std::int64_t tick, std::int64_t sim_time_ns);
  // The oldest under way. False: there is none, or it is not there yet. `picture` keeps its memory.
  bool take(Picture& picture, Patience patience);

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

}  // namespace yars::display::gl
