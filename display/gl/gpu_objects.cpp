#include "display/gl/gpu_objects.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <string>

#include "lib/error/error.hpp"

namespace yars::display::gl {

std::uint32_t new_texture() {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  return texture;
}

LightTexture::LightTexture() {
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  // No interpolation between video levels, because the light is one of eight grays.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, 256, 1, 0, GL_RED, GL_FLOAT, nullptr);
}

LightTexture::~LightTexture() {
  glDeleteTextures(1, &texture_);
}

void LightTexture::set(const std::array<float, 256>& light) {
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, static_cast<GLsizei>(light.size()), 1, GL_RED, GL_FLOAT, light.data());
}

void LightTexture::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, texture_);
  glActiveTexture(GL_TEXTURE0);
}

namespace {

using Log = std::array<char, 1024>;

GLuint compiled(GLenum kind, const char* name, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good != GL_TRUE) {
    Log log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    error::requirement_broken(name, log.data(), __FILE__, __LINE__);
  }
  return shader;
}

}  // namespace

ShaderProgram::ShaderProgram(const char* name, const char* vertex_source, const char* fragment_source)
    : program_(glCreateProgram()) {
  const GLuint vertex = compiled(GL_VERTEX_SHADER, name, vertex_source);
  const GLuint fragment = compiled(GL_FRAGMENT_SHADER, name, fragment_source);
  glAttachShader(program_, vertex);
  glAttachShader(program_, fragment);
  glLinkProgram(program_);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint good = GL_FALSE;
  glGetProgramiv(program_, GL_LINK_STATUS, &good);
  if (good != GL_TRUE) {
    Log log{};
    glGetProgramInfoLog(program_, static_cast<GLsizei>(log.size()), nullptr, log.data());
    error::requirement_broken(name, log.data(), __FILE__, __LINE__);
  }
}

ShaderProgram::~ShaderProgram() {
  glDeleteProgram(program_);
}

void ShaderProgram::use() const {
  glUseProgram(program_);
}

int ShaderProgram::uniform(const char* name) const {
  return glGetUniformLocation(program_, name);
}

Framebuffer::Framebuffer(int size, int rows_above) : rows_above_(rows_above) {
  glGenFramebuffers(1, &framebuffer_);
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  // One texel is shown as one pixel. The default filter would need mipmap levels, which this texture does not have.
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  resize(size);
}

Framebuffer::~Framebuffer() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &texture_);
}

void Framebuffer::resize(int size) {
  size_ = size;
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size, size + rows_above_, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  YARS_REQUIRE(glCheckFramebufferStatus(GL_FRAMEBUFFER), ==, static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, size_, size_);
}

void Framebuffer::bind_with_rows_above() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, size_, size_ + rows_above_);
}

// A software renderer copies memory here. It takes several times as long to draw a picture as a texture.
void Framebuffer::copy_from(const Framebuffer& other, int first_row) const {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_);
  other.bind_for_reading();
  glBlitFramebuffer(0, first_row, size_, first_row + size_, 0, 0, size_, size_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Framebuffer::bind_for_reading() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
}

void Framebuffer::bind_texture() const {
  glBindTexture(GL_TEXTURE_2D, texture_);
}

imageio::Image Framebuffer::read() const {
  const std::size_t row = static_cast<std::size_t>(size_) * 3;
  std::vector<std::uint8_t> bottom_up(row * static_cast<std::size_t>(size_));
  bind_for_reading();
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size_, size_, GL_RGB, GL_UNSIGNED_BYTE, bottom_up.data());
  // Rows of OpenGL run from the bottom up, rows of an image from the top down.
  imageio::Image image{size_, size_, 3, std::vector<std::uint8_t>(bottom_up.size())};
  for (std::size_t y = 0; y < static_cast<std::size_t>(size_); ++y) {
    const auto source =
        bottom_up.begin() + static_cast<std::ptrdiff_t>((static_cast<std::size_t>(size_) - 1 - y) * row);
    std::copy_n(source, row, image.pixels.begin() + static_cast<std::ptrdiff_t>(y * row));
  }
  return image;
}

namespace {

constexpr GLuint64 kMaxWait_ns = 10'000'000'000;  // 10 s; a longer copy counts as a failure of the driver

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
  if (count_ == kMaxPending) return false;
  Copy& copy = copies_[(first_ + count_) % kMaxPending];
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
  // Without a flush the driver may never start the copy, and the fence would not be signaled.
  glFlush();
  return true;
}

bool Readback::take_if_ready(Picture& picture) {
  return take(picture, 0);
}

bool Readback::take_when_ready(Picture& picture) {
  return take(picture, kMaxWait_ns);
}

bool Readback::take(Picture& picture, std::uint64_t max_wait_ns) {
  if (count_ == 0) return false;
  Copy& copy = copies_[first_];
  const GLenum outcome = glClientWaitSync(static_cast<GLsync>(copy.fence), 0, max_wait_ns);
  if (outcome == GL_TIMEOUT_EXPIRED && max_wait_ns == 0) return false;
  glDeleteSync(static_cast<GLsync>(copy.fence));
  copy.fence = nullptr;
  first_ = (first_ + 1) % kMaxPending;
  --count_;
  if (outcome != GL_ALREADY_SIGNALED && outcome != GL_CONDITION_SATISFIED) return false;
  return copy_out(copy, picture);
}

// Returns false if the driver cannot map the buffer.
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
    // Rows of OpenGL run from the bottom up, rows of the picture from the top down.
    const auto* bottom_up = static_cast<const std::uint8_t*>(mapped);
    for (std::size_t y = 0; y < rows; ++y)
      std::memcpy(picture.pixels.data() + y * row, bottom_up + (rows - 1 - y) * row, row);
    glUnmapBuffer(GL_PIXEL_PACK_BUFFER);
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  return mapped != nullptr;
}

namespace {

constexpr const char* kPictureVertex = R"(#version 330 core
layout(location = 0) in vec4 part;  // [pixels] left, top, right, bottom
uniform float edge;                 // of the picture [pixels]
void main() {
  vec2 at = mix(part.xy, part.zw, vec2(gl_VertexID & 1, gl_VertexID >> 1)) / (edge * 0.5) - 1.0;
  gl_Position = vec4(at.x, -at.y, 0.0, 1.0);
}
)";

// texelFetch copies exact pixels. texture() could mix two pixels. glBlitFramebuffer fails for some target framebuffers.
constexpr const char* kPictureFragment = R"(#version 330 core
uniform sampler2D picture;
uniform ivec2 corner;
out vec4 fragment;
void main() {
  fragment = texelFetch(picture, ivec2(gl_FragCoord.xy) - corner, 0);
}
)";

}  // namespace

PicturePass::PicturePass() : program_("picture", kPictureVertex, kPictureFragment) {
  static_assert(sizeof(Rect) == 4 * sizeof(float));
  glGenVertexArrays(1, &vertex_array_);
  glGenBuffers(1, &parts_);
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, parts_);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(Rect), nullptr);
  glVertexAttribDivisor(0, 1);
  program_.use();
  glUniform1i(program_.uniform("picture"), 0);
  corner_location_ = program_.uniform("corner");
  edge_location_ = program_.uniform("edge");
}

PicturePass::~PicturePass() {
  glDeleteBuffers(1, &parts_);
  glDeleteVertexArrays(1, &vertex_array_);
}

void PicturePass::draw(const Framebuffer& picture, int left, int bottom, std::span<const Rect> parts, int first_row) {
  if (parts.empty()) return;
  glViewport(left, bottom, picture.size(), picture.size());
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, parts_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(parts.size_bytes()), parts.data(), GL_STREAM_DRAW);
  glActiveTexture(GL_TEXTURE0);
  picture.bind_texture();
  program_.use();
  glUniform2i(corner_location_, left, bottom - first_row);
  glUniform1f(edge_location_, static_cast<float>(picture.size()));
  glDisable(GL_BLEND);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(parts.size()));
}

}  // namespace yars::display::gl
