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

// Returns false to stop long work. The work calls it between its steps, on the thread that started the work. An empty
// function never stops the work.
using GoesOn = std::function<bool()>;
// Thrown by work that GoesOn has stopped. The result of the work is lost; the objects that it used stay usable.
struct Stopped {};
inline void check(const GoesOn& goes_on) {
  if (goes_on && !goes_on()) throw Stopped{};
}

// Pool of threads that are reused for all jobs. Starting threads takes as long as a short scan of `yars scan`.
// run() does not wait for a worker that has not begun. On a busy machine a worker may lose its core while it works, and
// then the caller waits for it. When such waits have cost more time than the workers have saved, run() calls only
// job(0) for some time.
class ThreadPool {
 public:
  // `threads`: number of threads including the calling thread, at least 1.
  explicit ThreadPool(std::size_t threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  std::size_t threads() const { return workers_.size() + 1; }
  // Calls job(0) on the calling thread, and job(1) to job(threads() - 1) on those workers that begin before job(0) has
  // returned. Blocks until all of these have returned. Requirement: job(0) does all the work that no worker has taken.
  void run(const std::function<void(std::size_t)>& job);

 private:
  void open(const std::function<void(std::size_t)>* job);
  void close();
  void settle(std::int64_t saved_ns);
  bool enter(std::uint32_t& state);
  void leave();
  void run_worker(std::size_t number);

  // Separate cache lines avoid false sharing: polling one atomic does not slow writes to the other.
  // Bit 31: workers may enter the job. Bits 16 to 30: number of the job. Bits 0 to 15: workers inside the job.
  alignas(64) std::atomic<std::uint32_t> state_{0};
  alignas(64) std::atomic<std::uint32_t> left_{0};         // 1: the last worker has left the closed job
  alignas(64) std::atomic<std::int64_t> worked_ns_{0};     // processor time of the workers in the job
  const std::function<void(std::size_t)>* job_ = nullptr;  // null: the workers that enter end
  std::int64_t saved_ns_ = 0;                              // processor time of workers minus the waits for them
  std::int64_t alone_factor_ = 0;                          // time alone per time lost; 0: the machine is not busy
  std::int64_t alone_until_ns_ = 0;                        // steady clock; 0: the workers take part
  std::vector<std::thread> workers_;
};

// Function interface to a thread pool. Kernels receive an Executor instead of a ThreadPool. run(job) calls job(0) and
// at most job(1) to job(threads - 1) concurrently, and blocks until all have returned. The default runs job(0) on the
// calling thread.
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

// Queues of the chunks of one loop, one for each thread. In all loops of equal size, a thread begins with the same
// chunks, whose data is often still in its cache. A thread without chunks takes chunks of other threads.
class ChunkQueues {
 public:
  explicit ChunkQueues(std::size_t threads) : queues_(threads) {}
  // Distributes the chunks [0, chunks). Must not run concurrently with take().
  void begin(std::size_t chunks) {
    for (std::size_t thread = 0; thread < queues_.size(); ++thread)
      queues_[thread].begin(static_cast<std::uint32_t>(thread * chunks / queues_.size()),
                            static_cast<std::uint32_t>((thread + 1) * chunks / queues_.size()));
  }
  // Takes a chunk for this thread and returns its number, or -1 if none is left.
  int take(std::size_t thread) {
    for (std::size_t offset = 0; offset < queues_.size(); ++offset)
      if (const int chunk = queues_[(thread + offset) % queues_.size()].take(offset == 0); chunk >= 0) return chunk;
    return -1;
  }

 private:
  std::vector<ChunkQueue> queues_;
};

// Calls job(first, end, thread) for ranges [first, end) of at most `chunk` items, which together cover `count` items.
// ChunkQueues distributes them. With one thread, the job is called once for all items, and `chunk` has no effect.
template <class Job>
void parallel_for(const Executor& executor, int count, int chunk, const Job& job) {
  if (executor.threads == 1) return executor.run([&](std::size_t thread) { job(0, count, thread); });
  ChunkQueues queues(executor.threads);
  queues.begin(static_cast<std::size_t>((count + chunk - 1) / chunk));
  executor.run([&](std::size_t thread) {
    for (int number = queues.take(thread); number >= 0; number = queues.take(thread))
      job(number * chunk, std::min((number + 1) * chunk, count), thread);
  });
}

}  // namespace yars::parallel
