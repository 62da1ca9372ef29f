// A place on the glass, in glass units: 480 to the edge of the square, x right, y down, origin upper left.
#pragma once

#include <cstdint>

namespace yars::display {

inline constexpr float kGlassUnits = 480.0F;  // edge of the glass; the legends' layout is measured in it

struct Point {
  float x = 0.0F;
  float y = 0.0F;
  friend bool operator==(const Point&, const Point&) = default;
};

struct Rect {
  float left = 0.0F, top = 0.0F, right = 0.0F, bottom = 0.0F;
  friend bool operator==(const Rect&, const Rect&) = default;
};

// True when they share area; touching edges do not count.
inline bool intersect(const Rect& a, const Rect& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

inline Rect grown(const Rect& rect, float by) {
  return {rect.left - by, rect.top - by, rect.right + by, rect.bottom + by};
}

}  // namespace yars::display
