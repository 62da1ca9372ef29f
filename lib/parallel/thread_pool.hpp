// Thread pool and parallel loop with work stealing.
// Inputs: number of items, chunk size, a job on a range of items.
// Outputs: the job has run on every item. If items are independent, the result does not depend on the thread count.
// Errors: none. A job must not throw.
// Threads: at most one run() at a time per pool. The calling thread works as thread 0.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace yars::parallel {

// Waits until `value` differs from `seen`, and returns the new value. Polls for some hundred microseconds, then sleeps.
// The thread that changes the value must call its notify_one() or notify_all().
std::uint32_t wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t seen);

// Pool of worker threads. They wait between jobs: starting threads for each scan would cost as much as a short scan.
class ThreadPool {
 public:
  // `threads` counts the calling thread and is at least 1.
  explicit ThreadPool(std::size_t threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  std::size_t threads() const { return workers_.size() + 1; }
  // Calls job(0) on this thread and job(1) to job(threads() - 1) on the workers. Returns when all have returned.
  void run(const std::function<void(std::size_t)>& job);

 private:
  void run_worker(std::size_t number);

  const std::function<void(std::size_t)>* job_ = nullptr;  // null at a change of job_number_: the workers return
  // Each on a separate cache line: polling one does not slow writes to the other.
  alignas(64) std::atomic<std::uint32_t> job_number_{0};
  alignas(64) std::atomic<std::uint32_t> busy_workers_{0};
  std::vector<std::thread> workers_;
};

// Interface by which kernels use a thread pool: run(job) calls job(0) to job(threads - 1) concurrently and waits for
// all. The default has one thread, the calling one.
struct Executor {
  std::size_t threads = 1;
  std::function<void(const std::function<void(std::size_t)>&)> run = [](const auto& job) { job(0); };
};

// Lock-free queue of the chunks [first, last) of one thread. Its owner takes from the front, other threads from the
// back (work stealing).
class ChunkQueue {
 public:
  void begin(std::uint32_t first, std::uint32_t last) { left_.store(pack(first, last), std::memory_order_relaxed); }
  // Index of the chunk taken; -1: the queue is empty. `own`: called by the owner.
  int take(bool own) {
    std::uint64_t left = left_.load(std::memory_order_relaxed);
    while (true) {
      const auto first = static_cast<std::uint32_t>(left >> 32U);
      const auto last = static_cast<std::uint32_t>(left);
      if (first >= last) return -1;
      const std::uint64_t rest = own ? pack(first + 1, last) : pack(first, last - 1);
      if (left_.compare_exchange_weak(left, rest, std::memory_order_relaxed))
        return static_cast<int>(own ? first : last - 1);
    }
  }

 private:
  static std::uint64_t pack(std::uint32_t first, std::uint32_t last) { return std::uint64_t{first} << 32U | last; }

  // `first` in the upper, `last` in the lower 32 bits. The alignment gives each queue a separate cache line.
  alignas(64) std::atomic<std::uint64_t> left_{0};
};

// Calls job(first, end, thread) for ranges [first, end) of at most `chunk` items that cover [0, count).
// Loops of equal size give each thread the same first chunks, so that their data may still be in its cache.
// A thread without chunks of its own steals from the others. With one thread the job is called once, for all items.
template <class Job>
void parallel_for(const Executor& executor, int count, int chunk, const Job& job) {
  if (executor.threads == 1) return executor.run([&](std::size_t thread) { job(0, count, thread); });
  const std::size_t chunks = static_cast<std::size_t>((count + chunk - 1) / chunk);
  std::vector<ChunkQueue> queues(executor.threads);
  for (std::size_t thread = 0; thread < executor.threads; ++thread)
    queues[thread].begin(static_cast<std::uint32_t>(thread * chunks / executor.threads),
                         static_cast<std::uint32_t>((thread + 1) * chunks / executor.threads));
  executor.run([&](std::size_t thread) {
    for (std::size_t offset = 0; offset < executor.threads; ++offset) {
      ChunkQueue& queue = queues[(thread + offset) % executor.threads];
      for (int number = queue.take(offset == 0); number >= 0; number = queue.take(offset == 0))
        job(number * chunk, std::min((number + 1) * chunk, count), thread);
    }
  });
}

}  // namespace yars::parallel
