// The glass: keeps the sweeps and the maps, and draws them with the symbols when something that shows has changed.
// Draws into a picture of its own, which is then read back or drawn where the current framebuffer wants it.
// Needs a current context (context.hpp) for its lifetime; knows nothing of the session.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "databuffer/messages/model_records.hpp"
#include "display/gl/framebuffer.hpp"
#include "display/symbology/draw_list.hpp"
#include "display/symbology/plan_view.hpp"
#include "lib/imageio/png.hpp"
#include "lib/radar/configuration.hpp"

namespace yars::display::gl {

class Display {
 public:
  // `size`: pixels to the edge of the square.
  Display(const radar::RadarConfiguration& configuration, int size);  // in the colors of the configuration
  Display(const radar::RadarConfiguration& configuration, int size, const ColorScheme& colors);
  ~Display();
  Display(Display&&) noexcept;
  Display& operator=(Display&&) noexcept;

  void add(const databuffer::Sweep& sweep);
  // A map that the radar state names; it is kept as long as it is named.
  void add(const databuffer::PatchMap& map, std::span<const std::uint8_t> pixels);
  void resize(int size);
  int size() const;

  // True when it drew; false when the picture already shows this input.
  bool draw(const DisplayInput& input);

  imageio::Image read() const;  // RGB
  const Framebuffer& picture() const;
  // Draws the picture, pixel by pixel, into the current framebuffer with its lower left corner there.
  void show(int left, int bottom);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace yars::display::gl
