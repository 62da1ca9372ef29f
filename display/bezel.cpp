#include "display/bezel.hpp"

#include <array>
#include <cmath>

#include "lib/failure/require.hpp"
#include "lib/radar/limits.hpp"

namespace yars::display {

namespace {

constexpr float kFirst = 80.0F;     // [units] middle of the first button of a side, from the corner
constexpr float kPitch = 80.0F;     // [units] from button to button
constexpr float kMargin = 6.0F;     // [units] text to the edge
constexpr float kTopRow = 12.0F;    // [units] middle of the legends along the top
constexpr float kReach = 44.0F;     // [units] a click counts this far in from the edge; corners stay free
constexpr float kHalfZone = 34.0F;  // [units] and this far to either side of the button's middle

float along(int index) {
  return kFirst + kPitch * static_cast<float>(index);
}

// Index 0-4 of the button zone at a coordinate along a side.
std::optional<int> index_along(float coordinate) {
  const int index = static_cast<int>(std::lround((coordinate - kFirst) / kPitch));
  if (index < 0 || index > 4 || std::abs(coordinate - along(index)) > kHalfZone) return std::nullopt;
  return index;
}

}  // namespace

LegendPlace legend_place(int button) {
  YARS_REQUIRE(button, >=, 1);
  YARS_REQUIRE(button, <=, radar::kBezelButtons);
  const int side = (button - 1) / 5;
  const int index = (button - 1) % 5;
  switch (side) {
    case 0:
      return {{kMargin, along(index)}, Align::left};
    case 1:
      return {{along(index), kGlassUnits - kTopRow}, Align::center};
    case 2:
      return {{kGlassUnits - kMargin, along(4 - index)}, Align::right};
    default:
      return {{along(4 - index), kTopRow}, Align::center};
  }
}

std::optional<int> button_at(Point at) {
  if (at.x < 0.0F || at.y < 0.0F || at.x > kGlassUnits || at.y > kGlassUnits) return std::nullopt;
  const std::optional<int> row = index_along(at.y);
  const std::optional<int> column = index_along(at.x);
  if (row && at.x <= kReach) return 1 + *row;
  if (column && at.y >= kGlassUnits - kReach) return 6 + *column;
  if (row && at.x >= kGlassUnits - kReach) return 15 - *row;
  if (column && at.y <= kReach) return 20 - *column;
  return std::nullopt;
}

}  // namespace yars::display
