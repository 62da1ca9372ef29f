#include "lib/parallel/thread_pool.hpp"

namespace yars::parallel {

namespace {
// Number of polls before a thread sleeps. One poll takes tens of nanoseconds; a wake-up takes tens of microseconds.
// All polls together take a few hundred microseconds, about the longest wait of a thread within a scan of `yars scan`.
// With fewer polls, threads would sleep and wake up within a scan. With more polls, they would keep the cores busy
// longer after a scan.
constexpr int kPolls = 8000;

// Leaves the processor core to its other hardware thread for some clock cycles.
void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}
}  // namespace

std::uint32_t wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t seen) {
  for (int poll = 0; poll < kPolls; ++poll) {
    if (const std::uint32_t now = value.load(std::memory_order_acquire); now != seen) return now;
    pause();
  }
  value.wait(seen, std::memory_order_acquire);
  return value.load(std::memory_order_acquire);
}

ThreadPool::ThreadPool(std::size_t threads) {
  for (std::size_t number = 1; number < threads; ++number)
    workers_.emplace_back([this, number] { run_worker(number); });
}

ThreadPool::~ThreadPool() {
  job_ = nullptr;
  job_number_.fetch_add(1, std::memory_order_release);
  job_number_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::run(const std::function<void(std::size_t)>& job) {
  if (workers_.empty()) {
    job(0);
    return;
  }
  job_ = &job;
  busy_workers_.store(static_cast<std::uint32_t>(workers_.size()), std::memory_order_relaxed);
  job_number_.fetch_add(1, std::memory_order_release);
  job_number_.notify_all();
  job(0);
  for (std::uint32_t busy = busy_workers_.load(std::memory_order_acquire); busy != 0;)
    busy = wait_for_change(busy_workers_, busy);
}

void ThreadPool::run_worker(std::size_t number) {
  std::uint32_t seen_job = 0;
  while (true) {
    seen_job = wait_for_change(job_number_, seen_job);
    if (job_ == nullptr) return;
    (*job_)(number);
    if (busy_workers_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_workers_.notify_one();
  }
}

}  // namespace yars::parallel
