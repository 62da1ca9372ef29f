// The part that every keyboard source shares: edges of keys become events, Escape ends.
#pragma once

#include <utility>
#include <vector>

#include "databuffer/records/key_map.hpp"

namespace yars::inputmonitor {

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

}  // namespace yars::inputmonitor
