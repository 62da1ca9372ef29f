// What the tests of the symbols share: a picture as a list, its words, and whether anything lies over anything.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "display/present_frame.hpp"
#include "display/symbology.hpp"
#include "tests/display/glass_states.hpp"

namespace yars::display::testing {

inline DrawList drawn(const GlassInput& input, const radar::RadarConfiguration& configuration = {}) {
  const GlassView view(configuration.view);
  DrawList list;
  draw_symbology(input, configuration, view, present_frame(input, nullptr), list);
  return list;
}

inline std::vector<std::string> words(const DrawList& list) {
  std::vector<std::string> names;
  for (const OccupiedBox& box : list.occupied()) names.push_back(box.name);
  return names;
}

inline std::vector<std::string> words(const GlassInput& input) {
  return words(drawn(input));
}

inline std::size_t strokes(const DrawList& list) {
  return list.content(Layer::grid).strokes.size() + list.content(Layer::symbols).strokes.size() +
         list.content(Layer::notices).strokes.size();
}

inline void expect_no_overlap(const DrawList& list, const std::string& what) {
  const auto& boxes = list.occupied();
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    const Rect& rect = boxes[a].rect;
    EXPECT_TRUE(rect.left >= 0.0F && rect.top >= 0.0F && rect.right <= kGlassUnits && rect.bottom <= kGlassUnits)
        << what << ": " << boxes[a].name << " leaves the glass";
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      EXPECT_FALSE(intersect(rect, boxes[b].rect)) << what << ": " << boxes[a].name << " over " << boxes[b].name;
    }
  }
}

// Everything that can be lit at once is lit, each at its widest.
inline GlassInput crowded(radar::Mode mode, double range_nm) {
  GlassInput input = operating(mode, range_nm);
  input.state.boxed = ~0U;
  input.state.brightness = 15;
  input.state.window_nm = 0.67;
  input.state.flags |= databuffer::kFreeze;
  put_cursor(input, 359.7, range_nm);
  set_text(input.state.message, "SIXTEEN LETTERS AND THEN SOME MO");
  input.model.map_timer_s = 120.0;
  if (mode == radar::Mode::patch || mode == radar::Mode::ranging) put_map(input, 60.0, 20.0, 4.7);
  put_forming_map(input, 60.0, 20.0, 4.7);
  put_update(input, 2999.0, -22.0, 30);
  put_velocities(input, -188.8, 188.8, -188.8);
  input.model.velocity_beam = 3;
  input.model_alive = input.ownship_fresh = input.state_machine_alive = false;
  return input;
}

}  // namespace yars::display::testing
