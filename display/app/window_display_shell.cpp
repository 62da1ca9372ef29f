#include "display/app/window_display_shell.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "display/symbology/symbology.hpp"
#include "runtime/process.hpp"

namespace yars::display {

namespace {

using databuffer::Key;
using databuffer::monotonic_ns;

constexpr std::int64_t kTooltipDelay_ns = 400'000'000;  // the mouse rests on a button for 0.4 s
constexpr std::int64_t kNotice_ns = 4'000'000'000;

}  // namespace

int panel_edge(int picture, bool bezel) {
  const PanelLayout layout{bezel ? kBezelBorder : 0.0F};
  return static_cast<int>(std::lround(static_cast<float>(picture) * layout.edge() / kDisplayUnits));
}

WindowDisplay::WindowDisplay(gl::Window& window, host::Display& mpd, PilotInput& pilot,
                             std::optional<FramePublisher> publisher, bool bezel)
    : window_(window), mpd_(mpd), pilot_(pilot), publisher_(std::move(publisher)) {
  view_.bezel = bezel;
  mpd_.show_hints(true);
}

void WindowDisplay::take_input(std::int64_t max_wait_ns) {
  const std::int64_t wait_ns = std::min(next_redraw_ns_ - monotonic_ns(), max_wait_ns);
  const gl::WindowInput input = window_.take_input(1e-9 * static_cast<double>(std::max<std::int64_t>(wait_ns, 0)));
  for (const gl::MouseEdge& edge : input.mouse) take_mouse(edge);
  for (const gl::KeyEdge& edge : input.keys) take_key(edge);
  if (input.focus_lost) {
    mouse_.cancel();
    pilot_.release_all();
  }
  stale_ = stale_ || input.redraw_needed;
  if (window_.should_close()) runtime::request_stop();
}

void WindowDisplay::take_key(const gl::KeyEdge& edge) {
  const bool is_of_window = databuffer::is_help(edge.key) || edge.key == Key::f8 || edge.key == Key::f11;
  if (edge.pressed && databuffer::is_dead_letter(edge.key)) return say(databuffer::kDeadKeyHelp);
  if (!is_of_window && edge.key != Key::escape) return pilot_.send_key(edge);
  if (!edge.pressed) return;
  if (databuffer::is_help(edge.key)) mpd_.show_help(help_ = !help_);
  if (edge.key == Key::f8) view_.bezel = !view_.bezel;
  if (edge.key == Key::f11) window_.show_full_screen(!window_.is_full_screen());
  if (edge.key == Key::escape) take_escape();
  stale_ = true;
}

// Escape ends what is uppermost, and says so.
void WindowDisplay::take_escape() {
  if (help_) {
    mpd_.show_help(help_ = false);
    return say("Esc ended the help; ? shows it again");
  }
  if (window_.is_full_screen()) {
    window_.show_full_screen(false);
    return say("Esc ended full screen; F11 shows it again");
  }
  say("Esc ends nothing here: close the window to end the display");
}

void WindowDisplay::say(const std::string& words) {
  view_.notice = words;
  notice_end_ns_ = monotonic_ns() + kNotice_ns;
}

void WindowDisplay::take_mouse(const gl::MouseEdge& edge) {
  const MouseButton button = edge.left ? MouseButton::left : MouseButton::right;
  const bool takes = takes_cursor(mpd_.input()) && !help_;
  const auto events = edge.pressed ? mouse_.press(layout(), button, on_panel(edge.at), takes)
                                   : mouse_.release(layout(), button, on_panel(edge.at));
  for (const databuffer::InputEvent& event : events) pilot_.send(event);
}

// Moves a held cursor to the mouse, lights the button under the mouse and shows its tooltip after a while.
void WindowDisplay::follow_mouse(std::int64_t now_ns) {
  const auto at = window_.mouse();
  if (at)
    for (const databuffer::InputEvent& event : mouse_.move(layout(), on_panel(*at))) pilot_.send(event);
  const int lit = at ? button_at(layout(), on_panel(*at)).value_or(0) : 0;
  if (std::exchange(view_.lit, lit) != lit) lit_since_ns_ = now_ns;
  view_.tooltip = lit != 0 && now_ns - lit_since_ns_ >= kTooltipDelay_ns ? lit : 0;
  if (now_ns >= notice_end_ns_) view_.notice.clear();
}

void WindowDisplay::step(std::int64_t sim_time_ns) {
  mpd_.update(sim_time_ns);
  if (redraw(monotonic_ns())) mpd_.note_shown();
  const auto pixels = window_.pixels();
  const auto edge = static_cast<float>(std::min(pixels.width, pixels.height));
  if (publisher_) publisher_->work(mpd_, static_cast<int>(std::lround(edge * kDisplayUnits / layout().edge())));
}

// Returns true if the window shows the result of the last update.
bool WindowDisplay::redraw(std::int64_t now_ns) {
  if (now_ns < next_redraw_ns_) return false;
  next_redraw_ns_ = now_ns + kRedrawInterval_ns;
  follow_mouse(now_ns);
  const auto pixels = window_.pixels();
  const int edge = std::min(pixels.width, pixels.height);
  if (edge <= 0) return false;  // minimized
  const host::Viewport whole{0, 0, pixels.width, pixels.height};
  const bool partly = window_.keeps_framebuffer() && !stale_ && shown_ == whole;
  if (partly ? refresh(whole) : redraw_all(whole, edge))
    if (publisher_) publisher_->note_painted();
  return true;
}

// Both return true if the picture has changed.
bool WindowDisplay::refresh(const host::Viewport& whole) {
  const host::Viewport changed = mpd_.refresh_panel(view_, whole);
  if (changed.width <= 0) return false;
  // A window that was resized in the meantime has another framebuffer, whose content is undefined.
  const auto now = window_.pixels();
  stale_ = now.width != whole.width || now.height != whole.height;
  if (!stale_) window_.present();
  return true;
}

bool WindowDisplay::redraw_all(const host::Viewport& whole, int edge) {
  const bool painted = mpd_.paint_panel(view_, edge);
  if (!painted && !stale_) return false;
  window_.clear();
  mpd_.draw_panel(view_, whole);
  window_.present();
  shown_ = whole;
  stale_ = false;
  return painted;
}

}  // namespace yars::display
