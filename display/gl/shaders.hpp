// Shader programs and the textures that they sample.
#pragma once

#include <array>
#include <cstdint>

namespace yars::display::gl {

// Textures that hold video or light: one value a texel, smooth between them, no wrap at the edges.

// Bound when it returns; rows of bytes without padding can be uploaded. Needs a current context.
std::uint32_t new_texture();

// The table from video to light on the graphics processor, one for all that draws video.
// Needs a current context for its lifetime.
class LightTexture {
 public:
  LightTexture();
  ~LightTexture();
  LightTexture(const LightTexture&) = delete;
  LightTexture& operator=(const LightTexture&) = delete;

  void set(const std::array<float, 256>& light);  // [video] -> light
  void bind(int unit) const;                      // as a texture 256 wide, 1 high

 private:
  std::uint32_t texture_ = 0;
};

// A linked pair of shaders. A shader that does not compile is our bug: it ends the process with the driver's words.
class ShaderProgram {
 public:
  ShaderProgram(const char* name, const char* vertex_source, const char* fragment_source);
  ~ShaderProgram();
  ShaderProgram(const ShaderProgram&) = delete;
  ShaderProgram& operator=(const ShaderProgram&) = delete;

  void use() const;
  int uniform(const char* name) const;  // location

 private:
  std::uint32_t program_ = 0;
};

}  // namespace yars::display::gl
