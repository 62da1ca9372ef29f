// Tests of the extrapolation of an aircraft between the reports of an external program. The reports come from flights
// with known positions, such as a circle, and arrive with jitter and gaps.
#include "flightmodel/bridges/external_flight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "databuffer/messages/validation.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"
#include "tests/flightmodel/bridges/packets.hpp"

namespace yars::flightmodel::bridges {
namespace {

constexpr geo::Duration kMaxExtrapolation = geo::Duration::seconds(1.0);

geo::GeoPoint point_of(const databuffer::Ownship& own) {
  return {own.latitude_deg, own.longitude_deg};
}

double distance_m(const databuffer::Ownship& a, const databuffer::Ownship& b) {
  return std::hypot(geo::geodesic_inverse(point_of(a), point_of(b)).distance.metres(),
                    a.altitude_msl_m - b.altitude_msl_m);
}

// A level turn about a centre: exact position, velocity and attitude at any time.
struct Circle {
  geo::GeoPoint centre{36.6, -121.9};
  double radius_m = 4'800.0;
  double turn_dps = 3.0;
  double altitude_m = 0.0;  // at sea level, distance flown equals distance on the ellipsoid

  double speed_mps() const { return radius_m * turn_dps * geo::kRadiansPerDegree; }

  ExternalSample at(double time_s, bool with_rates) const {
    const double bearing_deg = turn_dps * time_s;
    const geo::GeodesicRay ray(centre, geo::Bearing::degrees(bearing_deg));
    const auto position = ray.position_and_azimuth(geo::Length::metres(radius_m));
    const double track_deg = position.azimuth.degrees() + 90.0;
    const Reading reading{position.point.latitude_deg,
                          position.point.longitude_deg,
                          altitude_m,
                          track_deg,
                          2.0,
                          40.0,
                          speed_mps() * std::cos(track_deg * geo::kRadiansPerDegree),
                          speed_mps() * std::sin(track_deg * geo::kRadiansPerDegree),
                          0.0};
    std::optional<AttitudeRates> rates;
    if (with_rates) rates = AttitudeRates{turn_dps, 0.0, 0.0};
    return checked_sample("circle", reading, rates).value();
  }
};

struct Outcome {
  double worst_position_m = 0.0;  // distance from the true position
  double worst_step_m = 0.0;      // distance between two outputs, minus the true distance
  double worst_heading_deg = 0.0;
  double worst_velocity_mps = 0.0;
  int missing = 0;  // moments without output
};

// Errors of one minute of flight with an output each 20 ms; the first 2 s do not count. Reports arrive in order, each
// up to `jitter_s` late; a fraction `lost_share` is lost.
Outcome fly(const Circle& circle, double rate_hz, double jitter_s, bool with_rates, double lost_share = 0.0) {
  constexpr unsigned kSeed = 4711;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  ExternalFlight flight(kMaxExtrapolation);
  Outcome outcome;
  double report_s = 0.0, next_s = 0.0, received_s = 0.0;
  bool has_before = false;
  databuffer::Ownship before{}, true_before{};
  for (double now_s = 0.02; now_s < 60.0; now_s += 0.02) {
    while (next_s <= now_s) {
      if (chance(random) >= lost_share) {
        received_s = std::max(received_s, next_s);
        flight.receive(circle.at(report_s, with_rates), seconds(received_s));
      }
      report_s += 1.0 / rate_hz;
      next_s = report_s + jitter_s * chance(random);
    }
    const auto sample = flight.at(seconds(now_s));
    if (!sample) {
      outcome.missing += now_s > 2.0 ? 1 : 0;
      has_before = false;
      continue;
    }
    EXPECT_FALSE(databuffer::validate(sample->ownship));
    EXPECT_FALSE(databuffer::validate(sample->nav));
    const databuffer::Ownship truth = circle.at(now_s, false).ownship;
    const databuffer::Ownship& own = sample->ownship;
    if (now_s > 2.0) {
      outcome.worst_position_m = std::max(outcome.worst_position_m, distance_m(own, truth));
      outcome.worst_heading_deg =
          std::max(outcome.worst_heading_deg, std::abs(geo::wrapped_degrees(own.heading_deg - truth.heading_deg)));
      outcome.worst_velocity_mps =
          std::max(outcome.worst_velocity_mps, std::hypot(own.velocity_north_mps - truth.velocity_north_mps,
                                                          own.velocity_east_mps - truth.velocity_east_mps));
      if (has_before)
        outcome.worst_step_m =
            std::max(outcome.worst_step_m, std::abs(distance_m(before, own) - distance_m(true_before, truth)));
    }
    has_before = true;
    before = own;
    true_before = truth;
  }
  return outcome;
}

// Bound of the position error: the distance flown in jitter_s, the effect of the turn's change of acceleration over
// interval_s, and 1 m.
double bound_m(const Circle& circle, double interval_s, double jitter_s) {
  const double turn = circle.turn_dps * geo::kRadiansPerDegree;
  const double acceleration = circle.speed_mps() * turn;
  return circle.speed_mps() * jitter_s + acceleration * turn * std::pow(interval_s, 3) / 6.0 + 1.0;
}

TEST(ExternalFlight, ATurnIsExtrapolatedSmoothlyAtEveryRateWithJitterAndLosses) {
  const Circle circle;  // 251 m/s, 13 m/s2
  struct Case {
    double rate_hz, jitter_s, lost;
  };
  for (const Case& c : {Case{5, 0, 0}, Case{5, 0.04, 0}, Case{10, 0.02, 0.1}, Case{30, 0.01, 0.2}, Case{60, 0.01, 0},
                        Case{400, 0.01, 0.5}})
    for (const bool with_rates : {true, false}) {
      SCOPED_TRACE(std::to_string(c.rate_hz) + " Hz, jitter " + std::to_string(c.jitter_s));
      const Outcome outcome = fly(circle, c.rate_hz, c.jitter_s, with_rates, c.lost);
      // With losses, the bound allows gaps of four intervals.
      const double interval_s = (c.lost > 0 ? 4.0 : 1.0) / c.rate_hz + c.jitter_s;
      EXPECT_LT(outcome.worst_position_m, bound_m(circle, interval_s, c.jitter_s));
      EXPECT_LT(outcome.worst_step_m, 0.08 * bound_m(circle, interval_s, c.jitter_s));
      EXPECT_LT(outcome.worst_heading_deg, 1.0);
      EXPECT_LT(outcome.worst_velocity_mps, 3.0);
      EXPECT_EQ(outcome.missing, 0);
    }
}

// Dead reckoning without smoothing makes steps beyond the bound of the test above.
TEST(ExternalFlight, DeadReckoningWithoutSmoothingMakesStepsBeyondTheBound) {
  const Circle circle;
  const double jitter_s = 0.04;
  const auto late = dead_reckoned(circle.at(0.0, true), seconds(0.2));
  const auto next = dead_reckoned(circle.at(0.2, true), seconds(-jitter_s));
  EXPECT_GT(distance_m(late, next), 0.08 * bound_m(circle, 0.24, jitter_s));
}

TEST(ExternalFlight, EndsOneSecondAfterTheLastReportAndResumesWithTheNext) {
  const Circle circle;
  ExternalFlight flight(kMaxExtrapolation);
  EXPECT_FALSE(flight.at(seconds(5)));
  flight.receive(circle.at(0, true), seconds(10));
  EXPECT_TRUE(flight.at(seconds(10.999)));
  EXPECT_FALSE(flight.at(seconds(11.001)));
  flight.receive(circle.at(7, true), seconds(17));
  const auto resumed = flight.at(seconds(17));
  ASSERT_TRUE(resumed);
  EXPECT_LT(distance_m(resumed->ownship, circle.at(7, true).ownship), 1e-6) << "no smoothing from before the gap";
  EXPECT_EQ(flight.jumps(), 0);
}

TEST(ExternalFlight, AJumpIsFollowedAtOnceAndCounted) {
  ExternalFlight flight(kMaxExtrapolation);
  Circle here, there;
  there.centre = {40.0, -100.0};
  flight.receive(here.at(0, true), seconds(0));
  flight.receive(there.at(0.1, true), seconds(0.1));
  const auto sample = flight.at(seconds(0.1));
  ASSERT_TRUE(sample);
  EXPECT_LT(distance_m(sample->ownship, there.at(0.1, true).ownship), 1e-6);
  EXPECT_EQ(flight.jumps(), 1);
}

TEST(ExternalFlight, APausedProgramStandsStillAlthoughItSendsAVelocity) {
  const Circle circle;
  ExternalFlight flight(kMaxExtrapolation);
  const ExternalSample paused = circle.at(0, true);
  for (int report = 0; report < 100; ++report) flight.receive(paused, seconds(0.03 * report));
  const auto sample = flight.at(seconds(2.98));
  ASSERT_TRUE(sample);
  EXPECT_LT(distance_m(sample->ownship, paused.ownship), 0.1);
  EXPECT_LT(std::hypot(sample->ownship.velocity_north_mps, sample->ownship.velocity_east_mps), 0.1);
}

TEST(ExternalFlight, DuplicatePacketsDoNotStopTheAircraft) {
  const Circle circle;
  ExternalFlight flight(kMaxExtrapolation);
  for (int report = 0; report < 100; ++report)
    for (const double again_s : {0.0, 0.0005})
      flight.receive(circle.at(0.05 * report, true), seconds(0.05 * report + again_s));
  const auto sample = flight.at(seconds(4.97));
  ASSERT_TRUE(sample);
  EXPECT_LT(distance_m(sample->ownship, circle.at(4.97, true).ownship), 1.0);
}

// JSBSim prints seven digits: longitude has steps of 1e-4 deg, 9 m here. At 400 Hz many lines have the same position.
TEST(ExternalFlight, APositionInCoarseStepsIsNotAPause) {
  Circle circle;
  ExternalFlight flight(kMaxExtrapolation);
  double worst_m = 0.0;
  for (int report = 0; report < 4'000; ++report) {
    const double now_s = report / 400.0;
    ExternalSample sample = circle.at(now_s, true);
    sample.ownship.longitude_deg = std::round(sample.ownship.longitude_deg * 1e4) / 1e4;
    sample.ownship.latitude_deg = std::round(sample.ownship.latitude_deg * 1e5) / 1e5;
    flight.receive(sample, seconds(now_s));
    if (now_s > 1.0)
      worst_m = std::max(worst_m, distance_m(flight.at(seconds(now_s))->ownship, circle.at(now_s, true).ownship));
  }
  EXPECT_LT(worst_m, 5.0) << "half a step of 9 m, smoothed";
}

TEST(ExternalFlight, ExtrapolatesBackToAMomentBeforeTheReport) {
  const Circle circle;
  ExternalFlight flight(kMaxExtrapolation);
  flight.receive(circle.at(10, true), seconds(10));
  const auto sample = flight.at(seconds(9.95));
  ASSERT_TRUE(sample);
  EXPECT_LT(distance_m(sample->ownship, circle.at(9.95, true).ownship), 0.1);
}

TEST(DeadReckoning, BeyondThePoleHeadingAndVelocityReverse) {
  const Reading reading{89.999, 30.0, 0.0, 0.0, 0.0, 0.0, 250.0, 0.0, 0.0};
  const auto sample = checked_sample("pole", reading).value();
  const databuffer::Ownship beyond_pole = dead_reckoned(sample, seconds(1.0));  // the pole is 111.7 m away
  EXPECT_NEAR(beyond_pole.longitude_deg, -150.0, 1e-6);
  EXPECT_NEAR(beyond_pole.heading_deg, 180.0, 1e-6);
  EXPECT_NEAR(beyond_pole.velocity_north_mps, -250.0, 1e-6);
}

TEST(DeadReckoning, AppliesVelocityAccelerationAndAttitudeRates) {
  const Reading reading{0.0, 0.0, 1000.0, 90.0, 0.0, 0.0, 0.0, 100.0, -10.0};
  const auto sample = checked_sample("accelerates", reading, AttitudeRates{0, 1, 4}, geo::Vector3{0, 10, 2}).value();
  const databuffer::Ownship there = dead_reckoned(sample, seconds(2.0));
  const double flown_m = (100.0 * 2.0 + 0.5 * 10.0 * 4.0) * 6'378'137.0 / 6'379'137.0;
  EXPECT_NEAR(there.longitude_deg, flown_m / 6'378'137.0 / geo::kRadiansPerDegree, 1e-9);
  EXPECT_NEAR(there.altitude_msl_m, 1000.0 + 20.0 - 4.0, 1e-9);
  EXPECT_NEAR(there.velocity_east_mps, 120.0, 1e-9);
  EXPECT_NEAR(there.velocity_down_mps, -6.0, 1e-9);
  EXPECT_NEAR(there.pitch_deg, 2.0, 1e-12);
  EXPECT_NEAR(there.roll_deg, 8.0, 1e-12);
}

// Compares position and velocity with a sum over many small steps. In each step, velocity and acceleration are rotated
// by the turn so far.
TEST(DeadReckoning, VelocityAndAccelerationRotateWithTheBody) {
  constexpr double kSeconds = 5.0;
  constexpr int kSteps = 10'000;
  for (const double turn_radps : {0.0, 1e-6, 1e-3, 0.02, 0.3}) {
    const Reading reading{36.0, -120.0, 0.0, 0.0, 0.0, 0.0, 100.0, 40.0, -5.0};
    auto sample = checked_sample("turns", reading, AttitudeRates{}, geo::Vector3{3.0, -2.0, 1.0}).value();
    const geo::Vector3 axis = glm::normalize(geo::Vector3{0.1, -0.2, 1.0});
    sample.turn_radps = turn_radps * axis;
    const auto velocity_at = [&](double t) {
      const geo::Vector3 straight = geo::Vector3{100.0, 40.0, -5.0} + t * *sample.acceleration_mps2;
      const double turned = turn_radps * t;
      return std::cos(turned) * straight + std::sin(turned) * cross(axis, straight) +
             (1.0 - std::cos(turned)) * dot(axis, straight) * axis;
    };
    geo::Vector3 displacement_m;
    for (int i = 0; i < kSteps; ++i) displacement_m += kSeconds / kSteps * velocity_at((i + 0.5) * kSeconds / kSteps);
    const databuffer::Ownship there = dead_reckoned(sample, seconds(kSeconds));
    const auto geodesic = geo::geodesic_inverse({36.0, -120.0}, {there.latitude_deg, there.longitude_deg});
    EXPECT_NEAR(geodesic.distance.metres() * std::cos(geodesic.azimuth_at_start.radians()), displacement_m.x, 1e-3)
        << turn_radps;
    EXPECT_NEAR(geodesic.distance.metres() * std::sin(geodesic.azimuth_at_start.radians()), displacement_m.y, 1e-3)
        << turn_radps;
    EXPECT_NEAR(-there.altitude_msl_m, displacement_m.z, 1e-6) << turn_radps;
    const geo::Vector3 velocity = velocity_at(kSeconds);
    EXPECT_NEAR(there.velocity_north_mps, velocity.x, 0.01) << turn_radps;
    EXPECT_NEAR(there.velocity_east_mps, velocity.y, 0.01) << turn_radps;
    EXPECT_NEAR(there.velocity_down_mps, velocity.z, 1e-9) << turn_radps;
  }
}

TEST(ExternalSample, BodyRatesBecomeRatesOfHeadingPitchAndRoll) {
  const auto level = rates_from_body(1.0, 2.0, 3.0, 0.0, 0.0);
  ASSERT_TRUE(level);
  EXPECT_DOUBLE_EQ(level->roll_dps, 1.0);
  EXPECT_DOUBLE_EQ(level->pitch_dps, 2.0);
  EXPECT_DOUBLE_EQ(level->heading_dps, 3.0);
  const auto banked_90_deg = rates_from_body(0.0, 2.0, 0.0, 0.0, 90.0);
  EXPECT_NEAR(banked_90_deg->heading_dps, 2.0, 1e-12) << "pitch rate at 90 deg of bank turns the heading";
  EXPECT_NEAR(banked_90_deg->pitch_dps, 0.0, 1e-12);
  EXPECT_FALSE(rates_from_body(1.0, 2.0, 3.0, 90.0, 0.0)) << "no heading rate with the nose straight up";
}

}  // namespace
}  // namespace yars::flightmodel::bridges
