// The aircraft between the reports of a program outside, at any moment asked for. Pure: it is told when a report came.
// Each report is flown on by dead reckoning: with its own rates and acceleration, else with those of the last 80 ms or
// more. What a new report says otherwise than the flight so far is taken out over kBlend, so that the output has no
// steps; what is too far off for that is a jump, and taken over at once. A place that stays though the velocity says
// otherwise stands: the program is paused.
// Bound, for reports 5 to 400 times a second that come up to J late, gaps T, a turn of acceleration a whose direction
// turns at w: the output is within |v| J + a w T^3 / 6 + 1 m of the truth, and steps of 20 ms differ from the truth's
// by at most 8 % of that (tests/bridges/external_flight_test.cpp).
#pragma once

#include <optional>

#include "databuffer/bridges/external_sample.hpp"
#include "databuffer/flight/flight_model.hpp"

namespace yars::databuffer::bridges {

// Time constant by which the output goes over to a new report; shorter shows jitter, longer lags behind manoeuvres.
inline constexpr geo::Duration kBlend = geo::Duration::seconds(0.25);
// A difference larger than this is a jump; dead reckoning of any flight stays far below.
inline constexpr geo::Length kJump = geo::Length::metres(300.0);

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
