// Display in a window: redraws on change, at most 60 times per second; keys, mouse, tooltips, help, full screen.
// Inputs: keys and mouse of the window; the session's records through host::Display.
// Outputs: the window; input events of the pilot; published frames.
// Source: docs/pilots_manual.md#window
#pragma once

#include <cstdint>
#include <optional>

#include "display/app/frame_output_shell.hpp"
#include "display/gl/context.hpp"
#include "display/host/display.hpp"
#include "display/host/session_link_shell.hpp"
#include "display/symbology/bezel.hpp"

namespace yars::display {

inline constexpr std::int64_t kRedrawInterval_ns = 1'000'000'000 / 60;  // minimum interval between redraws

// Edge of a panel with or without a bezel whose picture has the edge `picture` [pixels].
int panel_edge(int picture, bool bezel);

class WindowDisplay {
 public:
  WindowDisplay(gl::Window& window, host::Display& mpd, PilotInput& pilot, std::optional<FramePublisher> publisher,
                bool bezel);

  // Waits for input until the next redraw is allowed, at most `max_wait_ns`. Sends keys and clicks when they arrive.
  void take_input(std::int64_t max_wait_ns);
  // Updates the display to this time. Redraws the window at most once per kRedrawInterval_ns.
  void step(std::int64_t sim_time_ns);

 private:
  void take_key(const gl::KeyEdge& edge);
  void take_escape();
  void take_mouse(const gl::MouseEdge& edge);
  void follow_mouse(std::int64_t now_ns);
  void say(const std::string& words);
  PanelLayout layout() const { return {view_.bezel ? kBezelBorder : 0.0F}; }
  Point on_panel(Point fractions) const { return {fractions.x * layout().edge(), fractions.y * layout().edge()}; }
  bool redraw(std::int64_t now_ns);
  bool refresh(const host::Viewport& whole);
  bool redraw_all(const host::Viewport& whole, int edge);

  gl::Window& window_;
  host::Display& mpd_;
  PilotInput& pilot_;
  std::optional<FramePublisher> publisher_;
  Mouse mouse_;
  host::PanelView view_;
  bool help_ = false;
  std::int64_t lit_since_ns_ = 0;    // CLOCK_MONOTONIC, since when the mouse is on the lit button
  std::int64_t notice_end_ns_ = 0;   // CLOCK_MONOTONIC
  std::int64_t next_redraw_ns_ = 0;  // CLOCK_MONOTONIC
  bool stale_ = true;                // true: the window does not show the current picture
  host::Viewport shown_;             // the window when all of it was drawn
};

}  // namespace yars::display
