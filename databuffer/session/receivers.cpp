#include "databuffer/session/receivers.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>

#include "databuffer/messages/validation.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

namespace {

using Memory = OwnshipSelection::Memory;

bool is_fresh(const Memory& memory, std::int64_t now_ns) {
  return memory.received_ns && now_ns - *memory.received_ns <= kStaleAfter_ns;
}

// True if the lane is fresh and has delivered without a gap for kTakeoverAfter_ns. The time is measured from the first
// arrival after the last gap to the newest arrival, so that a single old record does not count.
bool is_established(const Memory& memory, std::int64_t now_ns) {
  return is_fresh(memory, now_ns) && *memory.received_ns - memory.delivering_since_ns >= kTakeoverAfter_ns;
}

// Returns the memory of a lane, updated with the lane's content at this tick.
Memory remember(const OwnshipLane& lane, std::int64_t now_ns, Memory memory) {
  if (!lane.present) {
    // The first version after an empty lane counts as an arrival.
    memory = Memory{};
    memory.known = true;
    return memory;
  }
  // If the clock has gone back, arrival times after `now_ns` are set to `now_ns`. Otherwise the lane would stay fresh
  // too long.
  if (memory.received_ns) memory.received_ns = std::min(*memory.received_ns, now_ns);
  memory.delivering_since_ns = std::min(memory.delivering_since_ns, now_ns);
  if (memory.known && lane.version != memory.version) {
    if (!is_fresh(memory, now_ns)) memory.delivering_since_ns = now_ns;
    memory.received_ns = now_ns;
  }
  memory.known = true;
  memory.version = lane.version;
  return memory;
}

// Qualified lane with the highest priority. At equal priority `chosen` wins, then the lower index.
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
  assert(lanes.size() <= kOwnshipLanes);
  OwnshipSelection next = previous;
  for (std::size_t lane = 0; lane < lanes.size(); ++lane)
    next.memory[lane] = remember(lanes[lane], now_ns, previous.memory[lane]);
  const auto fresh = [&](std::size_t lane) { return is_fresh(next.memory[lane], now_ns); };
  const auto established = [&](std::size_t lane) { return is_established(next.memory[lane], now_ns); };
  const auto chosen_or_established = [&](std::size_t lane) {
    return (lane == previous.lane && fresh(lane)) || established(lane);
  };
  next.lane = best(lanes, previous.lane, chosen_or_established);
  // If the selected lane is stale and no lane is established, the fresh lane of the highest priority is used.
  if (!next.lane) next.lane = best(lanes, std::nullopt, fresh);
  return next;
}

namespace {

double speed_mps(const Ownship& ownship) {
  return std::hypot(ownship.velocity_north_mps, ownship.velocity_east_mps, ownship.velocity_down_mps);
}

}  // namespace

bool JumpGuard::is_jump(const Ownship& next, std::int64_t received_ns) const {
  constexpr double kSpeedMargin = 2.0;  // covers sources that run faster than sim time, and late records
  const double time_s = 1e-9 * static_cast<double>(std::max<std::int64_t>(received_ns - last_received_ns_, 0));
  const double max_distance_m =
      kPositionTolerance_m + kSpeedMargin * std::max(speed_mps(*last_), speed_mps(next)) * time_s;
  if (std::abs(next.altitude_msl_m - last_->altitude_msl_m) > max_distance_m) return true;
  // An upper bound of the distance, cheaper than the geodesic, decides nearly every tick. No degree of latitude or
  // longitude is longer than kMaxMetresPerDegree.
  const double east_deg = std::remainder(next.longitude_deg - last_->longitude_deg, 360.0);
  const double north_deg = next.latitude_deg - last_->latitude_deg;
  if (geo::kMaxMetresPerDegree * std::hypot(north_deg, east_deg) <= max_distance_m) return false;
  return geo::geodesic_inverse({last_->latitude_deg, last_->longitude_deg}, {next.latitude_deg, next.longitude_deg})
             .distance.metres() > max_distance_m;
}

void JumpGuard::take(const Ownship& next, std::int64_t received_ns) {
  last_ = next;
  last_received_ns_ = received_ns;
  held_since_ns_.reset();
  proven_ = false;
}

bool JumpGuard::accepts(const Ownship& next, std::int64_t received_ns, std::int64_t now_ns, std::uint32_t epoch) {
  const bool jump = last_ && is_jump(next, received_ns);
  const bool first_of_epoch = last_ && next.epoch == epoch && last_->epoch != epoch;
  const bool epoch_changed = first_of_epoch || (held_since_ns_ && held_epoch_ != epoch);
  if (!jump || epoch_changed) {
    if (held_since_ns_ && !epoch_changed) ++abandoned_;
    take(next, received_ns);
    return true;
  }
  // If the clock goes back, the holding time starts again.
  if (!held_since_ns_ || now_ns < *held_since_ns_) held_since_ns_ = now_ns;
  held_epoch_ = epoch;
  proven_ = now_ns - *held_since_ns_ >= kJumpProof_ns;
  if (now_ns - *held_since_ns_ < kMaxHold_ns) return false;
  take(next, received_ns);
  return true;
}

namespace {

// Nav record for a source that publishes none: both navigators have the true position.
Nav nav_from_truth(const Ownship& ownship) {
  Nav nav{};
  nav.source_time_ns = ownship.source_time_ns;
  nav.mission_latitude_deg = nav.ins_latitude_deg = ownship.latitude_deg;
  nav.mission_longitude_deg = nav.ins_longitude_deg = ownship.longitude_deg;
  nav.velocity_north_mps = ownship.velocity_north_mps;
  nav.velocity_east_mps = ownship.velocity_east_mps;
  nav.velocity_down_mps = ownship.velocity_down_mps;
  nav.magnetic_variation_deg = std::nan("");
  nav.epoch = ownship.epoch;
  return nav;
}

}  // namespace

std::string name_of_source(const Ownship& ownship, std::uint32_t lane) {
  const std::string_view name = text::text_of(ownship.source);
  return name.empty() ? "unnamed (lane " + std::to_string(lane) + ")" : std::string(name);
}

void OwnshipReceiver::receive(const SessionLayout& layout, std::size_t index) {
  Lane& lane = lanes_[index];
  const auto count = [this, index](const char* record, const Refusal& reason) {
    if (!reason) return;
    ++refused_;
    refusals_.push_back(std::string(record) + " in lane " + std::to_string(index) + ": " + *reason);
  };
  // When a writer leaves, its lane is cleared. The last record of that writer must not count for the next writer.
  if (!layout.ownship[index].has_value()) lane.accepted = 0;
  if (!layout.nav[index].has_value()) lane.nav = {};
  if (lane.ownship.refresh(layout.ownship[index])) ++lane.accepted;
  count("ownship", lane.ownship.refusal());
  lane.nav.refresh(layout.nav[index]);
  count("nav", lane.nav.refusal());
}

const OwnshipReceiver::Selected& OwnshipReceiver::refresh(const SessionLayout& layout, std::int64_t sim_time_ns,
                                                          std::uint32_t epoch) {
  refusals_.clear();
  std::array<OwnshipLane, kOwnshipLanes> candidates{};
  for (std::size_t i = 0; i < kOwnshipLanes; ++i) {
    receive(layout, i);
    candidates[i].present = lanes_[i].accepted > 0 && layout.ownship[i].has_value();
    candidates[i].priority = layout.ownship_priority[i].load(std::memory_order_relaxed);
    candidates[i].version = lanes_[i].accepted;
  }
  selection_ = select_ownship(candidates, sim_time_ns, selection_);
  selected_.valid = selection_.lane.has_value();
  selected_.jump.reset();
  if (!selected_.valid) {
    selected_.lane = kNoLane;
    return selected_;
  }
  const Lane& lane = lanes_[*selection_.lane];
  const std::int64_t received_ns = selection_.memory[*selection_.lane].received_ns.value_or(sim_time_ns);
  const bool lockstep = layout.lockstep.enabled.load(std::memory_order_relaxed) != 0;
  if (!lockstep && !guard_.accepts(lane.ownship.value(), received_ns, sim_time_ns, epoch)) {
    if (guard_.is_proven()) {
      selected_.jump = lane.ownship.value();
      selected_.jump_lane = static_cast<std::uint32_t>(*selection_.lane);
    }
    return selected_;
  }
  selected_.lane = static_cast<std::uint32_t>(*selection_.lane);
  selected_.ownship = lane.ownship.value();
  selected_.received_ns = received_ns;
  selected_.nav = lane.nav.has_value() ? lane.nav.value() : nav_from_truth(lane.ownship.value());
  return selected_;
}

bool TrafficReceiver::refresh(const SessionLayout& layout, std::int64_t tick, std::int64_t sim_time_ns,
                              std::uint32_t epoch) {
  refusal_.reset();
  const bool is_new = take(layout, epoch);
  if (is_new) {
    latched_.tick = tick;
    received_ns_ = sim_time_ns;
    return true;
  }
  const bool gone =
      latched_.epoch != epoch || !layout.traffic.has_value() || sim_time_ns - received_ns_ > kTrafficStaleAfter;
  if (latched_.count == 0 || !gone) return false;
  latched_ = {};
  latched_.tick = tick;
  latched_.epoch = epoch;
  return true;
}

bool TrafficReceiver::take(const SessionLayout& layout, std::uint32_t epoch) {
  const bool is_valid = newest_.refresh(layout.traffic);
  refusal_ = newest_.refusal();
  if (is_valid && newest_.value().epoch != epoch)
    refusal_ = "epoch: expected " + std::to_string(epoch) + ", found " + std::to_string(newest_.value().epoch);
  if (refusal_) {
    refusal_ = "traffic: " + *refusal_;
    ++refused_;
    return false;
  }
  if (is_valid) latched_ = newest_.value();
  return is_valid;
}

}  // namespace yars::databuffer
