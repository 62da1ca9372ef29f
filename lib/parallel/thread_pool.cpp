#include "lib/parallel/thread_pool.hpp"

namespace yars::parallel {

namespace {
// Looks before a thread sleeps, tens of nanoseconds each: the rest of a scan is some hundred microseconds away at most,
// and a wake-up costs tens.
constexpr int kLooks = 8000;

// Leaves the core to its other thread for a moment.
void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}
}  // namespace

std::uint32_t wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t seen) {
  for (int look = 0; look < kLooks; ++look) {
    if (const std::uint32_t now = value.load(std::memory_order_acquire); now != seen) return now;
    pause();
  }
  value.wait(seen, std::memory_order_acquire);
  return value.load(std::memory_order_acquire);
}

ThreadPool::ThreadPool(std::size_t threads) {
  for (std::size_t number = 1; number < threads; ++number) helpers_.emplace_back([this, number] { help(number); });
}

ThreadPool::~ThreadPool() {
  job_ = nullptr;
  turn_.fetch_add(1, std::memory_order_release);
  turn_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void ThreadPool::run(const std::function<void(std::size_t)>& job) {
  if (helpers_.empty()) {
    job(0);
    return;
  }
  job_ = &job;
  busy_.store(static_cast<std::uint32_t>(helpers_.size()), std::memory_order_relaxed);
  turn_.fetch_add(1, std::memory_order_release);
  turn_.notify_all();
  job(0);
  for (std::uint32_t busy = busy_.load(std::memory_order_acquire); busy != 0;) busy = wait_for_change(busy_, busy);
}

void ThreadPool::help(std::size_t number) {
  std::uint32_t turn = 0;
  while (true) {
    turn = wait_for_change(turn_, turn);
    if (job_ == nullptr) return;
    (*job_)(number);
    if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_one();
  }
}

}  // namespace yars::parallel
