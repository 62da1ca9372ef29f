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
  std::atomic<std::uint32_t> turn_{0};
  std::atomic<std::uint32_t> busy_{0};
  std::vector<std::thread> helpers_;
};

}  // namespace yars::model::kernel
