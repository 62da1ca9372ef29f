// NoteRing: line numbers, writers that are killed or paused at any step, interrupted readers and damaged slots.
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
using Record = testing::NumberedRecord<4>;
using Ring = NoteRing<Record, 10, HookedAccess>;

// True if the ring has a whole record `number` as line `line`.
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
  EXPECT_FALSE(has_line(*ring, 34, 34)) << "not yet written";
}

TEST(NoteRing, AWriterKilledAtAnyStoreLosesOnlyItsOwnLine) {
  long stores = 0;
  for (bool alive = false; !alive; ++stores) {
    SharedMemory<Ring> ring;
    for (std::uint64_t n = 0; n < 15; ++n) ring->append(Record::make(n));
    alive = survives(stores, [&] { ring->append(Record::make(500)); });
    // A writer killed at its first store, the increment of `total`, takes no line number.
    const std::uint64_t next = stores == 0 ? 15 : 16;
    EXPECT_EQ(ring->total(), next);
    for (std::uint64_t n = 6; n < 15; ++n) EXPECT_TRUE(has_line(*ring, n, n)) << n << " after " << stores;
    EXPECT_EQ(has_line(*ring, 15, 500), alive);
    for (std::uint64_t n = 0; n < 10; ++n) EXPECT_EQ(ring->append(Record::make(900 + n)), next + n);
    for (std::uint64_t n = 0; n < 10; ++n) EXPECT_TRUE(has_line(*ring, next + n, 900 + n));
  }
  EXPECT_EQ(stores - 1, 4 + 5) << "stores: total, sequence, checksum, 5 words, sequence";
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

// A writer pauses at each of its loads and exchanges. Meanwhile, other writers overwrite all lines of the ring.
TEST(NoteRing, AWriterThatContinuesTooLateAbandonsItsLineAndCountsIt) {
  constexpr std::uint64_t kOthers = 14;
  long stopped_at = 1;
  for (bool stopped = true; stopped; ++stopped_at) {
    SharedMemory<Ring> ring;
    for (std::uint64_t n = 0; n < 12; ++n) ring->append(Record::make(n));
    stopped = testing::interrupted_at(
        stopped_at,
        [&] {
          for (std::uint64_t n = 0; n < kOthers; ++n) ring->append(Record::make(100 + n));
        },
        [&] { EXPECT_EQ(ring->append(Record::make(500)), 12u); });
    if (!stopped) break;
    EXPECT_EQ(ring->total(), 12 + 1 + kOthers);
    for (std::uint64_t line = ring->oldest(); line < ring->total(); ++line)
      EXPECT_TRUE(has_line(*ring, line, 100 + line - 13)) << line << ", stopped at " << stopped_at;
    EXPECT_EQ(ring->lost(), 1u) << stopped_at;
  }
  EXPECT_GT(stopped_at, 2 + 3 * 6) << "loads and exchanges of sequence, checksum and 5 words; exchange of the sequence";
}

// A late writer can change one word of a newer line, if that word equals the word that it has loaded. The checksum
// detects this.
TEST(NoteRing, ALineWithOneChangedWordIsNotRead) {
  using SmallRing = NoteRing<Record, 1, HookedAccess>;
  constexpr std::size_t kSlotWords = SmallRing::slot_stride() / sizeof(Word);
  for (std::size_t word = 1; word < kSlotWords; ++word) {
    SharedMemory<SmallRing> ring;
    ring->append(Record::make(1));
    ring->append(Record::make(2));
    auto* slot = reinterpret_cast<AtomicWord*>(reinterpret_cast<std::byte*>(&*ring) + SmallRing::slots_offset());
    slot[word] = slot[word].load() + 1;
    Record out = Record::make(12345);
    EXPECT_FALSE(ring->read(1, out)) << word;
    EXPECT_EQ(out.number, 12345u);
  }
}

TEST(NoteRing, ASlotWithADamagedSequenceIsOverwritten) {
  using SmallRing = NoteRing<Record, 2, HookedAccess>;
  for (const Word damage : {~Word{0}, ~Word{0} - 1, Word{1} << 63U, Word{1000}, Word{1001}}) {
    SharedMemory<SmallRing> ring;
    ring->append(Record::make(0));
    ring->append(Record::make(1));
    auto* slot = reinterpret_cast<AtomicWord*>(reinterpret_cast<std::byte*>(&*ring) + SmallRing::slots_offset());
    slot[0] = damage;
    ring->append(Record::make(2));
    Record out{};
    EXPECT_TRUE(ring->read(2, out) && out.number == 2) << damage;
    EXPECT_EQ(ring->lost(), 0u) << damage;
  }
}

}  // namespace
}  // namespace yars::shm
