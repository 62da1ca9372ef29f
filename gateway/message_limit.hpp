// Limits of what others can cause; of the messages of a library that they can make it write: some lines a second, the
// same line once a minute, and a count of the rest.
// Inputs: messages, with CLOCK_MONOTONIC times [ns].
// Outputs: the messages that pass; after a flood one line with the number of those left out.
// Memory: at most kBurst messages of kMaxLength bytes wait, and kRemembered are remembered.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace yars::gateway {

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

class MessageLimit {
 public:
  static constexpr std::size_t kBurst = 10;                  // messages that may come at once
  static constexpr std::int64_t kInterval_ns = 500'000'000;  // later each such time one more may come
  static constexpr std::int64_t kCount_ns = 10'000'000'000;  // least time between two lines with a count
  static constexpr std::size_t kMaxLength = 400;             // [bytes] a longer message is cut
  static constexpr std::int64_t kSame_ns = 60'000'000'000;   // least time between two messages that are the same
  static constexpr std::size_t kRemembered = 128;            // messages; 120 pass in kSame_ns

  void add(std::string_view text, std::int64_t now_ns) {
    std::string message(text.substr(0, kMaxLength));
    if (text.size() > kMaxLength) message += " ...";
    if (is_known(message, now_ns) || waiting_.size() >= kBurst || !allowance_.take(now_ns))
      ++left_out_;
    else
      waiting_.push_back(std::move(message));
  }

  // The messages since the last call, and at times the count of those left out. `source`: whose messages they are.
  std::vector<std::string> take(std::string_view source, std::int64_t now_ns) {
    std::vector<std::string> taken = std::exchange(waiting_, {});
    for (const std::string& message : taken) remembered_.emplace_back(message, now_ns);
    while (remembered_.size() > kRemembered) remembered_.pop_front();
    if (left_out_ == 0 || now_ns < next_count_ns_) return taken;
    next_count_ns_ = now_ns + kCount_ns;
    taken.push_back(std::to_string(std::exchange(left_out_, 0)) + " more messages of " + std::string(source) +
                    " left out");
    return taken;
  }

 private:
  // True if the message waits, or was taken within kSame_ns.
  bool is_known(const std::string& message, std::int64_t now_ns) const {
    return std::ranges::find(waiting_, message) != waiting_.end() ||
           std::ranges::any_of(remembered_, [&](const auto& taken) {
             return taken.first == message && now_ns - taken.second < kSame_ns;
           });
  }

  std::deque<std::pair<std::string, std::int64_t>> remembered_;  // with the times at which they were taken
  std::vector<std::string> waiting_;
  std::uint64_t left_out_ = 0;  // since the last count
  Allowance allowance_{kInterval_ns, kBurst};
  std::int64_t next_count_ns_ = 0;
};

}  // namespace yars::gateway
