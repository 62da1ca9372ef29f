// Entries that a page removed come back as they were; others are refused.
#include "station/removed_entries.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "lib/radar/world.hpp"
#include "world/world_values.hpp"

namespace yars::station {
namespace {

using databuffer::WorldState;
using ::testing::HasSubstr;
using world::WorldList;

// A world with a rain cell, a jammer, a mover and a sequence point, with the ids 1, 2, 3 and 4.
WorldState a_world() {
  WorldState world = world::world_state_from(radar::WorldConfiguration());
  EXPECT_TRUE(world::add(world, world::default_rain_cell({37.0, -122.0})));
  EXPECT_TRUE(world::add(world, world::default_jammer({36.0, -122.0})));
  EXPECT_TRUE(world::add(world, world::default_mover({35.0, -122.0}, 5)));
  EXPECT_TRUE(world::add(world, world::default_point(world, {34.0, -122.0}).value()));
  return world;
}

// The world without an entry, which `removed` then remembers.
WorldState without(RemovedEntries& removed, const WorldState& world, WorldList list, std::uint32_t id) {
  WorldState after = world;
  EXPECT_TRUE(world::remove(after, list, id));
  removed.note(world, after);
  return after;
}

TEST(RemovedEntries, AnEntryOfEachListComesBack) {
  RemovedEntries removed;
  const WorldState full = a_world();
  WorldState world = without(removed, full, WorldList::rain, 1);
  world = without(removed, world, WorldList::jammers, 2);
  world = without(removed, world, WorldList::movers, 3);
  world = without(removed, world, WorldList::points, 4);
  ASSERT_EQ(world.rain_count + world.jammer_count + world.mover_count + world.point_count, 0U);
  ASSERT_TRUE(removed.restore(world, WorldList::rain, 1));
  ASSERT_TRUE(removed.restore(world, WorldList::jammers, 2));
  ASSERT_TRUE(removed.restore(world, WorldList::movers, 3));
  EXPECT_EQ(world.rain[0].latitude_deg, 37.0);
  EXPECT_EQ(world.jammers[0].latitude_deg, 36.0);
  EXPECT_EQ(world.movers[0].since_ns, 5);
  ASSERT_TRUE(removed.restore(world, WorldList::points, 4));
  EXPECT_EQ(world.points[0].latitude_deg, 34.0);
}

TEST(RemovedEntries, WhatWasChangedBetweenTwoRemovalsComesBackChanged) {
  RemovedEntries removed;
  WorldState world = without(removed, a_world(), WorldList::jammers, 2);
  ASSERT_TRUE(removed.restore(world, WorldList::jammers, 2));
  ASSERT_TRUE(world::move(world, WorldList::jammers, 2, {10.0, 20.0}, 0));
  world = without(removed, world, WorldList::jammers, 2);
  ASSERT_TRUE(removed.restore(world, WorldList::jammers, 2));
  EXPECT_EQ(world.jammers[0].latitude_deg, 10.0);
}

TEST(RemovedEntries, OthersAreRefused) {
  RemovedEntries removed;
  WorldState world = without(removed, a_world(), WorldList::rain, 1);
  for (const auto& [list, id] : {std::pair{WorldList::jammers, 1U}, {WorldList::rain, 9U}}) {
    const auto refused = removed.restore(world, list, id);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), HasSubstr("expected an entry that a page has removed"));
  }
  ASSERT_TRUE(removed.restore(world, WorldList::rain, 1));
  EXPECT_FALSE(removed.restore(world, WorldList::rain, 1)) << "it is in the world";
}

TEST(RemovedEntries, TheOldestAreForgotten) {
  RemovedEntries removed;
  WorldState world = without(removed, a_world(), WorldList::rain, 1);
  for (std::size_t i = 0; i < RemovedEntries::kMaxEntries; ++i) {
    const auto id = world::add(world, world::default_rain_cell({37.0, -122.0}));
    ASSERT_TRUE(id);
    world = without(removed, world, WorldList::rain, *id);
  }
  EXPECT_FALSE(removed.restore(world, WorldList::rain, 1));
  EXPECT_TRUE(removed.restore(world, WorldList::rain, world.last_id));
}

}  // namespace
}  // namespace yars::station
