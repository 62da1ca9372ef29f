#include "shm/latest_value.hpp"

#include <gtest/gtest.h>

#include "tests/shm/child_process.hpp"
#include "tests/shm/counted_stores.hpp"
#include "tests/shm/numbered_record.hpp"

namespace yars::shm {
namespace {

using testing::CountedStores;
using testing::SharedMemory;
using testing::survives;
using Record = testing::NumberedRecord<7>;
using Value = LatestValue<Record, CountedStores>;

std::uint64_t number_in(const Value& value) {
  Record record{};
  EXPECT_TRUE(value.read(record).has_value());
  EXPECT_TRUE(record.is_whole());
  return record.number;
}

TEST(LatestValue, ZeroFilledMemoryIsEmpty) {
  SharedMemory<Value> value;
  Record out = Record::make(77);
  EXPECT_EQ(value->version(), 0u);
  EXPECT_FALSE(value->read(out).has_value());
  EXPECT_EQ(out.number, 77u) << "out stays untouched";
}

TEST(LatestValue, ReadGivesWhatWasPublishedLastAndItsVersion) {
  SharedMemory<Value> value;
  Record out{};
  for (std::uint64_t n = 1; n <= 20; ++n) {
    value->publish(Record::make(100 + n));
    EXPECT_EQ(value->read(out), n);
    EXPECT_EQ(value->version(), n);
    EXPECT_EQ(out.number, 100 + n);
    EXPECT_TRUE(out.is_whole());
  }
}

TEST(LatestValue, AClearedValueIsGoneAndTheVersionGoesOn) {
  SharedMemory<Value> value;
  value->publish(Record::make(1));
  value->clear();
  Record out{};
  EXPECT_FALSE(value->read(out).has_value());
  EXPECT_FALSE(value->has_value());
  EXPECT_EQ(value->version(), 2u);
  value->publish(Record::make(2));
  EXPECT_EQ(value->read(out), 3u);
  EXPECT_EQ(out.number, 2u);
}

TEST(LatestValue, AWriterKilledAfterAnyStoreLeavesTheLastWholeValue) {
  long stores = 0;
  for (bool alive = false; !alive; ++stores) {
    SharedMemory<Value> value;
    for (std::uint64_t n = 0; n < 6; ++n) value->publish(Record::make(n));
    alive = survives(stores, [&] { value->publish(Record::make(6)); });
    EXPECT_EQ(number_in(*value), alive ? 6u : 5u) << "killed after " << stores << " stores";
    value->publish(Record::make(7));
    EXPECT_EQ(number_in(*value), 7u) << "the next writer goes on";
  }
  EXPECT_EQ(stores - 1, 4 + 8) << "sequence, version, 8 words, sequence, state";
}

TEST(LatestValue, WritersKilledAgainAndAgainAtTheSameStoreDoNoHarm) {
  for (long stores = 0; stores < 12; ++stores) {
    SharedMemory<Value> value;
    value->publish(Record::make(1));
    for (std::uint64_t n = 0; n < 9; ++n) {
      EXPECT_FALSE(survives(stores, [&] { value->publish(Record::make(50 + n)); }));
      EXPECT_EQ(number_in(*value), 1u);
    }
    for (std::uint64_t n = 2; n < 12; ++n) {
      value->publish(Record::make(n));
      EXPECT_EQ(number_in(*value), n);
    }
  }
}

TEST(LatestValue, AKilledClearLeavesEitherTheValueOrNothing) {
  SharedMemory<Value> value;
  value->publish(Record::make(4));
  EXPECT_FALSE(survives(0, [&] { value->clear(); }));
  EXPECT_EQ(number_in(*value), 4u);
  EXPECT_TRUE(survives(1, [&] { value->clear(); }));
  EXPECT_FALSE(value->has_value());
}

TEST(LatestReader, KeepsItsValueUntilANewerOneComes) {
  SharedMemory<Value> value;
  LatestReader<Record, CountedStores> reader(*value);
  EXPECT_FALSE(reader.refresh());
  EXPECT_FALSE(reader.has_value());
  value->publish(Record::make(3));
  EXPECT_TRUE(reader.refresh());
  EXPECT_FALSE(reader.refresh());
  EXPECT_EQ(reader.value().number, 3u);
  value->clear();
  EXPECT_FALSE(reader.refresh());
  EXPECT_TRUE(reader.withdrawn());
  EXPECT_EQ(reader.value().number, 3u);
  EXPECT_EQ(reader.lost(), 0u) << "nothing there is no lost read";
  value->publish(Record::make(4));
  EXPECT_TRUE(reader.refresh());
  EXPECT_FALSE(reader.withdrawn());
}

// A writer that goes round all slots between each of the reader's looks at the index and at the slot cannot be staged
// from one thread; a slot left odd while the index names it has the same effect on the reader.
TEST(LatestReader, CountsAReadGivenUpAndKeepsTheLastValue) {
  SharedMemory<Value> value;
  LatestReader<Record, CountedStores> reader(*value);
  value->publish(Record::make(1));
  ASSERT_TRUE(reader.refresh());
  value->publish(Record::make(2));
  auto* bytes = reinterpret_cast<std::byte*>(&*value);
  auto* sequence = reinterpret_cast<AtomicWord*>(bytes + Value::slots_offset() + 2 * Value::slot_stride());
  const Word even = sequence->load();
  sequence->store(even + 1);
  EXPECT_FALSE(reader.refresh());
  EXPECT_EQ(reader.lost(), 1u);
  EXPECT_EQ(reader.value().number, 1u);
  sequence->store(even + 2);
  EXPECT_TRUE(reader.refresh());
  EXPECT_EQ(reader.value().number, 2u);
}

}  // namespace
}  // namespace yars::shm
