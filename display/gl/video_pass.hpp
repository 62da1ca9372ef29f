// Draws the stored sweeps: each wedge a narrow quadrangle, each pixel in it the video at its distance from the wedge's
// own apex, through the table of light. Video between two samples is interpolated along the range. Needs a current
// context for its lifetime.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "display/color_scheme.hpp"
#include "display/gl/light_texture.hpp"
#include "display/gl/shader_program.hpp"
#include "display/polar_store.hpp"
#include "display/wedge.hpp"

namespace yars::display::gl {

class VideoPass {
 public:
  VideoPass();
  ~VideoPass();
  VideoPass(const VideoPass&) = delete;
  VideoPass& operator=(const VideoPass&) = delete;

  void draw(const PolarStore& store, std::span<const Wedge> wedges, const LightTexture& light, const Color& color);

 private:
  void upload_new_rows(const PolarStore& store, std::span<const Wedge> wedges);

  ShaderProgram program_;
  std::uint32_t vertex_array_ = 0, instances_ = 0;
  std::uint32_t video_texture_ = 0;
  int color_location_ = 0;
  std::vector<std::uint64_t> uploaded_serial_;  // by row; 0 = nothing
  std::vector<float> instance_data_;
};

}  // namespace yars::display::gl
