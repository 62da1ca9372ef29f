#include "statemachine/sequence_points.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <span>
#include <string>

#include "databuffer/records/navigation.hpp"
#include "databuffer/records/plain_text.hpp"
#include "lib/geo/geodesic.hpp"
#include "lib/radar/point_name.hpp"
#include "statemachine/cursor.hpp"
#include "statemachine/designating.hpp"
#include "statemachine/switches.hpp"

namespace yars::statemachine {

namespace {

using databuffer::DrawnPoint;
using databuffer::RadarState;
using databuffer::text_of;
using radar::RoutePoint;

constexpr std::size_t kMostDrawn = 5;  // docs/spec/pilots_interface.md#rule-11; the record holds more
static_assert(kMostDrawn <= radar::kMaxPointsDrawn);

void put_name(char (&field)[8], std::string_view name) {
  std::memset(field, 0, sizeof(field));
  name.copy(field, sizeof(field) - 1);
}

// Among those of the route, and the target designated.
std::optional<RoutePoint> find_point(std::string_view name, const RadarState& state,
                                     const radar::RadarConfiguration& configuration) {
  const auto found = std::find_if(configuration.route.begin(), configuration.route.end(),
                                  [name](const RoutePoint& point) { return point.name == name; });
  if (found != configuration.route.end()) return *found;
  const auto target = designated_point(state);
  return target && target->name == name ? target : std::nullopt;
}

bool survives_declutter(const RoutePoint& point) {
  return point.kind == radar::PointKind::target || point.kind == radar::PointKind::target_offset;
}

void select(Step& step, const std::optional<RoutePoint>& point) {
  if (!point) return;
  put_name(step.state.sequence_point, point->name);
  jump_cursor(step.state, point->place, step.surroundings);
}

// The points to draw, kept sorted by distance while the route goes by; those always drawn go in at no distance.
class Nearest {
 public:
  void take(const RoutePoint* point, geo::Length distance) {
    if (!point) return;
    const auto end = entries_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto place =
        std::find_if(entries_.begin(), end, [distance](const Entry& entry) { return distance < entry.distance; });
    if (place == entries_.end()) return;
    std::move_backward(place, count_ < kMostDrawn ? end : end - 1, count_ < kMostDrawn ? end + 1 : end);
    *place = {point, distance};
    count_ = std::min(count_ + 1, kMostDrawn);
  }

  struct Entry {
    const RoutePoint* point = nullptr;
    geo::Length distance;
  };
  std::span<Entry> entries() { return {entries_.data(), count_}; }

 private:
  std::array<Entry, kMostDrawn> entries_{};
  std::size_t count_ = 0;
};

DrawnPoint drawn(const RoutePoint& point, bool selected) {
  DrawnPoint entry{};
  entry.latitude_deg = point.place.latitude_deg;
  entry.longitude_deg = point.place.longitude_deg;
  entry.elevation_m = point.elevation_m;
  put_name(entry.name, point.name);
  entry.kind = static_cast<std::uint8_t>(point.kind);
  entry.selected = selected ? 1 : 0;
  return entry;
}

}  // namespace

void next_sequence_point(Step& step) {
  const std::span points(step.state.points, step.state.points_drawn);
  if (points.empty()) return;
  const std::string_view present = text_of(step.state.sequence_point);
  const auto after = std::find_if(points.begin(), points.end(), [present](const DrawnPoint& point) {
    return radar::precedes(present, text_of(point.name));
  });
  const DrawnPoint& next = after == points.end() ? points.front() : *after;
  select(step, find_point(text_of(next.name), step.state, step.configuration));
}

void select_sequence_point(Step& step) {
  const std::string_view name = text_of(step.event.text);
  const auto point = find_point(name, step.state, step.configuration);
  if (!point) return refuse(step, "NO POINT " + std::string(name));
  select(step, point);
}

void select_first_sequence_point(RadarState& state, const radar::RadarConfiguration& configuration) {
  const auto first =
      std::min_element(configuration.route.begin(), configuration.route.end(),
                       [](const RoutePoint& a, const RoutePoint& b) { return radar::precedes(a.name, b.name); });
  put_name(state.sequence_point, first == configuration.route.end() ? std::string_view() : first->name);
}

std::optional<RoutePoint> selected_point(const RadarState& state, const radar::RadarConfiguration& configuration) {
  return find_point(text_of(state.sequence_point), state, configuration);
}

void draw_points(RadarState& state, const Surroundings& surroundings, const radar::RadarConfiguration& configuration) {
  const std::string_view selected = text_of(state.sequence_point);
  const std::optional<RoutePoint> target = designated_point(state);
  Nearest nearest;
  if (target) nearest.take(&*target, geo::Length());
  const auto is_target = [&target](const RoutePoint& point) { return target && point.name == target->name; };
  const geo::GeoPoint aircraft{surroundings.ownship.latitude_deg, surroundings.ownship.longitude_deg};
  const geo::Length range = geo::Length::nautical_miles(state.range_nm);
  for (const RoutePoint& point : configuration.route) {
    if (is_target(point)) continue;  // a point adopted is drawn once, as the target
    if (point.name == selected) {
      nearest.take(&point, geo::Length());
      continue;
    }
    if (!surroundings.ownship_valid) continue;
    if (has(state, databuffer::kDeclutter) && !survives_declutter(point)) continue;
    const geo::Length distance = geo::geodesic_inverse(aircraft, point.place).distance;
    if (distance <= range) nearest.take(&point, distance);
  }

  const auto entries = nearest.entries();
  const auto precedes = [](const auto& a, const auto& b) { return radar::precedes(a.point->name, b.point->name); };
  for (auto next = entries.begin(); next != entries.end(); ++next)
    std::rotate(std::upper_bound(entries.begin(), next, *next, precedes), next, next + 1);
  std::fill(std::begin(state.points), std::end(state.points), DrawnPoint{});
  std::transform(entries.begin(), entries.end(), state.points,
                 [selected](const auto& entry) { return drawn(*entry.point, entry.point->name == selected); });
  state.points_drawn = static_cast<std::uint8_t>(entries.size());
}

}  // namespace yars::statemachine
