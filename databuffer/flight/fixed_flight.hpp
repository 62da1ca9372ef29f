// Straight and level along a geodesic at a fixed speed; at 0 kt parked in the air. Written
// LAT,LON,ALT_FT,HDG,KT: degrees, degrees, feet above sea level, degrees true, knots over ground.
#pragma once

#include <string_view>

#include "databuffer/flight/flight_model.hpp"
#include "lib/failure/error.hpp"

namespace yars::databuffer::flight {

struct FixedSetting {
  Placement start;
  geo::Speed ground_speed;
};

// Latitude [-90, 90], longitude [-180, 180], altitude [-1000, 200000] ft, heading [0, 360], speed [0, 5000] kt.
failure::Expected<FixedSetting> parse_fixed(std::string_view text);

class FixedFlight final : public FlightModel {
 public:
  explicit FixedFlight(const FixedSetting& setting);
  FlightSample step(geo::Duration dt) override;
  void reset() override;
  bool reposition(const Placement& placement) override;

 private:
  FixedSetting setting_;
  Placement origin_;  // of the ray: the start, or where it was last placed
  geo::GeodesicRay ray_;
  geo::Length flown_;  // along the ray, on the ellipsoid
};

}  // namespace yars::databuffer::flight
