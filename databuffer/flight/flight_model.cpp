#include "databuffer/flight/flight_model.hpp"

#include <cmath>

namespace yars::databuffer::flight {

geo::Duration stretch_ahead(geo::Duration dt) {
  return std::isfinite(dt.seconds()) && dt.seconds() > 0.0 ? dt : geo::Duration();
}

bool FlightModel::resume(const Ownship& last, geo::Duration) {
  return reposition({{last.latitude_deg, last.longitude_deg},
                     geo::AltitudeMsl::metres(last.altitude_msl_m),
                     geo::Bearing::degrees(last.heading_deg)});
}

}  // namespace yars::databuffer::flight
