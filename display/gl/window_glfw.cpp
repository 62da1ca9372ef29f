#include "display/gl/window_glfw.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace yars::display::gl {

namespace {

using databuffer::Key;

Key key_of(int glfw_key) {
  constexpr std::array<std::pair<int, Key>, 15> kNamed{{{GLFW_KEY_UP, Key::up},
                                                        {GLFW_KEY_DOWN, Key::down},
                                                        {GLFW_KEY_LEFT, Key::left},
                                                        {GLFW_KEY_RIGHT, Key::right},
                                                        {GLFW_KEY_ENTER, Key::enter},
                                                        {GLFW_KEY_KP_ENTER, Key::enter},
                                                        {GLFW_KEY_TAB, Key::tab},
                                                        {GLFW_KEY_PAGE_UP, Key::page_up},
                                                        {GLFW_KEY_PAGE_DOWN, Key::page_down},
                                                        {GLFW_KEY_ESCAPE, Key::escape},
                                                        {GLFW_KEY_F1, Key::f1},
                                                        {GLFW_KEY_F2, Key::f2},
                                                        {GLFW_KEY_F3, Key::f3},
                                                        {GLFW_KEY_F4, Key::f4},
                                                        {GLFW_KEY_SPACE, Key::space}}};
  const auto* named = std::ranges::find(kNamed, glfw_key, &std::pair<int, Key>::first);
  if (named != kNamed.end()) return named->second;
  // GLFW numbers printable keys by their ASCII upper case.
  if (glfw_key < ' ' || glfw_key > '~') return Key::none;
  return databuffer::key_of_character(static_cast<char>(glfw_key));
}

class GlfwWindow final : public Window {
 public:
  explicit GlfwWindow(GLFWwindow* window) : window_(window) {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* from, int key, int, int action, int) {
      if (action != GLFW_REPEAT) input_of(from).keys.push_back({key_of(key), action == GLFW_PRESS});
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* from, int button, int action, int) {
      if (button == GLFW_MOUSE_BUTTON_LEFT && action == GLFW_PRESS) self_of(from).add_click();
    });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* from, int focused) {
      if (focused == GLFW_FALSE) input_of(from).focus_lost = true;
    });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* from) { input_of(from).redraw_needed = true; });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* from, int, int) { input_of(from).redraw_needed = true; });
  }
  // Does not end GLFW: that unloads the driver, which leaves memory behind that nobody can then name.
  ~GlfwWindow() override { glfwDestroyWindow(window_); }

  Pixels pixels() const override {
    Pixels pixels;
    glfwGetFramebufferSize(window_, &pixels.width, &pixels.height);
    return pixels;
  }
  bool should_close() const override { return glfwWindowShouldClose(window_) != GLFW_FALSE; }
  WindowInput take_input(double longest_wait_s) override {
    if (longest_wait_s > 0.0) {
      glfwWaitEventsTimeout(longest_wait_s);
    } else {
      glfwPollEvents();
    }
    return std::exchange(input_, {});
  }
  void clear() override {
    constexpr std::array<float, 4> kBlack{0.0F, 0.0F, 0.0F, 1.0F};
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glClearBufferfv(GL_COLOR, 0, kBlack.data());
  }
  void present() override { glfwSwapBuffers(window_); }

 private:
  static GlfwWindow& self_of(GLFWwindow* window) { return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window)); }
  static WindowInput& input_of(GLFWwindow* window) { return self_of(window).input_; }

  // The glass is the largest square in the middle of the window.
  void add_click() {
    double x = 0.0;
    double y = 0.0;
    int width = 0;
    int height = 0;
    glfwGetCursorPos(window_, &x, &y);
    glfwGetWindowSize(window_, &width, &height);
    const double edge = std::min(width, height);
    if (edge <= 0.0) return;
    const auto unit = [&](double place, int length) {
      return static_cast<float>((place - (length - edge) / 2.0) / edge) * kGlassUnits;
    };
    input_.clicks.push_back({unit(x, width), unit(y, height)});
  }

  GLFWwindow* window_;
  WindowInput input_;
};

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

failure::Expected<std::unique_ptr<Window>> no_window() {
  const char* description = nullptr;
  glfwGetError(&description);
  return failure::fail("window", "OpenGL 3.3 on the display", description == nullptr ? "no reason given" : description,
                       "use --headless --frames DIR");
}

}  // namespace

failure::Expected<std::unique_ptr<Window>> open_window(const std::string& title, int size) {
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) {
    return failure::fail("window", "a display in DISPLAY or WAYLAND_DISPLAY", "neither", "use --headless --frames DIR");
  }
  if (glfwInit() != GLFW_TRUE) return no_window();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  GLFWwindow* window = glfwCreateWindow(size, size, title.c_str(), nullptr, nullptr);
  if (window == nullptr) {
    auto failed = no_window();
    glfwTerminate();
    return failed;
  }
  glfwMakeContextCurrent(window);
  glfwSwapInterval(0);  // the main loop paces itself: under Xvfb the swap does not wait
  return std::make_unique<GlfwWindow>(window);
}

}  // namespace yars::display::gl
