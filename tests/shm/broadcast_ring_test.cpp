// BroadcastRing: order, lost records, and whole records although the producer is killed at any store or interrupts a
// reader at any load.
#include <gtest/gtest.h>

#include <algorithm>

#include "shm/ring_buffers.hpp"
#include "tests/shm/child_process.hpp"
#include "tests/shm/hooked_access.hpp"
#include "tests/shm/numbered_record.hpp"

namespace yars::shm {
namespace {

using testing::HookedAccess;
using testing::SharedMemory;
using testing::survives;
using testing::VaryingRecord;
using Record = testing::NumberedRecord<5>;
using Ring = BroadcastRing<Record, 8, HookedAccess>;

template <class R>
void publish_numbers(R& ring, std::uint64_t first, std::uint64_t end) {
  for (std::uint64_t n = first; n < end; ++n) EXPECT_EQ(ring.publish(Record::make(n)), n);
}

// Reads all available records and returns their number. Each record must be whole and have the expected number.
std::uint64_t read_all(const Ring& ring, std::uint64_t& cursor, std::uint64_t& lost) {
  std::uint64_t delivered = 0;
  for (Record out{};;) {
    const RingRead result = ring.read(cursor, out);
    lost += result.lost;
    if (!result.delivered) return delivered;
    EXPECT_EQ(out.number + 1, cursor);
    EXPECT_TRUE(out.is_whole());
    ++delivered;
  }
}

TEST(BroadcastRing, ZeroFilledMemoryIsEmpty) {
  SharedMemory<Ring> ring;
  std::uint64_t cursor = 0;
  Record out{};
  const RingRead result = ring->read(cursor, out);
  EXPECT_FALSE(result.delivered);
  EXPECT_EQ(result.lost, 0u);
  EXPECT_EQ(ring->next(), 0u);
  EXPECT_EQ(ring->oldest(), 0u);
}

TEST(BroadcastRing, EveryReaderGetsEveryRecordInOrder) {
  SharedMemory<Ring> ring;
  std::uint64_t cursors[2] = {0, 0};
  std::uint64_t lost = 0;
  for (std::uint64_t round = 0; round < 10; ++round) {
    publish_numbers(*ring, round * 7, round * 7 + 7);
    for (std::uint64_t& cursor : cursors) EXPECT_EQ(read_all(*ring, cursor, lost), 7u);
  }
  EXPECT_EQ(lost, 0u);
}

TEST(BroadcastRing, AReaderThatFellBehindGetsTheNumberOfLostRecords) {
  SharedMemory<Ring> ring;
  publish_numbers(*ring, 0, 100);
  std::uint64_t cursor = 10;
  std::uint64_t lost = 0;
  EXPECT_EQ(ring->oldest(), 93u) << "depth 8: 7 records are readable, and the producer may be writing the eighth slot";
  EXPECT_EQ(read_all(*ring, cursor, lost), 7u);
  EXPECT_EQ(lost, 83u);
  EXPECT_EQ(cursor, 100u);
}

TEST(BroadcastRing, ACursorBeyondTheEndIsSetToTheEnd) {
  SharedMemory<Ring> ring;
  publish_numbers(*ring, 0, 3);
  std::uint64_t cursor = 5000;
  std::uint64_t lost = 0;
  EXPECT_EQ(read_all(*ring, cursor, lost), 0u);
  EXPECT_EQ(cursor, 3u);
}

TEST(BroadcastRing, AfterAProducerIsKilledAtAnyStoreRecordsAreWholeAndTheNextContinues) {
  long stores = 0;
  for (bool alive = false; !alive; ++stores) {
    SharedMemory<Ring> ring;
    publish_numbers(*ring, 0, 20);
    alive = survives(stores, [&] { ring->publish(Record::make(20)); });
    std::uint64_t cursor = 0;
    std::uint64_t lost = 0;
    const std::uint64_t published = alive ? 21 : 20;
    EXPECT_EQ(read_all(*ring, cursor, lost), 7u) << "killed after " << stores << " stores";
    EXPECT_EQ(cursor, published);
    EXPECT_EQ(lost, published - 7);
    publish_numbers(*ring, published, published + 5);
    EXPECT_EQ(read_all(*ring, cursor, lost), 5u);
    EXPECT_EQ(lost, published - 7);
  }
  EXPECT_EQ(stores - 1, 4 + 6) << "stores: sequence, length, 6 words, sequence, next";
}

TEST(BroadcastRing, AReaderInterruptedAtAnyLoadByAnyNumberOfWritesGetsAWholeRecordAndCountsLostOnes) {
  for (std::uint64_t writes = 1; writes <= 20; ++writes) {
    long load = 1;
    for (bool interrupted = true; interrupted; ++load) {
      SharedMemory<Ring> ring;
      publish_numbers(*ring, 0, 20);
      std::uint64_t cursor = 13;
      Record out{};
      RingRead result{};
      interrupted = testing::interrupted_at(
          load, [&] { publish_numbers(*ring, 20, 20 + writes); }, [&] { result = ring->read(cursor, out); });
      ASSERT_TRUE(result.delivered);
      EXPECT_TRUE(out.is_whole()) << writes << " writes before load " << load;
      EXPECT_EQ(out.number, 13 + result.lost);
      EXPECT_EQ(cursor, out.number + 1);
    }
    EXPECT_GE(load, 10) << "loads: next, sequence, length, 6 words, sequence";
  }
}

TEST(BroadcastRing, AReaderInterruptedAtAnyLoadByAProducerKilledAtAnyStoreGetsAWholeRecord) {
  for (long stores = 0; stores < 10; ++stores) {
    long load = 1;
    for (bool interrupted = true; interrupted; ++load) {
      SharedMemory<Ring> ring;
      publish_numbers(*ring, 0, 20);
      std::uint64_t cursor = 13;
      Record out{};
      RingRead result{};
      const auto write = [&] {
        ring->publish(Record::make(20));
        EXPECT_FALSE(survives(stores, [&] { ring->publish(Record::make(21)); }));
      };
      interrupted = testing::interrupted_at(load, write, [&] { result = ring->read(cursor, out); });
      ASSERT_TRUE(result.delivered);
      EXPECT_TRUE(out.is_whole()) << stores << " stores before load " << load;
      EXPECT_EQ(out.number, 13 + result.lost);
    }
  }
}

TEST(BroadcastRing, AReaderOvertakenAtEveryLoadGivesUpAndCountsLostRecords) {
  SharedMemory<Ring> ring;
  publish_numbers(*ring, 0, 20);
  std::uint64_t cursor = 13;
  Record out{};
  RingRead result{};
  testing::interrupted_always([&] { publish_numbers(*ring, ring->next(), ring->next() + 9); },
                              [&] { result = ring->read(cursor, out); });
  EXPECT_FALSE(result.delivered);
  EXPECT_EQ(cursor, 13 + result.lost);
  EXPECT_GT(result.lost, 8u);
  EXPECT_TRUE(ring->read(cursor, out).delivered) << "without interruptions, the reader continues";
}

TEST(BroadcastRing, OnlyTheUsedWordsOfARecordAreCopied) {
  using VaryingRing = BroadcastRing<VaryingRecord, 4, HookedAccess>;
  SharedMemory<VaryingRing> ring;
  std::uint64_t cursor = 0;
  for (std::uint64_t n = 0; n < 40; ++n) {
    const VaryingRecord sent = VaryingRecord::make(n);
    long stores = 0;
    for (; !survives(stores, [&] { ring->publish(sent); }); ++stores) {
    }
    EXPECT_EQ(stores, static_cast<long>(4 + 2 + sent.used)) << "4 stores of the ring; number, length and used words";
    VaryingRecord out{};
    std::fill_n(out.words, VaryingRecord::kMaxWords, 0xabadcafeU);
    EXPECT_TRUE(ring->read(cursor, out).delivered);
    EXPECT_TRUE(out.is_whole());
    for (std::size_t i = out.used; i < VaryingRecord::kMaxWords; ++i) EXPECT_EQ(out.words[i], 0xabadcafeU);
  }
}

TEST(BroadcastRing, ASlotWithALengthBeyondTheRecordIsNotRead) {
  SharedMemory<Ring> ring;
  publish_numbers(*ring, 0, 1);
  auto* bytes = reinterpret_cast<std::byte*>(&*ring);
  reinterpret_cast<AtomicWord*>(bytes + Ring::slots_offset() + sizeof(Word))->store(1000);
  std::uint64_t cursor = 0;
  Record out{};
  EXPECT_FALSE(ring->read(cursor, out).delivered);
}

}  // namespace
}  // namespace yars::shm
