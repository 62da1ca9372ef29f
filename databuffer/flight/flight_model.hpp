// A flight model: where an aircraft is after another stretch of sim time. Pure and deterministic.
// It fills all of both records but source_time_ns and epoch, which the caller knows. Latitude and longitude are
// WGS84; altitudes are above mean sea level and taken for heights above the ellipsoid where lengths are scaled
// (an undulation of 100 m changes a velocity by 1.6e-5 of it). Velocity is the derivative of the position, without
// wind; radar altitude is NaN: no model here knows the ground. The navigators know the truth.
#pragma once

#include "databuffer/records/ownship.hpp"
#include "lib/geo/bearing.hpp"
#include "lib/geo/geodesic.hpp"
#include "lib/geo/height.hpp"

namespace yars::databuffer::flight {

struct FlightSample {
  Ownship ownship{};
  Nav nav{};
};

struct Placement {
  geo::GeoPoint point;
  geo::AltitudeMsl altitude;
  geo::Bearing heading;
};

// `dt` where it is a stretch of time ahead, else none.
geo::Duration stretch_ahead(geo::Duration dt);

class FlightModel {
 public:
  virtual ~FlightModel() = default;

  // `dt` after the call before; zero gives the present sample again, and so does what is no stretch of time ahead:
  // less than zero, infinite, not a number.
  virtual FlightSample step(geo::Duration dt) = 0;
  // Back to the start of the flight.
  virtual void reset() = 0;
  // Goes on from another place. False: this source cannot, and flies on as it was.
  virtual bool reposition(const Placement& placement) = 0;
  // Takes up where a predecessor of the same source was `gap` ago; false: this flight is not its. By default it is
  // placed where the predecessor was.
  virtual bool resume(const Ownship& last, geo::Duration gap);
};

}  // namespace yars::databuffer::flight
