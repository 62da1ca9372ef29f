#include "display/gl/passes.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>

#include "display/gl/gpu_objects.hpp"
#include "lib/radar/modes.hpp"

namespace yars::display::gl {

namespace {

// Floats of one instance, from the members of Wedge: apex (2) [units], unit vectors along the left edge (2) and the
// right edge (2), range [units], half width [rad], row, samples.
constexpr int kFloatsPerWedge = 10;

// The number 240 in the shader of the video is half of kDisplayUnits.
constexpr const char* kVideoVertex = R"(#version 330 core
layout(location = 0) in vec2 apex;
layout(location = 1) in vec4 edges;
layout(location = 2) in vec4 shape;  // range [units], half width [rad], row, samples
out vec2 offset;
flat out vec3 wedge;                 // range, row, samples
uniform float margin;                // units
uniform float share;                 // of the display in the height of the viewport
void main() {
  float reach = shape.x / cos(shape.y);
  vec2 edge = (gl_VertexID & 1) == 0 ? edges.xy : edges.zw;
  vec2 outward = normalize(edge - (edges.xy + edges.zw) * 0.5) * margin;
  offset = outward + (gl_VertexID < 2 ? vec2(0.0) : edge * reach);
  wedge = vec3(shape.x, shape.z, shape.w);
  vec2 at = (apex + offset) / 240.0 - 1.0;
  gl_Position = vec4(at.x, -at.y * share + (share - 1.0), 0.0, 1.0);
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
                        // OpenGL takes the offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
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
  glUniform1f(program_.uniform("margin"), kMargin);
  share_location_ = program_.uniform("share");
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
                     const Color& color, float share) {
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
  glUniform1f(share_location_, share);
  glDisable(GL_BLEND);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(wedges.size()));
}

namespace {

constexpr const char* kMapVertex = R"(#version 330 core
out vec2 texel;  // 0..1 from the upper left
void main() {
  texel = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(texel.x * 2.0 - 1.0, 1.0 - texel.y * 2.0, 0.0, 1.0);
}
)";

constexpr const char* kMapFragment = R"(#version 330 core
in vec2 texel;
uniform sampler2D map;
uniform sampler2D light;
uniform vec3 color;
out vec4 fragment;
void main() {
  float level = texture(map, texel).r;
  fragment = vec4(color * texture(light, vec2((level * 255.0 + 0.5) / 256.0, 0.5)).r, 1.0);
}
)";

std::uint32_t texture_of(std::uint32_t size, std::span<const std::uint8_t> pixels) {
  const std::uint32_t texture = new_texture();
  const auto edge = static_cast<GLsizei>(size);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, edge, edge, 0, GL_RED, GL_UNSIGNED_BYTE, pixels.data());
  return texture;
}

}  // namespace

MapPass::MapPass() : program_("map", kMapVertex, kMapFragment) {
  glGenVertexArrays(1, &vertex_array_);
  program_.use();
  glUniform1i(program_.uniform("map"), 0);
  glUniform1i(program_.uniform("light"), 1);
  color_location_ = program_.uniform("color");
}

MapPass::~MapPass() {
  keep({});
  glDeleteVertexArrays(1, &vertex_array_);
}

void MapPass::add(std::uint64_t id, std::uint32_t size, std::span<const std::uint8_t> pixels) {
  if (id == 0 || size == 0 || pixels.size() < std::size_t{size} * size || has(id)) return;
  maps_.push_back({id, texture_of(size, pixels), static_cast<int>(size)});
}

void MapPass::keep(std::span<const std::uint64_t> ids) {
  std::erase_if(maps_, [ids](const StoredMap& map) {
    if (std::ranges::find(ids, map.id) != ids.end()) return false;
    glDeleteTextures(1, &map.texture);
    return true;
  });
}

bool MapPass::has(std::uint64_t id) const {
  return std::ranges::find(maps_, id, &StoredMap::id) != maps_.end();
}

// Binds a map's texture. A map with more pixels than the display is averaged by mipmaps (smaller copies of the
// texture), because its speckle would flicker without averaging. Other maps get no mipmaps, because a software renderer
// generates mipmaps slowly.
void MapPass::bind(StoredMap& map, int display_size) {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, map.texture);
  if (map.averaged || map.size <= display_size) return;
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  map.averaged = true;
}

void MapPass::draw(std::uint64_t id, const LightTexture& light, const Color& color, int display_size) {
  const auto map = std::ranges::find(maps_, id, &StoredMap::id);
  if (map == maps_.end()) return;
  glBindVertexArray(vertex_array_);
  light.bind(1);
  bind(*map, display_size);
  program_.use();
  glUniform3f(color_location_, color.red, color.green, color.blue);
  glDisable(GL_BLEND);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

namespace {

// Floats of one instance: from (2), to (2), half width, color (3), the part of the square to draw (4) [pixels].
// The half width kRectangle marks a filled rectangle with the corners `from` and `to`.
constexpr int kFloatsPerInstance = 12;
constexpr float kRectangle = -1.0F;

constexpr const char* kOverlayVertex = R"(#version 330 core
layout(location = 0) in vec4 ends;
layout(location = 1) in vec4 style;  // half width, color
layout(location = 2) in vec4 part;   // [pixels] left, top, right, bottom; empty: all of the instance
uniform float pixels_per_unit;
uniform float edge;                  // of the square [pixels]
flat out vec4 segment;               // [pixels], like the half width below
flat out vec4 stroke;
void main() {
  segment = ends * pixels_per_unit;
  stroke = vec4(style.x * pixels_per_unit, style.yzw);
  vec2 side = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  float margin = style.x < 0.0 ? 0.0 : stroke.x + 1.0;
  vec2 at;
  if (style.x < 0.0 || part.z > part.x) {
    vec2 low = min(segment.xy, segment.zw) - margin;
    vec2 high = max(segment.xy, segment.zw) + margin;
    if (part.z > part.x) {
      low = max(low, part.xy);
      high = max(low, min(high, part.zw));
    }
    at = mix(low, high, side);
  } else {
    vec2 along = segment.zw - segment.xy;
    float size = length(along);
    along = size > 0.0 ? along / size : vec2(1.0, 0.0);
    at = mix(segment.xy - along * margin, segment.zw + along * margin, side.x) +
         vec2(-along.y, along.x) * (side.y * 2.0 - 1.0) * margin;
  }
  vec2 clip = at / (edge * 0.5) - 1.0;
  gl_Position = vec4(clip.x, -clip.y, 0.0, 1.0);
}
)";

// The position in the square comes from the pixel, not from the corners of what is drawn. A stroke drawn in parts
// therefore has the same pixels as a stroke drawn at once.
constexpr const char* kOverlayFragment = R"(#version 330 core
flat in vec4 segment;
flat in vec4 stroke;
uniform vec2 corner;  // upper left corner of the square, from the framebuffer's lower left corner [pixels]
out vec4 fragment;
void main() {
  float cover = 1.0;
  if (stroke.x >= 0.0) {
    vec2 at = vec2(gl_FragCoord.x - corner.x, corner.y - gl_FragCoord.y);
    vec2 along = segment.zw - segment.xy;
    vec2 from = at - segment.xy;
    float fraction = clamp(dot(from, along) / max(dot(along, along), 1e-6), 0.0, 1.0);
    cover = clamp(stroke.x + 0.5 - length(from - along * fraction), 0.0, 1.0);
    if (cover <= 0.0) discard;
  }
  fragment = vec4(stroke.yzw, cover);
}
)";

void instance_attribute(GLuint location, int first_float) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, 4, GL_FLOAT, GL_FALSE, kFloatsPerInstance * sizeof(float),
                        // OpenGL takes the offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
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
  instance_attribute(2, 8);
  scale_location_ = program_.uniform("pixels_per_unit");
  edge_location_ = program_.uniform("edge");
  corner_location_ = program_.uniform("corner");
}

OverlayPass::~OverlayPass() {
  glDeleteBuffers(1, &instances_);
  glDeleteVertexArrays(1, &vertex_array_);
}

// Adds the instance once for each rectangle of the damage that it may touch.
void OverlayPass::add(const Instance& instance, const Target& target) {
  const auto add_part = [&](const Rect& part) {
    const auto& [from, to, half_width, color] = instance;
    instance_data_.insert(instance_data_.end(), {from.x, from.y, to.x, to.y, half_width, color.red, color.green,
                                                 color.blue, part.left, part.top, part.right, part.bottom});
  };
  if (target.damage == nullptr || target.damage->is_all()) return add_part({});
  const float pixels_per_unit = static_cast<float>(target.edge) / target.units;
  const auto x = static_cast<float>(target.damage_left), y = static_cast<float>(target.damage_top);
  const float margin = instance.half_width < 0.0F ? 0.0F : instance.half_width * pixels_per_unit + 1.0F;
  const auto [left, right] = std::minmax(instance.from.x, instance.to.x);
  const auto [top, bottom] = std::minmax(instance.from.y, instance.to.y);
  const Rect box = grown({left * pixels_per_unit - x, top * pixels_per_unit - y, right * pixels_per_unit - x,
                          bottom * pixels_per_unit - y},
                         margin);
  target.damage->visit(
      box, [&](const Rect& part) { add_part({part.left + x, part.top + y, part.right + x, part.bottom + y}); });
}

void OverlayPass::add_strokes(std::span<const Segment> segments, const ColorScheme& colors, bool halo,
                              const Target& target) {
  for (const Segment& segment : segments) {
    if (halo && segment.halo <= 0.0F) continue;
    add({segment.from, segment.to, segment.width / 2.0F + (halo ? segment.halo : 0.0F),
         halo ? colors.ground : colors.of(segment.ink)},
        target);
  }
}

void OverlayPass::flush(const Target& target) {
  glViewport(target.left, target.bottom, target.edge, target.edge);
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, instances_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instance_data_.size() * sizeof(float)), instance_data_.data(),
               GL_STREAM_DRAW);
  program_.use();
  const auto edge = static_cast<float>(target.edge);
  glUniform1f(scale_location_, edge / target.units);
  glUniform1f(edge_location_, edge);
  glUniform2f(corner_location_, static_cast<float>(target.left), static_cast<float>(target.bottom + target.edge));
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(instance_data_.size() / kFloatsPerInstance));
}

void OverlayPass::draw(const DrawList& list, const ColorScheme& colors, const std::array<float, 256>& light,
                       const Target& target) {
  // Instances are drawn in order: panels, steps of the gray scale, then the layers from bottom to top.
  instance_data_.clear();
  const auto add_rectangle = [&](const Rect& rect, const Color& color) {
    add({{rect.left, rect.top}, {rect.right, rect.bottom}, kRectangle, color}, target);
  };
  for (const Panel& panel : list.panels()) add_rectangle(panel.rect, panel.color);
  for (const VideoStep& step : list.video_steps()) add_rectangle(step.rect, scaled(colors.video, light[step.video]));
  for (std::size_t layer = 0; layer < kLayers; ++layer) {
    const LayerContent& content = list.content(static_cast<Layer>(layer));
    for (const Rect& plate : content.plates) add_rectangle(plate, colors.ground);
    add_strokes(content.strokes, colors, true, target);
    add_strokes(content.strokes, colors, false, target);
  }
  if (!instance_data_.empty()) flush(target);
}

void PanelPass::draw(const DrawList& list, const ColorScheme& colors, const OverlayPass::Target& target) {
  overlay_.draw(list, colors, {}, target);
}

}  // namespace yars::display::gl
