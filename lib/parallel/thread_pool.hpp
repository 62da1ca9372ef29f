// Thread pool and parallel loop with work stealing.
// Inputs: the number of items, the chunk size [items], and a job for a range of items.
// Outputs: the job has run once for every item. If the items are independent, the number of threads does not change the
// result.
// Requirement: a job must not throw.
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

// Waits until `value` differs from `seen`, and returns the new value. The thread spins for a few hundred microseconds,
// then blocks. The thread that changes the value must call notify_one() or notify_all().
std::uint32_t wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t seen);

// Pool of threads that are reused for all jobs. Starting threads takes as long as a short scan of `yars scan`.
class ThreadPool {
 public:
  // `threads`: number of threads including the calling thread, at least 1.
  explicit ThreadPool(std::size_t threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  std::size_t threads() const { return workers_.size() + 1; }
  // Calls job(0) on the calling thread and job(1) to job(threads() - 1) on the workers. Blocks until all have returned.
  void run(const std::function<void(std::size_t)>& job);

 private:
  void run_worker(std::size_t number);

  // Separate cache lines avoid false sharing: polling one atomic does not slow writes to the other.
  alignas(64) std::atomic<std::uint32_t> job_number_{0};
  alignas(64) std::atomic<std::uint32_t> busy_workers_{0};
  const std::function<void(std::size_t)>* job_ = nullptr;  // null: the workers end at the next change of job_number_
  std::vector<std::thread> workers_;
};

// Function interface to a thread pool. Kernels receive an Executor instead of a ThreadPool. run(job) calls job(0) to
// job(threads - 1) concurrently and blocks until all have returned. The default runs job(0) on the calling thread.
struct Executor {
  std::size_t threads = 1;
  std::function<void(const std::function<void(std::size_t)>&)> run = [](const auto& job) { job(0); };
};

// Work-stealing queue of the chunks [first, last) of one thread. This thread, the owner, takes chunks from the front;
// other threads take chunks from the back.
class ChunkQueue {
 public:
  // Fills the queue with the chunks [first, last). Must not run concurrently with take().
  void begin(std::uint32_t first, std::uint32_t last) { left_.store(pack(first, last), std::memory_order_relaxed); }
  // Takes a chunk and returns its number, or -1 if the queue is empty. `own`: true if the caller is the owner.
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

// Calls job(first, end, thread) for ranges [first, end) of at most `chunk` items, which together cover `count` items.
// In all loops of equal `count` and `chunk`, a thread begins with the same chunks, whose data is often still in its
// cache. A thread without chunks takes chunks of other threads. With one thread, the job is called once for all
// items, and `chunk` has no effect.
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
