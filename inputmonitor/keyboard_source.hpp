// Keyboard sources: keys typed in a window or a terminal, as input events.
// Inputs: key edges (presses and releases) of a GLFW window; bytes of the terminal at standard input.
// Outputs: input events by databuffer/messages/key_map.hpp. The source ends at Escape, and when its window or terminal
// is closed.
// Errors: no display for a window; standard input is not a terminal with this process in its foreground.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "databuffer/messages/key_map.hpp"
#include "inputmonitor/event_source.hpp"
#include "lib/error/error.hpp"

namespace yars::inputmonitor {

// Common part of keyboard sources: turns key edges into events, and ends when Escape is pressed. Answers the keys of
// the help and Escape by a notice.
class Keyboard {
 public:
  // `name`: what Escape ends, for its notice: "the keys of this terminal".
  explicit Keyboard(std::string name) : name_(std::move(name)) {}
  void change(databuffer::Key key, bool pressed);
  void release_all() { append(state_.release_all()); }
  void end() { ended_ = true; }
  bool ended() const { return ended_; }
  std::vector<databuffer::InputEvent> take() { return std::exchange(events_, {}); }
  std::vector<Notice> notices() { return std::exchange(notices_, {}); }

 private:
  void append(const std::vector<databuffer::InputEvent>& events) {
    events_.insert(events_.end(), events.begin(), events.end());
  }

  std::string name_;
  databuffer::KeyboardState state_;
  std::vector<databuffer::InputEvent> events_;
  std::vector<Notice> notices_;
  bool ended_ = false;
};

// The functions of all keys, one row a line.
std::string key_help_text();

// Keys typed in a small window. Keys are identified by their position on a US keyboard. Key repeats are ignored. Loss
// of the keyboard focus releases all keys. `session` is shown in the title. Error: no display.
error::Expected<std::unique_ptr<EventSource>> open_window_source(const std::string& session);

// Keys typed in the terminal at standard input. Error: standard input is no terminal, or this process is not in the
// foreground of the terminal.
error::Expected<std::unique_ptr<EventSource>> open_terminal_source();

}  // namespace yars::inputmonitor
