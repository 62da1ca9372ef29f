#include "statemachine/sequence_points.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

#include "lib/geo/geodesic.hpp"
#include "lib/radar/point_name.hpp"
#include "statemachine/cursor.hpp"

namespace yars::statemachine {

namespace {

using databuffer::DrawnPoint;
using databuffer::RadarState;
using radar::RoutePoint;

constexpr std::size_t kMostDrawn = 5;  // rule 11; the record holds more
static_assert(kMostDrawn <= radar::kMaxPointsDrawn);

// Text of a record's field, which a foreign writer may have left without its zero.
template <std::size_t N>
std::string_view text_of(const char (&field)[N]) {
  return {field, static_cast<std::size_t>(std::find(field, field + N, '\0') - field)};
}

void put_name(char (&field)[8], std::string_view name) {
  std::memset(field, 0, sizeof(field));
  name.copy(field, sizeof(field) - 1);
}

const RoutePoint* find_point(std::string_view name, const radar::RadarConfiguration& configuration) {
  const auto found = std::find_if(configuration.route.begin(), configuration.route.end(),
                                  [name](const RoutePoint& point) { return point.name == name; });
  return found == configuration.route.end() ? nullptr : &*found;
}

bool survives_declutter(const RoutePoint& point) {
  return point.kind == radar::PointKind::target || point.kind == radar::PointKind::target_offset;
}

void select(Step& step, const RoutePoint& point) {
  put_name(step.state.sequence_point, point.name);
  jump_cursor(step.state, point);
}

// The points to draw, kept sorted by distance while the route goes by; the selected one is put first.
class Nearest {
 public:
  explicit Nearest(const RoutePoint* selected) { take(selected, geo::Length()); }

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
  if (const RoutePoint* point = find_point(text_of(next.name), step.configuration)) select(step, *point);
}

void select_sequence_point(Step& step) {
  if (const RoutePoint* point = find_point(text_of(step.event.text), step.configuration)) select(step, *point);
}

void select_first_sequence_point(RadarState& state, const radar::RadarConfiguration& configuration) {
  const auto first =
      std::min_element(configuration.route.begin(), configuration.route.end(),
                       [](const RoutePoint& a, const RoutePoint& b) { return radar::precedes(a.name, b.name); });
  put_name(state.sequence_point, first == configuration.route.end() ? std::string_view() : first->name);
}

const RoutePoint* selected_point(const RadarState& state, const radar::RadarConfiguration& configuration) {
  return find_point(text_of(state.sequence_point), configuration);
}

void draw_points(RadarState& state, const Surroundings& surroundings, const radar::RadarConfiguration& configuration) {
  const RoutePoint* selected = selected_point(state, configuration);
  Nearest nearest(selected);
  const geo::GeoPoint aircraft{surroundings.ownship.latitude_deg, surroundings.ownship.longitude_deg};
  const geo::Length range = geo::Length::nautical_miles(state.range_nm);
  for (const RoutePoint& point : configuration.route) {
    if (!surroundings.ownship_valid || &point == selected) continue;
    if (has(state, databuffer::kDeclutter) && !survives_declutter(point)) continue;
    const geo::Length distance = geo::geodesic_inverse(aircraft, point.place).distance;
    if (distance <= range) nearest.take(&point, distance);
  }

  const auto entries = nearest.entries();
  std::sort(entries.begin(), entries.end(),
            [](const auto& a, const auto& b) { return radar::precedes(a.point->name, b.point->name); });
  std::fill(std::begin(state.points), std::end(state.points), DrawnPoint{});
  std::transform(entries.begin(), entries.end(), state.points,
                 [selected](const auto& entry) { return drawn(*entry.point, entry.point == selected); });
  state.points_drawn = static_cast<std::uint8_t>(entries.size());
}

}  // namespace yars::statemachine
