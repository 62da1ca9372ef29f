#include "lib/parallel/thread_pool.hpp"

#include <chrono>
#include <ctime>

namespace yars::parallel {

namespace {
// Number of polls before a thread sleeps. One poll takes tens of nanoseconds; a wake-up takes tens of microseconds.
// All polls together take about 50 us, the time of a piece of a scan of `yars scan`. With fewer polls, threads would
// sleep and wake up within a scan. With more polls, they would take the cores from threads that work: with 8000, two
// threads on one core scan 6 % slower than one.
constexpr int kPolls = 1000;

// Fields of ThreadPool::state_. The number of a job wraps around; a worker that sleeps through a whole turn misses one.
constexpr std::uint32_t kOpen = 1U << 31U;
constexpr std::uint32_t kOneJob = 1U << 16U;
constexpr std::uint32_t kInside = kOneJob - 1U;
constexpr std::uint32_t kJob = kOpen - kOneJob;

// After workers have cost time, the caller works alone for this factor times that time. Each time in a row doubles the
// factor. Its inverse is the share that a busy machine loses by trying again: 6 % at first, 0.4 % in the end. A larger
// factor keeps the pool single-threaded for longer after the machine was busy.
constexpr std::int64_t kMinAloneFactor = 16;
constexpr std::int64_t kMaxAloneFactor = 256;
constexpr std::int64_t kMaxAlone_ns = 1'000'000'000;
// [ns] Maximum of the saved time that counts against later waits. When workers have saved this much, the machine no
// longer counts as busy.
constexpr std::int64_t kMaxSaved_ns = 2'000'000;

// Leaves the processor core to its other hardware thread for some clock cycles.
void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

std::int64_t wall_ns() {
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

std::int64_t thread_cpu_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

// Waits until `value` differs from `seen`, and returns the new value. The thread polls kPolls times, then sleeps. The
// thread that changes the value must call notify_one() or notify_all().
std::uint32_t wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t seen) {
  for (int poll = 0; poll < kPolls; ++poll) {
    if (const std::uint32_t now = value.load(std::memory_order_acquire); now != seen) return now;
    pause();
  }
  value.wait(seen, std::memory_order_acquire);
  return value.load(std::memory_order_acquire);
}
}  // namespace

ThreadPool::ThreadPool(std::size_t threads) {
  for (std::size_t number = 1; number < threads; ++number)
    workers_.emplace_back([this, number] { run_worker(number); });
}

ThreadPool::~ThreadPool() {
  open(nullptr);
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::open(const std::function<void(std::size_t)>* job) {
  job_ = job;
  left_.store(0, std::memory_order_relaxed);
  const std::uint32_t number = (state_.load(std::memory_order_relaxed) + kOneJob) & kJob;
  state_.store(kOpen | number, std::memory_order_release);
  state_.notify_all();
}

void ThreadPool::run(const std::function<void(std::size_t)>& job) {
  if (workers_.empty() || (alone_until_ns_ != 0 && wall_ns() < alone_until_ns_)) {
    job(0);
    return;
  }
  worked_ns_.store(0, std::memory_order_relaxed);
  open(&job);
  job(0);
  close();
}

void ThreadPool::close() {
  const std::uint32_t state = state_.fetch_and(~kOpen, std::memory_order_acq_rel) & ~kOpen;
  std::int64_t cost_ns = 0;
  if ((state & kInside) != 0) {
    const std::int64_t begin_ns = wall_ns();
    wait_for_change(left_, 0);
    cost_ns = wall_ns() - begin_ns;
  }
  settle(worked_ns_.load(std::memory_order_relaxed) - cost_ns);
}

void ThreadPool::settle(std::int64_t saved_ns) {
  saved_ns_ = std::min(saved_ns_ + saved_ns, kMaxSaved_ns);
  alone_until_ns_ = 0;
  if (saved_ns_ == kMaxSaved_ns) alone_factor_ = 0;
  if (saved_ns_ >= 0) return;
  alone_factor_ = std::clamp(2 * alone_factor_, kMinAloneFactor, kMaxAloneFactor);
  alone_until_ns_ = wall_ns() + std::min(alone_factor_ * -saved_ns_, kMaxAlone_ns);
  saved_ns_ = 0;
}

bool ThreadPool::enter(std::uint32_t& state) {
  while ((state & kOpen) != 0)
    if (state_.compare_exchange_weak(state, state + 1, std::memory_order_acquire)) return true;
  return false;
}

void ThreadPool::leave() {
  const std::uint32_t before = state_.fetch_sub(1, std::memory_order_acq_rel);
  if ((before & (kOpen | kInside)) != 1) return;  // open, or not the last
  left_.store(1, std::memory_order_release);
  left_.notify_one();
}

void ThreadPool::run_worker(std::size_t number) {
  std::uint32_t state = 0;
  std::uint32_t seen_job = 0;
  while (true) {
    while ((state & kJob) == seen_job) state = wait_for_change(state_, state);
    const bool entered = enter(state);
    seen_job = state & kJob;
    if (!entered) continue;
    if (job_ == nullptr) return;
    const std::int64_t begin_ns = thread_cpu_ns();
    (*job_)(number);
    worked_ns_.fetch_add(thread_cpu_ns() - begin_ns, std::memory_order_relaxed);
    leave();
  }
}

}  // namespace yars::parallel
