// A place on the glass, in glass units: 480 to the edge of the square, x right, y down, origin upper left.
#pragma once

#include <algorithm>
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

// True when a part of the line from one point to the other lies within; touching an edge does not count.
inline bool crosses(const Rect& rect, Point from, Point to) {
  float begin = 0.0F, end = 1.0F;  // shares of the line that lie between the edges
  const auto cut = [&](float at, float step, float low, float high) {
    if (step == 0.0F) {
      if (at <= low || at >= high) end = -1.0F;
      return;
    }
    const float first = (low - at) / step, second = (high - at) / step;
    begin = std::max(begin, std::min(first, second));
    end = std::min(end, std::max(first, second));
  };
  cut(from.x, to.x - from.x, rect.left, rect.right);
  cut(from.y, to.y - from.y, rect.top, rect.bottom);
  return begin < end;
}

inline Rect grown(const Rect& rect, float by) {
  return {rect.left - by, rect.top - by, rect.right + by, rect.bottom + by};
}

}  // namespace yars::display
