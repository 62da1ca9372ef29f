// Factory of the flight model that the option `--source` names, and the model of straight and level flight.
// Inputs: route:FILE, fixed:LAT,LON,ALT_FT,HDG,KT or csv:FILE. flightmodel/bridges has the other sources.
// Outputs: a FlightModel with a description for the log.
// Errors: a malformed option value is a usage error (Error::bad_usage). An error in a file names the line.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "flightmodel/motion.hpp"
#include "lib/error/error.hpp"

namespace yars::flightmodel {

// Parameters of FixedFlight.
// Text form: LAT,LON,ALT_FT,HDG,KT in degrees, degrees, feet above mean sea level, degrees true, knots over ground.
struct FixedSetting {
  Placement start;
  geo::Speed ground_speed;
};

// Ranges: latitude [-90, 90], longitude [-180, 180], altitude [-1000, 200000] ft, heading [0, 360], speed [0, 5000] kt.
error::Expected<FixedSetting> parse_fixed(std::string_view text);

// Straight and level flight along a geodesic at constant speed. At 0 kt the aircraft stays at its position in the air.
class FixedFlight final : public FlightModel {
 public:
  explicit FixedFlight(const FixedSetting& setting);
  FlightSample step(geo::Duration dt) override;
  void reset() override;
  bool reposition(const Placement& placement) override;

 private:
  FixedSetting setting_;
  geo::Speed ground_speed_;
  Placement origin_;  // origin of ray_: the start, or the position and heading of the last repositioning
  geo::GeodesicRay ray_;
  geo::Length flown_;  // distance from the origin along ray_, on the ellipsoid
};

// Flight model that a value of `--source` names.
struct FlightSource {
  std::unique_ptr<FlightModel> model;
  std::string description;  // for the log: kind, file, number of waypoints or rows
};

// Makes the flight model and reads its file. `text`: value of `--source`.
error::Expected<FlightSource> open_source(std::string_view text);

}  // namespace yars::flightmodel
