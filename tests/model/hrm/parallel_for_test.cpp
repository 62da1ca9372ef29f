// Work distributed over threads: each item is done exactly once.
#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "lib/parallel/thread_pool.hpp"
#include "tests/model/hrm/patch_maker.hpp"

namespace yars::test {
namespace {

TEST(Executor, DoesEachOfAnyNumberOfThingsOnce) {
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

// One does the others' work while they wait for it.
TEST(Executor, TakesFromTheEndsOfTheOthersSharesWhenItsOwnIsDone) {
  constexpr int kPieces = 20;
  std::atomic<int> done{0};
  std::atomic<bool> both{false};
  std::vector<int> order;
  parallel::parallel_for(executor_of(2), kPieces, 1, [&](int first, int /*last*/, std::size_t thread) {
    if (thread == 1) {
      both = true;
      while (done < kPieces - 1) std::this_thread::yield();
    } else {
      while (!both) std::this_thread::yield();
      order.push_back(first);
    }
    ++done;
  });
  ASSERT_EQ(order.size(), std::size_t{kPieces - 1});
  for (int i = 0; i < kPieces / 2; ++i) EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
  EXPECT_EQ(order[kPieces / 2], kPieces - 1);
}

}  // namespace
}  // namespace yars::test
