// A value that is computed at its first use and then stays for the life of the process.
// Threads that need it at once compute it each, and one result stays. There is no lock: a lock could be held when the
// process forks, and the child would wait for it. Objects have static storage duration.
#pragma once

#include <atomic>
#include <memory>

namespace yars::memory {

template <class T>
class ComputedOnce {
 public:
  // `compute()` returns a std::unique_ptr<const T>.
  template <class Compute>
  const T& get(const Compute& compute) {
    const T* known = value_.load(std::memory_order_acquire);
    if (known == nullptr) {
      std::unique_ptr<const T> made = compute();
      if (value_.compare_exchange_strong(known, made.get(), std::memory_order_acq_rel)) known = made.release();
    }
    return *known;
  }

 private:
  std::atomic<const T*> value_{nullptr};
};

}  // namespace yars::memory
