#include "display/gl/host_state_guard.hpp"

#include <epoxy/gl.h>

namespace yars::display::gl {

namespace {

// Capabilities (glEnable) that would hide, clip or recolor the picture. All are off while the display draws.
constexpr std::array<GLenum, 20> kEnable{
    GL_DEPTH_TEST,          GL_STENCIL_TEST,    GL_SCISSOR_TEST,     GL_CULL_FACE,
    GL_RASTERIZER_DISCARD,  GL_COLOR_LOGIC_OP,  GL_FRAMEBUFFER_SRGB, GL_SAMPLE_ALPHA_TO_COVERAGE,
    GL_SAMPLE_ALPHA_TO_ONE, GL_SAMPLE_COVERAGE, GL_SAMPLE_MASK,      GL_POLYGON_SMOOTH,
    GL_CLIP_DISTANCE0,      GL_CLIP_DISTANCE1,  GL_CLIP_DISTANCE2,   GL_CLIP_DISTANCE3,
    GL_CLIP_DISTANCE4,      GL_CLIP_DISTANCE5,  GL_CLIP_DISTANCE6,   GL_CLIP_DISTANCE7};

// Pixel storage parameters (glPixelStore). With the value `plain`, rows in client memory have no padding.
struct PixelNumber {
  GLenum name;
  GLint plain;
};
constexpr std::array<PixelNumber, 8> kPixelNumber{{{GL_UNPACK_ALIGNMENT, 1},
                                                   {GL_UNPACK_ROW_LENGTH, 0},
                                                   {GL_UNPACK_SKIP_ROWS, 0},
                                                   {GL_UNPACK_SKIP_PIXELS, 0},
                                                   {GL_PACK_ALIGNMENT, 1},
                                                   {GL_PACK_ROW_LENGTH, 0},
                                                   {GL_PACK_SKIP_ROWS, 0},
                                                   {GL_PACK_SKIP_PIXELS, 0}}};

GLint number_of(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

GLuint name_of(GLint bound) {
  return static_cast<GLuint>(bound);
}

void set_enabled(GLenum what, bool on) {
  if (on) {
    glEnable(what);
  } else {
    glDisable(what);
  }
}

}  // namespace

HostStateGuard::HostStateGuard()
    : draw_framebuffer_(number_of(GL_DRAW_FRAMEBUFFER_BINDING)),
      read_framebuffer_(number_of(GL_READ_FRAMEBUFFER_BINDING)),
      program_(number_of(GL_CURRENT_PROGRAM)),
      vertex_array_(number_of(GL_VERTEX_ARRAY_BINDING)),
      array_buffer_(number_of(GL_ARRAY_BUFFER_BINDING)),
      pack_buffer_(number_of(GL_PIXEL_PACK_BUFFER_BINDING)),
      unpack_buffer_(number_of(GL_PIXEL_UNPACK_BUFFER_BINDING)),
      active_unit_(number_of(GL_ACTIVE_TEXTURE)),
      blend_functions_{number_of(GL_BLEND_SRC_RGB), number_of(GL_BLEND_DST_RGB), number_of(GL_BLEND_SRC_ALPHA),
                       number_of(GL_BLEND_DST_ALPHA)},
      blend_equations_{number_of(GL_BLEND_EQUATION_RGB), number_of(GL_BLEND_EQUATION_ALPHA)} {
  static_assert(kEnable.size() == kEnables && kPixelNumber.size() == kPixelNumbers);
  glGetIntegerv(GL_VIEWPORT, viewport_.data());
  glGetIntegerv(GL_POLYGON_MODE, polygon_mode_.data());
  for (std::size_t i = 0; i < kUnits; ++i) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    units_[i] = {number_of(GL_TEXTURE_BINDING_2D), number_of(GL_SAMPLER_BINDING)};
  }
  for (std::size_t i = 0; i < kDrawBuffers; ++i) {
    const auto index = static_cast<GLuint>(i);
    draw_buffers_[i].blend = glIsEnabledi(GL_BLEND, index);
    glGetBooleani_v(GL_COLOR_WRITEMASK, index, draw_buffers_[i].mask.data());
  }
  for (std::size_t i = 0; i < kPixelNumbers; ++i) pixel_numbers_[i] = number_of(kPixelNumber[i].name);
  for (std::size_t i = 0; i < kEnables; ++i) enables_[i] = glIsEnabled(kEnable[i]) != GL_FALSE;
  set_defaults();
}

void HostStateGuard::set_defaults() const {
  for (std::size_t i = 0; i < kUnits; ++i) glBindSampler(static_cast<GLuint>(i), 0);
  glActiveTexture(GL_TEXTURE0);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glBlendEquation(GL_FUNC_ADD);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  // The display writes draw buffer 0 only. The host's other draw buffers stay unchanged.
  glColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  for (std::size_t i = 1; i < kDrawBuffers; ++i)
    glColorMaski(static_cast<GLuint>(i), GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  for (const PixelNumber& number : kPixelNumber) glPixelStorei(number.name, number.plain);
  for (const GLenum what : kEnable) glDisable(what);
}

HostStateGuard::~HostStateGuard() {
  for (std::size_t i = 0; i < kEnables; ++i) set_enabled(kEnable[i], enables_[i]);
  for (std::size_t i = 0; i < kPixelNumbers; ++i) glPixelStorei(kPixelNumber[i].name, pixel_numbers_[i]);
  for (std::size_t i = 0; i < kDrawBuffers; ++i) {
    const auto index = static_cast<GLuint>(i);
    const auto& [blend, mask] = draw_buffers_[i];
    if (blend != GL_FALSE) {
      glEnablei(GL_BLEND, index);
    } else {
      glDisablei(GL_BLEND, index);
    }
    glColorMaski(index, mask[0], mask[1], mask[2], mask[3]);
  }
  for (std::size_t i = 0; i < kUnits; ++i) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    glBindTexture(GL_TEXTURE_2D, name_of(units_[i].texture));
    glBindSampler(static_cast<GLuint>(i), name_of(units_[i].sampler));
  }
  glActiveTexture(static_cast<GLenum>(active_unit_));
  glPolygonMode(GL_FRONT_AND_BACK, static_cast<GLenum>(polygon_mode_[0]));
  glBlendEquationSeparate(static_cast<GLenum>(blend_equations_[0]), static_cast<GLenum>(blend_equations_[1]));
  glBlendFuncSeparate(static_cast<GLenum>(blend_functions_[0]), static_cast<GLenum>(blend_functions_[1]),
                      static_cast<GLenum>(blend_functions_[2]), static_cast<GLenum>(blend_functions_[3]));
  glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, name_of(unpack_buffer_));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, name_of(pack_buffer_));
  glBindVertexArray(name_of(vertex_array_));
  glBindBuffer(GL_ARRAY_BUFFER, name_of(array_buffer_));
  // A shader program that the host deleted while it was current ceased to exist when the display bound another one.
  glUseProgram(glIsProgram(name_of(program_)) != GL_FALSE ? name_of(program_) : 0);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, name_of(read_framebuffer_));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, name_of(draw_framebuffer_));
}

}  // namespace yars::display::gl
