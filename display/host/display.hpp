// Radar display in an OpenGL context: joins a session and draws. Programs of others use display/library.
// Inputs: a session, a current context of OpenGL 3.3 core or later, a viewport [pixels].
// Outputs: the picture in the viewport, or read back; button presses as input events of the session.
// Context: the OpenGL context must be current in all functions except press and click, also in constructor and
//   destructor. The functions restore the OpenGL state listed in display/gl/host_state_guard.hpp.
// Waits: only attach, read and wait_for_read may wait.
// Threads: one thread at a time for each Display. A program may have several Displays.
//
//   auto mpd = yars::display::host::Display::attach({.session = "default"});
//   each frame of the host:   mpd->update();   ...   mpd->draw({left, bottom, 600, 600});
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "display/gl/gpu_objects.hpp"
#include "display/symbology/plan_view.hpp"
#include "lib/error/error.hpp"
#include "lib/imageio/png.hpp"

namespace yars::databuffer {
class Session;
}
namespace yars::radar {
struct RadarConfiguration;
}

namespace yars::display::host {

inline constexpr int kMaxPixels = 4096;  // [pixels] maximum edge of the display; larger sizes are clamped

// Rectangle of the current framebuffer [pixels], from its lower left corner, as in glViewport.
struct Viewport {
  int left = 0, bottom = 0, width = 0, height = 0;
  friend bool operator==(const Viewport&, const Viewport&) = default;
};

// What surrounds the picture: the MPD's bezel, a tooltip, a line of text.
struct PanelView {
  bool bezel = true;
  int lit = 0;           // button that is drawn brighter, 1..20; 0: none
  int tooltip = 0;       // button whose tooltip is shown, 1..20; 0: none
  std::string notice{};  // line of text in the upper part of the picture; empty: none
  friend bool operator==(const PanelView&, const PanelView&) = default;
};

struct AttachOptions {
  std::string session = "default";    // created if it does not exist
  std::string configuration;          // path of the radar's GUF file; empty = the built-in APG-70
  std::string name = "host display";  // name of this program in `yars status`
};

class Display {
 public:
  // Errors: no current context, or OpenGL older than 3.3; an unreadable or invalid configuration; a session of another
  // user or another build.
  static error::Expected<Display> attach(const AttachOptions& options);
  // For a program with an open session, which must outlive the display. The picture names state-machine or radar-model
  // as missing if that program is not alive. In a live session, alive means a heartbeat less than 1 s old. In lockstep,
  // alive means that the program takes part in the run, so that the picture does not depend on real time.
  Display(databuffer::Session& session, const radar::RadarConfiguration& configuration, bool lockstep);
  Display(Display&&) noexcept;
  Display& operator=(Display&&) noexcept;
  ~Display();

  // Copies new records from the session and updates this program's heartbeat. Call update at least once per second,
  // even while nothing is drawn. The session keeps sweeps for about 5 s; a longer pause between calls loses sweeps.
  void update();
  void update(std::int64_t sim_time_ns);  // uses this simulation time instead of the session's

  // Updates the picture. `size`: edge [pixels]. Returns true if the picture has changed. draw() also calls paint().
  bool paint(int size);
  // Draws the display as the largest square in the middle of the viewport, with an edge of at most kMaxPixels. Pixels
  // outside the square are unchanged. True: the picture has changed.
  bool draw(const Viewport& viewport);
  // The picture with its surround, drawn as the largest square in the middle of the viewport. paint_panel() updates the
  // picture and the surround for a square with this edge [pixels]; true: something has changed. read_panel() paints and
  // reads it as RGB.
  bool paint_panel(const PanelView& view, int edge);
  bool draw_panel(const PanelView& view, const Viewport& viewport);  // true: something has changed
  // draw_panel() for a framebuffer that still shows what the last draw_panel() or refresh_panel() has drawn: draws only
  // what has changed. Returns the changed rectangle of the framebuffer; width 0: nothing has changed.
  Viewport refresh_panel(const PanelView& view, const Viewport& viewport);
  imageio::Image read_panel(const PanelView& view, int edge);
  // On, as at first in a live session: new sweeps are drawn into the kept video (gl::Display::keep_video), whose
  // displacement is below half a pixel. Off, as at first in lockstep: a picture depends on its sweeps and tick alone.
  void keep_video(bool on);
  // Covers the picture with the help: each button with its key and what it does now, the other keys. Off at first.
  void show_help(bool on);
  // Makes states without a picture say how to get back, and OFF how to switch on. Off at first: a cockpit's display is
  // dark while the radar is OFF.
  void show_hints(bool on);
  // What a button 1..20 does now, or why it is dead and the remedy: "longer range: 80 NM".
  std::string describe(int button) const;
  // The records that the picture shows.
  const DisplayInput& input() const;

  // Reports to the session that the last update is visible, for measurements of button latency.
  void note_shown();

  // The last painted picture as RGB. Waits for the GPU.
  imageio::Image read() const;
  // Asynchronous readback of the picture with its time (Readback in display/gl/gpu_objects.hpp).
  // start_reading returns false if two copies are pending. take_read returns false if no copy is ready or the driver
  // failed. wait_for_read waits for a pending copy, at most 10 s; false: none was pending, or the driver failed.
  bool start_reading();
  bool take_read(Picture& picture);
  bool wait_for_read(Picture& picture);

  // Pilot inputs, sent to the session. press: a button 1..20. click: a position as fractions of the display's edge,
  // from the upper left corner; returns false if the position is in no button's click zone. Errors: a button out of
  // range; no free input lane.
  error::Expected<void> press(int button);
  error::Expected<bool> click(double right, double down);

 private:
  struct State;
  explicit Display(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace yars::display::host
