// Numbers of latched worlds: in the ring of radar-model's host, and in the ring of this host.
// Inputs: each world that this gateway has written here.
// Outputs: the number that ModelTick::world has here.
// Threads: one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "databuffer/session/session_layout.hpp"

namespace yars::gateway {

class WorldNumbers {
 public:
  // True if the last record of the ring here is one that came from that segment. `next`: number of records in the ring.
  bool continues(std::uint64_t host, std::uint64_t segment, std::uint64_t next) const {
    return host == host_ && segment == segment_ && !pairs_.empty() && pairs_.back().ours + 1 == next;
  }
  // True if, in addition, that segment's record `number` has been written here.
  bool has(std::uint64_t host, std::uint64_t segment, std::uint64_t number, std::uint64_t next) const {
    return continues(host, segment, next) && number <= pairs_.back().theirs;
  }
  // `ours`: number of the record in the ring here.
  void add(std::uint64_t host, std::uint64_t segment, std::uint64_t number, std::uint64_t ours) {
    if (host != host_ || segment != segment_) pairs_.clear();
    host_ = host;
    segment_ = segment;
    pairs_.push_back({number, ours});
    if (pairs_.size() > databuffer::kLatchedWorlds) pairs_.pop_front();
  }
  // Number of records in the ring here up to the one that the other host's count names; nullopt: it has not arrived.
  std::optional<std::uint64_t> local(std::uint64_t host, std::uint64_t count) const {
    if (count == 0) return 0;
    if (host != host_) return std::nullopt;
    for (auto pair = pairs_.rbegin(); pair != pairs_.rend(); ++pair)
      if (pair->theirs + 1 == count) return pair->ours + 1;
    return std::nullopt;
  }

 private:
  struct Pair {
    std::uint64_t theirs, ours;
  };
  std::uint64_t host_ = 0, segment_ = 0;
  std::deque<Pair> pairs_;
};

}  // namespace yars::gateway
