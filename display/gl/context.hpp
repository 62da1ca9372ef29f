// OpenGL 3.3 core contexts: headless (EGL), and a window with keyboard and mouse clicks (GLFW).
// Errors: a missing library, display or OpenGL version is returned as an Expected.
// Threads: a context is current on the thread that made it, for its lifetime.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "databuffer/messages/key_map.hpp"
#include "display/symbology/draw_list.hpp"
#include "lib/error/error.hpp"

namespace yars::display::gl {

// An OpenGL 3.3 core context.
class Context {
 public:
  virtual ~Context() = default;
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

// Version of the current context of this thread: 33 = 3.3. 0: no context, or OpenGL ES.
int opengl_version();

// Renderer and version of the current context: "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6".
std::string renderer_name();

// A context without a screen: EGL on Mesa's surfaceless platform, else on the default display. A driver without
// surfaceless contexts gets a pixel buffer of one pixel. Pictures are drawn to a framebuffer object and read back.
error::Expected<std::unique_ptr<Context>> open_headless();

// A key pressed or released.
struct KeyEdge {
  databuffer::Key key = databuffer::Key::none;
  bool pressed = false;
};

// Events of the window since the last call of take_input. Clicks are in display units.
struct WindowInput {
  std::vector<KeyEdge> keys;
  std::vector<Point> clicks;
  bool focus_lost = false;
  bool redraw_needed = false;  // uncovered or resized
};

// A window with the display as the largest square in its middle.
class Window : public Context {
 public:
  struct Pixels {
    int width = 0, height = 0;
  };
  virtual Pixels pixels() const = 0;  // of the framebuffer
  virtual bool should_close() const = 0;
  // Waits at most `max_wait_s` for events. Returns immediately when there are any.
  virtual WindowInput take_input(double max_wait_s) = 0;
  virtual void clear() = 0;    // binds the window's framebuffer and clears it to black
  virtual void present() = 0;  // swaps buffers, without waiting for the screen
};

// `size`: edge of the window [GLFW screen coordinates]. Without DISPLAY and WAYLAND_DISPLAY the error names the
// headless options.
error::Expected<std::unique_ptr<Window>> open_window(const std::string& title, int size);

}  // namespace yars::display::gl
