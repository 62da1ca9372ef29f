#include "shm/note_ring.hpp"

#include <gtest/gtest.h>

#include "tests/shm/child_process.hpp"
#include "tests/shm/hooked_access.hpp"
#include "tests/shm/numbered_record.hpp"

namespace yars::shm {
namespace {

using testing::HookedAccess;
using testing::SharedMemory;
using testing::survives;
using Record = testing::NumberedRecord<4>;
using Ring = NoteRing<Record, 10, HookedAccess>;

bool has_line(const Ring& ring, std::uint64_t line, std::uint64_t number) {
  Record out{};
  return ring.read(line, out) && out.number == number && out.is_whole();
}

TEST(NoteRing, KeepsTheLastLinesUnderTheirNumbers) {
  SharedMemory<Ring> ring;
  EXPECT_EQ(ring->total(), 0u);
  EXPECT_FALSE(has_line(*ring, 0, 0));
  for (std::uint64_t n = 0; n < 34; ++n) EXPECT_EQ(ring->append(Record::make(n)), n);
  EXPECT_EQ(ring->total(), 34u);
  EXPECT_EQ(ring->oldest(), 24u);
  for (std::uint64_t n = 24; n < 34; ++n) EXPECT_TRUE(has_line(*ring, n, n));
  EXPECT_FALSE(has_line(*ring, 23, 23)) << "overwritten";
  EXPECT_FALSE(has_line(*ring, 34, 34)) << "not yet there";
}

TEST(NoteRing, AWriterKilledAfterAnyStoreLosesItsOwnLineOnly) {
  long stores = 0;
  for (bool alive = false; !alive; ++stores) {
    SharedMemory<Ring> ring;
    for (std::uint64_t n = 0; n < 15; ++n) ring->append(Record::make(n));
    alive = survives(stores, [&] { ring->append(Record::make(500)); });
    // Who dies before it has a number has taken nobody's place.
    const std::uint64_t next = stores == 0 ? 15 : 16;
    EXPECT_EQ(ring->total(), next);
    for (std::uint64_t n = 6; n < 15; ++n) EXPECT_TRUE(has_line(*ring, n, n)) << n << " after " << stores;
    EXPECT_EQ(has_line(*ring, 15, 500), alive);
    for (std::uint64_t n = 0; n < 10; ++n) EXPECT_EQ(ring->append(Record::make(900 + n)), next + n);
    for (std::uint64_t n = 0; n < 10; ++n) EXPECT_TRUE(has_line(*ring, next + n, 900 + n));
  }
  EXPECT_EQ(stores - 1, 4 + 5) << "total, sequence, checksum, 5 words, sequence";
}

TEST(NoteRing, AReaderInterruptedAtAnyLoadGetsAWholeLineOrNone) {
  for (std::uint64_t lines : {1U, 5U, 9U, 10U, 11U, 25U}) {
    long load = 1;
    for (bool interrupted = true; interrupted; ++load) {
      SharedMemory<Ring> ring;
      for (std::uint64_t n = 0; n < 12; ++n) ring->append(Record::make(n));
      Record out = Record::make(12345);
      bool found = false;
      interrupted = testing::interrupted_at(
          load,
          [&] {
            for (std::uint64_t n = 0; n < lines; ++n) ring->append(Record::make(100 + n));
          },
          [&] { found = ring->read(3, out); });
      EXPECT_TRUE(out.is_whole());
      EXPECT_EQ(out.number, found ? 3u : 12345u);
    }
    EXPECT_GE(load, 9);
  }
}

// One slot, so that the second writer meets the first where it stopped; then the first wakes up and goes on.
TEST(NoteRing, ALineSpoiltByAWriterThatWakesUpLateCountsAsLost) {
  using SmallRing = NoteRing<Record, 1, HookedAccess>;
  constexpr std::size_t kSlotWords = SmallRing::slot_stride() / sizeof(Word);
  const auto slot_of = [](SmallRing& of) {
    return reinterpret_cast<AtomicWord*>(reinterpret_cast<std::byte*>(&of) + SmallRing::slots_offset());
  };
  // Stores of an append: the total, the slot's words in order (sequence odd first), the sequence again.
  const auto has_line_two = [](const SmallRing& ring) {
    Record out{};
    return ring.read(1, out) && out.number == 2 && out.is_whole();
  };
  for (std::size_t stopped_at = 1; stopped_at < kSlotWords; ++stopped_at) {
    SharedMemory<SmallRing> ring, first_writer;
    first_writer->append(Record::make(1));
    survives(1 + static_cast<long>(stopped_at), [&] { ring->append(Record::make(1)); });
    ring->append(Record::make(2));
    EXPECT_TRUE(has_line_two(*ring)) << "the second writer's line is whole so far";
    for (std::size_t i = stopped_at; i < kSlotWords; ++i) {
      slot_of(*ring)[i].store(slot_of(*first_writer)[i].load());
      EXPECT_FALSE(has_line_two(*ring)) << "stopped at " << stopped_at << ", awake until " << i;
    }
    slot_of(*ring)[0].store(slot_of(*first_writer)[0].load());
    EXPECT_FALSE(has_line_two(*ring));
  }
}

}  // namespace
}  // namespace yars::shm
