// Extreme time steps of flight models, kernel and antenna: zero, negative, NaN, a nanosecond, ten seconds, thirty days.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "databuffer/messages/validation.hpp"
#include "flightmodel/route_flight.hpp"
#include "flightmodel/source_reader.hpp"
#include "lib/radar/modes.hpp"
#include "model/antenna/antenna.hpp"
#include "tests/model/kernel/cockpit.hpp"

namespace yars {
namespace {

using flightmodel::FlightModel;
using flightmodel::FlightSample;

constexpr double kTimeNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kTimeInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kThirtyDaysOfTicks = std::int64_t{30} * 24 * 3600 * 200;  // 518,400,000

// Calls `body` with two new, equal flight models of each kind. They fly at about 240 m/s to the north-east.
void for_each_flight(const std::function<void(FlightModel&, FlightModel&)>& body) {
  using namespace flightmodel;
  const auto each = [&body](const char* name, const auto& make) {
    SCOPED_TRACE(name);
    const auto first = make();
    const auto second = make();
    body(*first, *second);
  };
  each("fixed", [] { return std::make_unique<FixedFlight>(parse_fixed("38,-123,15000,45,480").value()); });
  each("route", [] {
    return std::make_unique<RouteFlight>(
        parse_route("38 -123 15000 480\n39 -122 20000 400\n39 -121 15000 480\n", "route").value());
  });
  each("track", [] {
    return std::make_unique<TrackFlight>(
        parse_track("time,lat,lon,alt_ft,heading,pitch,roll\n0,38,-123,15000,45,0,0\n5,38.01,-122.99,15000,45,0,0\n"
                    "500,39,-122,15000,45,0,0\n",
                    "track")
            .value());
  });
}

double apart_m(const FlightSample& a, const FlightSample& b) {
  return geo::geodesic_inverse({a.ownship.latitude_deg, a.ownship.longitude_deg},
                               {b.ownship.latitude_deg, b.ownship.longitude_deg})
      .distance.metres();
}

TEST(ExtremeTimes, ZeroNegativeAndNonFiniteStepsDoNotMoveTheAircraft) {
  for_each_flight([](FlightModel& flight, FlightModel&) {
    const FlightSample before = flight.step(geo::Duration::seconds(7.0));
    for (const double dt_s :
         {0.0, -0.0, -1e-9, -0.005, -10.0, -1e300, kTimeNan, -kTimeNan, kTimeInfinity, -kTimeInfinity}) {
      const FlightSample after = flight.step(geo::Duration::seconds(dt_s));
      ASSERT_EQ(databuffer::validate(after.ownship), std::nullopt) << dt_s;
      ASSERT_EQ(std::memcmp(&before.ownship, &after.ownship, sizeof before.ownship), 0) << dt_s;
    }
  });
}

TEST(ExtremeTimes, ANanosecondMovesTheAircraftByLessThanAMicrometre) {
  for_each_flight([](FlightModel& flight, FlightModel&) {
    const FlightSample before = flight.step(geo::Duration::seconds(7.0));
    // At most 300 m/s x 1 ns = 0.3 um. The rounding of latitude and longitude is below 0.1 um.
    EXPECT_LT(apart_m(before, flight.step(geo::Duration::seconds(1e-9))), 1e-6);
  });
}

TEST(ExtremeTimes, OneStepOfTenSecondsEndsWhereTwoThousandTicksEnd) {
  for_each_flight([](FlightModel& once, FlightModel& often) {
    const FlightSample start = once.step({});
    const FlightSample far = once.step(geo::Duration::seconds(10.0));
    FlightSample near{};
    for (int tick = 0; tick < 2000; ++tick) near = often.step(geo::Duration::seconds(radar::kTickSeconds));
    EXPECT_LT(apart_m(far, near), 0.5);
    EXPECT_GT(apart_m(far, start), 1000.0);
  });
}

// A sweep depends on the tick's index, not on its sim time. Only movers depend on sim time.
TEST(ExtremeTimes, SweepsAreEqualForAnyStepsOfSimTime) {
  test::Cockpit steady;
  const auto expected = steady.run(250);
  for (const std::int64_t step_ns : {std::int64_t{0}, std::int64_t{-5'000'000}, std::int64_t{1},
                                     std::int64_t{10'000'000'000}, std::int64_t{1'000'000'000'000'000}}) {
    SCOPED_TRACE(step_ns);
    test::Cockpit cockpit;
    std::size_t next = 0;
    for (int i = 0; i < 250; ++i) {
      ++cockpit.tick.tick;
      cockpit.tick.sim_time_ns += step_ns;
      if (!cockpit.kernel.step(cockpit.tick, cockpit.terrain, cockpit.sweep)) continue;
      ASSERT_LT(next, expected.size());
      ASSERT_EQ(cockpit.sweep.hash, expected[next].hash) << i;  // edges and video
      ++next;
    }
    EXPECT_EQ(next, expected.size());
  }
}

std::vector<std::uint64_t> bits_of(const model::antenna::Antenna::State& state) {
  return {std::bit_cast<std::uint64_t>(state.azimuth_deg), std::bit_cast<std::uint64_t>(state.elevation_deg),
          std::bit_cast<std::uint64_t>(state.centre_deg),  std::bit_cast<std::uint64_t>(state.width_deg),
          static_cast<std::uint64_t>(state.tick),          static_cast<std::uint64_t>(state.direction),
          static_cast<std::uint64_t>(state.phase)};
}

// With constant platform and commanded elevation, the antenna's next state depends only on its State. The only time in
// it is the tick within the scan. Two scans, one in each direction, return
// the state to the same bits. So do all pairs of scans in thirty days (1,296,000 pairs of the widest scan): the edges
// of sweeps do not drift.
TEST(ExtremeTimes, TwoScansReturnTheAntennaToTheSameBits) {
  for (const double width_deg : {100.0, 50.0, 25.0}) {
    for (const double heading_deg : {0.0, 33.3, 359.9}) {
      for (const double drift_deg : {0.0, 4.1, -10.0}) {
        const radar::Platform platform{
            geo::Bearing::degrees(heading_deg), {}, {}, geo::Bearing::degrees(heading_deg + drift_deg)};
        model::antenna::Antenna antenna({});
        antenna.restart(width_deg);
        const auto elevation = geo::Angle::degrees(-4.0);
        for (int tick = 0; tick < 1000; ++tick) antenna.step(platform, elevation);
        const auto before = bits_of(antenna.state());
        const int period = 2 * antenna.pattern().scan_ticks();
        ASSERT_EQ(kThirtyDaysOfTicks % period, 0);
        for (int tick = 0; tick < period; ++tick) antenna.step(platform, elevation);
        EXPECT_EQ(bits_of(antenna.state()), before) << width_deg << " " << heading_deg << " " << drift_deg;
      }
    }
  }
}

TEST(ExtremeTimes, AfterThirtyDaysSweepsHaveTheSameEdgesBitForBit) {
  test::Cockpit young;
  young.run(1000);
  const databuffer::ModelStatus status = young.status();
  test::Cockpit old;
  databuffer::ModelStatus later = status;
  later.tick += kThirtyDaysOfTicks;
  later.sim_time_ns += kThirtyDaysOfTicks * radar::kTickNanoseconds;
  later.scan += static_cast<std::uint32_t>(kThirtyDaysOfTicks / 200);
  later.sweep += static_cast<std::uint32_t>(kThirtyDaysOfTicks / 200 * 182);
  old.kernel.resume(later);
  old.tick = young.tick;
  old.tick.tick = later.tick;
  young.kernel.resume(status);  // both kernels resume, so that both begin a new chain of sweeps
  const auto first = young.run(600);
  const auto last = old.run(600);
  ASSERT_EQ(first.size(), last.size());
  ASSERT_GT(first.size(), 500U);
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(std::bit_cast<std::uint64_t>(first[i].azimuth_left_deg),
              std::bit_cast<std::uint64_t>(last[i].azimuth_left_deg));
    ASSERT_EQ(std::bit_cast<std::uint64_t>(first[i].azimuth_right_deg),
              std::bit_cast<std::uint64_t>(last[i].azimuth_right_deg));
    ASSERT_EQ(last[i].tick - first[i].tick, kThirtyDaysOfTicks);
    ASSERT_EQ(last[i].scan - first[i].scan, 2'592'000U);
    ASSERT_EQ(last[i].number - first[i].number, 471'744'000U);
  }
}

}  // namespace
}  // namespace yars
