#include "shm/note_ring.hpp"

#include <gtest/gtest.h>

#include "tests/shm/child_process.hpp"
#include "tests/shm/counted_stores.hpp"
#include "tests/shm/numbered_record.hpp"

namespace yars::shm {
namespace {

using testing::CountedStores;
using testing::SharedMemory;
using testing::survives;
using Record = testing::NumberedRecord<4>;
using Ring = NoteRing<Record, 10, CountedStores>;

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

TEST(NoteRing, ALineSpoiltByAWriterThatWakesUpLateCountsAsLost) {
  SharedMemory<Ring> ring;
  for (std::uint64_t n = 0; n < 3; ++n) ring->append(Record::make(n));
  auto* bytes = reinterpret_cast<std::byte*>(&*ring);
  auto* word = reinterpret_cast<AtomicWord*>(bytes + Ring::slots_offset() + Ring::slot_stride() + 4 * sizeof(Word));
  word->store(word->load() ^ 1U);
  EXPECT_TRUE(has_line(*ring, 0, 0));
  EXPECT_FALSE(has_line(*ring, 1, 1));
  EXPECT_TRUE(has_line(*ring, 2, 2));
}

}  // namespace
}  // namespace yars::shm
