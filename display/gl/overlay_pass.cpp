#include "display/gl/overlay_pass.hpp"

#include <epoxy/gl.h>

#include <cstddef>

namespace yars::display::gl {

namespace {

// Attributes of an instance: from 2, to 2, half width; color 3. A half width below 0 makes a rectangle of the two
// corners.
constexpr int kFloatsPerInstance = 8;
constexpr float kRectangle = -1.0F;

constexpr const char* kOverlayVertex = R"(#version 330 core
layout(location = 0) in vec4 ends;
layout(location = 1) in vec4 style;  // half width, color
uniform float pixels_per_unit;
out vec2 at;                         // pixels, as all below
flat out vec4 segment;
flat out vec4 look;
void main() {
  segment = ends * pixels_per_unit;
  look = vec4(style.x * pixels_per_unit, style.yzw);
  vec2 side = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  if (style.x < 0.0) {
    at = mix(segment.xy, segment.zw, side);
  } else {
    vec2 along = segment.zw - segment.xy;
    float size = length(along);
    along = size > 0.0 ? along / size : vec2(1.0, 0.0);
    float margin = look.x + 1.0;
    at = mix(segment.xy - along * margin, segment.zw + along * margin, side.x) +
         vec2(-along.y, along.x) * (side.y * 2.0 - 1.0) * margin;
  }
  vec2 clip = at / (240.0 * pixels_per_unit) - 1.0;
  gl_Position = vec4(clip.x, -clip.y, 0.0, 1.0);
}
)";

constexpr const char* kOverlayFragment = R"(#version 330 core
in vec2 at;
flat in vec4 segment;
flat in vec4 look;
out vec4 fragment;
void main() {
  float cover = 1.0;
  if (look.x >= 0.0) {
    vec2 along = segment.zw - segment.xy;
    vec2 from = at - segment.xy;
    float place = clamp(dot(from, along) / max(dot(along, along), 1e-6), 0.0, 1.0);
    cover = clamp(look.x + 0.5 - length(from - along * place), 0.0, 1.0);
    if (cover <= 0.0) discard;
  }
  fragment = vec4(look.yzw, cover);
}
)";

void instance_attribute(GLuint location, int first_float) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, 4, GL_FLOAT, GL_FALSE, kFloatsPerInstance * sizeof(float),
                        // OpenGL takes an offset in the shape of a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
                        reinterpret_cast<const void*>(static_cast<std::size_t>(first_float) * sizeof(float)));
  glVertexAttribDivisor(location, 1);
}

Color scaled(const Color& color, float factor) {
  return {color.red * factor, color.green * factor, color.blue * factor};
}

}  // namespace

OverlayPass::OverlayPass() : program_("overlay", kOverlayVertex, kOverlayFragment) {
  glGenVertexArrays(1, &vertex_array_);
  glGenBuffers(1, &instances_);
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, instances_);
  instance_attribute(0, 0);
  instance_attribute(1, 4);
  scale_location_ = program_.uniform("pixels_per_unit");
}

OverlayPass::~OverlayPass() {
  glDeleteBuffers(1, &instances_);
  glDeleteVertexArrays(1, &vertex_array_);
}

void OverlayPass::add_rectangle(const Rect& rect, const Color& color) {
  instance_data_.insert(instance_data_.end(),
                        {rect.left, rect.top, rect.right, rect.bottom, kRectangle, color.red, color.green, color.blue});
}

void OverlayPass::add_strokes(std::span<const Segment> segments, const ColorScheme& colors, bool halo) {
  for (const Segment& segment : segments) {
    if (halo && segment.halo <= 0.0F) continue;
    const Color color = halo ? colors.ground : colors.of(segment.ink);
    const float half_width = segment.width / 2.0F + (halo ? segment.halo : 0.0F);
    instance_data_.insert(instance_data_.end(), {segment.from.x, segment.from.y, segment.to.x, segment.to.y, half_width,
                                                 color.red, color.green, color.blue});
  }
}

void OverlayPass::flush(float pixels_per_unit) {
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, instances_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instance_data_.size() * sizeof(float)), instance_data_.data(),
               GL_STREAM_DRAW);
  program_.use();
  glUniform1f(scale_location_, pixels_per_unit);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(instance_data_.size() / kFloatsPerInstance));
}

void OverlayPass::draw(const DrawList& list, const ColorScheme& colors, const std::array<float, 256>& light,
                       float pixels_per_unit) {
  // Instances are drawn in their order: the list's layers, from the video up.
  instance_data_.clear();
  for (const VideoStep& step : list.video_steps()) add_rectangle(step.rect, scaled(colors.video, light[step.video]));
  for (std::size_t layer = 0; layer < kLayers; ++layer) {
    const LayerContent& content = list.content(static_cast<Layer>(layer));
    for (const Rect& plate : content.plates) add_rectangle(plate, colors.ground);
    add_strokes(content.strokes, colors, true);
    add_strokes(content.strokes, colors, false);
  }
  if (!instance_data_.empty()) flush(pixels_per_unit);
}

}  // namespace yars::display::gl
