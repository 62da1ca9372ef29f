#include "display/symbology/ground_symbols.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string_view>

#include "databuffer/messages/derived_values.hpp"
#include "display/symbology/readouts.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::display {

namespace {

constexpr float kSymbolRadius = 6.0F;  // [display units] radius of a point's symbol
// [display units] Distances of the inner and outer ends of the cursor's arms from its centre. The circle or square of a
// point fits between the inner ends.
constexpr float kGapInside = 7.0F, kArm = 16.0F;
// [display units] Minimum distance from a symbol to a text: kMarginDrawn if the last picture had the symbol's name,
// else kMarginNew. Without this hysteresis the symbol could blink.
constexpr float kMarginDrawn = 2.5F, kMarginNew = 4.0F;
constexpr float kArmHalfWidth = 2.0F;  // [display units] half width of a cursor arm with its halo

bool on_display(Point at) {
  return at.x >= 0.0F && at.y >= 0.0F && at.x <= kDisplayUnits && at.y <= kDisplayUnits;
}

void draw_square(Point at, bool dashed, DrawList& list) {
  constexpr float r = kSymbolRadius - 0.5F;
  const std::array<Point, 4> corners{Point{at.x - r, at.y - r}, Point{at.x + r, at.y - r}, Point{at.x + r, at.y + r},
                                     Point{at.x - r, at.y + r}};
  list.polygon(corners, dashed);
}

void draw_triangle(Point at, bool dashed, DrawList& list) {
  constexpr float r = kSymbolRadius + 1.5F;
  const float half = r * std::numbers::sqrt3_v<float> / 2.0F;
  const std::array<Point, 3> corners{Point{at.x, at.y - r}, Point{at.x + half, at.y + r / 2.0F},
                                     Point{at.x - half, at.y + r / 2.0F}};
  list.polygon(corners, dashed);
}

void draw_symbol(const databuffer::DrawnPoint& point, Point at, DrawList& list) {
  switch (static_cast<radar::PointKind>(point.kind)) {
    case radar::PointKind::steer:
      list.circle(at, kSymbolRadius, false);
      return;
    case radar::PointKind::initial:
      draw_square(at, false, list);
      return;
    case radar::PointKind::target:
      draw_triangle(at, false, list);
      return;
    case radar::PointKind::steer_offset:
      if (point.of_initial_point != 0) {
        draw_square(at, true, list);
      } else {
        list.circle(at, kSymbolRadius, true);
      }
      return;
    case radar::PointKind::target_offset:
      draw_triangle(at, true, list);
      return;
  }
}

std::span<const databuffer::DrawnPoint> points_of(const databuffer::RadarState& state) {
  return std::span(state.points).first(std::min<std::size_t>(state.points_drawn, radar::kMaxPointsDrawn));
}

NameRank rank_of(const databuffer::DrawnPoint& point, const databuffer::RadarState& state) {
  if (point.selected != 0) return NameRank::selected;
  const bool designated = (state.flags & databuffer::kTargetDesignated) != 0 &&
                          text::text_of(point.name) == text::text_of(state.target_name);
  return designated ? NameRank::target : NameRank::other;
}

// True if a symbol at `at` would be less than `margin` from a text or a solid scale. Overlap with thin symbols is
// allowed: carets, ticks of the elevation scale, and the pitch ball.
bool is_covered(Point at, float margin, const DrawList& list) {
  const Rect symbol = grown({at.x, at.y, at.x, at.y}, kSymbolRadius + margin);
  return std::ranges::any_of(list.occupied(), [&symbol](const OccupiedBox& box) {
    const bool covers = box.kind == BoxKind::text || box.kind == BoxKind::solid;
    return covers && intersect(symbol, box.rect);
  });
}

// Draws the parts of a cursor arm that lie clear of all texts. `out`: unit vector along the arm.
void draw_arm(Point at, Point out, DrawList& list) {
  // [display units] The ink of a text reaches 0.7 beyond its box, that of an arm with its halo 2.1 from its centre
  // line.
  constexpr float kAroundText = 3.0F;
  constexpr float kStep = 0.25F, kShortest = 1.5F;  // [display units] resolution of a cut; shorter parts are left out
  const auto on_arm = [&](float along) { return Point{at.x + out.x * along, at.y + out.y * along}; };
  const auto is_free = [&](float along) {
    const Point point = on_arm(along);
    return std::ranges::none_of(list.occupied(), [&](const OccupiedBox& box) {
      const Rect text = grown(box.rect, kAroundText);
      return (box.kind == BoxKind::text || box.kind == BoxKind::label) && point.x > text.left && point.x < text.right &&
             point.y > text.top && point.y < text.bottom;
    });
  };
  const int steps = static_cast<int>((kArm - kGapInside) / kStep);
  const auto along_of = [](int step) { return kGapInside + kStep * static_cast<float>(step); };
  for (int first = 0; first <= steps; ++first) {
    int last = first - 1;
    while (last < steps && is_free(along_of(last + 1))) ++last;
    if (along_of(last) - along_of(first) >= kShortest) list.line(on_arm(along_of(first)), on_arm(along_of(last)));
    first = std::max(first, last + 1);
  }
}

}  // namespace

std::optional<Point> cursor_at(const DisplayInput& input, const PlanView& view, const ViewFrame& frame) {
  if ((input.state.flags & databuffer::kCursorValid) == 0) return std::nullopt;
  const geo::GeoPoint position{input.state.cursor_latitude_deg, input.state.cursor_longitude_deg};
  const Point at = view.at_ground(frame, position);
  // The TDC stops the cursor at the edge. Rounding must not take it off the display there.
  constexpr float kAllowance = 0.5F;
  const Point inside{std::clamp(at.x, 0.0F, kDisplayUnits), std::clamp(at.y, 0.0F, kDisplayUnits)};
  const bool shown = std::abs(at.x - inside.x) <= kAllowance && std::abs(at.y - inside.y) <= kAllowance;
  return shown ? std::optional(inside) : std::nullopt;
}

void draw_cursor(Point at, DrawList& list) {
  list.draw_on(Layer::steered);
  for (const Point out : {Point{-1.0F, 0.0F}, Point{1.0F, 0.0F}, Point{0.0F, -1.0F}, Point{0.0F, 1.0F}})
    draw_arm(at, out, list);
  list.draw_on(Layer::symbols);
}

void occupy_cursor(Point at, DrawList& list) {
  // Two boxes, one per line of the cross, leave the four corners between the arms free for a name.
  list.occupy("cursor",
              {at.x - kArm - kArmHalfWidth, at.y - kArmHalfWidth, at.x + kArm + kArmHalfWidth, at.y + kArmHalfWidth},
              BoxKind::cursor);
  list.occupy("cursor",
              {at.x - kArmHalfWidth, at.y - kArm - kArmHalfWidth, at.x + kArmHalfWidth, at.y + kArm + kArmHalfWidth},
              BoxKind::cursor);
}

bool cursor_is_off(const DisplayInput& input, const PlanView& view, const ViewFrame& frame) {
  return (input.state.flags & databuffer::kCursorValid) != 0 && !cursor_at(input, view, frame);
}

void draw_window_outline(const DisplayInput& input, const PlanView& view, const ViewFrame& frame, DrawList& list) {
  const databuffer::ModelStatus& model = input.model;
  // Until radar-model has accepted the command, its status describes another map or no map.
  const bool forms = (input.state.flags & databuffer::kMapping) != 0 && model.map_request == input.state.map_request &&
                     model.map_window_nm > 0.0;
  if (!forms) return;
  const Point centre = view.at_ground(frame, {model.map_latitude_deg, model.map_longitude_deg});
  const double turn_rad = (geo::Bearing::degrees(model.map_up_deg) - frame.up).radians();
  const double half_m = model.map_window_nm * geo::kMetresPerNauticalMile / 2.0;
  const auto half = static_cast<float>(half_m / frame.range_m * static_cast<double>(view.units_per_range()));
  const Point up{half * static_cast<float>(std::sin(turn_rad)), -half * static_cast<float>(std::cos(turn_rad))};
  const Point right{-up.y, up.x};
  const std::array<Point, 4> corners{Point{centre.x - right.x + up.x, centre.y - right.y + up.y},
                                     Point{centre.x + right.x + up.x, centre.y + right.y + up.y},
                                     Point{centre.x + right.x - up.x, centre.y + right.y - up.y},
                                     Point{centre.x - right.x - up.x, centre.y - right.y - up.y}};
  list.draw_on(Layer::lines);
  list.polygon(corners, false);
  list.draw_on(Layer::symbols);
}

PlacedPoints place_points(const DisplayInput& input, const PlanView& view, const ViewFrame& frame,
                          const LabelMemory& labels, const DrawList& list) {
  PlacedPoints placed;
  const auto navigator = databuffer::selected_navigator_position(input.ownship, input.nav, input.state);
  const auto points = points_of(input.state);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point at = view.at_ground(frame, navigator.on_video({points[i].latitude_deg, points[i].longitude_deg}));
    const float margin = labels.names(text::text_of(points[i].name)) ? kMarginDrawn : kMarginNew;
    const bool always = rank_of(points[i], input.state) != NameRank::other;
    if (on_display(at) && (always || !is_covered(at, margin, list))) placed[i] = at;
  }
  return placed;
}

void draw_points(const databuffer::RadarState& state, const PlacedPoints& placed, DrawList& list) {
  list.draw_on(Layer::points);
  const auto points = points_of(state);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!placed[i]) continue;
    const Point at = *placed[i];
    draw_symbol(points[i], at, list);
    const NameRank rank = rank_of(points[i], state);
    const char* const name = rank == NameRank::selected ? "selected point"
                             : rank == NameRank::target ? "designated target"
                                                        : "point";
    list.occupy(name, grown({at.x, at.y, at.x, at.y}, kSymbolRadius + 1.0F), BoxKind::point);
  }
  list.draw_on(Layer::symbols);
}

void add_names(const databuffer::RadarState& state, const PlacedPoints& placed, NameRank rank, LabelQueue& queue) {
  const auto points = points_of(state);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (placed[i] && rank_of(points[i], state) == rank)
      queue.add(label_of(LabelRole::name, text::text_of(points[i].name), *placed[i]));
  }
}

namespace {

using databuffer::SteeringLine;

// [display units] Distances of the ends of the steering line from the target. kBegin is clear of the target's symbol.
constexpr float kBegin = 10.0F, kEnd = 70.0F;
constexpr float kArrow = 8.0F, kRing = 4.0F;  // [display units] length of an arrowhead's side; radius of the circle

// The point at `distance` [display units] from `from`. Direction: clockwise from up [deg].
Point offset_point(Point from, double direction_deg, float distance) {
  const double angle_rad = direction_deg * geo::kRadiansPerDegree;
  return {from.x + distance * static_cast<float>(std::sin(angle_rad)),
          from.y - distance * static_cast<float>(std::cos(angle_rad))};
}

// Arrowhead with its tip at `end`, pointing along the approach to the target.
void draw_arrowhead(Point end, double approach_deg, DrawList& list) {
  constexpr double kSpread_deg = 150.0;  // angle between the approach direction and a side
  const std::array<Point, 3> head{offset_point(end, approach_deg - kSpread_deg, kArrow), end,
                                  offset_point(end, approach_deg + kSpread_deg, kArrow)};
  list.polyline(head);
}

// Distance from the target at which the line ends: before the first fixed text on its way, at most kEnd. A target near
// the edge, as one astern, has texts there.
float end_of_line(Point target, double back_deg, const DrawList& list) {
  constexpr float kLineStep = 2.0F, kFreeOfText = kArrow + 1.0F;  // [display units] arrowhead and circle are free, too
  const Point begin = offset_point(target, back_deg, kBegin);
  const auto is_free = [&](float distance) {
    return std::ranges::none_of(list.occupied(), [&](const OccupiedBox& box) {
      return box.kind == BoxKind::text &&
             crosses(grown(box.rect, kFreeOfText), begin, offset_point(target, back_deg, distance));
    });
  };
  float end = kBegin;
  while (end < kEnd && is_free(end + kLineStep)) end += kLineStep;
  return end;
}

Label heading_label(const databuffer::RadarState& state, Point target) {
  std::array<char, 16> text{};
  // 359.6 deg rounds to 360, which is shown as 000.
  const double heading_deg = state.steering_line_deg - state.magnetic_variation_deg;
  const double shown_deg = std::fmod(std::round(heading_deg) + 720.0, 360.0);
  const int length = std::snprintf(text.data(), text.size(), "%03.0f\u00b0 %s", shown_deg, north_of_bearings(state));
  const auto size = std::min(static_cast<std::size_t>(std::max(length, 0)), text.size() - 1);
  return label_of(LabelRole::heading, {text.data(), size}, target);
}

}  // namespace

std::optional<Label> draw_steering_line(const DisplayInput& input, const PlanView& view, const ViewFrame& frame,
                                        DrawList& list) {
  const databuffer::RadarState& state = input.state;
  const auto line = static_cast<SteeringLine>(state.steering_line);
  if ((state.flags & databuffer::kTargetDesignated) == 0 || line == SteeringLine::none) return std::nullopt;
  const auto navigator = databuffer::selected_navigator_position(input.ownship, input.nav, state);
  const Point target =
      view.at_ground(frame, navigator.on_video({state.target_latitude_deg, state.target_longitude_deg}));
  if (!on_display(target)) return std::nullopt;
  const double approach_deg = (geo::Bearing::degrees(state.steering_line_deg) - frame.up).degrees();
  const double back_deg = approach_deg + 180.0;
  const float length = end_of_line(target, back_deg, list);
  const auto heading = heading_label(state, target);
  if (length < kBegin + kArrow) return heading;
  const Point end = offset_point(target, back_deg, length);
  list.draw_on(Layer::lines);
  const bool ring = line == SteeringLine::fixed;
  list.line(offset_point(target, back_deg, kBegin), ring ? offset_point(target, back_deg, length - kRing) : end);
  if (ring) list.circle(end, kRing);
  if (line == SteeringLine::slewing) draw_arrowhead(end, approach_deg, list);
  list.draw_on(Layer::symbols);
  return heading;
}

}  // namespace yars::display
