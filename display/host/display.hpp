// The glass for a program of one's own: takes part in a session and draws the radar's picture into the OpenGL context
// that the program has made current, which has to be 3.3 core or later. Every function but press and click needs that
// context, destruction too, and leaves its state as it was (the list: display/gl/plain_state.hpp). Nothing waits but
// attach and read. One thread at a time for each glass; a program may have several. Link the target yars_display.
//
//   auto glass = yars::display::host::Display::attach({.session = "default"});
//   each frame of the host:   glass->update();   ...   glass->draw({left, bottom, 600, 600});
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "display/gl/framebuffer.hpp"
#include "lib/error/error.hpp"
#include "lib/imageio/png.hpp"

namespace yars::databuffer {
class Session;
}
namespace yars::radar {
struct RadarConfiguration;
}

namespace yars::display::host {

inline constexpr int kMaxPixels = 4096;  // to the edge of the glass

// In pixels of the current framebuffer, from its lower left corner, as for glViewport.
struct Viewport {
  int left = 0, bottom = 0, width = 0, height = 0;
};

struct Place {
  std::string session = "default";  // made when it does not run yet
  std::string configuration;        // path of the set's GUF file; empty = the built-in APG-70
  std::string name = "host glass";  // what `yars status` calls this program
};

class Display {
 public:
  // Errors: no such configuration, another user's or another build's session, OpenGL older than 3.3.
  static error::Expected<Display> attach(const Place& place);
  // For a program that takes part already; the session outlives the glass. In lockstep, time is that of update().
  Display(databuffer::Session& session, const radar::RadarConfiguration& configuration, bool lockstep);
  Display(Display&&) noexcept;
  Display& operator=(Display&&) noexcept;
  ~Display();

  // Takes over what is new in the session. Call it at least once a second, drawn or not: who is silent longer counts as
  // hung, and after 5 s sweeps are lost.
  void update();
  void update(std::int64_t sim_time_ns);  // as of this time

  // Brings the picture up to date, `size` pixels to its edge; true when it is another one than before. Only for who
  // wants to know: draw() does it.
  bool paint(int size);
  // Draws the glass as the largest square in the middle of the viewport; what is beside it stays untouched.
  void draw(const Viewport& viewport);
  // Tells the session that what has been drawn is visible: others measure how long a button takes.
  void note_shown();

  // The picture as it was painted last: RGB, at once, waiting for the graphics processor.
  imageio::Image read() const;
  // The same with its time, without waiting: a copy is ordered (false: two are under way), and taken when it is there
  // (false: not yet, or none is under way).
  bool start_reading();
  bool take_read(Picture& picture);
  bool wait_for_read(Picture& picture);

  // What the pilot does on the glass goes to the set: a button 1..20; or a touch at fractions of the glass's edge from
  // its upper left corner, false when no button's legend is there. Error: all input lanes of the session are taken.
  error::Expected<void> press(int button);
  error::Expected<bool> click(double right, double down);

 private:
  struct State;
  explicit Display(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace yars::display::host
