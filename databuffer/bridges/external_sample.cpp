#include "databuffer/bridges/external_sample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "databuffer/records/plain_text.hpp"
#include "databuffer/records/validation.hpp"
#include "lib/geo/bearing.hpp"

namespace yars::databuffer::bridges {

namespace {

// Below this cosine of the pitch, 0.6 deg from the vertical, heading and roll turn without bound.
constexpr double kLeastCosine = 0.01;

std::optional<failure::Error> outside(std::string_view source, std::string_view field, double value, double least,
                                      double most) {
  // Written so that NaN fails.
  if (value >= least && value <= most) return std::nullopt;
  return failure::Error{std::string(source),
                        std::string(field) + " in [" + text_of_number(least) + ", " + text_of_number(most) + ']',
                        text_of_number(value),
                        {},
                        false};
}

// [deg] What is left over when a float of radians says 90 or 180 degrees.
constexpr double kRounding = 1e-4;

// Angles that other programs count from another zero, and what has no field in the record.
std::optional<failure::Error> fault_of(std::string_view source, const Reading& reading,
                                       const std::optional<AttitudeRates>& rates,
                                       const std::optional<geo::Vector3>& acceleration) {
  if (auto fault = outside(source, "heading_deg", reading.heading_deg, -360.0, 720.0)) return fault;
  if (auto fault = outside(source, "longitude_deg", reading.longitude_deg, -180.0, 360.0)) return fault;
  if (rates) {
    for (const double rate : {rates->heading_dps, rates->pitch_dps, rates->roll_dps})
      if (auto fault = outside(source, "attitude rate [deg/s]", rate, -kFastestTurn, kFastestTurn)) return fault;
  }
  if (acceleration) {
    for (const double part : {acceleration->x, acceleration->y, acceleration->z})
      if (auto fault = outside(source, "acceleration [m/s^2]", part, -kHardestPull, kHardestPull)) return fault;
  }
  return std::nullopt;
}

}  // namespace

failure::Expected<ExternalSample> checked_sample(std::string_view source, const Reading& reading,
                                                 const std::optional<AttitudeRates>& rates,
                                                 const std::optional<geo::Vector3>& acceleration_mps2) {
  if (auto fault = fault_of(source, reading, rates, acceleration_mps2)) return tl::unexpected(std::move(*fault));
  ExternalSample sample;
  Ownship& ownship = sample.ownship;
  ownship.latitude_deg = reading.latitude_deg;
  ownship.longitude_deg = geo::wrapped_degrees(reading.longitude_deg);
  ownship.altitude_msl_m = reading.altitude_msl_m;
  ownship.heading_deg = geo::Bearing::degrees(reading.heading_deg).degrees();
  const auto rounded = [](double angle_deg, double most_deg) {
    return std::abs(angle_deg) <= most_deg + kRounding ? std::clamp(angle_deg, -most_deg, most_deg) : angle_deg;
  };
  ownship.pitch_deg = rounded(reading.pitch_deg, 90.0);
  ownship.roll_deg = rounded(reading.roll_deg, 180.0);
  ownship.velocity_north_mps = reading.velocity_north_mps;
  ownship.velocity_east_mps = reading.velocity_east_mps;
  ownship.velocity_down_mps = reading.velocity_down_mps;
  ownship.radar_altitude_m = std::numeric_limits<double>::quiet_NaN();
  source.copy(ownship.source, sizeof ownship.source - 1);
  if (const auto refusal = why_refused(ownship))
    return failure::fail(std::string(source), "a flight that can be", *refusal);
  sample.rates = rates;
  sample.acceleration_mps2 = acceleration_mps2;
  return sample;
}

std::optional<AttitudeRates> rates_from_body(double roll_rate_dps, double pitch_rate_dps, double yaw_rate_dps,
                                             double pitch_deg, double roll_deg) {
  const double cos_pitch = std::cos(pitch_deg * geo::kRadiansPerDegree);
  if (std::abs(cos_pitch) < kLeastCosine) return std::nullopt;
  const double sin_roll = std::sin(roll_deg * geo::kRadiansPerDegree);
  const double cos_roll = std::cos(roll_deg * geo::kRadiansPerDegree);
  AttitudeRates rates;
  rates.heading_dps = (pitch_rate_dps * sin_roll + yaw_rate_dps * cos_roll) / cos_pitch;
  rates.pitch_dps = pitch_rate_dps * cos_roll - yaw_rate_dps * sin_roll;
  rates.roll_dps = roll_rate_dps + rates.heading_dps * std::sin(pitch_deg * geo::kRadiansPerDegree);
  return rates;
}

}  // namespace yars::databuffer::bridges
