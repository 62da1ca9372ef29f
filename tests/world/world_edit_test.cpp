// Edits of a world: each changes what it names and nothing else, and refuses what is out of range, with the limits.
#include "world/world_edit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "databuffer/messages/validation.hpp"
#include "lib/radar/modes.hpp"
#include "lib/values/fields.hpp"
#include "tests/world/new_entries.hpp"
#include "world/world_values.hpp"

namespace yars::world {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// A configured world with one entry of each kind and every value different from its default.
radar::WorldConfiguration configured() {
  radar::WorldConfiguration world;
  world.sea.state = 3.5;
  world.sea.wind_speed_mps = 7.7;
  world.sea.wind_from_deg = 123.4;
  world.rain.cells = {{{37.1, -122.1}, 9000.0, 20.0, 6000.0}};
  world.jamming.jammers = {{"noise", {37.2, -122.2}, 300.0, 2, {1, 4, 8}, 55.0}};
  world.movers = {{"ship",
                   {37.3, -122.3},
                   9.0,
                   45.0,
                   5000.0,
                   12.0,
                   geo::Duration::seconds(1.5),
                   radar::TargetEcho::trihedral,
                   40,
                   -10}};
  return world;
}

databuffer::WorldState a_world() {
  return world_state_from(configured());
}

bool equal_but_flags(databuffer::WorldState a, databuffer::WorldState b) {
  a.flags = b.flags = {};
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(WorldValues, ARecordGivesTheConfigurationBack) {
  const radar::WorldConfiguration world = configured();
  const databuffer::WorldState state = world_state_from(world);
  EXPECT_EQ(databuffer::validate(state), std::nullopt);
  EXPECT_EQ(state.flags, databuffer::kWorldConfigured);
  radar::WorldConfiguration other;
  EXPECT_TRUE(radar::changes_between(world, other).any());
  apply(state, other);
  EXPECT_FALSE(radar::changes_between(world, other).any());
  EXPECT_EQ(other.jamming.jammers[0].name, "noise");
  EXPECT_EQ(other.movers[0].name, "ship");
}

TEST(WorldValues, TheDefaultsAreValidAndValuesThatAreNotGivenStayMissing) {
  radar::WorldConfiguration world;
  world.jamming.jammers.emplace_back();
  const databuffer::WorldState state = world_state_from(world);
  EXPECT_EQ(databuffer::validate(state), std::nullopt);
  EXPECT_TRUE(std::isnan(state.sea_state) && std::isnan(state.jammers[0].altitude_m));
  EXPECT_EQ(state.jammers[0].channels, 255U);
  radar::WorldConfiguration again;
  apply(state, again);
  EXPECT_FALSE(radar::changes_between(world, again).any());
}

TEST(WorldValues, LongAndForeignNamesAreCutToWhatARecordHas) {
  radar::WorldConfiguration world;
  world.movers.push_back({.name = "K\xC3\xB6nigin der Meere", .position = {1.0, 2.0}});
  const databuffer::WorldState state = world_state_from(world);
  EXPECT_EQ(databuffer::validate(state), std::nullopt);
  EXPECT_STREQ(state.movers[0].name, "K??nigin der Me");
}

TEST(WorldEdit, AddsEntriesWithIdsOfTheirOwn) {
  databuffer::WorldState world = a_world();
  EXPECT_EQ(add(world, new_rain_cell({38.0, -123.0})), 2U);
  EXPECT_EQ(add(world, new_jammer({38.0, -123.0})), 3U);
  EXPECT_EQ(add(world, new_mover({38.0, -123.0}, 5 * kSecond_ns)), 4U);
  EXPECT_EQ(world.rain_count, 2U);
  EXPECT_EQ(world.rain[1].latitude_deg, 38.0);
  EXPECT_EQ(world.movers[1].since_ns, 5 * kSecond_ns);
  EXPECT_EQ(databuffer::validate(world), std::nullopt);
  EXPECT_EQ(world.flags & databuffer::kWorldConfigured, 0U) << "an edited world is not the configuration's";
}

TEST(WorldEdit, AnEntryOfEachListIsAddedMovedChangedAndRemoved) {
  databuffer::WorldState world{};
  std::uint32_t id = 0;
  databuffer::for_each_list([&]<class Entry>(std::type_identity<Entry>) {
    SCOPED_TRACE(Entry::Values::list.name);
    using List = databuffer::ListOf<Entry>;
    const auto entry = new_entry<Entry>(world, {38.0, -123.0});
    ASSERT_TRUE(entry && add(world, *entry) == ++id) << "ids of all lists count together";
    ASSERT_TRUE(move(world, List::list, id, {39.0, -123.0}, 0));
    auto changed = std::get<Entry>(entry_with(world, List::list, id, 0).value());
    EXPECT_EQ(changed.latitude_deg, 39.0);
    changed.longitude_deg = -120.0;
    ASSERT_TRUE(replace(world, changed));
    EXPECT_EQ(List::entries_in_use(world).front().longitude_deg, -120.0);
    EXPECT_EQ(databuffer::validate(world), std::nullopt);
    ASSERT_TRUE(remove(world, List::list, id));
    EXPECT_EQ(List::count(world), 0U);
    ASSERT_TRUE(restore(world, changed));
  });
  EXPECT_EQ(databuffer::validate(world), std::nullopt);
}

TEST(WorldEdit, RemovesTheEntryWithTheIdAndKeepsTheOrderOfTheOthers) {
  databuffer::WorldState world = a_world();
  for (const double longitude_deg : {1.0, 2.0, 3.0}) ASSERT_TRUE(add(world, new_rain_cell({0.0, longitude_deg})));
  ASSERT_TRUE(remove(world, WorldList::rain, 2));
  ASSERT_EQ(world.rain_count, 3U);
  EXPECT_EQ(world.rain[1].longitude_deg, 2.0);
  EXPECT_EQ(world.rain[2].longitude_deg, 3.0);
  EXPECT_EQ(world.rain[3].id, 0U) << "the freed place is empty";
  const auto again = remove(world, WorldList::rain, 2);
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().message().find("1, 3, 4"), std::string::npos) << again.error().message();
}

TEST(WorldEdit, GivesARemovedEntrysIdToNoOther) {
  databuffer::WorldState world = a_world();
  ASSERT_EQ(add(world, new_rain_cell({0.0, 0.0})), 2U);
  ASSERT_TRUE(remove(world, WorldList::rain, 2));
  EXPECT_EQ(add(world, new_rain_cell({0.0, 0.0})), 3U);
}

TEST(WorldEdit, AfterTheGreatestIdGivesTheLeastFreeOne) {
  databuffer::WorldState world = a_world();
  world.last_id = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(add(world, new_rain_cell({0.0, 0.0})), 2U) << "the configured cell has the id 1";
  EXPECT_EQ(databuffer::validate(world), std::nullopt);
}

TEST(WorldEdit, AFullListRefusesOneMore) {
  databuffer::WorldState world{};
  for (std::size_t i = 0; i < databuffer::kMaxJammers; ++i) ASSERT_TRUE(add(world, new_jammer({0.0, 0.0})));
  const databuffer::WorldState full = world;
  const auto refused = add(world, new_jammer({0.0, 0.0}));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("at most 16"), std::string::npos) << refused.error().message();
  EXPECT_TRUE(equal_but_flags(world, full));
}

TEST(WorldEdit, ARemovedEntryComesBackWithItsIdAndAllItsValues) {
  databuffer::WorldState world = a_world();
  const databuffer::WorldJammer jammer = world.jammers[0];
  const databuffer::WorldMover mover = world.movers[0];
  EXPECT_FALSE(restore(world, jammer)) << "it is there";
  ASSERT_TRUE(remove(world, WorldList::jammers, jammer.id));
  ASSERT_TRUE(remove(world, WorldList::movers, mover.id));
  ASSERT_TRUE(add(world, new_jammer({0.0, 0.0})));
  ASSERT_TRUE(restore(world, jammer));
  ASSERT_TRUE(restore(world, mover));
  EXPECT_EQ(std::memcmp(&world.jammers[1], &jammer, sizeof jammer), 0);
  EXPECT_EQ(std::memcmp(&world.movers[0], &mover, sizeof mover), 0);
  EXPECT_EQ(databuffer::validate(world), std::nullopt);
  EXPECT_EQ(world.flags & databuffer::kWorldConfigured, 0U);
}

// A world with the sequence points 1, 2, 2.1 and 5, with ids 1 to 4.
databuffer::WorldState a_route() {
  const std::vector<radar::RoutePoint> route{{"1", radar::PointKind::steer, {37.0, -122.0}, 10.0},
                                             {"2", radar::PointKind::steer, {37.1, -122.0}, kNaN},
                                             {"2.1", radar::PointKind::steer_offset, {37.2, -122.0}, 30.0},
                                             {"5", radar::PointKind::steer, {37.3, -122.0}, 40.0}};
  return world_state_from(configured(), route);
}

databuffer::WorldPoint a_point(const databuffer::WorldState& world, const char* name) {
  databuffer::WorldPoint point = new_point(world, {38.0, -121.0}).value();
  EXPECT_TRUE(name_it(point, name));
  return point;
}

radar::PointKind kind_of(databuffer::WorldState& world, std::uint32_t id) {
  return static_cast<radar::PointKind>(point_with(world, id).value().kind);
}

TEST(WorldValues, ARecordGivesTheRouteBack) {
  const databuffer::WorldState world = a_route();
  EXPECT_EQ(databuffer::validate(world), std::nullopt);
  EXPECT_EQ(world.flags, databuffer::kWorldConfigured);
  EXPECT_EQ(world.last_id, 4U);
  const auto route = route_of(world);
  ASSERT_EQ(route.size(), 4U);
  EXPECT_EQ(route[2].name, "2.1");
  EXPECT_EQ(route[2].kind, radar::PointKind::steer_offset);
  EXPECT_EQ(route[2].position, (geo::GeoPoint{37.2, -122.0}));
  EXPECT_EQ(route[2].elevation_m, 30.0);
  EXPECT_TRUE(std::isnan(route[1].elevation_m));
}

TEST(WorldPoints, ANewPointIsASteerPointWithTheNextNumberAndNoElevation) {
  databuffer::WorldState world = a_route();
  const auto point = new_point(world, {38.0, -121.0});
  ASSERT_TRUE(point);
  EXPECT_STREQ(point->name, "6");
  EXPECT_TRUE(std::isnan(point->elevation_m));
  EXPECT_EQ(add(world, *point), 5U);
  EXPECT_EQ(world.point_count, 5U);
  EXPECT_EQ(world.flags, databuffer::kWorldPointsChanged) << "state-machine then takes the points of the record";
  EXPECT_EQ(databuffer::validate(world), std::nullopt);
}

TEST(WorldPoints, AfterTheNumber100TheLowestFreeOneIsGivenAndThenNone) {
  databuffer::WorldState world = a_route();
  ASSERT_TRUE(add(world, a_point(world, "100")));
  EXPECT_STREQ(new_point(world, {0.0, 0.0}).value().name, "3");
  databuffer::WorldState full{};
  for (int number = 1; number <= 100; ++number)
    ASSERT_TRUE(add(full, a_point(full, std::to_string(number).c_str()))) << number;
  EXPECT_FALSE(new_point(full, {0.0, 0.0}));
}

TEST(WorldPoints, OtherEditsDoNotMarkThePointsAsChanged) {
  databuffer::WorldState world = a_route();
  ASSERT_TRUE(add(world, new_rain_cell({37.0, -122.0})));
  ASSERT_TRUE(set_sea_state(world, 3.0));
  EXPECT_EQ(world.flags & databuffer::kWorldPointsChanged, 0U);
}

TEST(WorldPoints, NamesAndNumbersThatOthersHaveAreRefused) {
  databuffer::WorldState world = a_route();
  const databuffer::WorldState before = world;
  for (const char* name : {"1", "1.", "5.", "2.1"}) {
    databuffer::WorldPoint point = new_point(world, {38.0, -121.0}).value();
    ASSERT_TRUE(name_it(point, name)) << name;
    const auto refused = add(world, point);
    ASSERT_FALSE(refused) << name;
    EXPECT_NE(refused.error().message().find("beside"), std::string::npos) << refused.error().message();
  }
  EXPECT_TRUE(equal_but_flags(world, before));
  for (const char* name : {"2.2", "2.01", "1.1", "3", "4."}) EXPECT_TRUE(add(world, a_point(world, name))) << name;
  EXPECT_EQ(databuffer::validate(world), std::nullopt);
  databuffer::WorldPoint point = a_point(world, "9");
  for (const char* name : {"", "0", "101", "2.001", "x", "7.."}) EXPECT_FALSE(name_it(point, name)) << name;
  EXPECT_STREQ(point.name, "9");
}

TEST(WorldPoints, ATargetMakesTheLastSteerPointBeforeItAnInitialPoint) {
  databuffer::WorldState world = a_route();
  const auto target = add(world, a_point(world, "6."));
  ASSERT_TRUE(target);
  EXPECT_EQ(kind_of(world, 4), radar::PointKind::initial);
  EXPECT_EQ(kind_of(world, 2), radar::PointKind::steer);
  EXPECT_EQ(kind_of(world, *target), radar::PointKind::target);
  databuffer::WorldPoint renamed = point_with(world, 2).value();
  ASSERT_TRUE(name_it(renamed, "3."));
  ASSERT_TRUE(replace(world, renamed));
  EXPECT_EQ(kind_of(world, 1), radar::PointKind::initial);
  EXPECT_EQ(kind_of(world, 2), radar::PointKind::target);
  EXPECT_EQ(databuffer::validate(world), std::nullopt);
}

TEST(WorldPoints, AMovedTargetChangesNoOtherPoint) {
  databuffer::WorldState world = a_route();
  ASSERT_TRUE(add(world, a_point(world, "6.")));
  world.points[3].kind = static_cast<std::uint8_t>(radar::PointKind::steer);  // as a configuration can state it
  ASSERT_TRUE(move(world, WorldList::points, 5, {39.0, -120.0}, 0));
  EXPECT_EQ(point_with(world, 5).value().latitude_deg, 39.0);
  EXPECT_EQ(kind_of(world, 4), radar::PointKind::steer);
}

TEST(WorldPoints, AnInitialPointKeepsItsKindUnderAnotherNumber) {
  databuffer::WorldState world = a_route();
  world.points[3].kind = static_cast<std::uint8_t>(radar::PointKind::initial);
  databuffer::WorldPoint point = world.points[3];
  ASSERT_TRUE(name_it(point, "8"));
  ASSERT_TRUE(replace(world, point));
  EXPECT_EQ(kind_of(world, 4), radar::PointKind::initial);
}

TEST(WorldPoints, AreRemovedAndComeBackUnlessTheirNameIsGiven) {
  databuffer::WorldState world = a_route();
  const databuffer::WorldPoint point = world.points[0];
  ASSERT_TRUE(remove(world, WorldList::points, 1));
  EXPECT_EQ(world.point_count, 3U);
  databuffer::WorldState renewed = world;
  ASSERT_TRUE(restore(world, point));
  EXPECT_EQ(std::memcmp(&world.points[3], &point, sizeof point), 0);
  ASSERT_TRUE(add(renewed, a_point(renewed, "1")));
  EXPECT_FALSE(restore(renewed, point));
  EXPECT_FALSE(point_with(world, 77));
}

TEST(WorldPoints, ValuesOutOfRangeAreRefused) {
  databuffer::WorldState world = a_route();
  databuffer::WorldPoint point = world.points[0];
  point.elevation_m = 33'000.0 * geo::kMetresPerFoot;
  const auto refused = replace(world, point);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("-39370 to 32808 ft"), std::string::npos) << refused.error().message();
  EXPECT_FALSE(move(world, WorldList::points, 1, {91.0, 0.0}, 0));
}

TEST(WorldPoints, ARecordWithWrongNamesOrKindsIsInvalid) {
  const auto refusal = [](auto change) {
    databuffer::WorldState world = a_route();
    change(world);
    return databuffer::validate(world).value_or("valid");
  };
  EXPECT_EQ(refusal([](databuffer::WorldState&) {}), "valid");
  EXPECT_NE(refusal([](databuffer::WorldState& world) { world.points[1].name[0] = '1'; }).find("points[1].name"),
            std::string::npos);
  EXPECT_NE(refusal([](databuffer::WorldState& world) { world.points[1].name[0] = 'x'; }).find("points[1].name"),
            std::string::npos);
  EXPECT_NE(refusal([](databuffer::WorldState& world) { world.points[1].kind = 2; }).find("points[1].kind"),
            std::string::npos);
  EXPECT_NE(refusal([](databuffer::WorldState& world) { world.points[1].kind = 9; }).find("kind"), std::string::npos);
  EXPECT_NE(refusal([](databuffer::WorldState& world) { world.points[1].id = 1; }).find("points[1].id"),
            std::string::npos);
  EXPECT_NE(refusal([](databuffer::WorldState& world) { world.point_count = 257; }).find("point_count"),
            std::string::npos);
}

TEST(WorldEdit, ARecordWithAnUnknownEchoOrAxisIsInvalid) {
  const auto refusal = [](auto change) {
    databuffer::WorldState world = a_world();
    change(world.movers[0]);
    return databuffer::validate(world).value_or("valid");
  };
  EXPECT_EQ(refusal([](databuffer::WorldMover&) {}), "valid");
  EXPECT_NE(refusal([](databuffer::WorldMover& mover) { mover.echo = 5; }).find("echo"), std::string::npos);
  EXPECT_NE(refusal([](databuffer::WorldMover& mover) { mover.tilt_deg = 91; }).find("tilt_deg"), std::string::npos);
  EXPECT_NE(refusal([](databuffer::WorldMover& mover) { mover.facing_deg = 360; }).find("facing_deg"),
            std::string::npos);
}

TEST(WorldEdit, AFullListTakesNoRemovedEntryBack) {
  databuffer::WorldState world = a_world();
  const databuffer::WorldJammer jammer = world.jammers[0];
  ASSERT_TRUE(remove(world, WorldList::jammers, jammer.id));
  while (world.jammer_count < databuffer::kMaxJammers) ASSERT_TRUE(add(world, new_jammer({0.0, 0.0})));
  EXPECT_FALSE(restore(world, jammer));
  EXPECT_EQ(world.jammer_count, databuffer::kMaxJammers);
}

TEST(WorldEdit, MovesAMoverFromTheGivenTimeOn) {
  databuffer::WorldState world = a_world();
  ASSERT_TRUE(move(world, WorldList::movers, 1, {36.0, -121.0}, 60 * kSecond_ns));
  EXPECT_EQ(world.movers[0].latitude_deg, 36.0);
  EXPECT_EQ(world.movers[0].since_ns, 60 * kSecond_ns);
  EXPECT_EQ(world.movers[0].speed_mps, 9.0);
  ASSERT_TRUE(move(world, WorldList::rain, 1, {36.0, -121.0}, 60 * kSecond_ns));
  EXPECT_EQ(world.rain[0].longitude_deg, -121.0);
  ASSERT_TRUE(move(world, WorldList::jammers, 1, {36.0, -120.0}, 60 * kSecond_ns));
  EXPECT_EQ(world.jammers[0].longitude_deg, -120.0);
}

TEST(WorldEdit, ASteeredMoverTurnsWhereItIs) {
  databuffer::WorldState world = a_world();
  const std::int64_t now_ns = 3601 * kSecond_ns + kSecond_ns / 2;
  const databuffer::WorldMover before = at_sim_time(world.movers[0], now_ns);
  const auto run = geo::geodesic_inverse({37.3, -122.3}, {before.latitude_deg, before.longitude_deg});
  EXPECT_NEAR(run.distance.metres(), 9.0 * 3600.0, 1e-3) << "an hour at 9 m/s";
  ASSERT_TRUE(steer(world, 1, 20.0, 270.0, now_ns));
  EXPECT_EQ(world.movers[0].latitude_deg, before.latitude_deg);
  EXPECT_EQ(world.movers[0].longitude_deg, before.longitude_deg);
  EXPECT_EQ(world.movers[0].heading_deg, 270.0);
  EXPECT_EQ(world.movers[0].speed_mps, 20.0);
  EXPECT_EQ(world.movers[0].since_ns, now_ns);
  EXPECT_FALSE(steer(world, 7, 20.0, 270.0, now_ns));
}

TEST(WorldEdit, ValuesOutOfRangeAreRefusedWithTheLimitsAndChangeNothing) {
  databuffer::WorldState world = a_world();
  const databuffer::WorldState before = world;
  const auto refused = [](const auto& outcome, const char* limits) {
    return !outcome && outcome.error().message().find(limits) != std::string::npos;
  };
  databuffer::WorldRainCell wide = new_rain_cell({0.0, 0.0});
  wide.radius_m = 200'000.0;
  EXPECT_TRUE(refused(add(world, wide), "0.1 to 100 NM"));
  databuffer::WorldMover fast = world.movers[0];
  fast.speed_mps = 5200.0;
  EXPECT_TRUE(refused(replace(world, fast), "0 to 10000 kt"));
  databuffer::WorldJammer lost = world.jammers[0];
  lost.latitude_deg = kNaN;
  EXPECT_TRUE(refused(replace(world, lost), "-90 to 90 deg"));
  EXPECT_TRUE(refused(move(world, WorldList::rain, 1, {0.0, 181.0}, 0), "-180 to 180 deg"));
  EXPECT_TRUE(refused(set_sea_state(world, 6.1), "0 to 6"));
  EXPECT_TRUE(refused(set_wind(world, 62.0, 0.0), "0 to 120 kt"));
  EXPECT_TRUE(refused(set_wind(world, 5.0, -1.0), "0 to 360 deg"));
  EXPECT_TRUE(refused(name_it(lost, "a name of 16 chr"), "at most 15 characters"));
  EXPECT_TRUE(refused(name_it(lost, "\x1b[2J"), "printable ASCII"));
  EXPECT_TRUE(equal_but_flags(world, before));
}

TEST(WorldEdit, TheLimitsThemselvesAreValid) {
  databuffer::WorldState world{};
  databuffer::WorldRainCell cell = new_rain_cell({90.0, 180.0});
  cell.radius_m = 100.0 * geo::kMetresPerNauticalMile;
  cell.top_m = 60'000.0 * geo::kMetresPerFoot;
  EXPECT_TRUE(add(world, cell));
  databuffer::WorldMover mover = new_mover({-90.0, -180.0}, 0);
  mover.speed_mps = values::WorldMover::speed.recorded(10'000.0);
  mover.height_m = 1000.0;
  mover.heading_deg = -360.0;
  EXPECT_TRUE(add(world, mover));
  mover.height_m = values::WorldMover::height.recorded(values::WorldMover::height.high);
  EXPECT_TRUE(add(world, mover));
  EXPECT_TRUE(set_wind(world, geo::Speed::knots(120.0).metres_per_second(), 360.0));
  EXPECT_TRUE(set_sea_state(world, kNaN));
  EXPECT_EQ(databuffer::validate(world), std::nullopt);
}

TEST(WorldEdit, ARecordWithTwoEqualIdsIsRefused) {
  databuffer::WorldState world = a_world();
  ASSERT_TRUE(add(world, new_mover({0.0, 0.0}, 0)));
  world.movers[1].id = world.movers[0].id;
  const auto refusal = databuffer::validate(world);
  ASSERT_TRUE(refusal);
  EXPECT_NE(refusal->find("movers[1].id"), std::string::npos) << *refusal;
  world.mover_count = 1;
  EXPECT_EQ(databuffer::validate(world), std::nullopt) << "entries behind the count are not in use";
}

}  // namespace
}  // namespace yars::world
