// Rule by which the hosts of a session agree, each for itself, which host has a role and which sets the clock.
// Inputs: what each host that is heard says about itself.
// Outputs: the host with the role; none if no host holds it.
// Units: times [ns], CLOCK_MONOTONIC of this host.
// Source: docs/network.md#which-host-has-a-role.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace yars::gateway {

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

}  // namespace yars::gateway
