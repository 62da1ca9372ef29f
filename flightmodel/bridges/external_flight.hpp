// Aircraft flown by an external program: checks of that program's reports, dead reckoning (extrapolation of the last
// report), and blending between reports.
// Inputs: reports with their arrival times.
// Outputs: position, attitude and velocity at any requested time.
// Units: degrees, metres, seconds, as in Ownship.
// Frame: WGS84; altitude above mean sea level; velocities and accelerations north, east, down.
// Errors: a report with a value out of range is refused; the error names the field.
// Threads: one thread per object. No function reads a clock.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "databuffer/messages/world_state.hpp"
#include "flightmodel/motion.hpp"
#include "lib/error/error.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/geo/quantity.hpp"

namespace yars::flightmodel::bridges {

// Maximum delay [s] of a packet in the network. Packets of a restarted sender can be refused for up to this time.
inline constexpr geo::Duration kMaxPacketDelay = geo::Duration::seconds(2.0);

// Checks the order of packets by the time stamps of their sender. A packet whose stamp equals the last accepted stamp
// is a duplicate; one whose stamp is at most kMaxPacketDelay older arrived out of order. Both are refused. A stamp more
// than kMaxPacketDelay older indicates a restarted sender, whose packets are accepted from the second one on, so that
// one stray packet has no effect.
class StampOrder {
 public:
  // `period`: stamps wrap to zero at this value; without it they do not wrap.
  explicit StampOrder(std::optional<geo::Duration> period = std::nullopt) : period_(period) {}

  // Returns nullopt if the packet is accepted, else the reason for the refusal. `stamp` is finite.
  std::optional<std::string> order_fault(geo::Duration stamp);

 private:
  geo::Duration since(geo::Duration before, geo::Duration stamp) const;

  std::optional<geo::Duration> period_;
  std::optional<geo::Duration> last_;
  std::optional<geo::Duration> restarted_;  // stamp that may be the first one of a restarted sender
};

// Time derivatives of the attitude angles, which differ from the rates about the body axes.
struct AttitudeRates {
  double heading_dps = 0.0;  // [deg/s] clockwise
  double pitch_dps = 0.0;    // [deg/s] nose up
  double roll_dps = 0.0;     // [deg/s] right wing down
};

// One checked report of an external program, in the units of Ownship.
struct ExternalSample {
  // Position, attitude, velocity and source. Radar altitude is NaN, all other fields are 0. validate() accepts it.
  databuffer::Ownship ownship{};
  std::optional<AttitudeRates> rates;
  std::optional<geo::Vector3> acceleration_mps2;  // derivative of the velocity: north, east, down; nullopt: unknown
  // Turn rate vector [rad/s] of velocity and acceleration (right-hand rule): north, east, down. Zero: their directions
  // are constant.
  geo::Vector3 turn_radps{};
};

// Values of a packet, converted to these units but not checked.
struct Reading {
  double latitude_deg, longitude_deg, altitude_msl_m;
  double heading_deg, pitch_deg, roll_deg;
  double velocity_north_mps, velocity_east_mps, velocity_down_mps;
};

// [deg/s] Limit of each attitude rate. A packet with a higher value is damaged, and would spin the picture.
inline constexpr double kMaxAttitudeRate_dps = 1'000.0;
// [m/s^2] Limit of each component of the acceleration, about 100 g. A packet with a higher value is damaged.
inline constexpr double kMaxAcceleration_mps2 = 1'000.0;

// Checks a reading and converts it to a sample. `source`: name in the record, at most 15 characters. Heading may be
// -360 to 720 deg and longitude -180 to 360 deg; both are wrapped. Rates and acceleration must be within
// kMaxAttitudeRate_dps and kMaxAcceleration_mps2. All other values must be in the ranges of Ownship; pitch and roll may
// exceed them by 1e-4 deg and are clamped. The error names the field.
error::Expected<ExternalSample> checked_sample(std::string_view source, const Reading& reading,
                                               const std::optional<AttitudeRates>& rates = std::nullopt,
                                               const std::optional<geo::Vector3>& acceleration_mps2 = std::nullopt);

// Rates of the attitude angles from the rates about the body axes [deg/s]. nullopt within 0.6 deg of vertical pitch,
// where heading and roll rates are singular.
std::optional<AttitudeRates> rates_from_body(double roll_rate_dps, double pitch_rate_dps, double yaw_rate_dps,
                                             double pitch_deg, double roll_deg);

// Ownship at the time `after` the sample; `after` may be slightly negative. The acceleration has constant magnitude.
// Velocity and acceleration turn at the rate turn_radps. The displacement is laid off along a geodesic. Attitude
// follows its rates, and is constant without them. Heading and velocity are corrected for the convergence of meridians,
// so that the result is valid near the poles. Angles are wrapped, and pitch is clamped to +-90 deg. The altitude may
// leave the range of the record.
databuffer::Ownship dead_reckoned(const ExternalSample& sample, geo::Duration after);

// Time constant [s] of blending to a new report. With a shorter time the output would jitter. With a longer
// time the output would lag in manoeuvres.
inline constexpr geo::Duration kBlendTime = geo::Duration::seconds(0.25);
// Position difference [m] that counts as a jump. The error of dead reckoning stays far below it.
inline constexpr geo::Length kJumpDistance = geo::Length::metres(300.0);

// Position, attitude and velocity of an external aircraft between its reports.
// Each report is dead reckoned with its own rates and acceleration. A report without them uses values measured between
// reports 80 ms to 1 s apart. The difference between a new report and the current output decays with kBlendTime, so
// that the output has no steps. A position difference above kJumpDistance is a jump: the output takes the new
// report at once. An angle difference above 30 deg applies at once, too. If the position stays constant in spite of a
// velocity, the external program counts as paused, and the aircraft stands still.
//
// Accuracy: reports arrive 5 to 400 times a second, up to J [s] late, at most T [s] apart. In a turn with velocity v,
// acceleration a and turn rate w, the output is within B = |v| J + a w T^3 / 6 + 1 m of the true position. The distance
// that the output moves in 20 ms has an error below 0.08 B (tests/flightmodel/bridges/external_flight_test.cpp).
class ExternalFlight {
 public:
  // `extrapolation_limit`: time after a report during which the aircraft is dead reckoned.
  explicit ExternalFlight(geo::Duration extrapolation_limit) : extrapolation_limit_(extrapolation_limit) {}

  // `received`: arrival time, which does not go back.
  void receive(const ExternalSample& sample, geo::Duration received);
  // Output at `moment`, which may be slightly before the last report. nullopt: no report has arrived, the last report
  // is older than the extrapolation limit, or the output is outside the ranges of Ownship.
  std::optional<flightmodel::FlightSample> at(geo::Duration moment) const;

  int jumps() const { return jumps_; }

 private:
  // Output minus dead-reckoned last report.
  struct Difference {
    double north_m = 0.0, east_m = 0.0, up_m = 0.0;
    double north_mps = 0.0, east_mps = 0.0, down_mps = 0.0;
    double heading_deg = 0.0, pitch_deg = 0.0, roll_deg = 0.0;
  };
  static Difference difference(const databuffer::Ownship& before, const databuffer::Ownship& reported);
  static bool is_jump(const Difference& difference);
  void measure_rates(const ExternalSample& sample, geo::Duration received);
  bool is_stationary(const ExternalSample& sample, geo::Duration received);
  std::optional<databuffer::Ownship> estimate(geo::Duration moment) const;

  struct Report {
    ExternalSample sample;
    geo::Duration received;
  };
  geo::Duration extrapolation_limit_;
  std::optional<Report> last_;     // last report, completed with measured rates and acceleration
  std::optional<Report> earlier_;  // reference for measuring rates
  std::optional<AttitudeRates> measured_rates_;
  std::optional<geo::Vector3> measured_acceleration_;
  std::optional<Report> unmoved_since_;  // first report of the present position
  Difference residual_;                  // difference at the time of last_
  int jumps_ = 0;
};

}  // namespace yars::flightmodel::bridges
