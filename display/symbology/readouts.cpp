#include "display/symbology/readouts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include "databuffer/messages/derived_values.hpp"
#include "display/symbology/text_layout.hpp"
#include "lib/error/error.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::display {

namespace {

constexpr float kFirstButton = 80.0F;  // [units] from the corner to the middle of a side's first button
constexpr float kButtonPitch = 80.0F;  // [units] distance between buttons
constexpr float kMargin = 6.0F;        // [units] distance from a text to the edge of the display
constexpr float kTopRow = 12.0F;       // [units] from the centre line of a top or bottom legend to the edge
constexpr float kZoneDepth = 44.0F;    // [units] depth of a click zone from the edge
constexpr float kHalfZone = 34.0F;     // [units] half length of a click zone along the side; no zone covers a corner

float along(int index) {
  return kFirstButton + kButtonPitch * static_cast<float>(index);
}

// Index 0-4 of the click zone at a coordinate along a side.
std::optional<int> index_along(float coordinate) {
  const int index = static_cast<int>(std::lround((coordinate - kFirstButton) / kButtonPitch));
  if (index < 0 || index > 4 || std::abs(coordinate - along(index)) > kHalfZone) return std::nullopt;
  return index;
}

}  // namespace

LegendPosition legend_position(int button) {
  YARS_REQUIRE(button, >=, 1);
  YARS_REQUIRE(button, <=, radar::kBezelButtons);
  const int side = (button - 1) / 5;
  const int index = (button - 1) % 5;
  switch (side) {
    case 0:
      return {{kMargin, along(index)}, Align::left};
    case 1:
      return {{along(index), kDisplayUnits - kTopRow}, Align::center};
    case 2:
      return {{kDisplayUnits - kMargin, along(4 - index)}, Align::right};
    default:
      return {{along(4 - index), kTopRow}, Align::center};
  }
}

std::optional<int> button_at(Point at) {
  if (at.x < 0.0F || at.y < 0.0F || at.x > kDisplayUnits || at.y > kDisplayUnits) return std::nullopt;
  const std::optional<int> row = index_along(at.y);
  const std::optional<int> column = index_along(at.x);
  if (row && at.x <= kZoneDepth) return 1 + *row;
  if (column && at.y >= kDisplayUnits - kZoneDepth) return 6 + *column;
  if (row && at.x >= kDisplayUnits - kZoneDepth) return 15 - *row;
  if (column && at.y <= kZoneDepth) return 20 - *column;
  return std::nullopt;
}

namespace {

constexpr float kTextHeight = 10.0F;    // [units] cap height of legends and readouts
constexpr float kArrowHeight = 14.0F;   // [units] cap height of the range buttons' arrows
constexpr float kAboveLegend = 15.5F;   // [units] distance from a legend of the bottom row to the number above it
constexpr float kBannerHeight = 18.0F;  // [units] cap height of STBY
constexpr float kHintHeight = 8.0F;     // [units] cap height of remedies and of how to get back
constexpr float kNoticeHeight = 13.0F;  // [units] cap height of NO OWNSHIP and similar

constexpr std::string_view kNoOwnship = "NO OWNSHIP";  // a notice, and the message that refuses a cursor function

using text::text_of;
using Buffer = std::array<char, 40>;

// Text that std::snprintf wrote into a buffer of `size` bytes. `length`: the result of std::snprintf, which also counts
// characters that did not fit.
std::string_view written_text(const char* buffer, std::size_t size, int length) {
  return {buffer, std::min(static_cast<std::size_t>(std::max(length, 0)), size - 1)};
}

std::string_view formatted(Buffer& buffer, const char* format, double value) {
  return written_text(buffer.data(), buffer.size(), std::snprintf(buffer.data(), buffer.size(), format, value));
}

// A distance [NM] without superfluous digits: "40", "4.7", ".67".
std::string_view miles(Buffer& buffer, double value) {
  std::string_view text = formatted(buffer, "%.4g", value);
  if (text.starts_with("0.")) text.remove_prefix(1);
  return text;
}

Point between(int button, int other) {
  const Point a = legend_position(button).at;
  const Point b = legend_position(other).at;
  return {(a.x + b.x) / 2.0F, (a.y + b.y) / 2.0F};
}

// Style of centered texts. A black plate hides the zero azimuth line and the arcs behind the text.
constexpr TextStyle centered(float height) {
  return {height, Align::center, false, true};
}

}  // namespace

namespace {

// [units] Clear space from a text to another text or the cursor: beside it, above and below it; and to a scale.
constexpr float kBeside = 4.0F, kAbove = 2.5F, kAroundScale = 1.0F;

Rect with_clear_space(const Rect& text) {
  return {text.left - kBeside, text.top - kAbove, text.right + kBeside, text.bottom + kAbove};
}

// True if a text in this box would be clear of all that is drawn so far, and on the display.
bool is_clear(const Rect& box, const DrawList& list) {
  const auto covers = [&box](const OccupiedBox& other) {
    const bool scale = other.kind == BoxKind::scale || other.kind == BoxKind::solid;
    return intersect(scale ? grown(box, kAroundScale) : with_clear_space(box), other.rect);
  };
  return box.left >= 0.0F && box.top >= 0.0F && box.right <= kDisplayUnits && box.bottom <= kDisplayUnits &&
         std::ranges::none_of(list.occupied(), covers);
}

Rect around(const Rect& a, const Rect& b) {
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

// Box around the whole cursor; nullopt if the list has none.
std::optional<Rect> cursor_box(const DrawList& list) {
  std::optional<Rect> all;
  for (const OccupiedBox& box : list.occupied())
    if (box.kind == BoxKind::cursor) all = all ? around(*all, box.rect) : box.rect;
  return all;
}

// Distance [units] by which a readout in `box` steps aside, positive right. It steps beyond the cursor, first to the
// side of `preferred`, else to the other side. 0: the cursor is not there, or neither side is clear.
float step_aside(const Rect& box, float preferred, const DrawList& list) {
  constexpr float kRounding = 0.5F;  // [units] boxes in the list are rounded
  const auto cursor = cursor_box(list);
  if (!cursor || !intersect(with_clear_space(box), *cursor)) return 0.0F;
  const float right = cursor->right + kBeside + kRounding - box.left;
  const float left = cursor->left - kBeside - kRounding - box.right;
  for (const float by : {preferred < 0.0F ? left : right, preferred < 0.0F ? right : left})
    if (is_clear({box.left + by, box.top, box.right + by, box.bottom}, list)) return by;
  return 0.0F;
}

// Side to which a readout steps aside: from the display's edge inward.
float inward(Align align) {
  return align == Align::right ? -1.0F : 1.0F;
}

// Distance [units] by which a block of texts moves up, so that it is clear of all that is drawn so far. 0: it is clear
// where it is, or nowhere above.
float rise(const Rect& block, const DrawList& list) {
  constexpr float kTop = 80.0F, kStep = 2.0F;  // [units] FREEZE and the name of a master mode are above kTop
  for (float by = 0.0F; block.top - by >= kTop; by += kStep)
    if (is_clear({block.left, block.top - by, block.right, block.bottom - by}, list)) return by;
  return 0.0F;
}

}  // namespace

void draw_readout(std::string_view words, Point at, const TextStyle& style, DrawList& list) {
  const float aside = step_aside(text_box(words, at, style), inward(style.align), list);
  list.text(words, {at.x + aside, at.y}, style);
}

const char* north_of_bearings(const databuffer::RadarState& state) {
  return (state.flags & databuffer::kVariationKnown) != 0 ? "MAG" : "TRUE";
}

void draw_legends(const databuffer::RadarState& state, DrawList& list) {
  for (int button = 1; button <= radar::kBezelButtons; ++button) {
    const std::string_view legend = text_of(state.legends[button]);
    if (legend.empty()) continue;
    const LegendPosition position = legend_position(button);
    const bool boxed = (state.boxed >> static_cast<unsigned>(button) & 1U) != 0;
    const bool arrow = legend == "^" || legend == "v";
    list.text(legend, position.at, {arrow ? kArrowHeight : kTextHeight, position.align, boxed, false});
  }
}

void draw_brightness(const databuffer::RadarState& state, DrawList& list) {
  Buffer buffer;
  draw_readout(formatted(buffer, "%.0f", state.brightness), between(4, 5), {kTextHeight, Align::left}, list);
}

void draw_range(const databuffer::RadarState& state, DrawList& list) {
  Buffer buffer;
  draw_readout(miles(buffer, state.range_nm), between(13, 14), {kTextHeight, Align::right}, list);
}

void draw_window_size(const databuffer::RadarState& state, DrawList& list) {
  if (!(state.window_nm > 0.0)) return;
  Buffer buffer;
  const Point legend = legend_position(8).at;
  draw_readout(miles(buffer, state.window_nm), {legend.x, legend.y - kAboveLegend}, {kTextHeight}, list);
}

void draw_cursor_readout(const databuffer::RadarState& state, DrawList& list) {
  if ((state.flags & databuffer::kCursorValid) == 0) return;
  Buffer buffer;
  // 359.6 rounds to 360, which is shown as 000.
  const double bearing_deg = std::fmod(std::round(state.cursor_bearing_deg) + 360.0, 360.0);
  const std::string_view bearing = formatted(buffer, "%03.0f\u00b0", bearing_deg);
  constexpr TextStyle kNumber{kTextHeight, Align::left}, kNorth{kHintHeight, Align::left};
  constexpr float kRow = 12.0F, kGap = 4.0F;  // [units]
  const Rect number = text_box(bearing, {kMargin, kRow}, kNumber);
  const Rect north = text_box(north_of_bearings(state), {number.right + kGap, kRow}, kNorth);
  const float aside = step_aside(around(number, north), inward(kNumber.align), list);
  list.text(bearing, {number.left + aside, kRow}, kNumber);
  list.text(north_of_bearings(state), {north.left + aside, kRow}, kNorth);
  draw_readout(formatted(buffer, "%.1fNM", state.cursor_range_nm), {6.0F, 27.0F}, {kTextHeight, Align::left}, list);
}

void draw_cursor_off(DrawList& list) {
  // Two rows below the cursor's readout, left of the elevation scale.
  list.text("OFF THE", {kMargin, 41.0F}, {kHintHeight, Align::left});
  list.text("DISPLAY", {kMargin, 53.0F}, {kHintHeight, Align::left});
}

void draw_map_width(const databuffer::PatchMap& map, DrawList& list) {
  // In the lower left corner, between the legends of PB 5 and 6, below the limit balls.
  Buffer buffer;
  const float row = kDisplayUnits - kTopRow;
  draw_readout("WIDTH", {kMargin, row - 13.0F}, {kHintHeight, Align::left}, list);
  draw_readout(std::string(miles(buffer, map.window_nm)) + "NM", {kMargin, row}, {kTextHeight, Align::left}, list);
}

void draw_update_errors(const databuffer::RadarState& state, DrawList& list) {
  if ((state.flags & databuffer::kUpdateShown) == 0) return;
  Buffer buffer;
  if (state.update_seconds >= 0) {
    const Point legend = legend_position(7).at;
    draw_readout(formatted(buffer, "%.0f", state.update_seconds), {legend.x, legend.y - kAboveLegend}, {kTextHeight},
                 list);
  }
  // The texts are in the upper right, above the legend of PB 15.
  constexpr float right = kDisplayUnits - 6.0F, first_row = 46.0F, second_row = 61.0F;
  if ((state.flags & databuffer::kUpdateInvalid) != 0) {
    draw_readout("INV", {right, first_row}, {kTextHeight, Align::right}, list);
    return;
  }
  const double distance_ft = geo::Length::metres(std::hypot(state.update_north_m, state.update_east_m)).feet();
  const bool in_miles = distance_ft > databuffer::kUpdateErrorInFeet;
  const auto draw = [&](double metres, char direction, float y) {
    const auto length = geo::Length::metres(std::abs(metres));
    const int size = in_miles
                         ? std::snprintf(buffer.data(), buffer.size(), "%c %.2fNM", direction, length.nautical_miles())
                         : std::snprintf(buffer.data(), buffer.size(), "%c %.0fFT", direction, length.feet());
    draw_readout(written_text(buffer.data(), buffer.size(), size), {right, y}, {kTextHeight, Align::right}, list);
  };
  draw(state.update_north_m, state.update_north_m < 0.0 ? 'S' : 'N', first_row);
  draw(state.update_east_m, state.update_east_m < 0.0 ? 'W' : 'E', second_row);
}

void draw_map_timer(double seconds, DrawList& list) {
  if (!std::isfinite(seconds)) return;
  Buffer buffer;
  draw_readout(formatted(buffer, "%.0f SEC", std::ceil(seconds)), {kDisplayUnits - 6.0F, 32.0F},
               {kTextHeight, Align::right}, list);
}

namespace {

// "12.3NM TO 4.": slant range to the designated target; what is missing, where there is none.
std::string slant_range_text(const DisplayInput& input) {
  if ((input.state.flags & databuffer::kTargetDesignated) == 0) return "NO TARGET";
  Buffer buffer;
  std::string words("NO RANGE");
  if (std::isfinite(input.slant_range_m))
    words = formatted(buffer, "%.1fNM", geo::Length::metres(input.slant_range_m).nautical_miles());
  return words.append(" TO ").append(in_capitals(text_of(input.state.target_name)));
}

}  // namespace

void draw_mode_name(const DisplayInput& input, DrawList& list) {
  const auto mode = static_cast<radar::Mode>(input.state.mode);
  const bool air_to_air = mode == radar::Mode::air_to_air;
  if (!air_to_air && mode != radar::Mode::ranging) return;
  constexpr float kMiddle = kDisplayUnits / 2.0F, kRow = 52.0F, kNextRow = 67.0F;  // [units]
  draw_readout(air_to_air ? "A/A" : "A/G RANGING", {kMiddle, kRow}, centered(kTextHeight + 1.0F), list);
  if (!air_to_air && input.state.map_shown != 0)
    draw_readout(slant_range_text(input), {kMiddle, kNextRow}, centered(kTextHeight), list);
}

void draw_freeze(DrawList& list) {
  draw_readout("FREEZE", {kDisplayUnits / 2.0F, 32.0F}, {kTextHeight + 1.0F}, list);
}

void draw_message(const DisplayInput& input, DrawList& list) {
  const std::string_view message = text_of(input.state.message);
  const bool shown_as_notice = message == kNoOwnship && !input.ownship_fresh;
  if (message.empty() || shown_as_notice || !input.state_machine_alive) return;
  constexpr float kLowestRow = 413.0F, kRowPitch = 12.0F;  // [units] above the azimuth scale
  constexpr float kMaxWidth = 270.0F;                      // [units] between elevation scale and gray scale
  // The longest remedy, PilotAdvice::remedy with 127 characters, takes three lines.
  const auto lines = wrapped(in_capitals(text_of(input.advice.remedy)), kMaxWidth / kHintHeight);
  float y = kLowestRow - kRowPitch * static_cast<float>(lines.size());
  Rect block = text_box(message, {kDisplayUnits / 2.0F, y}, centered(kTextHeight));
  for (const std::string& line : lines)
    block = around(block, text_box(line, {kDisplayUnits / 2.0F, kLowestRow}, centered(kHintHeight)));
  y -= rise(block, list);
  list.draw_on(Layer::notices);
  list.text(message, {kDisplayUnits / 2.0F, y}, centered(kTextHeight));
  for (const std::string& line : lines) {
    y += kRowPitch;
    list.text(line, {kDisplayUnits / 2.0F, y}, centered(kHintHeight));
  }
  list.draw_on(Layer::symbols);
}

namespace {

// Words of a state without a picture.
struct StateCard {
  const char* name;      // large
  const char* is;        // what the state is
  const char* back;      // how to get back
  float y = 240.0F;      // [units] of the name
  float height = 13.0F;  // [units] cap height of the name
};
constexpr StateCard kOffCard{"OFF", "", "SWITCH ON: POWER OPR (O)"};
constexpr StateCard kStandbyCard{"STBY", "STANDBY: NO TRANSMISSION, NO SCAN", "SWITCH ON: POWER OPR (O)", 240.0F,
                                 kBannerHeight};
constexpr StateCard kAirToAirCard{"AIR-TO-AIR", "THE RADAR WORKS WITHOUT A GROUND PICTURE",
                                  "BACK TO A/G: MODE AG (F5)"};
constexpr StateCard kRangingCard{"A/G RANGING", "THE RADAR MEASURES A RANGE, WITHOUT A PICTURE",
                                 "BACK TO A/G: MODE AG (F5)"};
constexpr StateCard kMenuCard{"MAIN MENU", "THE RADAR KEEPS RUNNING", "BACK TO THE RADAR: PB 6 (6)"};
constexpr StateCard kPvuCard{"PVU", "PRECISION VELOCITY UPDATE: NO PICTURE", "NEXT MODE: PB 6 (6)", 84.0F};

const StateCard* card_of(const databuffer::RadarState& state) {
  if (state.power == static_cast<std::uint8_t>(radar::Power::off)) return &kOffCard;
  const auto mode = static_cast<radar::Mode>(state.mode);
  if (mode == radar::Mode::menu) return &kMenuCard;
  if (state.power == static_cast<std::uint8_t>(radar::Power::standby)) return &kStandbyCard;
  if (mode == radar::Mode::pvu) return &kPvuCard;
  if (state.map_shown != 0) return nullptr;
  if (mode == radar::Mode::air_to_air) return &kAirToAirCard;
  return mode == radar::Mode::ranging ? &kRangingCard : nullptr;
}

}  // namespace

void draw_state(const DisplayInput& input, DrawList& list) {
  const StateCard* card = card_of(input.state);
  if (card == nullptr || (card == &kOffCard && !input.hints)) return;
  const Ink ink = card == &kOffCard ? Ink::dim : Ink::bright;
  const auto row = [&](const char* words, float y, float height) {
    list.text(words, {kDisplayUnits / 2.0F, y}, {height, Align::center, false, true, ink});
  };
  row(card->name, card->y, card->height);
  constexpr float kFirstRow = 20.0F, kRowPitch = 14.0F;  // [units] below the name
  float y = card->y + kFirstRow;
  if (card == &kRangingCard) {
    row(slant_range_text(input).c_str(), y, kTextHeight);
    y += kFirstRow;
  }
  for (const char* words : {card->is, input.hints ? card->back : ""}) {
    if (*words == '\0') continue;
    row(words, y, kHintHeight);
    y += kRowPitch;
  }
}

void draw_silent(const DisplayInput& input, DrawList& list) {
  struct Notice {
    bool healthy;
    std::string_view words;
    std::string remedy;
  };
  const std::array notices{
      Notice{input.ownship_fresh, kNoOwnship, in_capitals(databuffer::kRemedyNoOwnship)},
      Notice{input.model_alive, "NO MODEL", in_capitals(databuffer::kRemedyNoModel)},
      Notice{input.state_machine_alive, "NO STATE MACHINE", in_capitals(databuffer::kRemedyNoStateMachine)}};
  constexpr TextStyle kNoticeStyle{kNoticeHeight, Align::center, true, true};
  constexpr float kMiddle = kDisplayUnits / 2.0F;
  constexpr float kFirstRow = 290.0F, kBelowNotice = 19.0F, kNoticePitch = 39.0F;  // [units]
  std::optional<Rect> block;
  float y = kFirstRow;
  for (const Notice& notice : notices) {
    if (notice.healthy) continue;
    const Rect both = around(text_box(notice.words, {kMiddle, y}, kNoticeStyle),
                             text_box(notice.remedy, {kMiddle, y + kBelowNotice}, centered(kHintHeight)));
    block = block ? around(*block, both) : both;
    y += kNoticePitch;
  }
  if (!block) return;
  y = kFirstRow - rise(*block, list);
  list.draw_on(Layer::notices);
  for (const Notice& notice : notices) {
    if (notice.healthy) continue;
    list.text(notice.words, {kMiddle, y}, kNoticeStyle);
    list.text(notice.remedy, {kMiddle, y + kBelowNotice}, centered(kHintHeight));
    y += kNoticePitch;
  }
  list.draw_on(Layer::symbols);
}

namespace {

constexpr float kSmallHeight = 9.0F;   // [units] cap height of the velocity differences of IPVU
constexpr float kLargeHeight = 14.0F;  // [units] cap height of the texts in mode PVU

struct Row {
  const char* name;
  const char* abbreviation;
  double value_mps;
};

std::array<Row, 3> rows(const databuffer::RadarState& state) {
  return {Row{"ALONG", "AL", state.velocity_along_mps}, Row{"ACROSS", "AX", state.velocity_across_mps},
          Row{"VERTICAL", "VT", state.velocity_vertical_mps}};
}

bool shown(const databuffer::RadarState& state) {
  return (state.flags & databuffer::kVelocityShown) != 0;
}

// Formats a velocity in ft/s. Small negative values give "+0.0" instead of "-0.0".
std::string_view feet_per_second(Buffer& buffer, const char* format, double value_mps) {
  const double value = geo::Length::metres(value_mps).feet();
  return formatted(buffer, format, value > -0.05 && value < 0.0 ? 0.0 : value);
}

}  // namespace

void draw_velocity_differences(const databuffer::RadarState& state, DrawList& list) {
  if (!shown(state)) return;
  // The texts are in the right column, between the legends of PB 15 and 14.
  constexpr float right = kDisplayUnits - 6.0F, value_left = right - 40.0F;
  float y = 98.0F;
  draw_readout("FT/S", {right, y}, {kSmallHeight, Align::right}, list);
  constexpr TextStyle kStyle{kSmallHeight, Align::right};
  for (const Row& row : rows(state)) {
    y += 13.0F;
    Buffer buffer;
    const std::string_view value = feet_per_second(buffer, "%+.1f", row.value_mps);
    const Rect both = around(text_box(row.abbreviation, {value_left, y}, kStyle), text_box(value, {right, y}, kStyle));
    const float aside = step_aside(both, inward(kStyle.align), list);
    list.text(row.abbreviation, {value_left + aside, y}, kStyle);
    list.text(value, {right + aside, y}, kStyle);
  }
}

void draw_velocity_format(const DisplayInput& input, DrawList& list) {
  constexpr float left = 130.0F, right = 350.0F;
  float y = 168.0F;  // keeps all rows above the notices of draw_silent
  for (const Row& row : rows(input.state)) {
    Buffer buffer;
    list.text(row.name, {left, y}, {kLargeHeight, Align::left});
    list.text(shown(input.state) ? feet_per_second(buffer, "%+.1f FT/S", row.value_mps) : "--- FT/S", {right, y},
              {kLargeHeight, Align::right});
    y += 28.0F;
  }
  y += 14.0F;
  Buffer buffer;
  list.text("BEAM", {left, y}, {kLargeHeight, Align::left});
  list.text(input.model.velocity_beam == 0 ? "-" : formatted(buffer, "%.0f", input.model.velocity_beam), {right, y},
            {kLargeHeight, Align::right});
  // In PVU the display shows no ground and thus no outline of a map that forms. A text shows the progress of the map.
  if (!(input.model.map_window_nm > 0.0)) return;
  constexpr float map_row = 140.0F;
  Buffer progress;
  const double percent = std::isfinite(input.model.map_progress) ? 100.0 * input.model.map_progress : 0.0;
  list.text("MAP", {left, map_row}, {kLargeHeight, Align::left});
  list.text(formatted(progress, "%.0f %%", std::floor(percent)), {right, map_row}, {kLargeHeight, Align::right});
}

}  // namespace yars::display
