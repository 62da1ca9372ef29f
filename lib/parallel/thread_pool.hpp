// Thread pool and parallel loop with work stealing.
// Inputs: a number of items, a size of the chunks, a job on a range of items.
// Outputs: the job has run on every item. With independent items the result does not depend on the number of threads.
// Errors: none; a job must not throw.
// Threads: one run() at a time for each pool. The calling thread works as thread 0.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace yars::parallel {

// Waits until `value` differs from `seen` and returns it. Polls for some hundred microseconds, then sleeps. The thread
// that changes the value must notify.
std::uint32_t wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t seen);

// Pool of threads that wait between jobs. Starting threads for each scan would cost as much as a short scan.
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

  const std::function<void(std::size_t)>* job_ = nullptr;  // null when job_number_ changes: the workers end
  // Each on a separate cache line: polling one does not slow writes to the other.
  alignas(64) std::atomic<std::uint32_t> job_number_{0};
  alignas(64) std::atomic<std::uint32_t> busy_workers_{0};
  std::vector<std::thread> workers_;
};

// Interface of a thread pool for kernels: run(job) calls job(0) to job(threads - 1) concurrently and waits for all.
// The default runs on the calling thread.
struct Executor {
  std::size_t threads = 1;
  std::function<void(const std::function<void(std::size_t)>&)> run = [](const auto& job) { job(0); };
};

// Queue of the chunks [first, last) of one thread. Its owner takes chunks from the front, other threads from the back.
class ChunkQueue {
 public:
  void begin(std::uint32_t first, std::uint32_t last) { left_.store(pack(first, last), std::memory_order_relaxed); }
  // Number of the chunk taken; -1: the queue is empty.
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

// Calls job(first, end, thread) for ranges [first, end) that cover `count` items, `chunk` items at a time.
// Each thread begins with the same range of chunks in every loop of equal size, so that the data is in its cache. Then
// it takes chunks from the queues of other threads. With one thread the job is called once, for all items.
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
