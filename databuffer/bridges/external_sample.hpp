// What a program outside told of the aircraft at one moment, in the units of our records and checked like them.
#pragma once

#include <optional>
#include <string_view>

#include "databuffer/records/ownship.hpp"
#include "lib/failure/error.hpp"
#include "lib/geo/vector.hpp"

namespace yars::databuffer::bridges {

// How fast the three angles of the attitude change: not the rates about the body's axes.
struct AttitudeRates {
  double heading_dps = 0.0;  // [deg/s] clockwise
  double pitch_dps = 0.0;    // [deg/s] nose up
  double roll_dps = 0.0;     // [deg/s] right wing down
};

struct ExternalSample {
  // Place, attitude and velocity; all else is as a source without them has it. Valid by why_refused().
  Ownship ownship{};
  std::optional<AttitudeRates> rates;
  std::optional<geo::Vector3> acceleration_mps2;  // north, east, down, of the velocity; none: steady
};

// Numbers as they stood in a packet, units changed, nothing checked.
struct Reading {
  double latitude_deg, longitude_deg, altitude_msl_m;
  double heading_deg, pitch_deg, roll_deg;
  double velocity_north_mps, velocity_east_mps, velocity_down_mps;
};

// [deg/s] of one angle; faster is a broken packet, and would spin the picture.
inline constexpr double kFastestTurn = 1'000.0;
// [m/s^2] 100 g; more is a broken packet.
inline constexpr double kHardestPull = 1'000.0;

// `source`: name in the record, at most 15 characters. Heading may be given from -360 to 720 degrees and is wrapped;
// longitude from -180 to 360. All else must be in the record's range; the error names the field.
failure::Expected<ExternalSample> checked_sample(std::string_view source, const Reading& reading,
                                                 const std::optional<AttitudeRates>& rates = std::nullopt,
                                                 const std::optional<geo::Vector3>& acceleration_mps2 = std::nullopt);

// Rates of the attitude's angles from those about the body's axes [deg/s]; none where the nose points straight up or
// down, where heading and roll have no rates.
std::optional<AttitudeRates> rates_from_body(double roll_rate_dps, double pitch_rate_dps, double yaw_rate_dps,
                                             double pitch_deg, double roll_deg);

}  // namespace yars::databuffer::bridges
