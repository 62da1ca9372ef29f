// Aircraft flown outside: reports in order and checked, dead reckoning, the flight between reports.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "databuffer/flight/motion.hpp"
#include "databuffer/messages/world_state.hpp"
#include "lib/error/error.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::databuffer::bridges {

// What a network may hold a packet back by; longer and a sender that was started again waits that long to be heard.
inline constexpr geo::Duration kLongestDelay = geo::Duration::seconds(2.0);

// Whether a packet is news, by the stamp of its sender: one that is as old as the last, or a little older, came twice
// or out of order. A stamp that goes back by more than kLongestDelay is a sender that began again; that is believed
// once a second packet goes on from it, so that a single stray one moves nothing.
class StampOrder {
 public:
  // `period`: a stamp counts to there and begins again at zero; none: it counts on. [s]
  explicit StampOrder(std::optional<geo::Duration> period = std::nullopt) : period_(period) {}

  // Nothing: it is news. Else why not. `stamp` is finite.
  std::optional<std::string> why_not_news(geo::Duration stamp);

 private:
  geo::Duration since(geo::Duration before, geo::Duration stamp) const;

  std::optional<geo::Duration> period_;
  std::optional<geo::Duration> last_;
  std::optional<geo::Duration> restarted_;  // stamp of a packet that may be a sender's first
};

// How fast the three angles of the attitude change: not the rates about the body's axes.
struct AttitudeRates {
  double heading_dps = 0.0;  // [deg/s] clockwise
  double pitch_dps = 0.0;    // [deg/s] nose up
  double roll_dps = 0.0;     // [deg/s] right wing down
};

// What a program outside told of the aircraft at one moment, in the units of our records and checked like them.
struct ExternalSample {
  // Place, attitude and velocity; all else is as a source without them has it. Valid by validate().
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
error::Expected<ExternalSample> checked_sample(std::string_view source, const Reading& reading,
                                               const std::optional<AttitudeRates>& rates = std::nullopt,
                                               const std::optional<geo::Vector3>& acceleration_mps2 = std::nullopt);

// Rates of the attitude's angles from those about the body's axes [deg/s]; none where the nose points straight up or
// down, where heading and roll have no rates.
std::optional<AttitudeRates> rates_from_body(double roll_rate_dps, double pitch_rate_dps, double yaw_rate_dps,
                                             double pitch_deg, double roll_deg);

// Where an aircraft, ship or vehicle is a while after its last report, or a little before it: along the geodesic of its
// velocity, which itself changes by the acceleration told; attitude by its rates. Heading and velocity turn with the
// meridian, so that it holds near the poles.
//
// The record at that time after the sample; without rates the attitude stands. Angles are wrapped, pitch is held to the
// vertical. The altitude may leave the record's range.
Ownship dead_reckoned(const ExternalSample& sample, geo::Duration after);

// Time constant by which the output goes over to a new report; shorter shows jitter, longer lags behind manoeuvres.
inline constexpr geo::Duration kBlend = geo::Duration::seconds(0.25);
// A difference larger than this is a jump; dead reckoning of any flight stays far below.
inline constexpr geo::Length kJump = geo::Length::metres(300.0);

// The aircraft between the reports of a program outside, at any moment asked for. Pure: it is told when a report came.
// Each report is flown on by dead reckoning: with its own rates and acceleration, else with those of the last 80 ms or
// more. What a new report says otherwise than the flight so far is taken out over kBlend, so that the output has no
// steps; what is too far off for that is a jump, and taken over at once. A place that stays though the velocity says
// otherwise stands: the program is paused.
// Bound, for reports 5 to 400 times a second that come up to J late, gaps T, a turn of acceleration a whose direction
// turns at w: the output is within |v| J + a w T^3 / 6 + 1 m of the truth, and steps of 20 ms differ from the truth's
// by at most 8 % of that (tests/databuffer/bridges/external_flight_test.cpp).
class ExternalFlight {
 public:
  // `reach`: how long after a report the aircraft is flown on.
  explicit ExternalFlight(geo::Duration reach) : reach_(reach) {}

  // `received` does not go back.
  void receive(const ExternalSample& sample, geo::Duration received);
  // None: nothing came within reach. The moment may lie a little before the last report.
  std::optional<flight::FlightSample> at(geo::Duration moment) const;

  int jumps() const { return jumps_; }

 private:
  // What the output still has of the flight before the last report: its place and motion minus those told.
  struct Difference {
    double north_m = 0.0, east_m = 0.0, up_m = 0.0;
    double north_mps = 0.0, east_mps = 0.0, down_mps = 0.0;
    double heading_deg = 0.0, pitch_deg = 0.0, roll_deg = 0.0;
  };
  static Difference difference(const Ownship& before, const Ownship& told);
  static bool is_jump(const Difference& difference);
  void measure_rates(const ExternalSample& sample, geo::Duration received);
  bool stands(const ExternalSample& sample, geo::Duration received);
  std::optional<Ownship> estimate(geo::Duration moment) const;

  struct Report {
    ExternalSample sample;
    geo::Duration received;
  };
  geo::Duration reach_;
  std::optional<Report> last_;     // with the rates to fly on by
  std::optional<Report> earlier_;  // against which rates are measured
  std::optional<AttitudeRates> measured_rates_;
  std::optional<geo::Vector3> measured_acceleration_;
  std::optional<Report> unmoved_;  // the first report of the place that was told last
  Difference left_;                // at last_
  int jumps_ = 0;
};

}  // namespace yars::databuffer::bridges
