// Thread pool, and a parallel loop over pieces whose result does not depend on the number of threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace yars::parallel {

// Threads that wait for work between scans: making them anew for each would cost as much as a short scan. Every piece
// of work is done by all at once, each with its own number; the caller is number 0.

// Until the value is another one than the one seen; looks for a while before it sleeps. Whoever changes it notifies.
std::uint32_t wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t seen);

class ThreadPool {
 public:
  // `threads` with the caller, at least 1.
  explicit ThreadPool(std::size_t threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  std::size_t threads() const { return helpers_.size() + 1; }
  // Calls job(0) here and job(1), ... on the helpers; returns when all are done. One call at a time.
  void run(const std::function<void(std::size_t)>& job);

 private:
  void help(std::size_t number);

  const std::function<void(std::size_t)>* job_ = nullptr;  // null at a new turn: the end
  // Each on a cache line of its own: who looks at one does not slow who writes the other.
  alignas(64) std::atomic<std::uint32_t> turn_{0};
  alignas(64) std::atomic<std::uint32_t> busy_{0};
  std::vector<std::thread> helpers_;
};

// Hands that share a piece of work. What they make is the same however many they are.

// Runs job(0), ..., job(threads - 1) at the same time and waits for all.
struct Executor {
  std::size_t threads = 1;
  std::function<void(const std::function<void(std::size_t)>&)> run = [](const auto& job) { job(0); };
};

// Pieces [first, last) that are still to be done: their owner takes them from the front, others from behind.
class Share {
 public:
  void begin(std::uint32_t first, std::uint32_t last) { left_.store(pack(first, last), std::memory_order_relaxed); }
  // The number of a piece, or -1: there are no more.
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

  // On a cache line of its own.
  alignas(64) std::atomic<std::uint64_t> left_{0};
};

// job(first, behind the last, thread) on `count` things, so many a piece: every thread works through a share of its
// own, the same in every stage, for what it made is in its cache; then it takes pieces from the ends of the others'.
template <class Job>
void parallel_for(const Executor& crew, int count, int piece, const Job& job) {
  if (crew.threads == 1) return crew.run([&](std::size_t thread) { job(0, count, thread); });
  const std::size_t pieces = static_cast<std::size_t>((count + piece - 1) / piece);
  std::vector<Share> shares(crew.threads);
  for (std::size_t thread = 0; thread < crew.threads; ++thread)
    shares[thread].begin(static_cast<std::uint32_t>(thread * pieces / crew.threads),
                         static_cast<std::uint32_t>((thread + 1) * pieces / crew.threads));
  crew.run([&](std::size_t thread) {
    for (std::size_t off = 0; off < crew.threads; ++off) {
      Share& share = shares[(thread + off) % crew.threads];
      for (int number = share.take(off == 0); number >= 0; number = share.take(off == 0))
        job(number * piece, std::min((number + 1) * piece, count), thread);
    }
  });
}

}  // namespace yars::parallel
