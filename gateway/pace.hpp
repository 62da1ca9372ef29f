// Paces of everything that a gateway sends or says again and again.
// Units: [ns], CLOCK_MONOTONIC.
#pragma once

#include <algorithm>
#include <cstdint>

namespace yars::gateway {

// What is sent after a change, and else at a fixed interval.
class Pace {
 public:
  explicit Pace(std::int64_t interval_ns) : interval_ns_(interval_ns) {}
  // True: it is to be sent now. A change waits until `least_ns` have passed since the last time.
  bool is_due(bool changed, std::int64_t now_ns, std::int64_t least_ns = 0) {
    pending_ = pending_ || changed;
    if (now_ns - sent_ns_ < (pending_ ? least_ns : interval_ns_)) return false;
    pending_ = false;
    sent_ns_ = now_ns;
    return true;
  }

 private:
  std::int64_t interval_ns_, sent_ns_ = 0;
  bool pending_ = false;
};

// Limit of what others can cause: `at_once` times, and then once in an interval.
class Allowance {
 public:
  Allowance(std::int64_t interval_ns, std::int64_t at_once) : interval_ns_(interval_ns), at_once_(at_once) {}
  bool take(std::int64_t now_ns) {
    const std::int64_t next_ns = std::max(whole_at_ns_, now_ns) + interval_ns_;
    if (next_ns - now_ns > at_once_ * interval_ns_) return false;
    whole_at_ns_ = next_ns;
    return true;
  }

 private:
  std::int64_t interval_ns_, at_once_;
  std::int64_t whole_at_ns_ = 0;  // when the allowance is whole again
};

}  // namespace yars::gateway
