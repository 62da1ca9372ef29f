// InputLanes: order within a lane, full lanes, and no damage when a producer or the consumer is killed at any store.
#include <gtest/gtest.h>

#include "shm/ring_buffers.hpp"
#include "tests/shm/child_process.hpp"
#include "tests/shm/hooked_access.hpp"
#include "tests/shm/numbered_record.hpp"

namespace yars::shm {
namespace {

using testing::HookedAccess;
using testing::SharedMemory;
using testing::survives;
using Record = testing::NumberedRecord<3>;
using Lanes = InputLanes<Record, 3, 8, HookedAccess>;

void expect_next(Lanes& lanes, std::size_t lane, std::uint64_t number) {
  Record out{};
  ASSERT_TRUE(lanes.pop(lane, out));
  EXPECT_EQ(out.number, number);
  EXPECT_TRUE(out.is_whole());
}

TEST(InputLanes, KeepTheRecordsOfEachLaneInOrder) {
  SharedMemory<Lanes> lanes;
  for (std::uint64_t n = 0; n < 5; ++n)
    for (std::size_t lane = 0; lane < 3; ++lane) EXPECT_TRUE(lanes->push(lane, Record::make(100 * lane + n)));
  for (std::size_t lane = 3; lane-- > 0;) {
    for (std::uint64_t n = 0; n < 5; ++n) expect_next(*lanes, lane, 100 * lane + n);
    EXPECT_TRUE(lanes->empty(lane));
  }
}

TEST(InputLanes, AFullLaneDropsTheNewestAndCountsIt) {
  SharedMemory<Lanes> lanes;
  for (std::uint64_t n = 0; n < 8; ++n) EXPECT_TRUE(lanes->push(1, Record::make(n)));
  for (std::uint64_t n = 8; n < 11; ++n) EXPECT_FALSE(lanes->push(1, Record::make(n)));
  EXPECT_EQ(lanes->dropped(1), 3u);
  EXPECT_EQ(lanes->dropped(0), 0u);
  for (std::uint64_t n = 0; n < 8; ++n) expect_next(*lanes, 1, n);
  EXPECT_TRUE(lanes->push(1, Record::make(11))) << "the lane has space again";
  expect_next(*lanes, 1, 11);
}

TEST(InputLanes, WrapAroundAfterTheirDepth) {
  SharedMemory<Lanes> lanes;
  for (std::uint64_t n = 0; n < 1000; ++n) {
    ASSERT_TRUE(lanes->push(0, Record::make(n)));
    expect_next(*lanes, 0, n);
  }
  Record out{};
  EXPECT_FALSE(lanes->pop(0, out));
}

TEST(InputLanes, HaveTheNameOfTheirSourceUpTo23Characters) {
  SharedMemory<Lanes> lanes;
  lanes->set_source(0, "bezel");
  lanes->set_source(2, "a name that is longer than three words");
  EXPECT_EQ(lanes->source(0), "bezel");
  EXPECT_EQ(lanes->source(1), "");
  EXPECT_EQ(lanes->source(2), "a name that is longer t");
  lanes->set_source(2, "x");
  EXPECT_EQ(lanes->source(2), "x");
}

TEST(InputLanes, AfterAProducerIsKilledAtAnyStoreRecordsAreWholeAndTheNextContinues) {
  for (const std::uint64_t waiting : {0U, 5U}) {
    long stores = 0;
    for (bool alive = false; !alive; ++stores) {
      SharedMemory<Lanes> lanes;
      for (std::uint64_t n = 0; n < waiting; ++n) ASSERT_TRUE(lanes->push(0, Record::make(n)));
      alive = survives(stores, [&] { lanes->push(0, Record::make(90)); });
      ASSERT_TRUE(lanes->push(0, Record::make(91)));
      for (std::uint64_t n = 0; n < waiting; ++n) expect_next(*lanes, 0, n);
      if (alive) expect_next(*lanes, 0, 90);
      expect_next(*lanes, 0, 91);
      EXPECT_TRUE(lanes->empty(0));
    }
    EXPECT_EQ(stores - 1, 4 + 1) << "stores: 4 words, pushed";
  }
}

TEST(InputLanes, AProducerKilledAtAnyStoreOnAFullLaneChangesNoRecord) {
  for (long stores = 0; stores < 2; ++stores) {
    SharedMemory<Lanes> lanes;
    for (std::uint64_t n = 0; n < 8; ++n) ASSERT_TRUE(lanes->push(0, Record::make(n)));
    EXPECT_FALSE(survives(stores, [&] { lanes->push(0, Record::make(8)); }));
    for (std::uint64_t n = 0; n < 8; ++n) expect_next(*lanes, 0, n);
    EXPECT_TRUE(lanes->empty(0));
  }
}

TEST(InputLanes, AConsumerKilledAtAnyStoreOfAPopLosesNoRecord) {
  long stores = 0;
  for (bool alive = false; !alive; ++stores) {
    SharedMemory<Lanes> lanes;
    for (std::uint64_t n = 0; n < 3; ++n) ASSERT_TRUE(lanes->push(0, Record::make(n)));
    Record out{};
    alive = survives(stores, [&] { lanes->pop(0, out); });
    for (std::uint64_t n = alive ? 1 : 0; n < 3; ++n) expect_next(*lanes, 0, n);
    EXPECT_TRUE(lanes->empty(0));
  }
  EXPECT_EQ(stores - 1, 2) << "stores: the producer's cursor as the consumer has read it, the consumer's cursor";
}

}  // namespace
}  // namespace yars::shm
