#include "inputmonitor/learning.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace yars::inputmonitor {

namespace {

using Kind = Gesture::Kind;

constexpr char kEscapeByte = '\x1b';
constexpr std::string_view kIndent = "      ";

// The typed keys, in lower case; of a line, the first letter of each word. Sequences of arrow and function keys
// (ESC [ A, ESC O P) are left out.
std::string keys_of(std::string_view bytes, Typing typing) {
  std::string keys;
  bool in_word = false;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char byte = bytes[i];
    if (byte == kEscapeByte && i + 1 < bytes.size() && (bytes[i + 1] == '[' || bytes[i + 1] == 'O')) {
      i += 2;
      while (i < bytes.size() && (bytes[i] < '@' || bytes[i] > '~')) ++i;
      continue;
    }
    const bool is_key = byte > ' ' && byte <= '~';
    if (is_key && !in_word) keys += static_cast<char>(std::tolower(static_cast<unsigned char>(byte)));
    in_word = is_key && typing == Typing::lines;
  }
  return keys;
}

std::string line(std::string_view text) {
  return std::string(kIndent).append(text) + '\n';
}

}  // namespace

Learning::Learning(DeviceInfo info, const RestValues& rest, Typing typing)
    : info_(std::move(info)), typing_(typing), detector_(info_, rest) {}

std::string Learning::keys_text() const {
  if (typing_ == Typing::none) return "Ctrl-C ends and keeps what was learned.\n";
  const std::string how = typing_ == Typing::keys ? "Keys:" : "Type one of these letters and Enter:";
  return how + " s skip this one, n skip to the next part, b go back by one, r start this one again,\n" +
         "q end and keep what was learned (Ctrl-C does the same), ? show this again.\n";
}

std::string Learning::begin(std::int64_t now_ns) {
  const std::string device = info_.known && !info_.name.empty() ? " of " + info_.name : "";
  return "Learning the controls" + device + ". Move the control that each line asks for.\n" + keys_text() +
         request(now_ns);
}

// The request for the next control, with the title of its part where that begins.
std::string Learning::request(std::int64_t now_ns) {
  asked_ns_ = now_ns;
  hinted_ = idle_reported_ = false;
  if (finished()) return ended_ ? "" : "That was the last one.\n";
  const RequestedControl& control = requested_controls()[next_];
  std::string text;
  if (control.part != shown_part_) text = '\n' + std::string(control.part) + '\n';
  shown_part_ = control.part;
  text += std::to_string(next_ + 1) + '/' + std::to_string(requested_controls().size()) + ' ' + control.name;
  if (!control.where.empty()) text += " (" + control.where + ')';
  return text + ": " + control.request + '\n';
}

std::string Learning::hint(std::string_view text) {
  if (std::exchange(hinted_, true)) return {};
  return line(text);
}

std::string Learning::feed(const RawEvent& raw, std::int64_t now_ns) {
  return finished() ? std::string() : take(detector_.feed(raw, now_ns), now_ns);
}

std::string Learning::take(const Gesture& gesture, std::int64_t now_ns) {
  if (gesture.kind == Kind::nothing) return {};
  if (gesture.kind == Kind::too_short) return hint("that moved only a little; push it to the end and let go");
  if (gesture.kind == Kind::new_rest) return hint("something moved and stayed there; do it once more, then let go");
  const auto objection = controls_.objection(next_, gesture);
  if (objection) {
    begin_request(gesture.kind == Kind::press);
    asked_ns_ = now_ns;
    return line(*objection);
  }
  controls_.learn(next_, gesture);
  ++next_;
  begin_request(gesture.kind == Kind::press);
  const std::string_view what = gesture.kind == Kind::press   ? "got it: a button"
                                : gesture.kind == Kind::sweep ? "got it: a wheel or slider"
                                : is_hat(gesture.code)        ? "got it: one way of a hat"
                                                              : "got it: one way of a stick or rocker";
  return line(what) + request(now_ns);
}

std::string Learning::wait(std::int64_t now_ns) {
  if (finished()) return {};
  std::string text = take(detector_.wait(now_ns), now_ns);
  if (!text.empty()) return text;
  const std::int64_t moved_ns = std::max(asked_ns_, detector_.last_motion_ns().value_or(asked_ns_));
  if (now_ns - moved_ns >= kHeld_ns && requested_controls()[next_].kind != ControlKind::slider && detector_.is_held())
    return hint("something moved and has not come back; let it go, or press r and use another control");
  if (now_ns - moved_ns < kIdle_ns || std::exchange(idle_reported_, true)) return {};
  return line("nothing has moved for " + std::to_string(kIdle_ns / 1'000'000'000) +
              " s; is this the right device? Still waiting" + (typing_ == Typing::none ? "" : "; s skips this one"));
}

std::string Learning::reconnect(const RestValues& rest, std::int64_t now_ns) {
  detector_.reconnect(rest);
  return line("the device is back") + request(now_ns);
}

std::string Learning::type(std::string_view bytes, std::int64_t now_ns) {
  std::string text;
  for (const char key : keys_of(bytes, typing_))
    if (!finished()) text += take_key(key, now_ns);
  return text;
}

std::string Learning::take_key(char key, std::int64_t now_ns) {
  switch (key) {
    case 's':
      return skip(next_ + 1, now_ns);
    case 'n':
      return skip(next_part(), now_ns);
    case 'b':
      return back(now_ns);
    case 'r':
      detector_.take_rest();
      return line("again; where everything stands now is at rest") + request(now_ns);
    case 'q':
      ended_ = true;
      return {};
    case '?':
      return keys_text() + request(now_ns);
    default:
      return line(std::string("the key ") + key + " does nothing here; ? shows the keys");
  }
}

std::size_t Learning::next_part() const {
  const auto& controls = requested_controls();
  std::size_t index = next_;
  while (index < controls.size() && controls[index].part == controls[next_].part) ++index;
  return index;
}

std::string Learning::skip(std::size_t to, std::int64_t now_ns) {
  next_ = to;
  begin_request(false);
  return line("left out") + request(now_ns);
}

std::string Learning::back(std::int64_t now_ns) {
  if (next_ == 0) return line("this is the first one");
  --next_;
  const bool known = controls_.knows(next_);
  controls_.forget(next_);
  begin_request(false);
  return line(known ? "back; that one is forgotten" : "back") + request(now_ns);
}

void Learning::begin_request(bool after_press) {
  if (finished()) return;
  const bool sweeps = requested_controls()[next_].kind == ControlKind::slider;
  detector_.begin(sweeps ? GestureDetector::Wanted::sweep : GestureDetector::Wanted::push, after_press);
}

radar::Device Learning::device(const std::string& name) const {
  return controls_.device(name, info_, [this](std::uint16_t code) { return detector_.rest_error(code); });
}

}  // namespace yars::inputmonitor
