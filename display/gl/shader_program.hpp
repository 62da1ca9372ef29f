// A linked pair of shaders. A shader that does not compile is our bug: it ends the process with the driver's words.
#pragma once

#include <cstdint>

namespace yars::display::gl {

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
