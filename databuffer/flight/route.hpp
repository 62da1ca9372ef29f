// A route: waypoints in the order in which they are flown. One a line, `LAT LON ALT_FT KT` (degrees, degrees, feet
// above sea level, knots over ground), `#` begins a comment; a line `loop` at the end goes back to the first.
// Altitude and speed belong to the leg that ends at the waypoint.
#pragma once

#include <string_view>
#include <vector>

#include "lib/failure/error.hpp"
#include "lib/geo/geodesic.hpp"
#include "lib/geo/height.hpp"

namespace yars::databuffer::flight {

struct Waypoint {
  geo::GeoPoint point;
  geo::AltitudeMsl altitude;
  geo::Speed ground_speed;
};

struct Route {
  std::vector<Waypoint> waypoints;  // at least two, neighbours at least 100 m apart
  bool loop = false;

  // Index of the waypoint after this one; the size of the route after the last of a route without loop.
  std::size_t after(std::size_t waypoint) const;
};

// `name` is the file's, for errors: they carry the line.
failure::Expected<Route> parse_route(std::string_view text, std::string_view name);

}  // namespace yars::databuffer::flight
