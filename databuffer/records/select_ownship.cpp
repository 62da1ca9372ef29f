#include "databuffer/records/select_ownship.hpp"

#include <algorithm>
#include <cassert>

namespace yars::databuffer {

namespace {

using Memory = OwnshipSelection::Memory;

bool is_fresh(const Memory& memory, std::int64_t now_ns) {
  return memory.received_ns && now_ns - *memory.received_ns <= kStaleAfter;
}

// Delivered over a while, not one record that lies there: measured between arrivals.
bool is_established(const Memory& memory, std::int64_t now_ns) {
  return is_fresh(memory, now_ns) && *memory.received_ns - memory.delivering_since_ns >= kTakeoverAfter;
}

Memory remember(const OwnshipLane& lane, std::int64_t now_ns, Memory memory) {
  if (!lane.present) {
    // Whatever comes after an empty lane is news, whichever number it has.
    memory = Memory{};
    memory.seen = true;
    return memory;
  }
  // A clock that went back: what was received "later" counts as received now, or it would stay fresh for long.
  if (memory.received_ns) memory.received_ns = std::min(*memory.received_ns, now_ns);
  memory.delivering_since_ns = std::min(memory.delivering_since_ns, now_ns);
  if (memory.seen && lane.version != memory.version) {
    if (!is_fresh(memory, now_ns)) memory.delivering_since_ns = now_ns;
    memory.received_ns = now_ns;
  }
  memory.seen = true;
  memory.version = lane.version;
  return memory;
}

// The highest priority among lanes for which `qualifies`; the chosen one wins ties, then the lower index.
template <class Qualifies>
std::optional<std::size_t> best(std::span<const OwnshipLane> lanes, std::optional<std::size_t> chosen,
                                Qualifies qualifies) {
  std::optional<std::size_t> winner;
  if (chosen && qualifies(*chosen)) winner = chosen;
  for (std::size_t lane = 0; lane < lanes.size(); ++lane)
    if (qualifies(lane) && (!winner || lanes[lane].priority > lanes[*winner].priority)) winner = lane;
  return winner;
}

}  // namespace

OwnshipSelection select_ownship(std::span<const OwnshipLane> lanes, std::int64_t now_ns,
                                const OwnshipSelection& previous) {
  assert(lanes.size() <= kMaxOwnshipLanes);
  OwnshipSelection next = previous;
  for (std::size_t lane = 0; lane < lanes.size(); ++lane)
    next.memory[lane] = remember(lanes[lane], now_ns, previous.memory[lane]);
  const auto fresh = [&](std::size_t lane) { return is_fresh(next.memory[lane], now_ns); };
  const auto established = [&](std::size_t lane) { return is_established(next.memory[lane], now_ns); };
  const auto chosen_or_established = [&](std::size_t lane) {
    return (lane == previous.lane && fresh(lane)) || established(lane);
  };
  next.lane = best(lanes, previous.lane, chosen_or_established);
  // Nothing proven is left: better a young source than none.
  if (!next.lane) next.lane = best(lanes, std::nullopt, fresh);
  return next;
}

}  // namespace yars::databuffer
