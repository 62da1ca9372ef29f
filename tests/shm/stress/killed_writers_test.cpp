// Writer processes are killed at random times: every record read is whole, and the next writer continues. The seed is
// printed; the environment variable YARS_TEST_SEED repeats a run.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <random>

#include "shm/latest_value.hpp"
#include "shm/ring_buffers.hpp"
#include "tests/shm/child_process.hpp"
#include "tests/shm/numbered_record.hpp"

namespace yars::shm {
namespace {

using testing::ChildProcess;
using testing::SharedMemory;
using testing::wait_until;
using Record = testing::NumberedRecord<127>;

constexpr int kKills = 40;

struct Everything {
  LatestValue<Record> value;
  BroadcastRing<Record, 32> ring;
  InputLanes<Record, 1, 32> lanes;
  NoteRing<Record, 32> notes;
  std::atomic<std::uint64_t> rounds;  // records that the current writer has written to each container
};

unsigned seed() {
  const char* given = std::getenv("YARS_TEST_SEED");
  const unsigned value = given != nullptr ? static_cast<unsigned>(std::atoi(given)) : std::random_device{}();
  std::printf("YARS_TEST_SEED=%u\n", value);
  return value;
}

void write_forever(Everything& all) {
  for (;;) {
    all.value.publish(Record::make(all.value.version() + 1));
    all.ring.publish(Record::make(all.ring.next()));
    all.lanes.push(0, Record::make(all.lanes.pushed(0)));
    all.notes.append(Record::make(7));
    ++all.rounds;
  }
}

class Reader {
 public:
  explicit Reader(Everything& all) : all_(all), value_(all.value) {}

  void check() {
    if (value_.refresh()) {
      EXPECT_TRUE(value_.value().is_whole());
      EXPECT_EQ(value_.value().number, value_.version());
      EXPECT_GT(value_.version(), version_);
      version_ = value_.version();
    }
    Record out{};
    for (RingRead result = all_.ring.read(cursor_, out); result.delivered; result = all_.ring.read(cursor_, out)) {
      EXPECT_TRUE(out.is_whole());
      EXPECT_EQ(out.number + 1, cursor_);
      if (++delivered_ % 64 == 0) break;
    }
    for (int i = 0; i < 64 && all_.lanes.pop(0, out); ++i) {
      EXPECT_TRUE(out.is_whole());
      EXPECT_EQ(out.number, popped_++);
    }
    for (std::uint64_t line = all_.notes.oldest(); line < all_.notes.total(); ++line) {
      const bool whole = !all_.notes.read(line, out) || (out.is_whole() && out.number == 7);
      EXPECT_TRUE(whole);
    }
  }

 private:
  Everything& all_;
  LatestReader<Record> value_;
  std::uint64_t version_ = 0, cursor_ = 0, delivered_ = 0, popped_ = 0;
};

TEST(KilledWriters, LeaveOnlyWholeRecordsAndAreReplaced) {
  SharedMemory<Everything> all;
  std::mt19937 random(seed());
  Reader reader(*all);
  for (int n = 0; n < kKills; ++n) {
    all->rounds = 0;
    const std::uint64_t version = all->value.version();
    ChildProcess writer([&] { write_forever(*all); });
    const std::uint64_t life = 1 + random() % 2000;
    ASSERT_TRUE(wait_until([&] {
      reader.check();
      return all->rounds >= life;
    })) << "the writer after a killed writer makes no progress";
    writer.kill_now();
    for (int i = 0; i < 3; ++i) reader.check();
    EXPECT_GE(all->value.version(), version + life);
    Record out{};
    EXPECT_EQ(all->value.read(out), all->value.version()) << "the last published value is readable";
  }
}

}  // namespace
}  // namespace yars::shm
