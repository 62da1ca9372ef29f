// Draws a DrawList over the video: video steps, grid, plates, and symbols with their halo. Strokes have round ends
// and edges a pixel soft, from the distance to the segment; so they are crisp at any size of the glass.
// Needs a current context for its lifetime.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "display/color_scheme.hpp"
#include "display/draw_list.hpp"
#include "display/gl/shader_program.hpp"

namespace yars::display::gl {

class OverlayPass {
 public:
  OverlayPass();
  ~OverlayPass();
  OverlayPass(const OverlayPass&) = delete;
  OverlayPass& operator=(const OverlayPass&) = delete;

  // `light`: of the video, for the gray scale. `pixels_per_unit`: size of the glass in pixels / 480.
  void draw(const DrawList& list, const ColorScheme& colors, const std::array<float, 256>& light,
            float pixels_per_unit);

 private:
  void add_rectangle(const Rect& rect, const Color& color);
  void add_strokes(std::span<const Segment> segments, const ColorScheme& colors, bool halo);
  void flush(float pixels_per_unit);

  ShaderProgram program_;
  std::uint32_t vertex_array_ = 0, instances_ = 0;
  int scale_location_ = 0;
  std::vector<float> instance_data_;
};

}  // namespace yars::display::gl
