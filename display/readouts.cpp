#include "display/readouts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "databuffer/records/plain_text.hpp"
#include "display/bezel.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/limits.hpp"
#include "lib/radar/modes.hpp"

namespace yars::display {

namespace {

constexpr float kText = 10.0F;         // [units] cap height of all small text
constexpr float kArrow = 14.0F;        // [units] of the range buttons' arrows
constexpr float kAboveLegend = 15.5F;  // [units] from a legend of the bottom row to a number above it
constexpr float kBannerText = 18.0F;   // [units]
constexpr float kSilentText = 13.0F;   // [units]

using databuffer::text_of;
using Buffer = std::array<char, 40>;

std::string_view formatted(Buffer& buffer, const char* format, double value) {
  const int length = std::snprintf(buffer.data(), buffer.size(), format, value);
  return {buffer.data(), static_cast<std::size_t>(std::max(length, 0))};
}

// "40", "4.7", ".67": no digit that says nothing.
std::string_view miles(Buffer& buffer, double value) {
  std::string_view text = formatted(buffer, "%.4g", value);
  if (text.starts_with("0.")) text.remove_prefix(1);
  return text;
}

Point between(int button, int other) {
  const Point a = legend_place(button).at;
  const Point b = legend_place(other).at;
  return {(a.x + b.x) / 2.0F, (a.y + b.y) / 2.0F};
}

// Zero azimuth line and arcs run behind the middle of the glass.
constexpr TextStyle centered(float height) {
  return {height, Align::center, false, true};
}

}  // namespace

void draw_number(std::string_view words, Point at, const TextStyle& style, DrawList& list) {
  const Rect box = text_box(words, at, style);
  const auto stands_on = [&](const OccupiedBox& other) {
    return other.kind == BoxKind::cursor && intersect(grown(box, 1.0F), other.rect);
  };
  if (std::ranges::any_of(list.occupied(), stands_on)) {
    list.occupy("number beneath the cursor", box, BoxKind::solid);
  } else {
    list.text(words, at, style);
  }
}

void draw_legends(const databuffer::RadarState& state, DrawList& list) {
  for (int button = 1; button <= radar::kBezelButtons; ++button) {
    const std::string_view legend = text_of(state.legends[button]);
    if (legend.empty()) continue;
    const LegendPlace place = legend_place(button);
    const bool boxed = (state.boxed >> static_cast<unsigned>(button) & 1U) != 0;
    const bool arrow = legend == "^" || legend == "v";
    list.text(legend, place.at, {arrow ? kArrow : kText, place.align, boxed, false});
  }
}

void draw_brightness(const databuffer::RadarState& state, DrawList& list) {
  Buffer buffer;
  draw_number(formatted(buffer, "%.0f", state.brightness), between(4, 5), {kText, Align::left}, list);
}

void draw_range(const databuffer::RadarState& state, DrawList& list) {
  Buffer buffer;
  draw_number(miles(buffer, state.range_nm), between(13, 14), {kText, Align::right}, list);
}

void draw_window_size(const databuffer::RadarState& state, DrawList& list) {
  if (!(state.window_nm > 0.0)) return;
  Buffer buffer;
  const Point legend = legend_place(8).at;
  draw_number(miles(buffer, state.window_nm), {legend.x, legend.y - kAboveLegend}, {kText}, list);
}

void draw_cursor_readout(const databuffer::RadarState& state, DrawList& list) {
  if ((state.flags & databuffer::kCursorValid) == 0) return;
  Buffer buffer;
  // 359.6 rounds to 360, which reads 000; -0.0 does not occur in a bearing.
  const double bearing_deg = std::fmod(std::round(state.cursor_bearing_deg) + 360.0, 360.0);
  draw_number(formatted(buffer, "%03.0f\u00b0", bearing_deg), {6.0F, 12.0F}, {kText, Align::left}, list);
  draw_number(formatted(buffer, "%.1fNM", state.cursor_range_nm), {6.0F, 27.0F}, {kText, Align::left}, list);
}

void draw_update_errors(const databuffer::RadarState& state, DrawList& list) {
  if ((state.flags & databuffer::kUpdateShown) == 0) return;
  Buffer buffer;
  if (state.update_seconds >= 0) {
    const Point legend = legend_place(7).at;
    draw_number(formatted(buffer, "%.0f", state.update_seconds), {legend.x, legend.y - kAboveLegend}, {kText}, list);
  }
  // In the upper right, above the legend of PB 15.
  constexpr float right = kGlassUnits - 6.0F, first = 46.0F, second = 61.0F;
  if ((state.flags & databuffer::kUpdateInvalid) != 0) {
    list.text("INV", {right, first}, {kText, Align::right});
    return;
  }
  const double distance_ft = geo::Length::metres(std::hypot(state.update_north_m, state.update_east_m)).feet();
  const bool miles_beyond = distance_ft > databuffer::kUpdateErrorInFeet;
  const auto draw = [&](double metres, char direction, float y) {
    const auto length = geo::Length::metres(std::abs(metres));
    const int size = miles_beyond
                         ? std::snprintf(buffer.data(), buffer.size(), "%c %.2fNM", direction, length.nautical_miles())
                         : std::snprintf(buffer.data(), buffer.size(), "%c %.0fFT", direction, length.feet());
    draw_number({buffer.data(), static_cast<std::size_t>(std::max(size, 0))}, {right, y}, {kText, Align::right}, list);
  };
  draw(state.update_north_m, state.update_north_m < 0.0 ? 'S' : 'N', first);
  draw(state.update_east_m, state.update_east_m < 0.0 ? 'W' : 'E', second);
}

void draw_map_timer(double seconds, DrawList& list) {
  if (!std::isfinite(seconds)) return;
  Buffer buffer;
  draw_number(formatted(buffer, "%.0f SEC", std::ceil(seconds)), {kGlassUnits - 6.0F, 32.0F}, {kText, Align::right},
              list);
}

void draw_mode_name(const databuffer::RadarState& state, DrawList& list) {
  const auto mode = static_cast<radar::Mode>(state.mode);
  const bool air_to_air = mode == radar::Mode::air_to_air;
  if (!air_to_air && mode != radar::Mode::ranging) return;
  list.text(air_to_air ? "A/A" : "A/G RANGING", {kGlassUnits / 2.0F, 52.0F}, centered(kText + 1.0F));
}

void draw_freeze(DrawList& list) {
  list.text("FREEZE", {kGlassUnits / 2.0F, 32.0F}, {kText + 1.0F});
}

void draw_message(const databuffer::RadarState& state, DrawList& list) {
  list.draw_on(Layer::notices);
  const std::string_view message = text_of(state.message);
  if (!message.empty()) list.text(message, {kGlassUnits / 2.0F, 413.0F}, centered(kText));
  list.draw_on(Layer::symbols);
}

void draw_banner(std::string_view words, DrawList& list) {
  list.text(words, {kGlassUnits / 2.0F, 240.0F}, centered(kBannerText));
}

void draw_silent(const GlassInput& input, DrawList& list) {
  list.draw_on(Layer::notices);
  float y = 290.0F;
  const auto say = [&](bool well, std::string_view words) {
    if (well) return;
    list.text(words, {kGlassUnits / 2.0F, y}, {kSilentText, Align::center, true, true});
    y += 26.0F;
  };
  say(input.ownship_fresh, "NO OWNSHIP");
  say(input.model_alive, "NO MODEL");
  say(input.state_machine_alive, "NO STATE MACHINE");
  list.draw_on(Layer::symbols);
}

}  // namespace yars::display
