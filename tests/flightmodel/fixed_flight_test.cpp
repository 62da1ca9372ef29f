// Tests of FixedFlight (`--source fixed:LAT,LON,ALT_FT,HDG,KT`): level flight along a geodesic at constant speed.
#include <gmock/gmock.h>

#include "flightmodel/source_reader.hpp"
#include "tests/flightmodel/flight_checks.hpp"

namespace yars::flightmodel {
namespace {

using ::testing::HasSubstr;

FixedFlight fixed_flight_of(const char* text) {
  return FixedFlight(parse_fixed(text).value());
}

std::string fixed_refusal(const char* text) {
  const auto setting = parse_fixed(text);
  return setting ? "accepted" : setting.error().message();
}

TEST(FixedFlight, StartsAtItsGivenPosition) {
  auto flight = fixed_flight_of("38,-123.1,15000,160,480");
  const databuffer::Ownship ownship = flight.step({}).ownship;
  EXPECT_NEAR(ownship.latitude_deg, 38.0, 1e-12);
  EXPECT_NEAR(ownship.longitude_deg, -123.1, 1e-12);
  EXPECT_NEAR(ownship.altitude_msl_m, 4572.0, 1e-9);
  EXPECT_NEAR(ownship.heading_deg, 160.0, 1e-9);
  EXPECT_NEAR(ground_speed_of(ownship), 480.0 * 1852.0 / 3600.0, 1e-9);
  EXPECT_EQ(ownship.roll_deg, 0.0);
  EXPECT_EQ(ownship.pitch_deg, 0.0);
  EXPECT_TRUE(std::isnan(ownship.radar_altitude_m));
  EXPECT_STREQ(ownship.source, "fixed");
}

TEST(FixedFlight, InOneHourAtSeaLevelFliesAsManyMilesAsKnots) {
  auto flight = fixed_flight_of("10,20,0,45,360");
  FlightSample sample;
  for (int tick = 0; tick < 3'600; ++tick) sample = flight.step(geo::Duration::seconds(1.0));
  EXPECT_NEAR(distance_m({10, 20}, point_of(sample.ownship)), 360.0 * 1852.0, 1e-3);
}

TEST(FixedFlight, AtAltitudeTheDistanceOverGroundIsShorter) {
  auto flight = fixed_flight_of("0,0,100000,90,1000");
  FlightSample sample;
  for (int tick = 0; tick < 3'600; ++tick) sample = flight.step(geo::Duration::seconds(1.0));
  const double equator_m = 6'378'137.0;  // WGS84 a
  const double expected_m = 1000.0 * 1852.0 * equator_m / (equator_m + 30'480.0);
  EXPECT_NEAR(distance_m({0, 0}, point_of(sample.ownship)), expected_m, 1e-3);
}

TEST(FixedFlight, FliesAlongAGeodesic) {
  auto flight = fixed_flight_of("50,-10,30000,70,480");
  FlightSample sample;
  for (int minute = 0; minute < 300; ++minute) sample = flight.step(geo::Duration::seconds(60.0));
  const auto path = geo::geodesic_inverse({50, -10}, point_of(sample.ownship));
  EXPECT_NEAR(path.azimuth_at_start.degrees(), 70.0, 1e-9);
  EXPECT_NEAR(sample.ownship.heading_deg, path.azimuth_at_end.degrees(), 1e-9);
}

TEST(FixedFlight, VelocityIsTheDerivativeOfPosition) {
  for (const char* text : {"38,-123.1,15000,160,480", "0,179.99,40000,90,600", "-60,0,1000,359.9,250"}) {
    auto flight = fixed_flight_of(text);
    expect_consistent(flight, 120.0, 0.5, 1e-2);
  }
}

TEST(FixedFlight, CrossesThePoleAndTheAntimeridian) {
  auto across_pole = fixed_flight_of("89.9,30,20000,0,600");
  const FlightSample beyond_pole = expect_consistent(across_pole, 200.0, 0.5, 1e-2);
  EXPECT_NEAR(beyond_pole.ownship.longitude_deg, -150.0, 1e-6);
  EXPECT_NEAR(beyond_pole.ownship.heading_deg, 180.0, 1e-6);
  auto across_antimeridian = fixed_flight_of("10,179.9,20000,90,600");
  EXPECT_LT(expect_consistent(across_antimeridian, 200.0, 0.5, 1e-2).ownship.longitude_deg, -179.0);
}

TEST(FixedFlight, AtZeroSpeedStaysInPlace) {
  auto flight = fixed_flight_of("38,-123,15000,160,0");
  const FlightSample first = flight.step({});
  for (int tick = 0; tick < 1'000; ++tick) flight.step(geo::Duration::seconds(1.0));
  EXPECT_TRUE(same_sample(first, flight.step({})));
  EXPECT_EQ(ground_speed_of(first.ownship), 0.0);
  EXPECT_NEAR(first.ownship.heading_deg, 160.0, 1e-9);
}

TEST(FixedFlight, ResetReturnsToTheStart) {
  auto flight = fixed_flight_of("38,-123,15000,160,480");
  const FlightSample first = flight.step({});
  flight.step(geo::Duration::seconds(100.0));
  flight.reset();
  EXPECT_TRUE(same_sample(first, flight.step({})));
}

TEST(FixedFlight, RepositioningContinuesFromTheNewPosition) {
  auto flight = fixed_flight_of("38,-123,15000,160,480");
  flight.step(geo::Duration::seconds(100.0));
  EXPECT_TRUE(flight.reposition({{-20, 100}, geo::AltitudeMsl::metres(1000), geo::Bearing::degrees(90)}));
  const databuffer::Ownship ownship = flight.step({}).ownship;
  EXPECT_NEAR(ownship.latitude_deg, -20.0, 1e-12);
  EXPECT_NEAR(ownship.longitude_deg, 100.0, 1e-12);
  EXPECT_EQ(ownship.altitude_msl_m, 1000.0);
  EXPECT_NEAR(ground_speed_of(ownship), 480.0 * 1852.0 / 3600.0, 1e-9);
}

TEST(FixedFlight, ARepositioningMayHaveASpeedUntilAReset) {
  auto flight = fixed_flight_of("38,-123.1,15000,160,480");
  flight.reposition(
      {{37.0, -122.0}, geo::AltitudeMsl::feet(10'000), geo::Bearing::degrees(90), geo::Speed::knots(200)});
  EXPECT_NEAR(ground_speed_of(flight.step({}).ownship), geo::Speed::knots(200).metres_per_second(), 1e-9);
  flight.reset();
  EXPECT_NEAR(ground_speed_of(flight.step({}).ownship), geo::Speed::knots(480).metres_per_second(), 1e-9);
}

TEST(FixedFlight, ABadSettingNamesTheField) {
  EXPECT_THAT(fixed_refusal("38,-123,15000,160"), HasSubstr("LAT,LON,ALT_FT,HDG,KT"));
  EXPECT_THAT(fixed_refusal("91,-123,15000,160,480"), HasSubstr("LAT in [-90, 90]"));
  EXPECT_THAT(fixed_refusal("38,-181,15000,160,480"), HasSubstr("LON in [-180, 180]"));
  EXPECT_THAT(fixed_refusal("38,-123,nan,160,480"), HasSubstr("ALT_FT"));
  EXPECT_THAT(fixed_refusal("38,-123,15000,361,480"), HasSubstr("HDG"));
  EXPECT_THAT(fixed_refusal("38,-123,15000,160,-1"), HasSubstr("KT"));
  EXPECT_NE(fixed_refusal(""), "accepted");
}

}  // namespace
}  // namespace yars::flightmodel
