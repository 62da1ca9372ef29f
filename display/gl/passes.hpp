// The passes that make a picture: the stored sweeps or a patch map, and the draw list over them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "display/gl/shaders.hpp"
#include "display/symbology/draw_list.hpp"
#include "display/symbology/plan_view.hpp"
#include "display/symbology/radar_video.hpp"

namespace yars::display::gl {

// Draws the stored sweeps: each wedge a narrow quadrangle, each pixel in it the video at its distance from the wedge's
// own apex, through the table of light. Video between two samples is interpolated along the range. Needs a current
// context for its lifetime.
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

// Draws a patch map over the whole glass, through the table of light that the sweeps go through. Maps are kept as
// textures by their id, so that a flip to another one uploads nothing.
// Needs a current context for its lifetime.
class MapPass {
 public:
  MapPass();
  ~MapPass();
  MapPass(const MapPass&) = delete;
  MapPass& operator=(const MapPass&) = delete;

  // `pixels`: size x size, row 0 at the top of the glass. An id that is here already is left as it is.
  void add(std::uint64_t id, std::uint32_t size, std::span<const std::uint8_t> pixels);
  // Lets go of all maps but these.
  void keep(std::span<const std::uint64_t> ids);
  bool has(std::uint64_t id) const;

  // `glass_size`: pixels to the edge of what is drawn on.
  void draw(std::uint64_t id, const LightTexture& light, const Color& color, int glass_size);

 private:
  struct Kept {
    std::uint64_t id = 0;
    std::uint32_t texture = 0;
    int size = 0;
    bool averaged = false;  // has its levels for a coarser glass
  };
  static void bind(Kept& map, int glass_size);

  ShaderProgram program_;
  std::uint32_t vertex_array_ = 0;
  int color_location_ = 0;
  std::vector<Kept> maps_;
};

// Draws a DrawList over the video: video steps, grid, plates, and symbols with their halo. Strokes have round ends
// and edges a pixel soft, from the distance to the segment; so they are crisp at any size of the glass.
// Needs a current context for its lifetime.
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
