#include "display/velocity_readouts.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "display/readouts.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::display {

namespace {

constexpr float kSmallText = 9.0F;
constexpr float kLargeText = 14.0F;

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


// "+0.0" and "-0.0" are one thing.
std::string_view feet_per_second(Buffer& buffer, const char* format, double value_mps) {
  const double value = geo::Length::metres(value_mps).feet();
  const int length = std::snprintf(buffer.data(), buffer.size(), format, value > -0.05 && value < 0.0 ? 0.0 : value);
  return {buffer.data(), static_cast<std::size_t>(length > 0 ? length : 0)};
}

}  // namespace

void draw_velocity_differences(const databuffer::RadarState& state, DrawList& list) {
  if (!shown(state)) return;
  // In the right column, between the legends of PB 15 and 14.
  constexpr float right = kGlassUnits - 6.0F, value_left = right - 40.0F;
  float y = 98.0F;
  list.text("FT/S", {right, y}, {kSmallText, Align::right});
  for (const Row& row : rows(state)) {
    y += 13.0F;
    Buffer buffer;
    list.text(row.abbreviation, {value_left, y}, {kSmallText, Align::right});
    draw_number(feet_per_second(buffer, "%+.1f", row.value_mps), {right, y}, {kSmallText, Align::right}, list);
  }
}

void draw_velocity_format(const GlassInput& input, DrawList& list) {
  constexpr float left = 130.0F, right = 350.0F;
  float y = 168.0F;  // all rows above the place of what has gone silent
  for (const Row& row : rows(input.state)) {
    Buffer buffer;
    list.text(row.name, {left, y}, {kLargeText, Align::left});
    list.text(shown(input.state) ? feet_per_second(buffer, "%+.1f FT/S", row.value_mps) : "--- FT/S", {right, y},
              {kLargeText, Align::right});
    y += 28.0F;
  }
  y += 14.0F;
  Buffer buffer;
  list.text("BEAM", {left, y}, {kLargeText, Align::left});
  const int length = std::snprintf(buffer.data(), buffer.size(), "%d", input.model.velocity_beam);
  const std::string_view beam = input.model.velocity_beam == 0
                                    ? std::string_view("-")
                                    : std::string_view(buffer.data(), static_cast<std::size_t>(length));
  list.text(beam, {right, y}, {kLargeText, Align::right});
  // There is no picture to draw a window on: a map that forms is told in words.
  if (!(input.model.map_window_nm > 0.0)) return;
  constexpr float map_row = 140.0F;
  Buffer share;
  const double percent = std::isfinite(input.model.map_progress) ? 100.0 * input.model.map_progress : 0.0;
  const int written = std::snprintf(share.data(), share.size(), "%.0f %%", std::floor(percent));
  list.text("MAP", {left, map_row}, {kLargeText, Align::left});
  list.text({share.data(), static_cast<std::size_t>(written)}, {right, map_row}, {kLargeText, Align::right});
}

}  // namespace yars::display
