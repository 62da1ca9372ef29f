#include "databuffer/flight/flight_model.hpp"

namespace yars::databuffer::flight {

bool FlightModel::resume(const Ownship& last, geo::Duration) {
  return reposition({{last.latitude_deg, last.longitude_deg},
                     geo::AltitudeMsl::metres(last.altitude_msl_m),
                     geo::Bearing::degrees(last.heading_deg)});
}

}  // namespace yars::databuffer::flight
