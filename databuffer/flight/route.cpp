#include "databuffer/flight/route.hpp"

#include "databuffer/flight/numbers.hpp"

namespace yars::databuffer::flight {

namespace {

using failure::Expected;
using failure::fail;

constexpr double kLeastLeg = 100.0;  // [m] a shorter leg has no direction worth flying

Expected<Waypoint> parse_waypoint(const NumberedLine& line, std::string_view name) {
  const auto numbers = parse_numbers(
      place_in_file(name, line.number), words_of(line.text),
      {{"LAT", -90.0, 90.0}, {"LON", -180.0, 180.0}, {"ALT_FT", -1'000.0, 200'000.0}, {"KT", 30.0, 5'000.0}}, " ");
  if (!numbers) return tl::unexpected(numbers.error());
  const auto& value = *numbers;
  return Waypoint{{value[0], value[1]}, geo::AltitudeMsl::feet(value[2]), geo::Speed::knots(value[3])};
}

bool too_close(const Waypoint& from, const Waypoint& to) {
  return geo::geodesic_inverse(from.point, to.point).distance.metres() < kLeastLeg;
}

// The leg back to the start must be one too.
Expected<void> close_loop(Route& route, const std::string& place) {
  route.loop = true;
  if (route.waypoints.size() < 2 || !too_close(route.waypoints.back(), route.waypoints.front())) return {};
  return fail(place, "a last waypoint at least 100 m from the first", "the same place",
              "leave out the last waypoint: loop goes back to the first by itself");
}

}  // namespace

std::size_t Route::after(std::size_t waypoint) const {
  const std::size_t next = waypoint + 1;
  return next == waypoints.size() && loop ? 0 : next;
}

Expected<Route> parse_route(std::string_view text, std::string_view name) {
  Route route;
  for (const NumberedLine& line : numbered_lines(text)) {
    const std::string place = place_in_file(name, line.number);
    if (route.loop) return fail(place, "nothing behind loop", '"' + std::string(line.text) + '"');
    if (line.text == "loop") {
      if (auto closed = close_loop(route, place); !closed) return tl::unexpected(closed.error());
      continue;
    }
    const auto waypoint = parse_waypoint(line, name);
    if (!waypoint) return tl::unexpected(waypoint.error());
    if (!route.waypoints.empty() && too_close(route.waypoints.back(), *waypoint))
      return fail(place, "a waypoint at least 100 m from the one before", "the same place");
    route.waypoints.push_back(*waypoint);
  }
  if (route.waypoints.size() < 2)
    return fail(std::string(name), "at least two waypoints, LAT LON ALT_FT KT a line",
                std::to_string(route.waypoints.size()));
  return route;
}

}  // namespace yars::databuffer::flight
