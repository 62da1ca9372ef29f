// Limit for messages of a library that others can make it write: some lines a second, and a count of the rest.
// Inputs: messages, with CLOCK_MONOTONIC times [ns].
// Outputs: the messages that pass; after a flood one line with the number of those left out.
// Memory: at most kBurst messages of kMaxLength bytes wait.
// Threads: not thread-safe.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace yars::gateway {

class MessageLimit {
 public:
  static constexpr std::size_t kBurst = 10;                  // messages that may come at once
  static constexpr std::int64_t kInterval_ns = 500'000'000;  // later each such time one more may come
  static constexpr std::int64_t kCount_ns = 10'000'000'000;  // least time between two lines with a count
  static constexpr std::size_t kMaxLength = 400;             // [bytes] a longer message is cut

  void add(std::string_view text, std::int64_t now_ns) {
    if (full_at_ns_ == 0) full_at_ns_ = now_ns;
    // The allowance is kept as the time at which it is whole again.
    const std::int64_t next_ns = std::max(full_at_ns_, now_ns) + kInterval_ns;
    if (next_ns - now_ns > static_cast<std::int64_t>(kBurst) * kInterval_ns || waiting_.size() >= kBurst) {
      ++left_out_;
      return;
    }
    full_at_ns_ = next_ns;
    waiting_.emplace_back(text.substr(0, kMaxLength));
    if (text.size() > kMaxLength) waiting_.back() += " ...";
  }

  // The messages since the last call, and at times the count of those left out. `source`: whose messages they are.
  std::vector<std::string> take(std::string_view source, std::int64_t now_ns) {
    std::vector<std::string> taken = std::exchange(waiting_, {});
    if (left_out_ == 0 || now_ns < next_count_ns_) return taken;
    next_count_ns_ = now_ns + kCount_ns;
    taken.push_back(std::to_string(std::exchange(left_out_, 0)) + " more messages of " + std::string(source) +
                    " left out");
    return taken;
  }

 private:
  std::vector<std::string> waiting_;
  std::uint64_t left_out_ = 0;  // since the last count
  std::int64_t full_at_ns_ = 0;
  std::int64_t next_count_ns_ = 0;
};

}  // namespace yars::gateway
