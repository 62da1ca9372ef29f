// Tests of the table of DIS entities, of the surface traffic that the radar gets from it, and of the order of stamps.
#include <gmock/gmock.h>

#include "databuffer/messages/validation.hpp"
#include "flightmodel/bridges/dis.hpp"
#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"
#include "tests/flightmodel/bridges/packets.hpp"

namespace yars::flightmodel::bridges {
namespace {

using ::testing::HasSubstr;

TEST(EntityTable, AShipIsExtrapolatedByItsVelocity) {
  EntityTable table;
  ASSERT_FALSE(table.update(state_of("dis/ship.bin"), seconds(10)));
  const auto entities = table.at(seconds(18));
  ASSERT_EQ(entities.size(), 1U);
  const auto path =
      geo::geodesic_inverse({36.7, -122.1}, {entities[0].state.latitude_deg, entities[0].state.longitude_deg});
  EXPECT_NEAR(path.distance.metres(), 80.0, 0.01) << "10 m/s for 8 s";
  EXPECT_NEAR(path.azimuth_at_start.degrees(), 270.0, 0.01);
  EXPECT_EQ(entities[0].age.seconds(), 8.0);
}

TEST(EntityTable, AnEntitySilentForTwelveSecondsLeaves) {
  EntityTable table;
  table.update(state_of("dis/ship.bin"), seconds(10));
  EXPECT_EQ(table.at(seconds(22)).size(), 1U);
  EXPECT_EQ(table.at(seconds(22.01)).size(), 0U);
  EXPECT_FALSE(table.update(state_of("dis/ship.bin"), seconds(23))) << "after it has left, any stamp is accepted";
  EXPECT_EQ(table.at(seconds(23)).size(), 1U);
}

TEST(EntityTable, ADeactivatedEntityLeavesAtOnceAndAFrozenOneStandsStill) {
  EntityTable table;
  table.update(state_of("dis/ship.bin"), seconds(10));
  table.update(state_of("dis/ship_gone.bin"), seconds(11));
  EXPECT_EQ(table.at(seconds(11)).size(), 0U);
  table.update(state_of("dis/ship_frozen.bin"), seconds(12));
  EXPECT_NEAR(table.at(seconds(20))[0].state.longitude_deg, -122.1, 1e-9);
}

TEST(EntityTable, AnOlderReportDoesNotReplaceANewerOne) {
  EntityTable table;
  EntityState state = state_of("dis/ship.bin");
  table.update(state, seconds(10));
  state.stamp = state.stamp.value() - seconds(1);
  EXPECT_THAT(table.update(state, seconds(11)).value_or(""), HasSubstr("1,2,9"));
  EXPECT_EQ(table.at(seconds(11))[0].age.seconds(), 1.0);
}

TEST(EntityTable, AnEntityExtrapolatedToAnInvalidSpeedIsLeftOut) {
  EntityTable table;
  EntityState state = state_of("dis/ship.bin");
  state.sample.acceleration_mps2 = geo::Vector3{1'000.0, 0.0, 0.0};
  table.update(state, seconds(10));
  EXPECT_EQ(table.at(seconds(12)).size(), 1U);
  EXPECT_EQ(table.at(seconds(21)).size(), 0U) << "11 km/s";
}

TEST(EntityTable, HasALimitAndReplacesSilentEntities) {
  EntityTable table;
  EntityState state = state_of("dis/ship.bin");
  const auto add = [&](std::size_t number, double now_s) {
    state.id.application = static_cast<std::uint16_t>(number / 1'000);
    state.id.entity = static_cast<std::uint16_t>(number % 1'000);
    return table.update(state, seconds(now_s));
  };
  for (std::size_t number = 0; number < kMaxEntities; ++number) ASSERT_FALSE(add(number, 10));
  EXPECT_TRUE(add(kMaxEntities, 11));
  EXPECT_EQ(table.at(seconds(11)).size(), kMaxEntities);
  EXPECT_FALSE(add(kMaxEntities, 30)) << "all others have left";
  EXPECT_EQ(table.at(seconds(30)).size(), 1U);
}

TEST(SurfaceTraffic, HasShipsAndVehiclesButNoAircraft) {
  EntityTable table;
  for (const char* name : {"dis/air.bin", "dis/ship.bin", "dis/truck.bin"})
    ASSERT_FALSE(table.update(state_of(name), seconds(10)));
  const databuffer::Traffic traffic = surface_traffic(table.at(seconds(10)), {36.6, -121.9});
  EXPECT_FALSE(databuffer::validate(traffic));
  ASSERT_EQ(traffic.count, 2U);
  EXPECT_NEAR(traffic.entities[0].latitude_deg, 36.7, 1e-9);
  EXPECT_NEAR(traffic.entities[0].velocity_east_mps, -10.0, 1e-3);
  EXPECT_EQ(traffic.entities[0].cross_section_m2, kShipCrossSection_m2);
  EXPECT_EQ(traffic.entities[1].cross_section_m2, kVehicleCrossSection_m2);
  EXPECT_NE(traffic.entities[0].id, traffic.entities[1].id);
}

TEST(SurfaceTraffic, KeepsTheNearestEntities) {
  EntityTable table;
  EntityState state = state_of("dis/ship.bin");
  for (std::size_t number = 0; number < databuffer::kMaxTraffic + 10; ++number) {
    state.id.entity = static_cast<std::uint16_t>(number);
    state.sample.ownship.latitude_deg = 40.0 - 0.01 * static_cast<double>(number);
    ASSERT_FALSE(table.update(state, seconds(10)));
  }
  const databuffer::Traffic traffic = surface_traffic(table.at(seconds(10)), {30.0, -122.1});
  ASSERT_EQ(traffic.count, databuffer::kMaxTraffic);
  for (const databuffer::TrafficEntity& entity : traffic.entities) EXPECT_LT(entity.latitude_deg, 39.905);
}

TEST(StampOrder, StampsWrapAtTheFullHour) {
  StampOrder order(kDisStampPeriod);
  EXPECT_FALSE(order.order_fault(seconds(3'599.9)));
  EXPECT_FALSE(order.order_fault(seconds(0.1)));
  EXPECT_TRUE(order.order_fault(seconds(3'599.95)));
}

TEST(StampOrder, RepeatedOldStampsAreNoRestart) {
  StampOrder order;
  EXPECT_FALSE(order.order_fault(seconds(100)));
  EXPECT_TRUE(order.order_fault(seconds(3)));
  EXPECT_FALSE(order.order_fault(seconds(100.1)));
  EXPECT_TRUE(order.order_fault(seconds(3))) << "refused again after a newer stamp";
  EXPECT_TRUE(order.order_fault(seconds(3))) << "the same old stamp again: a duplicate";
}

}  // namespace
}  // namespace yars::flightmodel::bridges
