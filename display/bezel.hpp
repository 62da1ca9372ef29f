// The twenty buttons around the glass: 1-5 down the left, 6-10 along the bottom left to right, 11-15 up the right,
// 16-20 along the top right to left. A legend stands beside its button, inside the glass.
#pragma once

#include <optional>

#include "display/draw_list.hpp"
#include "display/point.hpp"

namespace yars::display {

struct LegendPlace {
  Point at;  // reference point of the text, middle of its height
  Align align = Align::center;
};

// `button` is 1..20.
LegendPlace legend_place(int button);

// The button whose legend area lies under a click at `at`; nothing in the middle and in the corners.
std::optional<int> button_at(Point at);

}  // namespace yars::display
