#include "inputmonitor/event_source.hpp"

#include <algorithm>

namespace yars::inputmonitor {

namespace {

constexpr std::int64_t kNanosecondsPerMillisecond = 1'000'000;

}  // namespace

void EventSource::wait(const Moment& moment, int longest_ms) {
  if (const auto due_ns = deadline_ns()) {
    // Rounded up: a deadline met a little early would be asked for again at once.
    const std::int64_t left_ms =
        (*due_ns - moment.monotonic_ns + kNanosecondsPerMillisecond - 1) / kNanosecondsPerMillisecond;
    longest_ms = static_cast<int>(std::clamp<std::int64_t>(left_ms, 0, longest_ms));
  }
  std::vector<pollfd> wanted;
  add_descriptors(wanted);
  poll(wanted.data(), wanted.size(), longest_ms);
}

}  // namespace yars::inputmonitor
