// OpenGL 3.3 core contexts: headless by the library EGL, and a window with keyboard and mouse clicks by the library
// GLFW.
// Errors: a missing library, a missing display, or OpenGL older than 3.3.
// Threads: a context is current on the thread that created it, until its owner object is destroyed.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "databuffer/messages/key_map.hpp"
#include "display/symbology/draw_list.hpp"
#include "lib/error/error.hpp"

namespace yars::display::gl {

// Owner of an OpenGL context: the state and the objects with which a thread draws.
class Context {
 public:
  virtual ~Context() = default;
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

// OpenGL version of this thread's current context as MAJOR * 10 + MINOR: 33 for 3.3. 0 without a context and for
// OpenGL ES.
int opengl_version();

// Renderer and version of the current context, such as
// "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6".
std::string renderer_name();

// Opens a context without a window: EGL on Mesa's surfaceless platform, else on the default EGL display.
// With a driver that requires a surface, the context gets a pixel buffer (pbuffer) of one pixel.
// The caller draws into a framebuffer object, because the context has no window.
error::Expected<std::unique_ptr<Context>> open_headless();

// Press or release of a key.
struct KeyEdge {
  databuffer::Key key = databuffer::Key::none;
  bool pressed = false;
};

// Press or release of a mouse button. `at`: position as fractions of the largest square in the middle of the window,
// from its upper left corner. A position outside the square has a coordinate outside 0..1.
struct MouseEdge {
  bool left = true;  // false: the right button
  bool pressed = false;
  Point at;
};

// Events of the window since the last call of take_input().
struct WindowInput {
  std::vector<KeyEdge> keys;
  std::vector<MouseEdge> mouse;
  bool focus_lost = false;
  bool redraw_needed = false;  // the window was uncovered or resized
};

// Window for the radar display. The display is the largest square in the middle of the window.
class Window : public Context {
 public:
  struct Pixels {
    int width = 0, height = 0;
  };
  virtual Pixels pixels() const = 0;  // size of the framebuffer
  virtual bool should_close() const = 0;
  // Waits at most `max_wait_s` for events. Returns immediately if events are pending.
  virtual WindowInput take_input(double max_wait_s) = 0;
  // Present position of the mouse as in MouseEdge; nullopt while it is outside the window.
  virtual std::optional<Point> mouse() const = 0;
  virtual void show_full_screen(bool on) = 0;  // on the monitor that has most of the window
  virtual bool is_full_screen() const = 0;
  virtual void clear() = 0;    // binds the window's framebuffer and clears it to black
  virtual void present() = 0;  // swaps buffers without waiting for vertical sync
  // True if the framebuffer keeps its content after present() while the window keeps its size, so that the next picture
  // need only be drawn where it has changed.
  virtual bool keeps_framebuffer() const = 0;
};

// Opens a window of the class "yars-radar-display" (WM_CLASS), with an icon. `size`: width and height of the window
// [pixels at a scale of 1]; the scale of the monitor enlarges it. nullopt: two thirds of the height of the primary
// monitor's work area, which is the monitor without panels and docks, and at most `max_size`.
// Errors: the environment has neither DISPLAY nor WAYLAND_DISPLAY, or no window with OpenGL 3.3 can be opened. The
// error names the options with which radar-display needs no window.
error::Expected<std::unique_ptr<Window>> open_window(const std::string& title, std::optional<int> size, int max_size);

}  // namespace yars::display::gl
