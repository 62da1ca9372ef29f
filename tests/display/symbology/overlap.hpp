// Finds forbidden overlaps of texts and symbols in a draw list. These overlaps are allowed:
// - a symbol over a symbol (points, cursor, ticks and carets): the ground or a scale fixes their positions;
// - a line on the ground, the selected point or the designated target behind a fixed text with a black plate;
// - these two points under a scale: they are always drawn;
// - any symbol over range arcs and the zero azimuth line.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "display/symbology/draw_list.hpp"

namespace yars::display::testing {

// Distance [units] from the centre line of a stroke to the edge of its ink: half of the stroke width 1.35 units, plus
// half a pixel of antialiasing. `size`: [pixels] edge of the display.
inline float ink(int size) {
  return 0.675F + 0.5F * kDisplayUnits / static_cast<float>(size);
}

inline bool is_word(const OccupiedBox& box) {
  return box.kind == BoxKind::text || box.kind == BoxKind::label;
}

// True when a black plate covers the text.
inline bool is_blanked(const DrawList& list, const OccupiedBox& text) {
  const auto covers = [&](const Rect& plate) {
    const Rect& box = text.rect;
    return plate.left < box.left && plate.top < box.top && plate.right > box.right && plate.bottom > box.bottom;
  };
  return std::ranges::any_of(list.content(Layer::symbols).plates, covers) ||
         std::ranges::any_of(list.content(Layer::notices).plates, covers);
}

// The selected point and the designated target are drawn wherever they are.
inline bool is_always_drawn(const OccupiedBox& box) {
  return box.kind == BoxKind::point && (box.name == "selected point" || box.name == "designated target");
}

// The boxes of the cursor and of a point that is always drawn may overlap a fixed text. overlaps() checks their
// strokes.
inline bool may_overlap(const OccupiedBox& word, const OccupiedBox& other) {
  return word.kind == BoxKind::text && (other.kind == BoxKind::cursor || is_always_drawn(other));
}

// Adds a sentence for each other point on a solid box, such as the gray scale or the ticks of the azimuth scale.
inline void add_points_on_scales(const DrawList& list, std::vector<std::string>& found) {
  for (const OccupiedBox& scale : list.occupied()) {
    if (scale.kind != BoxKind::solid) continue;
    for (const OccupiedBox& point : list.occupied()) {
      if (point.kind == BoxKind::point && !is_always_drawn(point) && intersect(scale.rect, point.rect))
        found.push_back("a point on the " + scale.name);
    }
  }
}

inline bool touch(const OccupiedBox& word, const OccupiedBox& other, int size) {
  // The box of a symbol already contains its ink. Half a pixel of antialiasing is no overlap with a symbol.
  return is_word(other) ? intersect(grown(word.rect, ink(size)), grown(other.rect, ink(size)))
                        : intersect(grown(word.rect, 0.675F), other.rect);
}

// One sentence for each forbidden overlap on a display of `size` pixels, and for each text beyond the display's edge.
inline std::vector<std::string> overlaps(const DrawList& list, int size) {
  std::vector<std::string> found;
  const auto& boxes = list.occupied();
  for (const OccupiedBox& word : boxes) {
    if (!is_word(word)) continue;
    const Rect& rect = word.rect;
    if (rect.left < 0.0F || rect.top < 0.0F || rect.right > kDisplayUnits || rect.bottom > kDisplayUnits)
      found.push_back(word.name + " extends beyond the display");
    for (const OccupiedBox& other : boxes) {
      const bool listed_before = is_word(other) && &other <= &word;
      if (listed_before || !touch(word, other, size)) continue;
      if (may_overlap(word, other)) continue;
      found.push_back(word.name + " over " + other.name);
    }
    const auto lies_behind = [&](const Segment& line) { return crosses(grown(rect, ink(size)), line.from, line.to); };
    // The ink of both strokes. No plate of a text hides the cursor.
    const auto under_cursor = [&](const Segment& line) {
      return crosses(grown(rect, 2.0F * ink(size)), line.from, line.to);
    };
    if (std::ranges::any_of(list.content(Layer::steered).strokes, under_cursor))
      found.push_back(word.name + " under the cursor");
    const bool blanked = word.kind == BoxKind::text && is_blanked(list, word);
    if (!blanked && (std::ranges::any_of(list.content(Layer::lines).strokes, lies_behind) ||
                     std::ranges::any_of(list.content(Layer::points).strokes, lies_behind)))
      found.push_back(word.name + " over a line on the ground");
  }
  add_points_on_scales(list, found);
  return found;
}

inline void expect_no_overlap(const DrawList& list, const std::string& what) {
  for (const int size : {480, 1024}) {
    for (const std::string& sentence : overlaps(list, size))
      ADD_FAILURE() << what << " at " << size << ": " << sentence;
  }
}

}  // namespace yars::display::testing
