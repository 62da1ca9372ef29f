// Offset between the clocks of two hosts, measured by questions and answers, and followed without a jump.
// Inputs: the four times of each answered question.
// Outputs: offset = CLOCK_MONOTONIC of the other host minus that of this host, and its maximum error.
// Units: [ns].
// Errors: at most half of the round trip, and 0.4 ms by clocks whose rates differ by 100 ppm in kWindow answers, 4 a
//   second.
// Source: D. Mills, RFC 5905, section 8 (on-wire protocol), section 10 (clock filter: the least round trip counts).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace yars::gateway {

// later - earlier, in numbers without a sign: times from another host may have any value.
constexpr std::int64_t difference_ns(std::int64_t later, std::int64_t earlier) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(later) - static_cast<std::uint64_t>(earlier));
}

struct ProbeTimes {
  std::int64_t asked_ns = 0;     // this host
  std::int64_t received_ns = 0;  // the other host
  std::int64_t answered_ns = 0;  // the other host
  std::int64_t returned_ns = 0;  // this host
};

class OffsetEstimator {
 public:
  struct Estimate {
    std::int64_t offset_ns = 0;
    std::int64_t round_trip_ns = 0;
  };

  // False: the times contradict each other and are left out.
  bool add(const ProbeTimes& times) {
    const std::int64_t away_ns = difference_ns(times.returned_ns, times.asked_ns);
    const std::int64_t there_ns = difference_ns(times.answered_ns, times.received_ns);
    if (away_ns < 0 || there_ns < 0 || there_ns > away_ns || away_ns > kMaxRoundTrip_ns) return false;
    if (times.received_ns < 0 || times.received_ns > kMaxTime_ns || times.asked_ns < 0) return false;
    const std::int64_t outward_ns = times.received_ns - times.asked_ns;
    const std::int64_t homeward_ns = times.answered_ns - times.returned_ns;
    answers_[count_++ % kWindow] = {outward_ns / 2 + homeward_ns / 2, away_ns - there_ns};
    return true;
  }

  // The answer with the least round trip among the last kWindow; nullopt: none yet.
  std::optional<Estimate> best() const {
    if (count_ == 0) return std::nullopt;
    return *std::min_element(
        answers_.begin(), answers_.begin() + static_cast<std::ptrdiff_t>(std::min(count_, kWindow)),
        [](const Estimate& first, const Estimate& second) { return first.round_trip_ns < second.round_trip_ns; });
  }
  // Half of the last round trip.
  std::int64_t latency_ns() const { return count_ == 0 ? 0 : answers_[(count_ - 1) % kWindow].round_trip_ns / 2; }
  std::size_t count() const { return count_; }

 private:
  static constexpr std::size_t kWindow = 16;  // 4 s. A longer window would follow a drifting clock too late
  static constexpr std::int64_t kMaxRoundTrip_ns = 2'000'000'000;
  // 18 years, as databuffer::kLatestClockBase_ns. Ten times an offset, at the greatest rate, is no overflow.
  static constexpr std::int64_t kMaxTime_ns = std::int64_t{1} << 59;
  std::array<Estimate, kWindow> answers_{};
  std::size_t count_ = 0;
};

// An offset in use that moves towards the measured one, by at most 1 ms per second; if it is far off, by 10 ms.
class SlewedOffset {
 public:
  void set(std::int64_t offset_ns) {
    offset_ns_ = offset_ns;
    slewing_ = false;
  }
  // Moves towards `measured_ns`; `elapsed_ns` since the last call. True if the offset has changed.
  bool approach(std::int64_t measured_ns, std::int64_t elapsed_ns) {
    const std::int64_t error_ns = measured_ns - offset_ns_;
    const std::int64_t distance_ns = error_ns < 0 ? -error_ns : error_ns;
    if (distance_ns >= kBegin_ns) slewing_ = true;
    if (!slewing_) return false;
    const std::int64_t step_ns = std::min(distance_ns, elapsed_ns / (distance_ns > kFar_ns ? kFarSlew : kMaxSlew));
    offset_ns_ += error_ns < 0 ? -step_ns : step_ns;
    if (distance_ns - step_ns <= kEnd_ns) slewing_ = false;
    return step_ns != 0;
  }
  std::int64_t offset_ns() const { return offset_ns_; }

 private:
  static constexpr std::int64_t kMaxSlew = 1000;  // 1 ms per second. The drift of two computers is below 0.2 ms/s
  static constexpr std::int64_t kFarSlew = 100;   // 10 ms per second, after a bad first measurement
  static constexpr std::int64_t kFar_ns = 2'000'000;
  static constexpr std::int64_t kBegin_ns = 50'000;  // smaller errors are noise of the measurement
  static constexpr std::int64_t kEnd_ns = 5'000;
  std::int64_t offset_ns_ = 0;
  bool slewing_ = false;
};

}  // namespace yars::gateway
