// Entries that a page removed come back as they were; others are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <utility>

#include "lib/radar/world.hpp"
#include "station/instructor_message.hpp"
#include "tests/world/new_entries.hpp"
#include "world/world_values.hpp"

namespace yars::station {
namespace {

using databuffer::WorldState;
using ::testing::HasSubstr;
using world::WorldList;

// A world with an entry in each list, with the ids 1, 2 and so on; a mover is where it is at 5 ns.
WorldState a_world() {
  WorldState world = world::world_state_from(radar::WorldConfiguration());
  databuffer::for_each_list([&world]<class Entry>(std::type_identity<Entry>) {
    EXPECT_TRUE(world::add(world, world::new_entry<Entry>(world, {37.0, -122.0}, 5).value()));
  });
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
  WorldState world = full;
  std::uint32_t id = 0;
  databuffer::for_each_list([&]<class Entry>(std::type_identity<Entry>) {
    world = without(removed, world, databuffer::ListOf<Entry>::list, ++id);
    EXPECT_EQ(databuffer::ListOf<Entry>::count(world), 0U);
  });
  id = 0;
  databuffer::for_each_list([&]<class Entry>(std::type_identity<Entry>) {
    using List = databuffer::ListOf<Entry>;
    ASSERT_TRUE(removed.restore(world, List::list, ++id));
    EXPECT_EQ(std::memcmp(&List::entries(world)[0], &List::entries(full)[0], sizeof(Entry)), 0);
  });
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
    const auto id = world::add(world, world::new_rain_cell({37.0, -122.0}));
    ASSERT_TRUE(id);
    world = without(removed, world, WorldList::rain, *id);
  }
  EXPECT_FALSE(removed.restore(world, WorldList::rain, 1));
  EXPECT_TRUE(removed.restore(world, WorldList::rain, world.last_id));
}

}  // namespace
}  // namespace yars::station
