// The state of a point that flies, and the records that say so.
#pragma once

#include <string_view>

#include "databuffer/flight/flight_model.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::databuffer::flight {

struct Motion {
  geo::GeoPoint point;
  geo::AltitudeMsl altitude;
  geo::Bearing track;
  geo::Speed ground_speed;  // horizontal, at the aircraft's altitude
  geo::Speed climb;         // up positive
};

struct Attitude {
  geo::Bearing heading;
  geo::Angle pitch;
  geo::Angle roll;
};

// How far the point on the ellipsoid below moves while the aircraft, R + h from the centre, covers a distance.
geo::Length surface_distance(const Motion& motion, geo::Length flown);
// The reverse: the speed at altitude of an aircraft over a point that moves at `surface` on the ellipsoid.
geo::Speed speed_at_altitude(const Motion& motion, geo::Speed surface);

// Nose along the flight path, wings as given.
Attitude coordinated_attitude(const Motion& motion, geo::Angle roll);

// `source`: at most 15 characters are kept.
FlightSample sample_of(const Motion& motion, const Attitude& attitude, std::string_view source);

}  // namespace yars::databuffer::flight
