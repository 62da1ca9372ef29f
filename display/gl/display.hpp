// Radar display in OpenGL: stores sweeps and patch maps, and draws them with the symbology.
// Inputs: sweeps, patch maps, DisplayInput.
// Outputs: a square picture in a framebuffer object (render target in GPU memory) that Display owns. The picture can be
// read back as RGB, or copied to the current framebuffer.
// Units: sizes in pixels.
// Threads: an OpenGL context (context.hpp) must be current for the lifetime of an object.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "databuffer/messages/model_records.hpp"
#include "display/gl/damage.hpp"
#include "display/gl/gpu_objects.hpp"
#include "display/symbology/draw_list.hpp"
#include "display/symbology/plan_view.hpp"
#include "display/symbology/symbology.hpp"
#include "lib/imageio/png.hpp"

namespace yars::display::gl {

class Display {
 public:
  // `size`: side of the square [pixels]. Without `colors`, the configuration's color scheme is used.
  Display(const SymbologyParameters& parameters, int size);
  Display(const SymbologyParameters& parameters, int size, const ColorScheme& colors);
  ~Display();
  Display(Display&&) noexcept;
  Display& operator=(Display&&) noexcept;

  void add(const databuffer::Sweep& sweep);  // stores a sweep
  // Stores a patch map. draw() drops a map that the radar state no longer names as newest, old or stored map.
  void add(const databuffer::PatchMap& map, std::span<const std::uint8_t> pixels);
  void resize(int size);
  int size() const;

  // On, as at first: new sweeps are drawn into the video of the last picture, which is scrolled by whole pixels as the
  // aircraft flies. The video is displaced by at most half a pixel along the flight and as much across. All sweeps are
  // drawn again when it would be more, as in a turn; when sweeps vanish that no newer sweep replaces; and after
  // newer sweeps replaced others, at the end of the scan or after a second (60 pictures). Off: each picture with new
  // sweeps is drawn from all sweeps.
  void keep_video(bool on);

  // Draws the parts of the picture that have changed. Returns false, without drawing, if a new picture would not differ
  // visibly from the present one.
  bool draw(const DisplayInput& input);
  // The parts that the last draw() has drawn; empty if it returned false.
  const Damage& damage() const;

  imageio::Image read() const;  // RGB
  const Framebuffer& picture() const;
  // Copies the picture unscaled into the current framebuffer. `left`, `bottom`: lower left corner of the copy [pixels].
  void show(int left, int bottom);
  void show(int left, int bottom, std::span<const Rect> parts);  // from the picture's upper left corner [pixels]

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace yars::display::gl
