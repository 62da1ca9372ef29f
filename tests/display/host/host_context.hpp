// OpenGL of a host program, for tests: Canvas stands for its window, OddState sets unusual OpenGL state, and
// state_of_context() lists all state values of the context.
#pragma once

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace yars::display::host {

inline void expect_no_error(const char* after) {
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR)) << after;
}

// Makes glReadPixels() write rows without gaps to client memory.
inline void plain_reading() {
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  for (const GLenum name : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS}) glPixelStorei(name, 0);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

// Framebuffer with two color buffers, depth and stencil.
class Canvas {
 public:
  Canvas(int width, int height) : width_(width), height_(height) {
    glGenFramebuffers(1, &framebuffer_);
    glGenRenderbuffers(3, buffers_.data());
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    attach(0, GL_RGBA8, GL_COLOR_ATTACHMENT0);
    attach(1, GL_RGBA8, GL_COLOR_ATTACHMENT1);
    attach(2, GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT);
    constexpr std::array<GLenum, 2> kBoth{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(2, kBoth.data());
  }
  ~Canvas() {
    glDeleteRenderbuffers(3, buffers_.data());
    glDeleteFramebuffers(1, &framebuffer_);
  }
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_); }
  void fill() const {
    constexpr std::array<float, 4> kBrown{0.4F, 0.3F, 0.2F, 0.5F};
    for (const GLint buffer : {0, 1}) glClearBufferfv(GL_COLOR, buffer, kBrown.data());
  }

  // RGBA pixels of both color buffers, one after the other; rows from the bottom.
  std::vector<std::uint8_t> read() const {
    plain_reading();
    std::vector<std::uint8_t> pixels(2 * bytes());
    for (const std::size_t color : {0U, 1U}) {
      glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(color));
      glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data() + color * bytes());
    }
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    return pixels;
  }
  // RGB pixels of a square of the first color buffer; rows from the top.
  std::vector<std::uint8_t> square(const std::vector<std::uint8_t>& pixels, int left, int bottom, int size) const {
    std::vector<std::uint8_t> square;
    for (int y = bottom + size - 1; y >= bottom; --y)
      for (int x = left; x < left + size; ++x)
        square.insert(square.end(), &pixels[offset_of(x, y)], &pixels[offset_of(x, y)] + 3);
    return square;
  }
  // Number of pixels that differ: in the first color buffer outside the square, in the second one anywhere.
  int changed_outside(const std::vector<std::uint8_t>& before, const std::vector<std::uint8_t>& after, int left,
                      int bottom, int size) const {
    int changed = 0;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const bool inside = x >= left && x < left + size && y >= bottom && y < bottom + size;
        for (const std::size_t color : {0U, 1U}) {
          const std::size_t at = offset_of(x, y) + color * bytes();
          if (color == 0U && inside) continue;
          changed += std::equal(&before[at], &before[at] + 4, &after[at]) ? 0 : 1;
        }
      }
    }
    return changed;
  }

 private:
  std::size_t bytes() const { return 4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }
  std::size_t offset_of(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  }
  void attach(std::size_t buffer, GLenum format, GLenum attachment) const {
    glBindRenderbuffer(GL_RENDERBUFFER, buffers_[buffer]);
    glRenderbufferStorage(GL_RENDERBUFFER, format, width_, height_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffers_[buffer]);
  }

  int width_, height_;
  GLuint framebuffer_ = 0;
  std::array<GLuint, 3> buffers_{};
};

// Capabilities that OddState enables.
constexpr std::array kOddEnables{GL_DEPTH_TEST,          GL_STENCIL_TEST,
                                 GL_SCISSOR_TEST,        GL_CULL_FACE,
                                 GL_RASTERIZER_DISCARD,  GL_COLOR_LOGIC_OP,
                                 GL_FRAMEBUFFER_SRGB,    GL_SAMPLE_ALPHA_TO_COVERAGE,
                                 GL_SAMPLE_ALPHA_TO_ONE, GL_SAMPLE_COVERAGE,
                                 GL_SAMPLE_MASK,         GL_POLYGON_SMOOTH,
                                 GL_POLYGON_OFFSET_FILL, GL_LINE_SMOOTH,
                                 GL_PRIMITIVE_RESTART,   GL_DEPTH_CLAMP,
                                 GL_PROGRAM_POINT_SIZE,  GL_TEXTURE_CUBE_MAP_SEAMLESS,
                                 GL_CLIP_DISTANCE0,      GL_CLIP_DISTANCE3,
                                 GL_CLIP_DISTANCE7};

// OpenGL state that hides or distorts what is drawn, and a host's own objects at the binding points.
class OddState {
 public:
  explicit OddState(const Canvas& canvas) : canvas_(&canvas) {
    glGenTextures(3, textures_.data());
    glGenSamplers(1, &sampler_);
    glGenBuffers(4, buffers_.data());
    glGenVertexArrays(1, &vertex_array_);
    glGenRenderbuffers(1, &renderbuffer_);
  }
  ~OddState() {
    glUseProgram(0);
    glDeleteProgram(program_);
    glDeleteRenderbuffers(1, &renderbuffer_);
    glDeleteVertexArrays(1, &vertex_array_);
    glDeleteBuffers(4, buffers_.data());
    glDeleteSamplers(1, &sampler_);
    glDeleteTextures(3, textures_.data());
  }
  OddState(const OddState&) = delete;
  OddState& operator=(const OddState&) = delete;

  void set() const {
    canvas_->bind();
    bind_objects();
    expect_no_error("binding");
    glViewport(3, 5, 17, 19);
    glScissor(2, 2, 1, 1);
    glClearColor(1.0F, 0.5F, 0.25F, 0.75F);
    glClearStencil(3);
    glClearDepth(0.25);
    glDepthFunc(GL_NEVER);
    glDepthMask(GL_FALSE);
    glStencilFunc(GL_NEVER, 1, 1);
    glFrontFace(GL_CW);
    glCullFace(GL_FRONT_AND_BACK);
    glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
    glLogicOp(GL_XOR);
    glSampleCoverage(0.0F, GL_FALSE);
    glSampleMaski(0, 0);
    glBlendFuncSeparate(GL_ZERO, GL_ONE, GL_DST_COLOR, GL_ZERO);
    glBlendEquationSeparate(GL_MIN, GL_FUNC_REVERSE_SUBTRACT);
    for (const GLuint buffer : {0U, 2U}) glEnablei(GL_BLEND, buffer);
    glColorMaski(0, GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
    glColorMaski(3, GL_TRUE, GL_FALSE, GL_FALSE, GL_TRUE);
    for (const GLenum what : kOddEnables) glEnable(what);
    expect_no_error("setting");
    glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
    glPixelStorei(GL_PACK_ALIGNMENT, 8);
    for (const GLenum name : {GL_UNPACK_ROW_LENGTH, GL_PACK_ROW_LENGTH}) glPixelStorei(name, 1001);
    for (const GLenum name : {GL_UNPACK_SKIP_ROWS, GL_PACK_SKIP_ROWS}) glPixelStorei(name, 2);
    for (const GLenum name : {GL_UNPACK_SKIP_PIXELS, GL_PACK_SKIP_PIXELS}) glPixelStorei(name, 3);
  }

 private:
  void bind_objects() const {
    for (std::size_t unit = 0; unit < textures_.size(); ++unit) {
      glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
      glBindTexture(GL_TEXTURE_2D, textures_[unit]);
      glBindSampler(static_cast<GLuint>(unit), sampler_);
    }
    constexpr std::array kTargets{GL_ARRAY_BUFFER, GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER, GL_UNIFORM_BUFFER};
    for (std::size_t i = 0; i < kTargets.size(); ++i) {
      glBindBuffer(kTargets[i], buffers_[i]);
      glBufferData(kTargets[i], 64, nullptr, GL_STATIC_DRAW);
    }
    glBindVertexArray(vertex_array_);
    glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer_);
    glLinkProgram(program_);
    glUseProgram(program_);
  }

  const Canvas* canvas_;
  std::array<GLuint, 3> textures_{};
  std::array<GLuint, 4> buffers_{};
  GLuint sampler_ = 0, vertex_array_ = 0, renderbuffer_ = 0, program_ = linked_program();

  static GLuint linked_program() {
    const char* const kVertex = "#version 330 core\nvoid main() { gl_Position = vec4(0.0); }";
    const GLuint shader = glCreateShader(GL_VERTEX_SHADER);
    glShaderSource(shader, 1, &kVertex, nullptr);
    glCompileShader(shader);
    const GLuint program = glCreateProgram();
    glAttachShader(program, shader);
    glDeleteShader(shader);
    return program;
  }
};

using ContextState = std::map<std::string, std::vector<double>>;

inline void add_numbers(ContextState& state) {
#define YARS_STATE(name) {#name, name}
  constexpr std::array<std::pair<const char*, GLenum>, 61> kNames{{
      YARS_STATE(GL_DRAW_FRAMEBUFFER_BINDING),
      YARS_STATE(GL_READ_FRAMEBUFFER_BINDING),
      YARS_STATE(GL_CURRENT_PROGRAM),
      YARS_STATE(GL_VERTEX_ARRAY_BINDING),
      YARS_STATE(GL_ARRAY_BUFFER_BINDING),
      YARS_STATE(GL_PIXEL_PACK_BUFFER_BINDING),
      YARS_STATE(GL_PIXEL_UNPACK_BUFFER_BINDING),
      YARS_STATE(GL_UNIFORM_BUFFER_BINDING),
      YARS_STATE(GL_ELEMENT_ARRAY_BUFFER_BINDING),
      YARS_STATE(GL_RENDERBUFFER_BINDING),
      YARS_STATE(GL_ACTIVE_TEXTURE),
      YARS_STATE(GL_VIEWPORT),
      YARS_STATE(GL_SCISSOR_BOX),
      YARS_STATE(GL_DEPTH_RANGE),
      YARS_STATE(GL_COLOR_CLEAR_VALUE),
      YARS_STATE(GL_DEPTH_CLEAR_VALUE),
      YARS_STATE(GL_STENCIL_CLEAR_VALUE),
      YARS_STATE(GL_DEPTH_FUNC),
      YARS_STATE(GL_DEPTH_WRITEMASK),
      YARS_STATE(GL_STENCIL_FUNC),
      YARS_STATE(GL_STENCIL_REF),
      YARS_STATE(GL_STENCIL_VALUE_MASK),
      YARS_STATE(GL_STENCIL_WRITEMASK),
      YARS_STATE(GL_STENCIL_FAIL),
      YARS_STATE(GL_STENCIL_PASS_DEPTH_FAIL),
      YARS_STATE(GL_STENCIL_PASS_DEPTH_PASS),
      YARS_STATE(GL_FRONT_FACE),
      YARS_STATE(GL_CULL_FACE_MODE),
      YARS_STATE(GL_POLYGON_MODE),
      YARS_STATE(GL_LOGIC_OP_MODE),
      YARS_STATE(GL_SAMPLE_COVERAGE_VALUE),
      YARS_STATE(GL_SAMPLE_COVERAGE_INVERT),
      YARS_STATE(GL_BLEND_SRC_RGB),
      YARS_STATE(GL_BLEND_DST_RGB),
      YARS_STATE(GL_BLEND_SRC_ALPHA),
      YARS_STATE(GL_BLEND_DST_ALPHA),
      YARS_STATE(GL_BLEND_EQUATION_RGB),
      YARS_STATE(GL_BLEND_EQUATION_ALPHA),
      YARS_STATE(GL_BLEND_COLOR),
      YARS_STATE(GL_UNPACK_ALIGNMENT),
      YARS_STATE(GL_UNPACK_ROW_LENGTH),
      YARS_STATE(GL_UNPACK_SKIP_ROWS),
      YARS_STATE(GL_UNPACK_SKIP_PIXELS),
      YARS_STATE(GL_UNPACK_SWAP_BYTES),
      YARS_STATE(GL_UNPACK_LSB_FIRST),
      YARS_STATE(GL_UNPACK_IMAGE_HEIGHT),
      YARS_STATE(GL_UNPACK_SKIP_IMAGES),
      YARS_STATE(GL_PACK_ALIGNMENT),
      YARS_STATE(GL_PACK_ROW_LENGTH),
      YARS_STATE(GL_PACK_SKIP_ROWS),
      YARS_STATE(GL_PACK_SKIP_PIXELS),
      YARS_STATE(GL_PACK_SWAP_BYTES),
      YARS_STATE(GL_PACK_LSB_FIRST),
      YARS_STATE(GL_LINE_WIDTH),
      YARS_STATE(GL_POINT_SIZE),
      YARS_STATE(GL_POLYGON_OFFSET_FACTOR),
      YARS_STATE(GL_POLYGON_OFFSET_UNITS),
      YARS_STATE(GL_PROVOKING_VERTEX),
      YARS_STATE(GL_PRIMITIVE_RESTART_INDEX),
      YARS_STATE(GL_CLAMP_READ_COLOR),
      YARS_STATE(GL_READ_BUFFER),
  }};
#undef YARS_STATE
  for (const auto& [name, number] : kNames) {
    std::array<GLdouble, 4> values{};
    glGetDoublev(number, values.data());
    state[name].assign(values.begin(), values.end());
  }
}

// State values of the current OpenGL 3.3 context, without the contents of objects. Changes the active texture unit and
// restores it.
inline ContextState state_of_context() {
  ContextState state;
  add_numbers(state);
  constexpr std::array kOtherEnables{
      GL_DITHER,         GL_MULTISAMPLE,    GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_POINT, GL_CLIP_DISTANCE1,
      GL_CLIP_DISTANCE2, GL_CLIP_DISTANCE4, GL_CLIP_DISTANCE5,      GL_CLIP_DISTANCE6};
  for (const GLenum what : kOddEnables)
    state["enable " + std::to_string(what)] = {static_cast<double>(glIsEnabled(what))};
  for (const GLenum what : kOtherEnables)
    state["enable " + std::to_string(what)] = {static_cast<double>(glIsEnabled(what))};
  for (GLuint i = 0; i < 8; ++i) {
    std::array<GLboolean, 4> mask{};
    glGetBooleani_v(GL_COLOR_WRITEMASK, i, mask.data());
    state["draw buffer " + std::to_string(i)] = {static_cast<double>(glIsEnabledi(GL_BLEND, i)),
                                                 static_cast<double>(mask[0]), static_cast<double>(mask[1]),
                                                 static_cast<double>(mask[2]), static_cast<double>(mask[3])};
  }
  GLint active = 0;
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
  for (GLuint unit = 0; unit < 4; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    for (const GLenum what : {GL_TEXTURE_BINDING_2D, GL_SAMPLER_BINDING, GL_TEXTURE_BINDING_3D,
                              GL_TEXTURE_BINDING_RECTANGLE, GL_TEXTURE_BINDING_CUBE_MAP}) {
      GLint bound = 0;
      glGetIntegerv(what, &bound);
      state["unit " + std::to_string(unit) + " " + std::to_string(what)] = {static_cast<double>(bound)};
    }
  }
  glActiveTexture(static_cast<GLenum>(active));
  return state;
}

}  // namespace yars::display::host
