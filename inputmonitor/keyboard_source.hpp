// Keyboards as sources of events: keys typed in a window or a terminal.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "databuffer/messages/key_map.hpp"
#include "inputmonitor/event_source.hpp"
#include "lib/error/error.hpp"

namespace yars::inputmonitor {

// The part that every keyboard source shares: edges of keys become events, Escape ends.
class Keyboard {
 public:
  void change(databuffer::Key key, bool pressed) {
    ended_ = ended_ || (key == databuffer::Key::escape && pressed);
    append(state_.change(key, pressed));
  }
  void let_go() { append(state_.release_all()); }
  void end() { ended_ = true; }
  bool ended() const { return ended_; }
  std::vector<databuffer::InputEvent> take() { return std::exchange(events_, {}); }

 private:
  void append(const std::vector<databuffer::InputEvent>& events) {
    events_.insert(events_.end(), events.begin(), events.end());
  }

  databuffer::KeyboardState state_;
  std::vector<databuffer::InputEvent> events_;
  bool ended_ = false;
};

// What the keys do, on one line, for a pilot who has no manual at hand.
inline constexpr const char* kKeyHelp =
    "2-9 a-k: buttons 2-20, arrows: TDC, Enter: TDC switch, Tab: next point, PgUp PgDn: ACQ, Space: freeze, "
    "[ ]: elevation, F1 F2 F3: A/G A/A ranging, F4: navigator, Esc: ends";

// Keys typed in a small window of its own. Keys are told by their place on an American keyboard; repeats of a held
// key are passed over, and a window that loses the keyboard lets go of everything.
// `session` goes into the title. An error when there is no display.
error::Expected<std::unique_ptr<EventSource>> open_window_source(const std::string& session);

// Keys typed in the terminal that is standard input.
error::Expected<std::unique_ptr<EventSource>> open_terminal_source();

}  // namespace yars::inputmonitor
