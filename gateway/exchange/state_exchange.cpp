#include "gateway/exchange/state_exchange.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace yars::gateway {

namespace {

// [ns] After this silence of all other hosts the local lane of their ownship is released.
constexpr std::int64_t kOwnshipSilence_ns = 5'000'000'000;
constexpr std::int64_t kLockstepRefresh_ns = 250'000'000;

}  // namespace

// Each held lane has a writer of its own. The writer of a lane without new records ends after the lease, so that the
// other hosts see the next lane. In lockstep a record is repeated, because a host that joins would wait for it.
void StateExchange::send_ownship(Context& context) {
  const auto& layout = std::as_const(context.session).layout();
  for (std::size_t lane = 0; lane < databuffer::kOwnshipLanes; ++lane) {
    const auto number = static_cast<std::uint32_t>(lane);
    SentLane& sent = sent_lanes_[lane];
    if (lanes_->ownship_lane == lane || !std::as_const(context.session).ownship_lane_is_held(lane)) {
      if (std::exchange(sent.is_held, false)) context.link->end_ownship(number);
      continue;
    }
    sent.is_held = true;
    const std::uint64_t version = layout.ownship[lane].version();
    const bool repeats = context.lockstep && context.now_ns - sent.sent_ns > kLockstepRefresh_ns;
    if (version == sent.version && !repeats) {
      if (!context.lockstep && context.now_ns - sent.sent_ns > kLease_ns) context.link->end_ownship(number);
      continue;
    }
    const auto ownship = databuffer::read_valid(layout.ownship[lane]);
    if (!ownship) continue;
    sent.version = version;
    sent.sent_ns = context.now_ns;
    yars_net_OwnshipSample sample{};
    context.hosts.stamp(sample);
    sample.priority = layout.ownship_priority[lane].load(std::memory_order_acquire);
    sample.lane = number;
    copy_record(sample.ownship, *ownship);
    if (const auto nav = databuffer::read_valid(layout.nav[lane]))
      copy_record(sample.nav, *nav);
    else
      sample.nav.mission_latitude_deg = std::numeric_limits<double>::quiet_NaN();  // none
    context.link->write_ownship(number, sample);
  }
}

void StateExchange::receive(Context& context, const yars_net_OwnshipSample& sample) {
  if (!context.hosts.is_new(sample) || context.hosts.find(sample.host) == nullptr) return;
  const bool has_nav = !std::isnan(sample.nav.mission_latitude_deg);
  const auto ownship = context.valid<databuffer::Ownship>(sample, sample.ownship);
  if (!ownship) return;
  const auto nav = has_nav ? context.valid<databuffer::Nav>(sample, sample.nav) : std::nullopt;
  if (has_nav && !nav) return;
  if (!lane_) {
    auto claim = context.session.claim_ownship_lane(sample.priority);
    if (!claim) return context.hosts.refuse(sample, claim.error().message());
    lane_.emplace(std::move(*claim));
    last_ownship_ = {};
  }
  const auto lane = static_cast<std::size_t>(lane_->lane());
  auto& layout = context.session.layout();
  const RemoteName name{sample.host, sample.lane};
  if (lanes_->ownship_lane != lane || lanes_->ownship != name)
    layout.ownship_priority[lane].store(sample.priority, std::memory_order_release);
  lanes_->ownship_lane = lane;
  lanes_->ownship = name;
  ownship_heard_ns_ = context.now_ns;
  if (context.lockstep && equal(*ownship, last_ownship_)) return;  // a repetition
  last_ownship_ = *ownship;
  if (nav)
    layout.nav[lane].publish(*nav);
  else
    layout.nav[lane].clear();
  layout.ownship[lane].publish(*ownship);
}

void StateExchange::keep_lane(Context& context) {
  if (!lane_ || context.lockstep || context.now_ns - ownship_heard_ns_ < kOwnshipSilence_ns) return;
  lane_.reset();
  lanes_->ownship_lane.reset();
}

}  // namespace yars::gateway
