// What each host of a session finds out for itself about the others: their numbers, which host has a role and which
// sets the clock, and the offset between the clocks of two hosts, followed without a jump.
// Inputs: names of hosts; what each host that is heard says about itself; the four times of each answered question.
// Outputs: FNV-1a (64 bits) of a name; the host with the role, none if no host holds it; offset = CLOCK_MONOTONIC of
// the other host minus that of this host, and its maximum error.
// Units: times [ns], CLOCK_MONOTONIC of this host. Errors of the offset: at most half of the round trip, and 0.4 ms by
// clocks whose rates differ by 100 ppm in kWindow answers, 4 a second.
// Source: docs/network.md#which-host-has-a-role. G. Fowler, L. Noll, K. Vo, "FNV hash", parameters for 64 bits. D.
// Mills, RFC 5905, section 8 (on-wire protocol), section 10 (clock filter: the least round trip counts).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace yars::gateway {

constexpr std::uint64_t host_id(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
  return hash;
}

// Epochs count on from 0 after the greatest number.
constexpr bool is_later(std::uint32_t epoch, std::uint32_t other) {
  return static_cast<std::int32_t>(epoch - other) > 0;
}
constexpr std::uint32_t later_of(std::uint32_t epoch, std::uint32_t other) {
  return is_later(other, epoch) ? other : epoch;
}

// A host that is heard, or this host.
struct HostView {
  std::uint64_t id = 0;
  std::string name;
  std::uint32_t priority = 0;
  std::uint32_t group = 1;       // number of hosts that it heard 1 s ago, itself included
  std::uint32_t held_roles = 0;  // bit n: a process of the host holds role n
  bool owns_clock = false;
};

// True if `first` keeps a role that both hold: by priority, then as the larger part before they met, then by name.
inline bool precedes(const HostView& first, const HostView& second) {
  if (first.priority != second.priority) return first.priority > second.priority;
  if (first.group != second.group) return first.group > second.group;
  return first.name != second.name ? first.name < second.name : first.id < second.id;
}

// The preceding host of those for which `holds(host)` is true; nullptr: none.
template <class Holds>
const HostView* preceding(std::span<const HostView> hosts, const Holds& holds) {
  const HostView* best = nullptr;
  for (const HostView& host : hosts)
    if (holds(host) && (best == nullptr || precedes(host, *best))) best = &host;
  return best;
}

// Number of hosts that precede `self` in the order of priority and name.
inline std::size_t rank_of(std::span<const HostView> hosts, const HostView& self) {
  return static_cast<std::size_t>(std::ranges::count_if(hosts, [&self](HostView host) {
    host.group = self.group;
    return host.id != self.id && precedes(host, self);
  }));
}

// Wait, for each rank, before a host takes what no host has. Two hosts rarely take a role in the same moment.
inline constexpr std::int64_t kTurn_ns = 150'000'000;

class Vacancy {
 public:
  // `vacant`: no host has the role now. True if this host may take it.
  bool may_take(bool vacant, std::size_t rank, std::int64_t now_ns) {
    if (!vacant) {
      since_ns_.reset();
      return false;
    }
    if (!since_ns_) since_ns_ = now_ns;
    return now_ns - *since_ns_ >= static_cast<std::int64_t>(rank) * kTurn_ns;
  }

 private:
  std::optional<std::int64_t> since_ns_;
};

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
