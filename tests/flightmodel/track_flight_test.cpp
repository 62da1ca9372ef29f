// Tests of TrackFlight (`--source csv:FILE`): the file's columns and errors, and the flight along its rows.
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "flightmodel/source_reader.hpp"
#include "tests/flightmodel/flight_checks.hpp"

namespace yars::flightmodel {
namespace {

using ::testing::HasSubstr;

const std::string kHeader = "time,lat,lon,alt_ft,heading,pitch,roll\n";

TrackFlight flight_of(const std::string& rows) {
  return TrackFlight(parse_track(kHeader + rows, "t.csv").value());
}

databuffer::Ownship after(TrackFlight& flight, double seconds) {
  return flight.step(geo::Duration::seconds(seconds)).ownship;
}

std::string track_refusal(const std::string& text) {
  const auto track = parse_track(text, "t.csv");
  return track ? "accepted" : track.error().message();
}

TEST(Track, ColumnsAreFoundByName) {
  const auto track = parse_track(
      "roll,pitch,fuel,heading,alt_ft,lon,lat,time\n3,2,99,90,1000,20,10,5\n3,2,98,-90,1000,20,11,6\n", "t.csv");
  ASSERT_TRUE(track) << track.error().message();
  EXPECT_EQ(track->rows[0].point.latitude_deg, 10.0);
  EXPECT_EQ(track->rows[0].time.seconds(), 5.0);
  EXPECT_NEAR(track->rows[0].attitude.roll.degrees(), 3.0, 1e-12);
  EXPECT_EQ(track->rows[1].attitude.heading.degrees(), 270.0);
}

TEST(Track, ErrorsCarryTheLineAndWhatWasExpected) {
  EXPECT_THAT(track_refusal(""), HasSubstr("header"));
  EXPECT_THAT(track_refusal("time,lat,lon\n"), HasSubstr("t.csv:1"));
  EXPECT_THAT(track_refusal("time,lat,lon,alt_ft,heading,pitch\n"), HasSubstr("no column roll"));
  EXPECT_THAT(track_refusal(kHeader + "0,10,20,1000,90,0,0\n"), HasSubstr("at least two rows"));
  EXPECT_THAT(track_refusal(kHeader + "0,10,20,1000,90,0,0\n1,10,20,1000,90,0\n"), HasSubstr("t.csv:3"));
  EXPECT_THAT(track_refusal(kHeader + "0,10,20,1000,90,0,0\n1,10,200,1000,90,0,0\n"), HasSubstr("lon in [-180, 180]"));
  EXPECT_THAT(track_refusal(kHeader + "1,10,20,1000,90,0,0\n1,10,20,1000,90,0,0\n"), HasSubstr("a time after 1 s"));
  EXPECT_THAT(track_refusal(kHeader + "0,10,20,1000,90,0,0\n1,10,20,x,90,0,0\n"), HasSubstr("alt_ft"));
  EXPECT_THAT(track_refusal(kHeader + "0,0,0,0,0,0,0\n1,0,0,0,0,0,0\nloop\n2,0,0,0,0,0,0\n"), HasSubstr("behind loop"));
}

TEST(TrackFlight, InterpolatesAllValuesLinearlyInTime) {
  auto flight = flight_of("10,10,20,1000,80,2,10\n20,10.1,20,2000,100,4,-10\n");
  const databuffer::Ownship ownship = after(flight, 5.0);
  EXPECT_NEAR(distance_m(point_of(ownship), {10, 20}), distance_m({10, 20}, {10.1, 20}) / 2.0, 1e-3);
  EXPECT_NEAR(ownship.altitude_msl_m, 1500.0 * 0.3048, 1e-9);
  EXPECT_NEAR(ownship.heading_deg, 90.0, 1e-9);
  EXPECT_NEAR(ownship.pitch_deg, 3.0, 1e-9);
  EXPECT_NEAR(ownship.roll_deg, 0.0, 1e-9);
  EXPECT_NEAR(ownship.velocity_down_mps, -30.48, 1e-9);
  EXPECT_NEAR(ownship.velocity_east_mps, 0.0, 1e-6);
  EXPECT_STREQ(ownship.source, "csv");
}

TEST(TrackFlight, HeadingTurnsTheShortWayThroughNorth) {
  auto flight = flight_of("0,10,20,1000,350,0,0\n10,10.1,20,1000,10,0,0\n");
  EXPECT_NEAR(geo::wrapped_degrees(after(flight, 5.0).heading_deg), 0.0, 1e-9);
  EXPECT_NEAR(after(flight, 2.5).heading_deg, 5.0, 1e-9);
}

TEST(TrackFlight, CrossesTheAntimeridianTheShortWay) {
  auto flight = flight_of("0,0,179.9,1000,90,0,0\n100,0,-179.9,1000,90,0,0\n");
  const FlightSample last = expect_consistent(flight, 99.0, 0.5, 1e-2);
  EXPECT_NEAR(ground_speed_of(last.ownship), distance_m({0, 179.9}, {0, -179.9}) / 100.0, 0.02);
  EXPECT_LT(last.ownship.longitude_deg, -179.0);
}

TEST(TrackFlight, CrossesThePoleWithHeadingEqualToTrack) {
  auto flight = flight_of("0,89.9,0,10000,0,0,0\n100,89.9,180,10000,180,0,0\n");
  after(flight, 25.0);
  for (int second = 0; second < 50; ++second) {
    const databuffer::Ownship ownship = after(flight, 1.0);
    const double track_deg = std::atan2(ownship.velocity_east_mps, ownship.velocity_north_mps) / geo::kRadiansPerDegree;
    ASSERT_NEAR(geo::wrapped_degrees(ownship.heading_deg - track_deg), 0.0, 1e-6);
  }
  flight.reset();
  expect_consistent(flight, 99.0, 0.5, 1e-2);
}

TEST(TrackFlight, VelocityIsThatBetweenTwoRows) {
  auto flight = flight_of("0,10,20,1000,0,0,0\n10,10.05,20,1000,0,0,0\n30,10.05,20.1,3000,90,0,0\n");
  EXPECT_NEAR(after(flight, 5.0).velocity_north_mps, distance_m({10, 20}, {10.05, 20}) / 10.0, 0.1);
  const databuffer::Ownship second = after(flight, 15.0);
  EXPECT_NEAR(second.velocity_east_mps, distance_m({10.05, 20}, {10.05, 20.1}) / 20.0, 0.1);
  EXPECT_NEAR(second.velocity_down_mps, -30.48, 1e-9);
}

TEST(TrackFlight, AtTheLastRowItStandsStill) {
  auto flight = flight_of("0,10,20,1000,0,5,0\n10,10.05,20,1000,0,5,0\n");
  const databuffer::Ownship end = after(flight, 1'000.0);
  EXPECT_EQ(end.latitude_deg, 10.05);
  EXPECT_EQ(ground_speed_of(end), 0.0);
  EXPECT_NEAR(end.pitch_deg, 5.0, 1e-12);
}

TEST(TrackFlight, ALoopContinuesAtTheFirstRow) {
  auto flight = flight_of("5,10,20,1000,0,0,0\n15,10.1,20,1000,0,0,0\n25,10,20,1000,0,0,0\nloop\n");
  const databuffer::Ownship first = after(flight, 4.0);
  const databuffer::Ownship again = after(flight, 20.0);
  EXPECT_NEAR(distance_m(point_of(first), point_of(again)), 0.0, 1e-6);
  EXPECT_NEAR(first.velocity_north_mps, again.velocity_north_mps, 1e-9);
  const databuffer::Ownship many = after(flight, 20.0 * 1'000.0);
  EXPECT_NEAR(distance_m(point_of(first), point_of(many)), 0.0, 1e-3);
}

TEST(TrackFlight, CannotBeRepositioned) {
  auto flight = flight_of("0,10,20,1000,0,0,0\n10,10.1,20,1000,0,0,0\n");
  EXPECT_FALSE(flight.reposition({{0, 0}, geo::AltitudeMsl::metres(0), {}}));
  EXPECT_NEAR(distance_m(point_of(after(flight, 0.0)), {10, 20}), 0.0, 1e-6);
}

TEST(TrackFlight, ResumesAtTheFlightTimeThatItsPredecessorPublished) {
  const std::string rows = "0,10,20,1000,0,0,0\n100,11,20,2000,0,0,0\n200,11,21,2000,90,0,0\n";
  TrackFlight before = flight_of(rows);
  const databuffer::Ownship last = after(before, 130.0);
  TrackFlight successor = flight_of(rows);
  ASSERT_TRUE(successor.resume(last, geo::Duration::seconds(2.0)));
  const databuffer::Ownship resumed = after(successor, 0.0);
  const databuffer::Ownship flown_on = after(before, 2.0);
  EXPECT_NEAR(resumed.latitude_deg, flown_on.latitude_deg, 1e-12);
  EXPECT_NEAR(resumed.longitude_deg, flown_on.longitude_deg, 1e-12);
  EXPECT_NEAR(resumed.flight_time_s, 132.0, 1e-9);
}

TEST(TrackFlight, DoesNotResumeWithoutAFlightTimeWithinTheTrack) {
  TrackFlight flight = flight_of("0,10,20,1000,0,0,0\n100,11,20,2000,0,0,0\n");
  databuffer::Ownship last{};
  EXPECT_FALSE(flight.resume(last, {}));
  last.flight_time_s = 101.0;
  EXPECT_FALSE(flight.resume(last, {}));
  last.flight_time_s = std::nan("");
  EXPECT_FALSE(flight.resume(last, {}));
}

}  // namespace
}  // namespace yars::flightmodel
