// Scope guard for the OpenGL state of a host, the program that owns the context. The constructor saves the state and
// sets the values that the display needs. The destructor restores the state. All state that display/gl changes
// is saved:
// - bound draw and read framebuffers, program, vertex array, array buffer, pixel pack and unpack buffers;
// - active texture unit, 2D textures and samplers of units 0 and 1;
// - viewport 0 (restored to all viewport indices), polygon mode, pixel pack and unpack parameters;
// - blend enables and color masks of draw buffers 0 to 7, blend functions and equations;
// - the capabilities in kEnable (host_state_guard.cpp), such as GL_DEPTH_TEST.
// Needs a current OpenGL 3.3 context without active transform feedback or conditional rendering.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace yars::display::gl {

class HostStateGuard {
 public:
  HostStateGuard();
  ~HostStateGuard();
  HostStateGuard(const HostStateGuard&) = delete;
  HostStateGuard& operator=(const HostStateGuard&) = delete;

 private:
  static constexpr std::size_t kUnits = 2;         // texture units that the display uses
  static constexpr std::size_t kDrawBuffers = 8;   // every OpenGL 3.3 has at least this number of draw buffers
  static constexpr std::size_t kEnables = 20;      // size of kEnable in host_state_guard.cpp
  static constexpr std::size_t kPixelNumbers = 8;  // size of kPixelNumber in host_state_guard.cpp
  struct Unit {
    std::int32_t texture = 0, sampler = 0;
  };
  struct DrawBuffer {
    std::uint8_t blend = 0;
    std::array<std::uint8_t, 4> mask{};
  };
  void set_defaults() const;

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
