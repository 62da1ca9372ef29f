// Flight model that an option names, and the simplest: straight and level.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "databuffer/flight/motion.hpp"
#include "lib/error/error.hpp"

namespace yars::databuffer::flight {

// Straight and level along a geodesic at a fixed speed; at 0 kt parked in the air. Written
// LAT,LON,ALT_FT,HDG,KT: degrees, degrees, feet above sea level, degrees true, knots over ground.
struct FixedSetting {
  Placement start;
  geo::Speed ground_speed;
};

// Latitude [-90, 90], longitude [-180, 180], altitude [-1000, 200000] ft, heading [0, 360], speed [0, 5000] kt.
error::Expected<FixedSetting> parse_fixed(std::string_view text);

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

// From `--source KIND:...` to the flight model that it names; reads the file of a route or track.
struct FlightSource {
  std::unique_ptr<FlightModel> model;
  std::string description;  // for the log: what flies, from which file
};

// route:FILE, fixed:LAT,LON,ALT_FT,HDG,KT, csv:FILE (programs outside: databuffer/bridges). An error about the text
// itself counts as bad usage.
error::Expected<FlightSource> open_source(std::string_view text);

}  // namespace yars::databuffer::flight
