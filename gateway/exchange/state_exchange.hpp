// States on several hosts: ownship, radar state, outputs, advice, model status, traffic, caption, recorder status.
// Inputs: the latest values of the local segment whose writer is a local process; samples of other hosts.
// Outputs: a sample for each new value, and at least one each 0.25 s; the values of other hosts in the local segment,
//   written by the holder of the role, which is this gateway.
// Errors: a value that fails validate() is refused, counted and noted; the last valid one stays.
#pragma once

#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>

#include "gateway/exchange/context.hpp"

namespace yars::gateway {

// Lanes in a sample have the numbers that they have on their own hosts. `leaves`: the sample is to be sent; else it has
// been received and gets the numbers of the lanes here.
template <class Sample>
void translate_lanes(Sample& sample, const LaneNames& lanes, std::uint64_t self, bool leaves) {
  if constexpr (std::is_same_v<Sample, yars_net_AdviceSample>) {
    std::uint32_t& lane = sample.advice.idle_lane;
    if (leaves)
      lanes.input_name(lane, self).write_to(sample.sender, lane);
    else if (sample.sender != self)
      lane = kNoLane;
  } else if constexpr (std::is_same_v<Sample, yars_net_ModelStatusSample>) {
    std::uint32_t& lane = sample.status.ownship_lane;
    if (leaves)
      lanes.ownship_name(lane, self).write_to(sample.ownship_host, lane);
    else
      lane = lanes.local_ownship_lane({sample.ownship_host, lane}, self, kNoLane);
  }
}

// The state of one topic. The holder of a role writes it.
template <class Sample, class Field, class Record>
class State {
 public:
  // `field`: of the record in a sample. `least_ns`: least time between two samples.
  State(Role role, Field Sample::* field, shm::LatestValue<Record> databuffer::SessionLayout::* slot,
        std::int64_t least_ns = 0)
      : role_(role), field_(field), slot_(slot), least_ns_(least_ns) {}

  void send(Context& context, const LaneNames& lanes) {
    const auto& slot = context.layout().*slot_;
    if (!context.roles.exports(role_) || !slot.has_value()) return;
    const bool is_new = reader_.refresh(slot);
    if (!reader_.has_value() || !pace_.is_due(is_new, context.now_ns, context.lockstep ? 0 : least_ns_)) return;
    auto sample = context.made<Sample>();
    copy_record(sample.*field_, reader_.value());
    translate_lanes(sample, lanes, context.hosts.self().id, true);
    context.write(sample);
  }
  // Publishes the record of the host that has the role. Samples of other hosts, or of other topics, are left out.
  template <class Other>
  void receive(Context& context, const LaneNames& lanes, const Other& other) {
    if constexpr (std::is_same_v<Other, Sample>) {
      if (!context.hosts.is_new(other) || context.roles.source(role_) != other.host) return;
      Sample sample = other;
      translate_lanes(sample, lanes, context.hosts.self().id, false);
      if (const auto record = context.valid<Record>(sample, sample.*field_))
        publish_changed(context.session.layout().*slot_, *record);  // a repeated state is no new version
    }
  }

 private:
  Role role_;
  Field Sample::* field_;
  shm::LatestValue<Record> databuffer::SessionLayout::* slot_;
  std::int64_t least_ns_;
  Pace pace_{250'000'000};  // a host that joins, or takes a role, waits so long
  databuffer::Validated<Record> reader_;
};

inline auto all_states() {
  using databuffer::SessionLayout;
  constexpr std::int64_t kTick_ns = 20'000'000;  // of states that change in every tick: 50 Hz
  return std::tuple{
      State(Role::state_machine, &yars_net_RadarStateSample::state, &SessionLayout::radar_state),
      State(Role::state_machine, &yars_net_OutputsSample::outputs, &SessionLayout::outputs, kTick_ns),
      State(Role::state_machine, &yars_net_AdviceSample::advice, &SessionLayout::advice),
      State(Role::radar_model, &yars_net_ModelStatusSample::status, &SessionLayout::model_status, kTick_ns),
      State(Role::traffic, &yars_net_TrafficSample::traffic, &SessionLayout::traffic),
      State(Role::tour, &yars_net_CaptionSample::caption, &SessionLayout::caption),
      State(Role::recorder, &yars_net_RecorderStatusSample::status, &SessionLayout::recorder_status, kTick_ns)};
}

class StateExchange {
 public:
  explicit StateExchange(LaneNames& lanes) : lanes_(&lanes) {}

  void send(Context& context) {
    send_ownship(context);
    for_each([&](auto& state) { state.send(context, *lanes_); });
  }
  void receive(Context& context) {
    context.take<yars_net_OwnshipSample>(*this);
    for_each([&]<class Sample, class... Others>(State<Sample, Others...>&) { context.take<Sample>(*this); });
    keep_lane(context);
  }
  template <class Sample>
  void receive(Context& context, const Sample& sample) {
    for_each([&](auto& state) { state.receive(context, *lanes_, sample); });
  }
  void receive(Context& context, const yars_net_OwnshipSample& sample) {
    if (!context.hosts.is_new(sample) || context.hosts.find(sample.host) == nullptr) return;
    const bool has_nav = !std::isnan(sample.nav.mission_latitude_deg);
    const auto ownship = context.valid<databuffer::Ownship>(sample, sample.ownship);
    const auto nav = ownship && has_nav ? context.valid<databuffer::Nav>(sample, sample.nav) : std::nullopt;
    if (!ownship || (has_nav && !nav)) return;
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

  // Releases the lane of other hosts' ownship when they have been silent.
  void keep_lane(Context& context) {
    if (!lane_ || context.lockstep || context.now_ns - ownship_heard_ns_ < kOwnshipSilence_ns) return;
    lane_.reset();
    lanes_->ownship_lane.reset();
  }

 private:
  // [ns] After this silence of all other hosts the local lane of their ownship is released.
  static constexpr std::int64_t kOwnshipSilence_ns = 5'000'000'000;
  static constexpr std::int64_t kLockstepRefresh_ns = 250'000'000;

  template <class Call>
  void for_each(const Call& call) {
    std::apply([&](auto&... states) { (call(states), ...); }, states_);
  }

  // Each held lane has a writer of its own. The writer of a lane without new records ends after the lease, so that the
  // other hosts see the next lane. In lockstep a record is repeated, because a host that joins would wait for it.
  void send_ownship(Context& context) {
    const auto& layout = context.layout();
    for (std::uint32_t lane = 0; lane < databuffer::kOwnshipLanes; ++lane) {
      SentLane& sent = sent_lanes_[lane];
      if (lanes_->ownship_lane == lane || !std::as_const(context.session).ownship_lane_is_held(lane)) {
        context.link->end_ownship(lane);
        continue;
      }
      const std::uint64_t version = layout.ownship[lane].version();
      const bool repeats = context.lockstep && context.now_ns - sent.sent_ns > kLockstepRefresh_ns;
      if (version == sent.version && !repeats) {
        if (!context.lockstep && context.now_ns - sent.sent_ns > kLease_ns) context.link->end_ownship(lane);
        continue;
      }
      const auto ownship = databuffer::read_valid(layout.ownship[lane]);
      if (!ownship) continue;
      sent.version = version;
      sent.sent_ns = context.now_ns;
      auto sample = context.made<yars_net_OwnshipSample>();
      sample.priority = layout.ownship_priority[lane].load(std::memory_order_acquire);
      sample.lane = lane;
      copy_record(sample.ownship, *ownship);
      if (const auto nav = databuffer::read_valid(layout.nav[lane]))
        copy_record(sample.nav, *nav);
      else
        sample.nav.mission_latitude_deg = std::numeric_limits<double>::quiet_NaN();  // none
      context.link->write_ownship(lane, sample);
    }
  }

  struct SentLane {
    std::uint64_t version = 0;
    std::int64_t sent_ns = 0;
  };
  LaneNames* lanes_;
  decltype(all_states()) states_ = all_states();
  std::array<SentLane, databuffer::kOwnshipLanes> sent_lanes_;
  std::optional<databuffer::Claim> lane_;  // local ownship lane of the other hosts' ownship
  databuffer::Ownship last_ownship_{};
  std::int64_t ownship_heard_ns_ = 0;
};

}  // namespace yars::gateway
