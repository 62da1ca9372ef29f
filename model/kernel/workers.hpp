// Threads that wait for work between scans: making them anew for each would cost as much as a short scan. Every piece
// of work is done by all at once, each with its own number; the caller is number 0.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace yars::model::kernel {

// Until the value is another one than the one seen; looks for a while before it sleeps. Whoever changes it notifies.
std::uint32_t wait_for_change(const std::atomic<std::uint32_t>& value, std::uint32_t seen);

class Workers {
 public:
  // `threads` with the caller, at least 1.
  explicit Workers(std::size_t threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

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

}  // namespace yars::model::kernel
