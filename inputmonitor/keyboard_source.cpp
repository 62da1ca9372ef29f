#include "inputmonitor/keyboard_source.hpp"

#include <GLFW/glfw3.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <utility>

#include "inputmonitor/terminal.hpp"

namespace yars::inputmonitor {

std::string key_help_text() {
  std::string text = "keys:\n  2-9 A-K        push buttons 2 to 20\n";
  for (const databuffer::KeyHelp& one : databuffer::key_help()) {
    std::string keys = one.keys;
    keys.resize(15, ' ');
    text += "  " + keys + one.does + '\n';
  }
  return text + "  ? or F1        this help\n  Esc            ends these keys; the set runs on";
}

void Keyboard::change(databuffer::Key key, bool pressed) {
  if (pressed && databuffer::is_help(key)) notices_.push_back({false, key_help_text(), true});
  if (pressed && databuffer::is_dead_letter(key)) notices_.push_back({false, databuffer::kDeadKeyHelp, true});
  if (pressed && key == databuffer::Key::escape && !ended_) {
    notices_.push_back({false, "Esc ended " + name_ + "; the set runs on. input-monitor starts them again", true});
    ended_ = true;
  }
  append(state_.change(key, pressed));
}

namespace {

constexpr const char* kShortHelp = "? shows the keys, Esc ends them";
constexpr int kWidth = 640;  // [pixels] width of the window, which shows a title only
constexpr int kHeight = 80;  // [pixels]

Keyboard& keyboard_of(GLFWwindow* window) {
  return *static_cast<Keyboard*>(glfwGetWindowUserPointer(window));
}

void on_key(GLFWwindow* window, int code, int, int action, int) {
  if (action != GLFW_REPEAT) keyboard_of(window).change(databuffer::key_of_glfw(code), action == GLFW_PRESS);
}

void on_focus(GLFWwindow* window, int focused) {
  if (focused == GLFW_FALSE) keyboard_of(window).release_all();
}

// GLFW has no key for "?", whose place depends on the keyboard's layout.
void on_character(GLFWwindow* window, unsigned code) {
  if (code == '?') keyboard_of(window).change(databuffer::Key{'?'}, true);
  if (code == '?') keyboard_of(window).change(databuffer::Key{'?'}, false);
}

class KeyboardSource : public EventSource {
 public:
  explicit KeyboardSource(std::string name) : keyboard_(std::move(name)) {}
  std::vector<databuffer::InputEvent> release() override {
    keyboard_.release_all();
    return keyboard_.take();
  }
  bool ended() const override { return keyboard_.ended(); }
  bool follows_sim_time() const override { return false; }
  std::vector<Notice> notices() override { return keyboard_.notices(); }

 protected:
  Keyboard keyboard_;
};

class WindowSource final : public KeyboardSource {
 public:
  explicit WindowSource(GLFWwindow* window) : KeyboardSource("the keys of this window"), window_(window) {
    glfwSetWindowUserPointer(window_, &keyboard_);
    glfwSetKeyCallback(window_, on_key);
    glfwSetCharCallback(window_, on_character);
    glfwSetWindowFocusCallback(window_, on_focus);
  }
  WindowSource(const WindowSource&) = delete;
  WindowSource& operator=(const WindowSource&) = delete;
  ~WindowSource() override {
    glfwDestroyWindow(window_);
    glfwTerminate();
  }

  // GLFW does not expose the descriptor of the display connection.
  bool add_descriptors(std::vector<pollfd>&) const override { return false; }
  void wait(const Moment&, int max_wait_ms) override { glfwWaitEventsTimeout(static_cast<double>(max_wait_ms) * 1e-3); }

  std::vector<databuffer::InputEvent> take(const Moment&) override {
    glfwPollEvents();
    if (glfwWindowShouldClose(window_) == GLFW_TRUE) keyboard_.end();
    return keyboard_.take();
  }

  std::string description() const override { return std::string("a window; ") + kShortHelp; }

 private:
  GLFWwindow* window_;
};

error::Expected<std::unique_ptr<EventSource>> no_window() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return error::fail("--source window", "a display on which a window can be opened",
                     reason != nullptr ? reason : "none", "use --source terminal or script:FILE");
}

}  // namespace

error::Expected<std::unique_ptr<EventSource>> open_window_source(const std::string& session) {
  if (glfwInit() == GLFW_FALSE) return no_window();
  // No OpenGL context: the window draws nothing.
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  const std::string title = "YARS input (" + session + ")  " + kShortHelp;
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "yars-input-monitor");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "yars-input-monitor");
  GLFWwindow* window = glfwCreateWindow(kWidth, kHeight, title.c_str(), nullptr, nullptr);
  if (window != nullptr) return std::make_unique<WindowSource>(window);
  auto error = no_window();
  glfwTerminate();
  return error;
}

namespace {

// True when the descriptor has bytes or is at its end, within `milliseconds`.
bool readable_within(int descriptor, int milliseconds) {
  pollfd wanted{descriptor, POLLIN, 0};
  return poll(&wanted, 1, milliseconds) > 0;
}

class TerminalSource final : public KeyboardSource {
 public:
  explicit TerminalSource(std::unique_ptr<TerminalMode> mode)
      : KeyboardSource("the keys of this terminal"), mode_(std::move(mode)) {}

  bool add_descriptors(std::vector<pollfd>& wanted) const override {
    wanted.push_back({STDIN_FILENO, POLLIN, 0});
    return true;
  }
  std::optional<std::int64_t> deadline_ns() const override { return decoder_.deadline_ns(); }

  std::vector<databuffer::InputEvent> take(const Moment& moment) override {
    apply(decoder_.advance(moment.monotonic_ns));
    while (!keyboard_.ended() && readable_within(STDIN_FILENO, 0)) {
      std::array<char, 256> bytes;
      const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
      // End of file or error: the terminal is closed.
      if (count <= 0) keyboard_.end();
      if (count > 0) apply(decoder_.feed({bytes.data(), static_cast<std::size_t>(count)}, moment.monotonic_ns));
    }
    return keyboard_.take();
  }

  std::string description() const override { return std::string("this terminal; ") + kShortHelp; }

 private:
  void apply(const std::vector<KeyChange>& changes) {
    for (const KeyChange& change : changes) keyboard_.change(change.key, change.pressed);
  }

  std::unique_ptr<TerminalMode> mode_;
  TerminalDecoder decoder_;
};

}  // namespace

error::Expected<std::unique_ptr<EventSource>> open_terminal_source() {
  auto mode = TerminalMode::enter(STDIN_FILENO);
  if (!mode) return tl::unexpected(mode.error());
  return std::make_unique<TerminalSource>(std::move(*mode));
}

}  // namespace yars::inputmonitor
