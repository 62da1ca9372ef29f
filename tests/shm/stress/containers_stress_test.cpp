// Stress of the containers with writers and readers as threads on one mapping: records arrive whole and in order, and
// lost records are counted. In one process, ThreadSanitizer sees all accesses (preset tsan).
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <set>
#include <thread>
#include <vector>

#include "shm/latest_value.hpp"
#include "shm/ring_buffers.hpp"
#include "tests/shm/child_process.hpp"
#include "tests/shm/numbered_record.hpp"

namespace yars::shm {
namespace {

using testing::SharedMemory;
using testing::VaryingRecord;
using Record = testing::NumberedRecord<31>;

constexpr std::uint64_t kRecords = 100'000;

// Runs each body on its own thread; all start at the same time.
template <class... Bodies>
void run_together(Bodies... bodies) {
  std::atomic<int> waiting{sizeof...(Bodies)};
  std::vector<std::thread> threads;
  const auto start = [&](auto body) {
    threads.emplace_back([&waiting, body] {
      --waiting;
      while (waiting > 0) std::this_thread::yield();
      body();
    });
  };
  (start(bodies), ...);
  for (std::thread& thread : threads) thread.join();
}

// A long record, and as a rule more threads than cores: the scheduler interrupts readers inside their copy, while the
// writer cycles through all slots.
TEST(ContainersStress, EveryValueReadIsWholeAndNewerThanTheOneBefore) {
  using LongRecord = testing::NumberedRecord<511>;
  constexpr std::uint64_t kValues = 20'000;
  SharedMemory<LatestValue<LongRecord>> value;
  std::atomic<std::uint64_t> seen{0};
  const auto read = [&] {
    const auto reader = std::make_unique<LatestReader<LongRecord>>(*value);
    std::uint64_t last = 0;
    while (last < kValues) {
      if (!reader->refresh()) {
        std::this_thread::yield();
        continue;
      }
      ASSERT_TRUE(reader->value().is_whole());
      ASSERT_EQ(reader->value().number, reader->version()) << "the version belongs to the value";
      ASSERT_GT(reader->version(), last);
      last = reader->version();
      ++seen;
    }
  };
  run_together(
      [&] {
        for (std::uint64_t n = 1; n <= kValues; ++n) value->publish(LongRecord::make(n));
      },
      read, read, read, read);
  std::printf("values seen %lu\n", seen.load());
}

template <class Ring>
void stress_ring() {
  SharedMemory<Ring> ring;
  using RingRecord = decltype([] {
    if constexpr (requires(Ring& r, const VaryingRecord& v) { r.publish(v); })
      return VaryingRecord{};
    else
      return Record{};
  }());
  std::atomic<std::uint64_t> all_lost{0};
  const auto read = [&] {
    auto out = std::make_unique<RingRecord>();
    std::uint64_t cursor = 0, delivered = 0, lost = 0;
    while (cursor < kRecords) {
      const RingRead result = ring->read(cursor, *out);
      lost += result.lost;
      if (!result.delivered) {
        std::this_thread::yield();
        continue;
      }
      ++delivered;
      ASSERT_TRUE(out->is_whole());
      ASSERT_EQ(out->number + 1, cursor);
      ASSERT_EQ(delivered + lost, cursor) << "each record is either delivered or counted as lost";
    }
    all_lost += lost;
  };
  run_together(
      [&] {
        for (std::uint64_t n = 0; n < kRecords; ++n) ring->publish(RingRecord::make(n));
      },
      read, read);
  std::printf("records lost by two readers of %lu: %lu\n", kRecords, all_lost.load());
}

TEST(ContainersStress, ARingDeliversWholeRecordsInOrderAndCountsTheRest) {
  stress_ring<BroadcastRing<Record, 64>>();
}
TEST(ContainersStress, ASmallRingThatOvertakesItsReadersDeliversWholeRecords) {
  stress_ring<BroadcastRing<Record, 2>>();
}
TEST(ContainersStress, ARingOfRecordsOfVaryingLengthDeliversWholeRecords) {
  stress_ring<BroadcastRing<VaryingRecord, 4>>();
}

TEST(ContainersStress, LanesDeliverEverythingOnceAndInOrder) {
  using Lanes = InputLanes<Record, 2, 16>;
  SharedMemory<Lanes> lanes;
  const auto feed = [&](std::size_t lane) {
    return [&lanes, lane] {
      for (std::uint64_t n = 0; n < kRecords;) {
        if (lanes->push(lane, Record::make(n)))
          ++n;
        else
          std::this_thread::yield();
      }
    };
  };
  run_together(feed(0), feed(1), [&] {
    std::uint64_t next[2] = {0, 0};
    Record out{};
    while (next[0] < kRecords || next[1] < kRecords) {
      bool any = false;
      for (std::size_t lane = 0; lane < 2; ++lane) {
        if (!lanes->pop(lane, out)) continue;
        any = true;
        ASSERT_TRUE(out.is_whole());
        ASSERT_EQ(out.number, next[lane]++);
      }
      if (!any) std::this_thread::yield();
    }
  });
  EXPECT_TRUE(lanes->empty(0) && lanes->empty(1));
}

// A writer that is preempted while others overwrite the ring abandons its line and counts it. Every other of the last
// 256 lines is whole and has one line number.
TEST(ContainersStress, NotesOfManyWritersAreWholeNumberedOnceOrCountedAsLost) {
  using Ring = NoteRing<Record, 256>;
  constexpr std::uint64_t kLines = kRecords / 4;
  SharedMemory<Ring> ring;
  std::atomic<int> writing{3};
  const auto write = [&](std::uint64_t first) {
    return [&, first] {
      for (std::uint64_t n = 0; n < kLines; ++n) ring->append(Record::make(first + n));
      --writing;
    };
  };
  std::atomic<std::uint64_t> whole{0};
  run_together(write(0), write(1'000'000), write(2'000'000), [&] {
    Record out{};
    while (writing > 0)
      for (std::uint64_t line = ring->oldest(); line < ring->total(); ++line)
        if (ring->read(line, out)) {
          ASSERT_TRUE(out.is_whole());
          ++whole;
        }
  });
  EXPECT_EQ(ring->total(), 3 * kLines);
  std::uint64_t missing = 0;
  std::set<std::uint64_t> numbers;
  Record out{};
  for (std::uint64_t line = ring->oldest(); line < ring->total(); ++line) {
    if (!ring->read(line, out)) {
      ++missing;
      continue;
    }
    EXPECT_TRUE(out.is_whole());
    EXPECT_TRUE(numbers.insert(out.number).second) << out.number << " is in two lines";
  }
  EXPECT_LE(missing, ring->lost());
  std::printf("lines read whole while three wrote: %lu; given up by late writers: %lu\n", whole.load(), ring->lost());
}

}  // namespace
}  // namespace yars::shm
