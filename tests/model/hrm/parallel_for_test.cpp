// parallel_for(): work distributed over threads. Each item is done exactly once, and threads steal work.
#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "lib/parallel/thread_pool.hpp"
#include "tests/model/hrm/patch_maker.hpp"

namespace yars::test {
namespace {

TEST(Executor, DoesEachItemOnce) {
  for (const std::size_t threads : {1U, 2U, 3U, 8U}) {
    for (const int count : {0, 1, 7, 64, 1000}) {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(count));
      parallel::parallel_for(executor_of(threads), count, 3, [&](int first, int last, std::size_t thread) {
        EXPECT_LT(thread, threads);
        for (int i = first; i < last; ++i) ++done[static_cast<std::size_t>(i)];
      });
      for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1) << threads << ' ' << count;
    }
  }
}

// Thread 1 blocks in its first item until thread 0 has done the other 19. Thread 0 does its own half in ascending
// order, then takes items from the end of the other half.
TEST(Executor, StealsFromTheEndOfAnotherThreadsQueue) {
  constexpr int kItems = 20;
  std::atomic<int> done{0};
  std::atomic<bool> thread_1_started{false};
  std::vector<int> order;
  parallel::parallel_for(executor_of(2), kItems, 1, [&](int first, int /*last*/, std::size_t thread) {
    if (thread == 1) {
      thread_1_started = true;
      while (done < kItems - 1) std::this_thread::yield();
    } else {
      while (!thread_1_started) std::this_thread::yield();
      order.push_back(first);
    }
    ++done;
  });
  ASSERT_EQ(order.size(), std::size_t{kItems - 1});
  for (int i = 0; i < kItems / 2; ++i) EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
  EXPECT_EQ(order[kItems / 2], kItems - 1);
}

}  // namespace
}  // namespace yars::test
