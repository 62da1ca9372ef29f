// Shader programs, and textures for video and for the light table (light 0..1 of each 8-bit video level).
// Errors: a shader that does not compile or link ends the process with the driver's log.
// Threads: all functions need a current OpenGL context; objects need it for their lifetime.
#pragma once

#include <array>
#include <cstdint>

namespace yars::display::gl {

// Makes and binds a 2D texture with linear filter and clamped edges, and sets the unpack alignment to 1 byte.
std::uint32_t new_texture();

// Light table of the video as a texture, shared by all passes that draw video.
class LightTexture {
 public:
  LightTexture();
  ~LightTexture();
  LightTexture(const LightTexture&) = delete;
  LightTexture& operator=(const LightTexture&) = delete;

  void set(const std::array<float, 256>& light);  // index: video level
  void bind(int unit) const;                      // binds the texture, 256 texels wide, 1 high

 private:
  std::uint32_t texture_ = 0;
};

class ShaderProgram {
 public:
  ShaderProgram(const char* name, const char* vertex_source, const char* fragment_source);
  ~ShaderProgram();
  ShaderProgram(const ShaderProgram&) = delete;
  ShaderProgram& operator=(const ShaderProgram&) = delete;

  void use() const;
  int uniform(const char* name) const;  // location of a uniform variable

 private:
  std::uint32_t program_ = 0;
};

}  // namespace yars::display::gl
