#include "display/gl/shader_program.hpp"

#include <epoxy/gl.h>

#include <array>
#include <string>

#include "lib/failure/require.hpp"

namespace yars::display::gl {

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
    failure::requirement_broken(name, log.data(), __FILE__, __LINE__);
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
    failure::requirement_broken(name, log.data(), __FILE__, __LINE__);
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

}  // namespace yars::display::gl
