#include "display/symbology/mouse.hpp"

#include <algorithm>

namespace yars::display {

namespace {

using databuffer::EventKind;
using databuffer::InputEvent;

InputEvent event_of(EventKind kind, int argument = 0) {
  InputEvent event{};
  event.kind = static_cast<std::uint16_t>(kind);
  event.argument = static_cast<std::int16_t>(argument);
  return event;
}

bool is_on_picture(Point at) {
  return at.x >= 0.0F && at.y >= 0.0F && at.x <= kDisplayUnits && at.y <= kDisplayUnits;
}

InputEvent cursor_at(Point on_picture) {
  InputEvent event = event_of(EventKind::cursor);
  event.x = static_cast<double>(std::clamp(on_picture.x / kDisplayUnits, 0.0F, 1.0F));
  event.y = static_cast<double>(std::clamp(on_picture.y / kDisplayUnits, 0.0F, 1.0F));
  return event;
}

}  // namespace

std::vector<InputEvent> Mouse::press(const PanelLayout& layout, MouseButton button, Point at, bool takes_cursor) {
  if (held_) return {};
  if (const auto pressed = button_at(layout, at)) {
    if (button != MouseButton::left) return {};
    return {event_of(EventKind::push_button, *pressed)};
  }
  if (!takes_cursor || !is_on_picture(layout.on_picture(at))) return {};
  held_ = button;
  last_ = at;
  std::vector<InputEvent> events{cursor_at(layout.on_picture(at))};
  if (button == MouseButton::left) events.push_back(event_of(EventKind::tdc_press));
  return events;
}

std::vector<InputEvent> Mouse::release(const PanelLayout& layout, MouseButton button, Point at) {
  if (held_ != button) return {};
  std::vector<InputEvent> events = move(layout, at);
  held_.reset();
  const bool on_map = is_on_picture(layout.on_picture(at)) && !button_at(layout, at);
  if (button == MouseButton::left && on_map) events.push_back(event_of(EventKind::tdc_release));
  return events;
}

std::vector<InputEvent> Mouse::move(const PanelLayout& layout, Point at) {
  if (!held_ || at == last_) return {};
  last_ = at;
  return {cursor_at(layout.on_picture(at))};
}

}  // namespace yars::display
