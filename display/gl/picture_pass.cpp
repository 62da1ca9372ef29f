#include "display/gl/picture_pass.hpp"

#include <epoxy/gl.h>

namespace yars::display::gl {

namespace {

constexpr const char* kPictureVertex = R"(#version 330 core
void main() {
  vec2 place = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(place * 2.0 - 1.0, 0.0, 1.0);
}
)";

// By texel: a filter or a rounded place could mix two pixels. A blit would do the same, but not into every framebuffer.
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
  glGenVertexArrays(1, &vertex_array_);
  program_.use();
  glUniform1i(program_.uniform("picture"), 0);
  corner_location_ = program_.uniform("corner");
}

PicturePass::~PicturePass() {
  glDeleteVertexArrays(1, &vertex_array_);
}

void PicturePass::draw(const Framebuffer& picture, int left, int bottom) {
  glViewport(left, bottom, picture.size(), picture.size());
  glBindVertexArray(vertex_array_);
  glActiveTexture(GL_TEXTURE0);
  picture.bind_texture();
  program_.use();
  glUniform2i(corner_location_, left, bottom);
  glDisable(GL_BLEND);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace yars::display::gl
