// Tests of the session's counters, and of the notes that reach the flight recorder in a flood of similar notes.
#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "databuffer/session/session.hpp"
#include "tests/databuffer/session/open_session.hpp"
#include "tests/shm/child_process.hpp"

namespace yars::databuffer {
namespace {

using shm::testing::ChildProcess;
using shm::testing::SharedMemory;
using shm::testing::wait_until;

using CountersTest = testing::OpenSessionTest;

// Written one by one, 100 refusals per second would push the supervisor's notes out of the flight recorder.
TEST_F(CountersTest, SimilarNotesInAFloodAreCountedAndNotWritten) {
  Session session = open("radar-model");
  session.count_restart("radar-model");
  session.note(NoteKind::supervision, "started again: was killed", "radar-model");
  for (int i = 0; i < 5000; ++i)
    session.note(NoteKind::refusal, "ownship: latitude_deg: expected [-90, 90], found " + std::to_string(i + 91));
  const auto& layout = session.layout();
  EXPECT_EQ(layout.note_counts[static_cast<std::size_t>(NoteKind::refusal)], 5000u);
  EXPECT_EQ(layout.counters.refusals.count, 5000u);
  EXPECT_EQ(layout.counters.notes_folded, 5000u - 3);
  EXPECT_LE(layout.notes.total(), 10u);
  Note note{};
  ASSERT_TRUE(layout.notes.read(0, note));
  EXPECT_STREQ(note.text, "started again: was killed");
  EXPECT_EQ(layout.counters.restarts[*counted_role("radar-model")].within(60'000'000'000, monotonic_ns()), 1);
}

TEST(SkippedTicks, AreSummedOverTheLastSeconds) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  SkippedTicks skipped{};
  EXPECT_EQ(skipped.within(10, 100 * kSecond_ns).ticks, 0u);
  skipped.add(5, 100 * kSecond_ns);
  skipped.add(7, 100 * kSecond_ns + 999'999'999);
  skipped.add(20, 103 * kSecond_ns);
  EXPECT_EQ(skipped.within(10, 103 * kSecond_ns).ticks, 32u);
  EXPECT_EQ(skipped.within(10, 103 * kSecond_ns).seconds, 2);
  EXPECT_EQ(skipped.within(10, 110 * kSecond_ns).ticks, 20u) << "the second 100 is over";
  EXPECT_EQ(skipped.within(10, 113 * kSecond_ns).ticks, 0u);
  skipped.add(1, 116 * kSecond_ns);  // the slot of second 100
  EXPECT_EQ(skipped.within(16, 116 * kSecond_ns).ticks, 21u);
  EXPECT_EQ(skipped.within(10, 99 * kSecond_ns).ticks, 0u) << "a damaged second in the future counts for nothing";
}

TEST_F(CountersTest, NotesThatWereNotWrittenAreReportedWhenTheSessionCloses) {
  Session watcher = open("watcher");
  {
    Session session = open("radar-model");
    for (int i = 0; i < 50; ++i) session.note(NoteKind::loss, "fell behind by " + std::to_string(i));
  }
  EXPECT_EQ(last_note(watcher), "47 more: fell behind by 49");
}

TEST_F(CountersTest, AnEventSourceThatDiesStaysMarkedAndOneThatLeavesDoesNot) {
  Session session = open("tester");
  const auto& sources = session.layout().counters.input_sources;
  {
    const auto claim = session.claim_input_lane("panel");
    ASSERT_TRUE(claim);
    EXPECT_EQ(sources, 1u);
  }
  EXPECT_EQ(sources, 0u);
  SharedMemory<std::atomic<int>> ready;
  ChildProcess child([&] {
    Session own = open("panel");
    const auto claim = own.claim_input_lane("panel");
    *ready = claim ? 1 : 2;
    for (;;) pause();
  });
  ASSERT_TRUE(wait_until([&] { return *ready != 0; }));
  child.kill_now();
  EXPECT_EQ(sources, 1u);
  EXPECT_FALSE(session.input_lane_is_held(0));
}

// Seven sources claim and release lanes at the same time; another source keeps its lane. After each round only the lane
// of that source is marked.
TEST_F(CountersTest, ConcurrentSourcesThatLeaveDoNotStayMarked) {
  Session session = open("tester");
  const auto kept_claim = session.claim_input_lane("panel");
  ASSERT_TRUE(kept_claim);
  constexpr int kThreads = 7;
  constexpr int kRounds = 300;
  int wrong = 0;
  std::barrier together(kThreads, [&]() noexcept {});
  std::barrier checked(kThreads, [&]() noexcept { wrong += session.layout().counters.input_sources == 1u ? 0 : 1; });
  std::vector<std::jthread> threads;
  for (int thread = 0; thread < kThreads; ++thread)
    threads.emplace_back([&, thread] {
      for (int round = 0; round < kRounds; ++round) {
        auto claim = session.claim_input_lane("panel " + std::to_string(thread));
        if (thread % 2 == 0) together.arrive_and_wait();
        claim = tl::unexpected(error::Error{});
        if (thread % 2 != 0) together.arrive_and_wait();
        checked.arrive_and_wait();
      }
    });
  threads.clear();
  EXPECT_EQ(wrong, 0);
}

TEST(RecentCount, CountsTheLastEightTimesAndIgnoresImpossibleTimes) {
  RecentCount count{};
  for (std::int64_t i = 1; i <= 20; ++i) count.add(i * 1000);
  EXPECT_EQ(count.count, 20u);
  EXPECT_EQ(count.within(5000, 20'000), 5);
  EXPECT_EQ(count.within(1'000'000, 20'000), 8);
  for (auto& time : count.times_ns) time = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(count.within(std::numeric_limits<std::int64_t>::max(), 20'000), 0);
  for (auto& time : count.times_ns) time = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(count.within(1000, 20'000), 0);
}

}  // namespace
}  // namespace yars::databuffer
