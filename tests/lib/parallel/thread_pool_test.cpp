// ThreadPool: nobody works outside a job, and the caller can do a job alone.
#include "lib/parallel/thread_pool.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <thread>
#include <vector>

namespace yars::parallel {
namespace {

constexpr std::size_t kThreads = 3;

Executor executor_of(ThreadPool& pool) {
  return {pool.threads(), [&pool](const std::function<void(std::size_t)>& job) { pool.run(job); }};
}

TEST(ThreadPool, DoesEachItemOnceInEveryJob) {
  ThreadPool pool(kThreads);
  const Executor executor = executor_of(pool);
  for (int job = 0; job < 2000; ++job) {
    std::array<std::atomic<int>, 17> done{};
    parallel_for(executor, 17, 2, [&](int first, int end, std::size_t thread) {
      ASSERT_LT(thread, kThreads);
      for (int i = first; i < end; ++i) ++done[static_cast<std::size_t>(i)];
    });
    for (const std::atomic<int>& times : done) ASSERT_EQ(times, 1) << job;
  }
}

// More jobs than the pool has numbers for (32,768). A thread that entered twice, or a worker that runs after run() has
// returned, shows in the counts.
TEST(ThreadPool, ThreadsEnterAJobOnceAndLeaveItBeforeItEnds) {
  ThreadPool pool(kThreads);
  for (int job = 0; job < 70'000; ++job) {
    std::array<std::atomic<int>, kThreads> entered{};
    std::atomic<int> inside{0};
    pool.run([&](std::size_t thread) {
      ++inside;
      ++entered[thread];
      --inside;
    });
    ASSERT_EQ(inside, 0) << job;
    ASSERT_EQ(entered[0], 1) << job;
    for (const std::atomic<int>& times : entered) ASSERT_LE(times, 1) << job;
  }
}

TEST(ThreadPool, WorkersTakePart) {
  ThreadPool pool(2);
  std::atomic<bool> entered{false};
  pool.run([&](std::size_t thread) {
    if (thread == 1) entered = true;
    while (!entered) std::this_thread::yield();
  });
  EXPECT_TRUE(entered);
}

// The worker enters and sleeps, so that the caller waits for it.
void hold_up_the_caller(ThreadPool& pool) {
  std::atomic<bool> entered{false};
  pool.run([&](std::size_t thread) {
    while (thread == 0 && !entered) std::this_thread::yield();
    if (thread == 0) return;
    entered = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
  });
}

// Whether the worker enters a job that lasts until it does, or for 200 ms.
bool worker_enters(ThreadPool& pool) {
  std::atomic<bool> entered{false};
  pool.run([&](std::size_t thread) {
    if (thread != 0) entered = true;
    const auto begin = std::chrono::steady_clock::now();
    while (!entered && std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(200))
      std::this_thread::yield();
  });
  return entered;
}

// On a busy machine the caller may lose its core and not be held up: another pool tries again.
TEST(ThreadPool, AfterWorkersHaveCostTimeTheCallerWorksAloneForAWhile) {
  bool entered = true;
  for (int attempt = 0; entered && attempt < 20; ++attempt) {
    ThreadPool pool(2);
    hold_up_the_caller(pool);
    entered = worker_enters(pool);
  }
  EXPECT_FALSE(entered);
}

TEST(ThreadPool, EndsWithWorkersThatNeverHadAJob) {
  for (int i = 0; i < 20; ++i) ThreadPool pool(8);
}

}  // namespace
}  // namespace yars::parallel
