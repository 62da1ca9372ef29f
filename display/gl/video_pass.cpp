#include "display/gl/video_pass.hpp"

#include <epoxy/gl.h>

#include <cstddef>

#include "display/gl/texture.hpp"
#include "lib/radar/limits.hpp"

namespace yars::display::gl {

namespace {

// Attributes of an instance: apex 2, left 2, right 2, range, half width, row, samples.
constexpr int kFloatsPerWedge = 10;

// Neighbours measured from apexes a few metres apart leave cracks: the strip between them is as wide as the aircraft
// has flown across it, 0.22 units between two sweeps of a Doppler beam sharpened scan at 4.7 NM and 250 m/s. Each wedge
// is drawn this much wider on either side, and the newer one covers the seam. Larger blurs the azimuth of the oldest
// edge.
constexpr const char* kVideoVertex = R"(#version 330 core
layout(location = 0) in vec2 apex;
layout(location = 1) in vec4 edges;
layout(location = 2) in vec4 shape;  // range, half width, row, samples
out vec2 offset;
flat out vec3 wedge;                 // range, row, samples
const float kMargin = 0.25;          // units
void main() {
  float reach = shape.x / cos(shape.y);
  vec2 edge = (gl_VertexID & 1) == 0 ? edges.xy : edges.zw;
  vec2 outward = normalize(edge - (edges.xy + edges.zw) * 0.5) * kMargin;
  offset = outward + (gl_VertexID < 2 ? vec2(0.0) : edge * reach);
  wedge = vec3(shape.x, shape.z, shape.w);
  vec2 at = (apex + offset) / 240.0 - 1.0;
  gl_Position = vec4(at.x, -at.y, 0.0, 1.0);
}
)";

constexpr const char* kVideoFragment = R"(#version 330 core
in vec2 offset;
flat in vec3 wedge;
uniform sampler2D video;
uniform sampler2D light;
uniform vec3 color;
out vec4 fragment;
void main() {
  float fraction = length(offset) / wedge.x;
  if (fraction > 1.0) discard;
  vec2 size = vec2(textureSize(video, 0));
  float column = clamp(fraction * wedge.z, 0.5, wedge.z - 0.5);
  float level = texture(video, vec2(column, wedge.y + 0.5) / size).r;
  fragment = vec4(color * texture(light, vec2((level * 255.0 + 0.5) / 256.0, 0.5)).r, 1.0);
}
)";

void instance_attribute(GLuint location, GLint components, int first_float) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, kFloatsPerWedge * sizeof(float),
                        // OpenGL takes an offset in the shape of a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
                        reinterpret_cast<const void*>(static_cast<std::size_t>(first_float) * sizeof(float)));
  glVertexAttribDivisor(location, 1);
}

}  // namespace

VideoPass::VideoPass() : program_("video", kVideoVertex, kVideoFragment), uploaded_serial_(PolarStore::kRows) {
  glGenVertexArrays(1, &vertex_array_);
  glGenBuffers(1, &instances_);
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, instances_);
  instance_attribute(0, 2, 0);
  instance_attribute(1, 4, 2);
  instance_attribute(2, 4, 6);

  video_texture_ = new_texture();
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, PolarStore::kRowSamples, PolarStore::kRows, 0, GL_RED, GL_UNSIGNED_BYTE,
               nullptr);

  program_.use();
  glUniform1i(program_.uniform("video"), 0);
  glUniform1i(program_.uniform("light"), 1);
  color_location_ = program_.uniform("color");
}

VideoPass::~VideoPass() {
  glDeleteTextures(1, &video_texture_);
  glDeleteBuffers(1, &instances_);
  glDeleteVertexArrays(1, &vertex_array_);
}

void VideoPass::upload_new_rows(const PolarStore& store, std::span<const Wedge> wedges) {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, video_texture_);
  for (const Wedge& wedge : wedges) {
    std::uint64_t& uploaded = uploaded_serial_[static_cast<std::size_t>(wedge.row)];
    if (uploaded == wedge.serial) continue;
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, wedge.row, wedge.samples, 1, GL_RED, GL_UNSIGNED_BYTE,
                    store.video(wedge.row).data());
    uploaded = wedge.serial;
  }
}

void VideoPass::draw(const PolarStore& store, std::span<const Wedge> wedges, const LightTexture& light,
                     const Color& color) {
  if (wedges.empty()) return;
  upload_new_rows(store, wedges);
  instance_data_.clear();
  for (const Wedge& wedge : wedges) {
    instance_data_.insert(instance_data_.end(), {wedge.apex.x, wedge.apex.y, wedge.left.x, wedge.left.y, wedge.right.x,
                                                 wedge.right.y, wedge.range, wedge.half_width,
                                                 static_cast<float>(wedge.row), static_cast<float>(wedge.samples)});
  }
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, instances_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instance_data_.size() * sizeof(float)), instance_data_.data(),
               GL_STREAM_DRAW);
  light.bind(1);
  program_.use();
  glUniform3f(color_location_, color.red, color.green, color.blue);
  glDisable(GL_BLEND);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(wedges.size()));
}

}  // namespace yars::display::gl
