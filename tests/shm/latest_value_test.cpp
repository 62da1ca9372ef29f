// LatestValue and LatestReader: versions, and whole values although a writer is killed at any store or interrupts a
// reader at any load.
#include "shm/latest_value.hpp"

#include <gtest/gtest.h>

#include "tests/shm/child_process.hpp"
#include "tests/shm/hooked_access.hpp"
#include "tests/shm/numbered_record.hpp"

namespace yars::shm {
namespace {

using testing::HookedAccess;
using testing::SharedMemory;
using testing::survives;
using Record = testing::NumberedRecord<7>;
using Value = LatestValue<Record, HookedAccess>;

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

TEST(LatestValue, AfterClearThereIsNoValueAndTheVersionHasIncreased) {
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

TEST(LatestValue, AfterTheLastVersionComesTheFirst) {
  for (const std::uint64_t last : {~std::uint64_t{0}, ~std::uint64_t{0} - 1}) {
    SharedMemory<Value> value;
    auto* state = reinterpret_cast<std::atomic<std::uint64_t>*>(value.operator->());
    state->store(last);
    value->publish(Record::make(7));
    EXPECT_EQ(value->version(), 1U);
    EXPECT_EQ(number_in(*value), 7U);
    state->store(last);
    value->clear();
    EXPECT_EQ(value->version(), 1U);
    EXPECT_FALSE(value->has_value());
  }
}

TEST(LatestValue, AWriterKilledAtAnyStoreLeavesThePreviousValueWhole) {
  long stores = 0;
  for (bool alive = false; !alive; ++stores) {
    SharedMemory<Value> value;
    for (std::uint64_t n = 0; n < 6; ++n) value->publish(Record::make(n));
    alive = survives(stores, [&] { value->publish(Record::make(6)); });
    EXPECT_EQ(number_in(*value), alive ? 6u : 5u) << "killed after " << stores << " stores";
    value->publish(Record::make(7));
    EXPECT_EQ(number_in(*value), 7u) << "the next writer continues";
  }
  EXPECT_EQ(stores - 1, 4 + 8) << "stores: sequence, version, 8 words, sequence, state";
}

TEST(LatestValue, WritersKilledNineTimesAtTheSameStoreLeaveThePreviousValueWhole) {
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

TEST(LatestValue, AClearKilledAtItsOnlyStoreLeavesTheValue) {
  SharedMemory<Value> value;
  value->publish(Record::make(4));
  EXPECT_FALSE(survives(0, [&] { value->clear(); }));
  EXPECT_EQ(number_in(*value), 4u);
  EXPECT_TRUE(survives(1, [&] { value->clear(); }));
  EXPECT_FALSE(value->has_value());
}

TEST(LatestReader, KeepsItsValueUntilANewerOneComes) {
  SharedMemory<Value> value;
  LatestReader<Record, HookedAccess> reader(*value);
  EXPECT_FALSE(reader.refresh());
  EXPECT_FALSE(reader.has_value());
  value->publish(Record::make(3));
  EXPECT_TRUE(reader.refresh());
  EXPECT_FALSE(reader.refresh());
  EXPECT_EQ(reader.value().number, 3u);
  value->clear();
  EXPECT_FALSE(reader.refresh());
  EXPECT_EQ(reader.value().number, 3u);
  value->publish(Record::make(4));
  EXPECT_TRUE(reader.refresh());
}

TEST(LatestReader, KeepsItsValueIfEachLoadOfARefreshIsOvertaken) {
  SharedMemory<Value> value;
  LatestReader<Record, HookedAccess> reader(*value);
  std::uint64_t published = 1;
  value->publish(Record::make(published));
  ASSERT_TRUE(reader.refresh());
  value->publish(Record::make(++published));
  testing::interrupted_always(
      [&] {
        for (std::size_t i = 0; i < Value::kSlots; ++i) value->publish(Record::make(++published));
      },
      [&] { EXPECT_FALSE(reader.refresh()); });
  EXPECT_EQ(reader.value().number, 1u);
  EXPECT_TRUE(reader.value().is_whole());
  EXPECT_TRUE(reader.refresh());
  EXPECT_EQ(reader.value().number, published);
}

TEST(LatestValue, AReaderInterruptedAtAnyLoadByAnyNumberOfWritesGetsAWholeValue) {
  for (std::uint64_t writes = 1; writes <= 9; ++writes) {
    long load = 1;
    for (bool interrupted = true; interrupted; ++load) {
      SharedMemory<Value> value;
      for (std::uint64_t n = 1; n <= 5; ++n) value->publish(Record::make(n));
      const auto write = [&] {
        for (std::uint64_t n = 0; n < writes; ++n) value->publish(Record::make(6 + n));
      };
      interrupted = testing::interrupted_at(load, write, [&] {
        Record out{};
        const auto version = value->read(out);
        EXPECT_TRUE(out.is_whole()) << writes << " writes before load " << load;
        EXPECT_EQ(version, out.number);
        EXPECT_GE(out.number, 5u);
      });
    }
    EXPECT_GE(load, 12) << "loads: state, sequence, version, 8 words, sequence";
  }
}

TEST(LatestValue, AReaderInterruptedAtAnyLoadByAWriterKilledAtAnyStoreGetsAWholeValue) {
  for (std::uint64_t whole_writes = 0; whole_writes <= 4; ++whole_writes)
    for (long stores = 0; stores < 12; ++stores) {
      long load = 1;
      for (bool interrupted = true; interrupted; ++load) {
        SharedMemory<Value> value;
        for (std::uint64_t n = 1; n <= 5; ++n) value->publish(Record::make(n));
        const auto write = [&] {
          for (std::uint64_t n = 0; n < whole_writes; ++n) value->publish(Record::make(6 + n));
          EXPECT_FALSE(survives(stores, [&] { value->publish(Record::make(6 + whole_writes)); }));
        };
        interrupted = testing::interrupted_at(load, write, [&] {
          Record out{};
          const auto version = value->read(out);
          ASSERT_TRUE(version.has_value());
          EXPECT_TRUE(out.is_whole()) << whole_writes << " writes and " << stores << " stores before load " << load;
          EXPECT_EQ(*version, out.number);
          EXPECT_LE(out.number, 5 + whole_writes) << "an unpublished value is not delivered";
        });
      }
    }
}

}  // namespace
}  // namespace yars::shm
