#include "display/symbology/bezel.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "display/symbology/overlay_texts.hpp"
#include "display/symbology/readouts.hpp"
#include "display/symbology/text_layout.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::display {

namespace {

constexpr float kHalfButton = 17.0F;           // [units] half the edge of a button
constexpr float kMiddle = 28.0F;               // [units] from the panel's edge to the middle of a button
constexpr float kBevel = 2.0F;                 // [units] width of lit and shaded edges
constexpr Color kFace{0.085F, 0.09F, 0.095F};  // dark, so that the picture stays the brightest
constexpr Color kLitEdge{0.20F, 0.21F, 0.22F};
constexpr Color kShade{0.02F, 0.02F, 0.02F};
constexpr Color kButton{0.14F, 0.145F, 0.15F};
constexpr Color kButtonLit{0.24F, 0.25F, 0.26F};

// Middle of a button on the panel. Buttons lie at the height or column of their legends.
Point middle_of_button(const PanelLayout& layout, int button) {
  const Point legend = legend_position(button).at;
  const float far = layout.edge() - kMiddle;
  const int side = (button - 1) / 5;
  if (side == 0) return {kMiddle, legend.y + layout.border};
  if (side == 1) return {legend.x + layout.border, far};
  if (side == 2) return {far, legend.y + layout.border};
  return {legend.x + layout.border, kMiddle};
}

Rect square_about(Point middle, float half) {
  return {middle.x - half, middle.y - half, middle.x + half, middle.y + half};
}

bool contains(const Rect& rect, Point at) {
  return at.x >= rect.left && at.x <= rect.right && at.y >= rect.top && at.y <= rect.bottom;
}

// A raised face: lit at the upper and left edge, shaded at the others.
void draw_raised(const Rect& rect, const Color& face, DrawList& list) {
  list.panel(grown(rect, kBevel), kShade);
  list.panel({rect.left - kBevel, rect.top - kBevel, rect.right, rect.bottom}, kLitEdge);
  list.panel(rect, face);
}

void draw_border(const PanelLayout& layout, DrawList& list) {
  const float edge = layout.edge(), inner = edge - layout.border;
  list.panel({0.0F, 0.0F, edge, layout.border}, kFace);
  list.panel({0.0F, inner, edge, edge}, kFace);
  list.panel({0.0F, layout.border, layout.border, inner}, kFace);
  list.panel({inner, layout.border, edge, inner}, kFace);
  // The frame of the screen is sunk: shaded above and left, lit below and right.
  const float from = layout.border - kBevel, to = inner + kBevel;
  list.panel({from, from, to, layout.border}, kShade);
  list.panel({from, from, layout.border, to}, kShade);
  list.panel({from, inner, to, to}, kLitEdge);
  list.panel({inner, from, to, to}, kLitEdge);
}

}  // namespace

std::optional<int> button_at(const PanelLayout& layout, Point on_panel) {
  for (int button = 1; layout.border > 0.0F && button <= radar::kBezelButtons; ++button)
    if (contains(square_about(middle_of_button(layout, button), kHalfButton + kBevel), on_panel)) return button;
  return button_at(layout.on_picture(on_panel));
}

void draw_bezel(const PanelLayout& layout, int lit, DrawList& list) {
  if (layout.border <= 0.0F) return;
  draw_border(layout, list);
  for (int button = 1; button <= radar::kBezelButtons; ++button) {
    const Point middle = middle_of_button(layout, button);
    draw_raised(square_about(middle, kHalfButton), button == lit ? kButtonLit : kButton, list);
    list.text(std::to_string(button), middle, {9.0F, Align::center, false, false, Ink::dim});
  }
}

namespace {

// Lines of the tooltip: number, key and legend; what the button does; for PB 8 also the window above its legend.
std::vector<std::string> tooltip_lines(const DisplayInput& input, int button, float max_width) {
  constexpr int kBelowWindow = 8;
  const std::string legend(text::text_of(input.state.legends[button]));
  std::vector<std::string> lines{name_of_button(button) + (legend.empty() ? "" : ": " + legend)};
  const auto add = [&](const std::string& words) {
    for (std::string& line : wrapped(in_capitals(words), max_width)) lines.push_back(std::move(line));
  };
  add(words_of_button(input, button));
  const bool off = input.state.power == static_cast<std::uint8_t>(radar::Power::off);
  if (button == kBelowWindow && input.state_machine_alive && !off) add(words_of_window(input));
  return lines;
}

}  // namespace

void draw_tooltip(const PanelLayout& layout, const DisplayInput& input, int button, DrawList& list) {
  constexpr float kHeight = 9.0F, kPitch = 14.0F, kMargin = 7.0F, kMaxWidth = 260.0F;  // [units]
  constexpr float kGap = 66.0F;  // [units] from the picture's edge, so that the legend stays visible
  const std::vector<std::string> lines = tooltip_lines(input, button, kMaxWidth / kHeight);
  float width = 0.0F;
  for (const std::string& line : lines) width = std::max(width, text_width(line) * kHeight);
  width += 2.0F * kMargin;
  const float height = kPitch * static_cast<float>(lines.size()) + kMargin;
  const LegendPosition beside = legend_position(button);
  // The middle of the box, in display units: beside the legend, within the picture.
  const float half_width = width / 2.0F, half_height = height / 2.0F;
  Point middle = beside.at;
  const int side = (button - 1) / 5;
  if (side == 0) middle.x = kGap + half_width;
  if (side == 2) middle.x = kDisplayUnits - kGap - half_width;
  if (side == 1) middle.y = kDisplayUnits - kGap / 2.0F - half_height;
  if (side == 3) middle.y = kGap / 2.0F + half_height;
  middle.x = std::clamp(middle.x, half_width, kDisplayUnits - half_width) + layout.border;
  middle.y = std::clamp(middle.y, half_height, kDisplayUnits - half_height) + layout.border;
  const Rect box{middle.x - half_width, middle.y - half_height, middle.x + half_width, middle.y + half_height};
  list.draw_on(Layer::cover);
  list.plate(box);
  list.frame(box);
  float y = box.top + kMargin / 2.0F + kPitch / 2.0F;
  for (const std::string& line : lines) {
    list.text(line, {box.left + kMargin, y}, {kHeight, Align::left});
    y += kPitch;
  }
  list.draw_on(Layer::symbols);
}

void draw_notice(const PanelLayout& layout, std::string_view words, DrawList& list) {
  list.draw_on(Layer::cover);
  list.text(in_capitals(words), {layout.edge() / 2.0F, layout.border + 74.0F}, {9.0F, Align::center, true, true});
  list.draw_on(Layer::symbols);
}

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
