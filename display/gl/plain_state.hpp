// Keeps what a host has set in its OpenGL context, sets what the glass takes for granted, and puts the host's back when
// it goes out of scope. Covers all that the folder's code changes: the bound draw and read framebuffers, program,
// vertex array, array buffer, pixel pack and unpack buffers; the active texture unit, 2D textures and samplers of units
// 0 and 1; viewport (one for all indices); blend enables and color masks of each draw buffer, blend functions and
// equations; polygon mode; pixel pack and unpack parameters; and the enables listed in the source, which would bend a
// plain draw. Needs a current context of OpenGL 3.3, whose host has no transform feedback or conditional rendering
// under way.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace yars::display::gl {

class PlainState {
 public:
  PlainState();
  ~PlainState();
  PlainState(const PlainState&) = delete;
  PlainState& operator=(const PlainState&) = delete;

 private:
  static constexpr std::size_t kUnits = 2;         // the glass's textures
  static constexpr std::size_t kDrawBuffers = 8;   // OpenGL 3.3 promises as many
  static constexpr std::size_t kEnables = 20;      // see the source
  static constexpr std::size_t kPixelNumbers = 8;  // see the source
  struct Unit {
    std::int32_t texture = 0, sampler = 0;
  };
  struct DrawBuffer {
    std::uint8_t blend = 0;
    std::array<std::uint8_t, 4> mask{};
  };
  void set_plain() const;

  std::int32_t draw_framebuffer_ = 0, read_framebuffer_ = 0, program_ = 0, vertex_array_ = 0;
  std::int32_t array_buffer_ = 0, pack_buffer_ = 0, unpack_buffer_ = 0, active_unit_ = 0;
  std::array<std::int32_t, 4> viewport_{}, blend_functions_{};
  std::array<std::int32_t, 2> blend_equations_{}, polygon_mode_{};
  std::array<Unit, kUnits> units_{};
  std::array<DrawBuffer, kDrawBuffers> draw_buffers_{};
  std::array<std::int32_t, kPixelNumbers> pixel_numbers_{};
  std::array<bool, kEnables> enables_{};
};

}  // namespace yars::display::gl
