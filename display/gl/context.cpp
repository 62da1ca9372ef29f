#include "display/gl/context.hpp"

#include <GLFW/glfw3.h>
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdio>

namespace yars::display::gl {

namespace {

std::string text_of(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? "?" : reinterpret_cast<const char*>(text);
}

}  // namespace

int opengl_version() {
  const int version = epoxy_gl_version();  // 0 without a context
  return version != 0 && epoxy_is_desktop_gl() ? version : 0;
}

std::string renderer_name() {
  return text_of(GL_RENDERER) + ", " + text_of(GL_VERSION);
}

namespace {

class HeadlessContext final : public Context {
 public:
  HeadlessContext(EGLDisplay display, EGLContext context, EGLSurface surface)
      : display_(display), context_(context), surface_(surface) {}
  // Does not terminate the EGL display. Termination unloads the driver, and the next context would load it again.
  ~HeadlessContext() override {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
    eglDestroyContext(display_, context_);
  }

 private:
  EGLDisplay display_;
  EGLContext context_;
  EGLSurface surface_;
};

constexpr const char* kLibrary = "libEGL.so.1";
constexpr const char* kInstall = "install libegl1 and libgl1-mesa-dri";

error::Expected<std::unique_ptr<Context>> no_context(const char* step) {
  std::array<char, 16> code{};
  std::snprintf(code.data(), code.size(), "0x%04x", static_cast<unsigned>(eglGetError()));
  return error::fail("headless display", "OpenGL 3.3 through EGL", std::string(step) + " failed with " + code.data(),
                     kInstall);
}

// libepoxy ends the program if it cannot open libEGL. Opening libEGL here first gives an error instead.
error::Expected<void> open_library() {
  static const void* const library = dlopen(kLibrary, RTLD_LAZY | RTLD_LOCAL);
  if (library != nullptr) return {};
  const char* why = dlerror();
  return error::fail("headless display", kLibrary, why != nullptr ? why : "a library that cannot be opened", kInstall);
}

EGLDisplay initialized(EGLDisplay display) {
  EGLint major = 0;
  EGLint minor = 0;
  if (display == EGL_NO_DISPLAY || eglInitialize(display, &major, &minor) != EGL_TRUE) return EGL_NO_DISPLAY;
  return display;
}

EGLDisplay open_display() {
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    const EGLDisplay surfaceless =
        initialized(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    if (surfaceless != EGL_NO_DISPLAY) return surfaceless;
  }
  return initialized(eglGetDisplay(EGL_DEFAULT_DISPLAY));
}

}  // namespace

error::Expected<std::unique_ptr<Context>> open_headless() {
  if (const auto library = open_library(); !library) return tl::unexpected(library.error());
  const EGLDisplay display = open_display();
  if (display == EGL_NO_DISPLAY) return no_context("eglInitialize");
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return no_context("eglBindAPI(EGL_OPENGL_API)");

  constexpr std::array<EGLint, 5> kConfig{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                          EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (eglChooseConfig(display, kConfig.data(), &config, 1, &configs) != EGL_TRUE || configs == 0) {
    return no_context("eglChooseConfig");
  }
  constexpr std::array<EGLint, 7> kContext{
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, kContext.data());
  if (context == EGL_NO_CONTEXT) return no_context("eglCreateContext");

  // A driver that requires a surface gets a surface of one pixel. Nothing is drawn into that surface.
  EGLSurface surface = EGL_NO_SURFACE;
  if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) {
    constexpr std::array<EGLint, 5> kSurface{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    surface = eglCreatePbufferSurface(display, config, kSurface.data());
  }
  auto owner = std::make_unique<HeadlessContext>(display, context, surface);
  if (eglMakeCurrent(display, surface, surface, context) != EGL_TRUE) return no_context("eglMakeCurrent");
  return owner;
}

}  // namespace yars::display::gl

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "display/gl/window_icon.hpp"

namespace yars::display::gl {

namespace {

// True if the window's framebuffer keeps its content when buffers are swapped, as with Mesa's software renderer on X11.
// The test clears, swaps and reads three times, with three colors that look black. A driver that alternates between two
// or three buffers gives an older color. Only a software renderer is tested. A GPU draws a whole window fast, and its
// driver may change its way of swapping.
bool keeps_content(GLFWwindow* window) {
  const std::string renderer = text_of(GL_RENDERER);
  if (renderer.find("llvmpipe") == std::string::npos && renderer.find("softpipe") == std::string::npos) return false;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  for (int level = 1; level <= 3; ++level) {
    const std::array<float, 4> color{static_cast<float>(level) / 255.0F, 0.0F, 0.0F, 1.0F};
    glClearBufferfv(GL_COLOR, 0, color.data());
    glfwSwapBuffers(window);
    std::array<std::uint8_t, 4> found{};
    glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, found.data());
    if (found[0] != level) return false;
  }
  return true;
}

// The context of the window must be current.
class GlfwWindow final : public Window {
 public:
  explicit GlfwWindow(GLFWwindow* window) : window_(window), keeps_framebuffer_(keeps_content(window)) {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* from, int key, int, int action, int) {
      if (action != GLFW_REPEAT) input_of(from).keys.push_back({databuffer::key_of_glfw(key), action == GLFW_PRESS});
    });
    // GLFW has no key code for "?", because its position depends on the keyboard's layout.
    glfwSetCharCallback(window, [](GLFWwindow* from, unsigned code) {
      if (code != '?') return;
      for (const bool pressed : {true, false}) input_of(from).keys.push_back({databuffer::Key{'?'}, pressed});
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* from, int button, int action, int) {
      if (button == GLFW_MOUSE_BUTTON_LEFT || button == GLFW_MOUSE_BUTTON_RIGHT)
        self_of(from).input_.mouse.push_back(
            {button == GLFW_MOUSE_BUTTON_LEFT, action == GLFW_PRESS, self_of(from).mouse_position()});
    });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* from, int focused) {
      if (focused == GLFW_FALSE) input_of(from).focus_lost = true;
    });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* from) { input_of(from).redraw_needed = true; });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* from, int, int) { input_of(from).redraw_needed = true; });
  }
  // Does not terminate GLFW. Termination unloads the driver; leak reports then lose the driver's function names.
  ~GlfwWindow() override { glfwDestroyWindow(window_); }

  Pixels pixels() const override {
    Pixels pixels;
    glfwGetFramebufferSize(window_, &pixels.width, &pixels.height);
    return pixels;
  }
  bool should_close() const override { return glfwWindowShouldClose(window_) != GLFW_FALSE; }
  WindowInput take_input(double max_wait_s) override {
    if (max_wait_s > 0.0) {
      glfwWaitEventsTimeout(max_wait_s);
    } else {
      glfwPollEvents();
    }
    return std::exchange(input_, {});
  }
  std::optional<Point> mouse() const override {
    if (glfwGetWindowAttrib(window_, GLFW_HOVERED) == GLFW_FALSE) return std::nullopt;
    return mouse_position();
  }
  bool is_full_screen() const override { return glfwGetWindowMonitor(window_) != nullptr; }
  void show_full_screen(bool on) override {
    if (on == is_full_screen()) return;
    if (!on) {
      glfwSetWindowMonitor(window_, nullptr, windowed_.left, windowed_.top, windowed_.width, windowed_.height, 0);
      return;
    }
    GLFWmonitor* monitor = monitor_of_window();
    const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
    if (mode == nullptr) return;
    glfwGetWindowPos(window_, &windowed_.left, &windowed_.top);
    glfwGetWindowSize(window_, &windowed_.width, &windowed_.height);
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  }
  void clear() override {
    constexpr std::array<float, 4> kBlack{0.0F, 0.0F, 0.0F, 1.0F};
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glClearBufferfv(GL_COLOR, 0, kBlack.data());
  }
  void present() override { glfwSwapBuffers(window_); }
  bool keeps_framebuffer() const override { return keeps_framebuffer_; }

 private:
  static GlfwWindow& self_of(GLFWwindow* window) { return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window)); }
  static WindowInput& input_of(GLFWwindow* window) { return self_of(window).input_; }

  // Position of the mouse as fractions of the largest square in the middle of the window.
  Point mouse_position() const {
    double x = 0.0;
    double y = 0.0;
    int width = 0;
    int height = 0;
    glfwGetCursorPos(window_, &x, &y);
    glfwGetWindowSize(window_, &width, &height);
    const double edge = std::max(1, std::min(width, height));
    const auto fraction = [&](double coordinate, int length) {
      return static_cast<float>((coordinate - (length - edge) / 2.0) / edge);
    };
    return {fraction(x, width), fraction(y, height)};
  }

  // The monitor that shows the middle of the window, else the primary monitor.
  GLFWmonitor* monitor_of_window() const {
    Frame frame;
    glfwGetWindowPos(window_, &frame.left, &frame.top);
    glfwGetWindowSize(window_, &frame.width, &frame.height);
    const int x = frame.left + frame.width / 2, y = frame.top + frame.height / 2;
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i) {
      int left = 0, top = 0;
      glfwGetMonitorPos(monitors[i], &left, &top);
      const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
      const bool inside = mode != nullptr && x >= left && x < left + mode->width && y >= top && y < top + mode->height;
      if (inside) return monitors[i];
    }
    return glfwGetPrimaryMonitor();
  }

  struct Frame {
    int left = 0, top = 0, width = 0, height = 0;  // [screen coordinates]
  };
  Frame windowed_;  // position and size to return to from full screen
  GLFWwindow* window_;
  bool keeps_framebuffer_;
  WindowInput input_;
};

void set_icon(GLFWwindow* window) {
  std::array<imageio::Image, 3> icons{window_icon(16), window_icon(32), window_icon(64)};
  std::array<GLFWimage, icons.size()> images{};
  std::ranges::transform(icons, images.begin(),
                         [](imageio::Image& icon) { return GLFWimage{icon.width, icon.height, icon.pixels.data()}; });
  glfwSetWindowIcon(window, static_cast<int>(images.size()), images.data());
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

error::Expected<std::unique_ptr<Window>> no_window() {
  const char* description = nullptr;
  glfwGetError(&description);
  return error::fail("window", "OpenGL 3.3 on the display", description == nullptr ? "no reason given" : description,
                     "use --headless --frames DIR");
}

// Side of a square window [screen coordinates]: two thirds of the height of the monitor's work area, at most its width.
int edge_on_screen() {
  constexpr int kWithoutMonitor = 480;
  int left = 0, top = 0, width = 0, height = 0;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor(); monitor != nullptr)
    glfwGetMonitorWorkarea(monitor, &left, &top, &width, &height);
  const int edge = std::min(2 * height / 3, width);
  return edge > 0 ? edge : kWithoutMonitor;
}

}  // namespace

error::Expected<std::unique_ptr<Window>> open_window(const std::string& title, std::optional<int> size, int max_size) {
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) {
    return error::fail("window", "a display in DISPLAY or WAYLAND_DISPLAY", "neither", "use --headless --frames DIR");
  }
  if (glfwInit() != GLFW_TRUE) return no_window();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  // A side from the monitor already includes the monitor's scale. A side that the user gives does not.
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, size ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "yars-radar-display");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "yars-radar-display");
  const int edge = size ? *size : std::min(edge_on_screen(), max_size);
  GLFWwindow* window = glfwCreateWindow(edge, edge, title.c_str(), nullptr, nullptr);
  if (window == nullptr) {
    auto failed = no_window();
    glfwTerminate();
    return failed;
  }
  set_icon(window);
  glfwMakeContextCurrent(window);
  glfwSwapInterval(0);  // swaps do not wait for vertical sync; the main loop limits the frame rate
  return std::make_unique<GlfwWindow>(window);
}

}  // namespace yars::display::gl
