// Tests of the pool of patch maps in the segment: eight slots, also with interrupted writers and readers.
#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/receivers.hpp"
#include "tests/databuffer/session/made_up_map.hpp"
#include "tests/databuffer/session/open_session.hpp"
#include "tests/shm/child_process.hpp"
#include "tests/shm/hooked_access.hpp"

namespace yars::databuffer {
namespace {

using shm::testing::HookedAccess;
using shm::testing::interrupted_at;
using shm::testing::SharedMemory;
using shm::testing::survives;
using testing::is_whole;
using testing::made_up_map;
using testing::made_up_pixels;

using WantedMapsTest = testing::OpenSessionTest;

class PatchPool : public ::testing::Test {
 protected:
  // `keep`: ids of the maps that must not be overwritten. False: no slot was free.
  bool publish(std::uint64_t id, std::uint32_t size, std::vector<std::uint64_t> keep = {}) {
    return publish_patch<HookedAccess>(*layout, made_up_map(id, size), made_up_pixels(id, size), keep);
  }
  bool has(std::uint64_t id) {
    PatchMap found{};
    return read_patch(*layout, id, found);
  }

  SharedMemory<SessionLayout> layout;
  PatchMap map{};
  std::vector<std::uint8_t> pixels;
};

TEST_F(PatchPool, AFreshPoolHasNoMap) {
  EXPECT_EQ(greatest_id<shm::PlainAccess>(layout->patches), 0U);
  EXPECT_FALSE(read_patch(*layout, 1, map, pixels));
  EXPECT_FALSE(read_patch(*layout, 0, map, pixels)) << "id 0 marks an empty slot and is no map";
}

TEST_F(PatchPool, AMapIsReadAsItWasPublished) {
  for (const std::uint32_t size : {1U, 3U, 8U, 481U, 1024U}) {
    const std::uint64_t id = 100 + size;
    ASSERT_TRUE(publish(id, size));
    ASSERT_TRUE(read_patch(*layout, id, map, pixels)) << size;
    EXPECT_EQ(map.id, id);
    EXPECT_EQ(map.size, size);
    EXPECT_EQ(map.distance_m, 37'040.0);
    EXPECT_TRUE(is_whole(map, pixels)) << size;
    EXPECT_EQ(greatest_id<shm::PlainAccess>(layout->patches), id);
  }
}

TEST_F(WantedMapsTest, EachWantedMapIsReadOnceAlsoIfInvalid) {
  Session session = open();
  WantedMaps wanted(session, "map");
  std::array<PatchMap, 3> maps{};
  const std::array<std::uint64_t, 3> ids{7, 8, 9};
  int reads = 0, taken = 0;
  for (int refresh = 0; refresh < 5; ++refresh)
    wanted.refresh(
        maps, ids,
        [&](std::uint64_t id, PatchMap& next) {
          ++reads;
          next = made_up_map(id, 480);
          if (id != 8) next.window_nm = -1.0;
          return true;
        },
        [&](const PatchMap&) { ++taken; });
  EXPECT_EQ(reads, 3);
  EXPECT_EQ(taken, 1);
}

TEST_F(PatchPool, TheRecordIsReadWithoutItsPixels) {
  publish(7, 480);
  ASSERT_TRUE(read_patch(*layout, 7, map));
  EXPECT_EQ(map.id, 7U);
  EXPECT_EQ(map.window_nm, 4.7);
}

TEST_F(PatchPool, HasEightMapsAndANewOneReplacesTheOldest) {
  for (std::uint64_t id = 1; id <= 8; ++id) ASSERT_TRUE(publish(id, 4));
  for (std::uint64_t id = 1; id <= 8; ++id) EXPECT_TRUE(has(id)) << id;
  publish(9, 4);
  EXPECT_FALSE(has(1));
  for (std::uint64_t id = 2; id <= 9; ++id) EXPECT_TRUE(has(id)) << id;
}

TEST_F(PatchPool, AKeptMapIsNeverOverwritten) {
  for (std::uint64_t id = 1; id <= 200; ++id) ASSERT_TRUE(publish(id, 4, {0, 1, 2, 5, id - 1}));
  for (const std::uint64_t id : {1U, 2U, 5U, 199U, 200U}) EXPECT_TRUE(has(id)) << id;
}

TEST_F(PatchPool, WhenAllMapsAreKeptNothingIsWritten) {
  const std::vector<std::uint64_t> all{1, 2, 3, 4, 5, 6, 7, 8};
  for (const std::uint64_t id : all) publish(id, 4);
  EXPECT_FALSE(publish(9, 4, all));
  for (const std::uint64_t id : all) EXPECT_TRUE(has(id)) << id;
}

TEST_F(PatchPool, AnExcessiveSizeIsReadOnlyToTheEndOfTheSlot) {
  PatchMap wrong = made_up_map(3, 4);
  wrong.size = 4'000'000'000U;
  publish_patch(*layout, wrong, made_up_pixels(3, 4), {});
  ASSERT_TRUE(read_patch(*layout, 3, map, pixels));
  EXPECT_EQ(pixels.size(), std::size_t{kMaxPatchPixels} * kMaxPatchPixels);
}

TEST_F(PatchPool, AWriterKilledAfterAnyStoreLeavesNoTornMap) {
  long stores = 0;
  for (bool alive = false; !alive; ++stores) {
    SharedMemory<SessionLayout> pool;
    for (std::uint64_t id = 1; id <= 8; ++id)
      publish_patch<HookedAccess>(*pool, made_up_map(id, 4), made_up_pixels(id, 4), {});
    const auto write = [&] { publish_patch<HookedAccess>(*pool, made_up_map(9, 4), made_up_pixels(9, 4), {}); };
    alive = survives(stores, write);
    for (std::uint64_t id = 1; id <= 9; ++id) {
      const bool found = read_patch(*pool, id, map, pixels);
      EXPECT_TRUE(!found || is_whole(map, pixels)) << id << " after " << stores;
    }
    for (std::uint64_t id = 2; id <= 8; ++id) EXPECT_TRUE(read_patch(*pool, id, map)) << id;
    write();
    ASSERT_TRUE(read_patch(*pool, 9, map, pixels)) << "the next writer succeeds";
    EXPECT_TRUE(is_whole(map, pixels));
  }
  EXPECT_EQ(stores - 1, 1 + 32 + 2 + 1) << "stores: id, 32 words of the map, 2 of its pixels, id";
}

TEST_F(PatchPool, AReaderInterruptedAtAnyLoadGetsACompleteMapOrNone) {
  long load = 1;
  int refused = 0;
  for (bool interrupted = true; interrupted; ++load) {
    SharedMemory<SessionLayout> pool;
    publish_patch(*pool, made_up_map(1, 4), made_up_pixels(1, 4), {});
    const auto overwrite = [&] {
      const std::array<std::uint64_t, 0> nothing_kept{};
      for (std::uint64_t id = 2; id <= 9; ++id)
        publish_patch(*pool, made_up_map(id, 4), made_up_pixels(id, 4), nothing_kept);
    };
    interrupted = interrupted_at(load, overwrite, [&] {
      const bool found = read_patch<HookedAccess>(*pool, 1, map, pixels);
      EXPECT_TRUE(!found || (map.id == 1 && is_whole(map, pixels))) << load;
      refused += found ? 0 : 1;
    });
  }
  EXPECT_GE(load, 1 + 32 + 2 + 1);
  EXPECT_GT(refused, 30) << "an overwritten map is not read";
}

}  // namespace
}  // namespace yars::databuffer
