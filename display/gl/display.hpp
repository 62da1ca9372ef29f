// The radar display in OpenGL: stored sweeps and maps, drawn with the symbology when something visible has changed.
// Inputs: sweeps, patch maps, DisplayInput.
// Outputs: a square picture in an own framebuffer, read back as RGB or drawn into the current framebuffer.
// Units: sizes in pixels.
// Threads: needs a current context (context.hpp) for its lifetime.
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
  // `size`: edge of the square [pixels]. The colors are those of the configuration unless given.
  Display(const radar::RadarConfiguration& configuration, int size);
  Display(const radar::RadarConfiguration& configuration, int size, const ColorScheme& colors);
  ~Display();
  Display(Display&&) noexcept;
  Display& operator=(Display&&) noexcept;

  void add(const databuffer::Sweep& sweep);
  // Adds a patch map. It is kept while the radar state names it as newest, old or stored map.
  void add(const databuffer::PatchMap& map, std::span<const std::uint8_t> pixels);
  void resize(int size);
  int size() const;

  // True when the picture was drawn again. False when it already shows this input.
  bool draw(const DisplayInput& input);

  imageio::Image read() const;  // RGB
  const Framebuffer& picture() const;
  // Copies the picture, pixel by pixel, into the current framebuffer. `left`, `bottom`: its lower left corner [pixels].
  void show(int left, int bottom);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace yars::display::gl
