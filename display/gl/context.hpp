// OpenGL 3.3 contexts: what each promises, one without a display (EGL), one in a window (GLFW).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "databuffer/messages/key_map.hpp"
#include "display/symbology/draw_list.hpp"
#include "lib/error/error.hpp"

namespace yars::display::gl {

// An OpenGL 3.3 core context that is current for its lifetime on the thread that made it.
class Context {
 public:
  virtual ~Context() = default;
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

// 33 = 3.3, of what is current on this thread; 0: nothing is, or OpenGL ES.
int opengl_version();

// What draws: "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6".
std::string renderer_name();

// A context without a display: EGL on Mesa's surfaceless platform, else on the default display with a pixel buffer
// of one pixel. Pictures go to a framebuffer object and are read back.
error::Expected<std::unique_ptr<Context>> open_headless();

// A window with the glass in it: a context, the keyboard, and clicks in glass units.
struct KeyEdge {
  databuffer::Key key = databuffer::Key::none;
  bool pressed = false;
};

// What happened at the window since the last look.
struct WindowInput {
  std::vector<KeyEdge> keys;
  std::vector<Point> clicks;
  bool focus_lost = false;
  bool redraw_needed = false;  // uncovered or resized
};

class Window : public Context {
 public:
  struct Pixels {
    int width = 0, height = 0;
  };
  virtual Pixels pixels() const = 0;  // of the framebuffer
  virtual bool should_close() const = 0;
  // Waits for events up to so long [s]; returns at once when there are any.
  virtual WindowInput take_input(double longest_wait_s) = 0;
  virtual void clear() = 0;    // black, all of it; the window is what is drawn on from here
  virtual void present() = 0;  // shows what has been drawn; does not wait for the screen
};

// `size`: edge of the window. Without DISPLAY or WAYLAND_DISPLAY the error says to go headless.
error::Expected<std::unique_ptr<Window>> open_window(const std::string& title, int size);

}  // namespace yars::display::gl
