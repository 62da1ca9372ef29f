// Draws a patch map over the whole glass, through the table of light that the sweeps go through. Maps are kept as
// textures by their id, so that a flip to another one uploads nothing.
// Needs a current context for its lifetime.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "display/color_scheme.hpp"
#include "display/gl/light_texture.hpp"
#include "display/gl/shader_program.hpp"

namespace yars::display::gl {

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

}  // namespace yars::display::gl
