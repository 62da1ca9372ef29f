// The glass's own vector font: capitals, digits and a few signs as polylines, readable at 10 units of height.
// In:  text, ASCII or UTF-8 of which only the degree sign is known; small letters read as capitals, but "v" is a
//      down arrow and "^" an up arrow, as the legends of PB 14 and 13 have them.
// Out: strokes in units of the cap height, x right, y down, origin at the left end of the base line.
// A character that the font has not is drawn as an empty box.
#pragma once

#include <span>
#include <string_view>

#include "display/point.hpp"

namespace yars::display {

// Called once for each polyline of the text; the points are valid during the call.
class StrokeSink {
 public:
  virtual void polyline(std::span<const Point> points) = 0;

 protected:
  ~StrokeSink() = default;
};

void stroke_text(std::string_view text, StrokeSink& sink);

// Width of the inked part, in cap heights.
float text_width(std::string_view text);

}  // namespace yars::display
