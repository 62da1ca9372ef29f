#include "display/markers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "databuffer/records/navigation.hpp"
#include "databuffer/records/plain_text.hpp"
#include "lib/radar/limits.hpp"
#include "lib/radar/modes.hpp"

namespace yars::display {

namespace {

constexpr float kRadius = 6.0F;                   // [units] of a point's symbol
constexpr float kGapInside = 7.0F, kArm = 16.0F;  // [units] of the plus: a point's symbol fits into its middle
constexpr float kNameText = 9.0F;

bool on_glass(Point at) {
  return at.x >= 0.0F && at.y >= 0.0F && at.x <= kGlassUnits && at.y <= kGlassUnits;
}

void draw_square(Point at, bool dashed, DrawList& list) {
  constexpr float r = kRadius - 0.5F;
  const std::array<Point, 4> corners{Point{at.x - r, at.y - r}, Point{at.x + r, at.y - r}, Point{at.x + r, at.y + r},
                                     Point{at.x - r, at.y + r}};
  list.polygon(corners, dashed);
}

void draw_triangle(Point at, bool dashed, DrawList& list) {
  constexpr float r = kRadius + 1.5F;
  const float half = r * std::numbers::sqrt3_v<float> / 2.0F;
  const std::array<Point, 3> corners{Point{at.x, at.y - r}, Point{at.x + half, at.y + r / 2.0F},
                                     Point{at.x - half, at.y + r / 2.0F}};
  list.polygon(corners, dashed);
}

// "3.2" belongs to point "3".
bool is_offset_of_initial_point(std::string_view name, std::span<const radar::RoutePoint> route) {
  const std::string_view base = name.substr(0, name.find('.'));
  return std::ranges::any_of(route, [&](const radar::RoutePoint& point) {
    return point.kind == radar::PointKind::initial && point.name == base;
  });
}

void draw_symbol(const databuffer::DrawnPoint& point, std::span<const radar::RoutePoint> route, Point at,
                 DrawList& list) {
  switch (static_cast<radar::PointKind>(point.kind)) {
    case radar::PointKind::steer:
      list.circle(at, kRadius, false);
      return;
    case radar::PointKind::initial:
      draw_square(at, false, list);
      return;
    case radar::PointKind::target:
      draw_triangle(at, false, list);
      return;
    case radar::PointKind::steer_offset:
      if (is_offset_of_initial_point(databuffer::text_of(point.name), route)) {
        draw_square(at, true, list);
      } else {
        list.circle(at, kRadius, true);
      }
      return;
    case radar::PointKind::target_offset:
      draw_triangle(at, true, list);
      return;
  }
}

// Where the open plus stands; nothing when it is not on the glass.
std::optional<Point> cursor_at(const GlassInput& input, const GlassView& view, const GlassFrame& frame) {
  if ((input.state.flags & databuffer::kCursorValid) == 0) return std::nullopt;
  const geo::GeoPoint place{input.state.cursor_latitude_deg, input.state.cursor_longitude_deg};
  const Point at = view.at_ground(frame, place);
  return on_glass(at) ? std::optional(at) : std::nullopt;
}

// What the arms of the plus cover; a name may stand in the corners between them.
std::array<Rect, 2> arms_of(Point cursor) {
  constexpr float clear = 2.0F;
  return {Rect{cursor.x - kArm, cursor.y - clear, cursor.x + kArm, cursor.y + clear},
          Rect{cursor.x - clear, cursor.y - kArm, cursor.x + clear, cursor.y + kArm}};
}

void draw_name(std::string_view name, Point at, std::optional<Point> cursor, DrawList& list) {
  struct Place {
    float right, down;
    Align align;
  };
  constexpr float side = kRadius + 4.0F;
  constexpr float lift = 11.0F;
  constexpr std::array places{Place{side, -lift, Align::left}, Place{side, lift, Align::left},
                              Place{-side, -lift, Align::right}, Place{-side, lift, Align::right}};
  const auto box_at = [&](const Place& place) {
    return text_box(name, {at.x + place.right, at.y + place.down}, {kNameText, place.align});
  };
  const auto is_free = [&](const Place& place) {
    const Rect box = box_at(place);
    const bool inside = box.left >= 0.0F && box.top >= 0.0F && box.right <= kGlassUnits && box.bottom <= kGlassUnits;
    const auto covers = [&](const Rect& arm) { return intersect(box, arm); };
    if (cursor && std::ranges::any_of(arms_of(*cursor), covers)) return false;
    return inside &&
           std::ranges::none_of(list.occupied(), [&](const OccupiedBox& other) { return intersect(box, other.rect); });
  };
  const auto* chosen = std::ranges::find_if(places, is_free);
  if (chosen == places.end()) chosen = places.begin();
  list.text(name, {at.x + chosen->right, at.y + chosen->down}, {kNameText, chosen->align});
}

}  // namespace

void draw_cursor(const GlassInput& input, const GlassView& view, const GlassFrame& frame, DrawList& list) {
  const std::optional<Point> cursor = cursor_at(input, view, frame);
  if (!cursor) return;
  const Point at = *cursor;
  list.line({at.x - kArm, at.y}, {at.x - kGapInside, at.y});
  list.line({at.x + kGapInside, at.y}, {at.x + kArm, at.y});
  list.line({at.x, at.y - kArm}, {at.x, at.y - kGapInside});
  list.line({at.x, at.y + kGapInside}, {at.x, at.y + kArm});
}

void draw_window_outline(const GlassInput& input, const GlassView& view, const GlassFrame& frame, DrawList& list) {
  const databuffer::ModelStatus& model = input.model;
  // Until the model has taken the command up it tells of another map, or of none.
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
  list.polygon(corners, false);
}

void draw_points(const GlassInput& input, std::span<const radar::RoutePoint> route, const GlassView& view,
                 const GlassFrame& frame, DrawList& list) {
  struct Shown {
    const databuffer::DrawnPoint* point;
    Point at;
  };
  std::array<Shown, radar::kMaxPointsDrawn> shown;
  std::size_t count = 0;
  const std::size_t given = std::min<std::size_t>(input.state.points_drawn, radar::kMaxPointsDrawn);
  const auto belief = databuffer::belief_in_use(input.ownship, input.nav, input.state);
  for (const databuffer::DrawnPoint& point : std::span(input.state.points).first(given)) {
    const geo::GeoPoint place{point.latitude_deg, point.longitude_deg};
    const Point at = view.at_ground(frame, belief.on_video(place));
    if (!on_glass(at)) continue;
    draw_symbol(point, route, at, list);
    list.occupy("point", grown({at.x, at.y, at.x, at.y}, kRadius + 1.0F));
    shown[count++] = {&point, at};
  }
  // Names after all symbols, so that none of them is written over.
  const std::optional<Point> cursor = cursor_at(input, view, frame);
  for (const Shown& one : std::span(shown).first(count)) {
    draw_name(databuffer::text_of(one.point->name), one.at, cursor, list);
  }
}

}  // namespace yars::display
