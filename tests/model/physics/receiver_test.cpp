// Radar equation, illuminated area, beam patterns and pulse smear, against closed forms.
#include "model/physics/receiver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "lib/radar/configuration.hpp"
#include "tests/model/physics/decibels.hpp"

namespace yars::model::rbm {
namespace {

physics::Receiver receiver_at(double range_nm) {
  return physics::Receivers(radar::RadarConfiguration{}).at(geo::Length::nautical_miles(range_nm));
}

TEST(Receiver, AtTwiceTheRangeAPointReturnsTwelveDecibelsLess) {
  EXPECT_NEAR(decibels(physics::returned_power(10.0, 1.0, 40000.0) / physics::returned_power(10.0, 1.0, 20000.0)),
              -12.04, 0.005);
}

TEST(Receiver, AtTwiceTheRangePulseLimitedClutterReturnsNineDecibelsLess) {
  const physics::Receiver receiver = receiver_at(40.0);
  const double sin_grazing = std::sin(2.0 * geo::kRadiansPerDegree);
  const double near =
      physics::returned_power(20000.0 * physics::illuminated_length_m(receiver, 20000.0, sin_grazing), 1.0, 20000.0);
  const double far =
      physics::returned_power(40000.0 * physics::illuminated_length_m(receiver, 40000.0, sin_grazing), 1.0, 40000.0);
  EXPECT_NEAR(decibels(far / near), -9.03, 0.005);
}

TEST(Receiver, IsBeamLimitedStraightDownAndPulseLimitedAtZeroGrazing) {
  const physics::Receiver receiver = receiver_at(40.0);
  const double range_m = 10000.0;
  EXPECT_NEAR(physics::illuminated_length_m(receiver, range_m, 1.0), range_m * receiver.elevation_beamwidth_rad, 1e-6);
  EXPECT_NEAR(physics::illuminated_length_m(receiver, range_m, 0.0), receiver.pulse_length_m, 1e-6);
}

TEST(Receiver, ThePulseOfTheShortestRangeCoversTheReports127Feet) {
  // 0.26 us, docs/spec/physics.md#pulse.
  EXPECT_NEAR(receiver_at(4.7).pulse_length_m / geo::kMetresPerFoot, 127.0, 1.5);
  EXPECT_NEAR(receiver_at(160.0).pulse_length_m, 6.0 * 149.896, 0.01);
  EXPECT_NEAR(receiver_at(300.0).pulse_length_m, 6.0 * 149.896, 0.01);
}

TEST(Receiver, TheTwoWayGaussianIsAQuarterAtHalfABeamwidth) {
  const double theta = 2.5 * geo::kRadiansPerDegree;
  EXPECT_NEAR(physics::two_way_gain(radar::BeamPattern::gaussian, theta, 0.0, 0.5 * theta), 0.25, 1e-4);
  EXPECT_NEAR(physics::two_way_gain(radar::BeamPattern::gaussian, theta, -0.1, -0.1), 1.0, 1e-12);
}

TEST(Receiver, TheHardEdgeIsHalfABeamwidthFromTheCentre) {
  const double theta = 2.5 * geo::kRadiansPerDegree;
  EXPECT_EQ(physics::two_way_gain(radar::BeamPattern::hard_edge, theta, 0.0, 0.499 * theta), 1.0);
  EXPECT_EQ(physics::two_way_gain(radar::BeamPattern::hard_edge, theta, 0.0, -0.501 * theta), 0.0);
}

TEST(Receiver, TheMappingBeamFallsWithTheCosecantSquaredBelowItsCentre) {
  const double theta = 2.5 * geo::kRadiansPerDegree;
  const double centre = -5.0 * geo::kRadiansPerDegree;
  for (const double depression_deg : {6.0, 10.0, 30.0, 89.0}) {
    const double depression = depression_deg * geo::kRadiansPerDegree;
    const double ratio = std::sin(-centre) / std::sin(depression);
    EXPECT_NEAR(physics::two_way_gain(radar::BeamPattern::cosecant_squared, theta, centre, -depression), ratio * ratio,
                1e-12);
  }
  EXPECT_NEAR(physics::two_way_gain(radar::BeamPattern::cosecant_squared, theta, centre, centre + 0.5 * theta), 0.25,
              1e-4);
}

TEST(PulseSmear, ConservesPowerForAnyPulseLength) {
  for (const double samples : {0.0, 0.5, 1.0, 1.94, 2.0, 5.3, 18.7, 64.0, 1000.0}) {
    const physics::PulseSmear smear = physics::make_pulse_smear(samples);
    EXPECT_NEAR(std::accumulate(smear.weights.begin(), smear.weights.end(), 0.0), 1.0, 1e-12) << samples;
    EXPECT_LE(smear.reach, physics::PulseSmear::kMaxRadius);
  }
}

TEST(PulseSmear, OfTwoSamplesIsAQuarterAHalfAQuarter) {
  const physics::PulseSmear smear = physics::make_pulse_smear(2.0);
  ASSERT_EQ(smear.reach, 1);
  EXPECT_DOUBLE_EQ(smear.weights[0], 0.25);
  EXPECT_DOUBLE_EQ(smear.weights[1], 0.5);
  EXPECT_DOUBLE_EQ(smear.weights[2], 0.25);
}

// A sample is the mean over its cell: with a pulse of half a sample, a quarter of the cell's ranges sees the next
// sample with a quarter of the pulse on average.
TEST(PulseSmear, OfHalfASampleReachesASixteenthIntoItsNeighbours) {
  const physics::PulseSmear smear = physics::make_pulse_smear(0.5);
  ASSERT_EQ(smear.reach, 1);
  EXPECT_DOUBLE_EQ(smear.weights[0], 0.0625);
  EXPECT_DOUBLE_EQ(smear.weights[1], 0.875);
}

TEST(PulseSmear, IsNoneForAPulseWithoutLength) {
  const physics::PulseSmear smear = physics::make_pulse_smear(0.0);
  EXPECT_EQ(smear.reach, 0);
  EXPECT_DOUBLE_EQ(smear.weights[0], 1.0);
}

}  // namespace
}  // namespace yars::model::rbm
