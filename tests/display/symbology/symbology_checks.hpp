// Helpers of the symbology tests: the draw list of a picture, its texts and its strokes.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "display/symbology/plan_view.hpp"
#include "display/symbology/symbology.hpp"
#include "tests/display/symbology/display_states.hpp"

namespace yars::display::testing {

inline DrawList drawn(const DisplayInput& input, const radar::RadarConfiguration& configuration = {}) {
  const PlanView view(configuration.view);
  DrawList list;
  LabelMemory labels;
  draw_symbology(input, configuration, view, present_frame(input, nullptr), labels, list);
  return list;
}

// Names of all occupied boxes: the texts, and the kinds of scales and symbols.
inline std::vector<std::string> words(const DrawList& list) {
  std::vector<std::string> names;
  for (const OccupiedBox& box : list.occupied()) names.push_back(box.name);
  return names;
}

inline std::vector<std::string> words(const DisplayInput& input) {
  return words(drawn(input));
}

// The texts that stand at fixed places, sorted: neither names of points nor the heading of the steering line.
inline std::vector<std::string> texts(const DrawList& list) {
  std::vector<std::string> found;
  for (const OccupiedBox& box : list.occupied())
    if (box.kind == BoxKind::text) found.push_back(box.name);
  std::ranges::sort(found);
  return found;
}

inline std::size_t strokes(const DrawList& list) {
  std::size_t count = 0;
  for (std::size_t layer = 0; layer < kLayers; ++layer) count += list.content(static_cast<Layer>(layer)).strokes.size();
  return count;
}

// The strokes of all layers except the grid.
inline std::vector<Segment> symbol_strokes(const DrawList& list) {
  std::vector<Segment> all;
  for (const Layer layer : {Layer::lines, Layer::points, Layer::symbols, Layer::notices, Layer::steered}) {
    const auto& strokes = list.content(layer).strokes;
    all.insert(all.end(), strokes.begin(), strokes.end());
  }
  return all;
}

// Strokes of `with` that `without` does not have. The grid is not compared.
inline std::vector<Segment> more_strokes(const DrawList& with, const DrawList& without) {
  const auto base = symbol_strokes(without);
  std::vector<Segment> more;
  for (const Segment& segment : symbol_strokes(with))
    if (std::ranges::find(base, segment) == base.end()) more.push_back(segment);
  return more;
}

inline Rect bounds_of(const std::vector<Segment>& strokes) {
  Rect bounds{1e9F, 1e9F, -1e9F, -1e9F};
  for (const Segment& segment : strokes) {
    for (const Point& point : {segment.from, segment.to}) {
      bounds = {std::min(bounds.left, point.x), std::min(bounds.top, point.y), std::max(bounds.right, point.x),
                std::max(bounds.bottom, point.y)};
    }
  }
  return bounds;
}

inline Point middle_of(const Rect& rect) {
  return {(rect.left + rect.right) / 2.0F, (rect.top + rect.bottom) / 2.0F};
}

// A state with all indications that can be on at the same time, each with its widest text.
inline DisplayInput crowded(radar::Mode mode, double range_nm) {
  DisplayInput input = operating(mode, range_nm);
  input.state.boxed = ~0U;
  input.state.brightness = 15;
  input.state.window_nm = 0.67;
  input.state.flags |= databuffer::kFreeze;
  put_cursor(input, 359.7, range_nm);
  set_text(input.state.message, "SIXTEEN LETTERS AND THEN SOME MO");
  set_text(input.advice.remedy, "move the cursor out to 160.0 NM or more, or take window 0.67: acq aft (PgDn)");
  input.hints = true;
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
