// Render passes of a picture (stored sweeps, patch map, draw list) and of its surround (bezel, tooltip, notice).
// Inputs: PolarStore and wedges, pixels of patch maps, DrawList, light table (light 0..1 of each video level); for the
//   surround a draw list in panel units (display/symbology/bezel.hpp).
// Outputs: draws into the current framebuffer.
// Units: sizes in pixels, positions in display units (draw_list.hpp).
// Threads: objects need a current OpenGL context for their lifetime.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "display/gl/damage.hpp"
#include "display/gl/gpu_objects.hpp"
#include "display/symbology/draw_list.hpp"
#include "display/symbology/plan_view.hpp"
#include "display/symbology/radar_video.hpp"

namespace yars::display::gl {

// Draws the stored sweeps. Each sweep is a wedge (sector of ground), drawn as a narrow quadrangle. A pixel shows the
// video at the pixel's distance from the wedge's apex. Video is interpolated linearly along the range.
class VideoPass {
 public:
  // [units] Each wedge is drawn wider by kMargin on either side, so that no gap is visible between adjacent wedges.
  // A gap arises because the apex of a wedge is the aircraft's position, and the aircraft moves between two sweeps.
  // The gap is 0.22 display units in a Doppler beam sharpened scan at 4.7 NM range and 250 m/s ground speed.
  // In the overlap the newer wedge is on top. A margin larger than needed would visibly widen the newest wedges.
  static constexpr float kMargin = 0.25F;

  VideoPass();
  ~VideoPass();
  VideoPass(const VideoPass&) = delete;
  VideoPass& operator=(const VideoPass&) = delete;

  // `share`: of the display in the height of the viewport, from the lower edge.
  void draw(const PolarStore& store, std::span<const Wedge> wedges, const LightTexture& light, const Color& color,
            float share = 1.0F);

 private:
  void upload_new_rows(const PolarStore& store, std::span<const Wedge> wedges);

  ShaderProgram program_;
  std::uint32_t vertex_array_ = 0, instances_ = 0;
  std::uint32_t video_texture_ = 0;
  int color_location_ = 0, share_location_ = 0;
  std::vector<std::uint64_t> uploaded_serial_;  // serial of the sweep in each row; 0: none
  std::vector<float> instance_data_;
};

// Draws a patch map over the whole display, with the same light table as sweeps. Maps are kept as textures, so a change
// between stored maps needs no upload.
class MapPass {
 public:
  MapPass();
  ~MapPass();
  MapPass(const MapPass&) = delete;
  MapPass& operator=(const MapPass&) = delete;

  // `pixels`: video levels, size x size, row 0 at the top. Ignored: id 0, size 0, too few pixels, an
  // id that is already stored.
  void add(std::uint64_t id, std::uint32_t size, std::span<const std::uint8_t> pixels);
  // Deletes all maps with other ids.
  void keep(std::span<const std::uint64_t> ids);
  bool has(std::uint64_t id) const;

  // Draws nothing if the id is not stored. `display_size`: edge of the display [pixels].
  void draw(std::uint64_t id, const LightTexture& light, const Color& color, int display_size);

 private:
  struct StoredMap {
    std::uint64_t id = 0;
    std::uint32_t texture = 0;
    int size = 0;
    bool averaged = false;  // the texture has mipmap levels, for a display smaller than the map
  };
  static void bind(StoredMap& map, int display_size);

  ShaderProgram program_;
  std::uint32_t vertex_array_ = 0;
  int color_location_ = 0;
  std::vector<StoredMap> maps_;
};

// Draws a DrawList over the video: panels, the gray scale, then the layers. A layer has plates (black rectangles),
// halos (black margins of strokes) and strokes. Strokes have round ends. Edges of strokes and halos are antialiased
// over one pixel at any display size: the alpha of a pixel depends on its distance from the stroke's centre line.
class OverlayPass {
 public:
  OverlayPass();
  ~OverlayPass();
  OverlayPass(const OverlayPass&) = delete;
  OverlayPass& operator=(const OverlayPass&) = delete;

  // Square of the current framebuffer, and the part of it to draw.
  struct Target {
    int left = 0, bottom = 0, edge = 0;   // [pixels] from the framebuffer's lower left corner
    float units = kDisplayUnits;          // edge of the square
    const Damage* damage = nullptr;       // nullptr: the whole square
    int damage_left = 0, damage_top = 0;  // [pixels] position of the damage, from the square's upper left corner
  };
  // `light`: light table of the video, for the gray scale.
  void draw(const DrawList& list, const ColorScheme& colors, const std::array<float, 256>& light, const Target& target);

 private:
  // A filled rectangle, or a stroke with its halo [units].
  struct Instance {
    Point from, to;
    float half_width = 0.0F;
    Color color;
  };
  void add(const Instance& instance, const Target& target);
  void add_strokes(std::span<const Segment> segments, const ColorScheme& colors, bool halo, const Target& target);
  void flush(const Target& target);

  ShaderProgram program_;
  std::uint32_t vertex_array_ = 0, instances_ = 0;
  int scale_location_ = 0, edge_location_ = 0, corner_location_ = 0;
  std::vector<float> instance_data_;
};

class PanelPass {
 public:
  // Draws the list into the target, over what is there.
  void draw(const DrawList& list, const ColorScheme& colors, const OverlayPass::Target& target);

 private:
  OverlayPass overlay_;
};

}  // namespace yars::display::gl
