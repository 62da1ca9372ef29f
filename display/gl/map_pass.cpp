#include "display/gl/map_pass.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>

#include "display/gl/texture.hpp"

namespace yars::display::gl {

namespace {

constexpr const char* kMapVertex = R"(#version 330 core
out vec2 place;  // 0..1 from the upper left
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(place.x * 2.0 - 1.0, 1.0 - place.y * 2.0, 0.0, 1.0);
}
)";

constexpr const char* kMapFragment = R"(#version 330 core
in vec2 place;
uniform sampler2D map;
uniform sampler2D light;
uniform vec3 color;
out vec4 fragment;
void main() {
  float level = texture(map, place).r;
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
  std::erase_if(maps_, [ids](const Kept& map) {
    if (std::ranges::find(ids, map.id) != ids.end()) return false;
    glDeleteTextures(1, &map.texture);
    return true;
  });
}

bool MapPass::has(std::uint64_t id) const {
  return std::ranges::find(maps_, id, &Kept::id) != maps_.end();
}

// A map finer than the glass is averaged down by the mean of its pixels, or speckle would turn into sparkle. A software
// renderer takes a while to make the levels: only then.
void MapPass::bind(Kept& map, int glass_size) {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, map.texture);
  if (map.averaged || map.size <= glass_size) return;
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  map.averaged = true;
}

void MapPass::draw(std::uint64_t id, const LightTexture& light, const Color& color, int glass_size) {
  const auto map = std::ranges::find(maps_, id, &Kept::id);
  if (map == maps_.end()) return;
  glBindVertexArray(vertex_array_);
  light.bind(1);
  bind(*map, glass_size);
  program_.use();
  glUniform3f(color_location_, color.red, color.green, color.blue);
  glDisable(GL_BLEND);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace yars::display::gl
