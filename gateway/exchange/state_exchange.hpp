// States on several hosts: ownship, radar state, outputs, advice, model status, traffic, caption, recorder status.
// Inputs: the latest values of the local segment whose writer is a local process; samples of other hosts.
// Outputs: a sample for each new value, and at least one each 0.25 s; the values of other hosts in the local segment,
//   written by the holder of the role, which is this gateway.
// Errors: a value that fails validate() is refused, counted and noted; the last valid one stays.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <tuple>
#include <type_traits>

#include "databuffer/session/session_layout.hpp"
#include "databuffer/session/validated.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/pace.hpp"

namespace yars::gateway {

// Numbers of lanes in a sample that is sent: those that they have on their own hosts.
template <class Sample>
void name_lanes(Sample& sample, const LaneNames& lanes, std::uint64_t self) {
  if constexpr (std::is_same_v<Sample, yars_net_AdviceSample>) {
    const RemoteName name = lanes.input_name(sample.advice.idle_lane, self);
    sample.sender = name.host;
    sample.advice.idle_lane = name.lane;
  } else if constexpr (std::is_same_v<Sample, yars_net_ModelStatusSample>) {
    const RemoteName name = lanes.ownship_name(sample.status.ownship_lane, self);
    sample.ownship_host = name.host;
    sample.status.ownship_lane = name.lane;
  }
}

// Numbers of lanes in a sample that was received: those that they have here.
template <class Sample>
void number_lanes(Sample& sample, const LaneNames& lanes, std::uint64_t self) {
  if constexpr (std::is_same_v<Sample, yars_net_AdviceSample>) {
    if (sample.sender != self) sample.advice.idle_lane = kNoLane;
  } else if constexpr (std::is_same_v<Sample, yars_net_ModelStatusSample>) {
    sample.status.ownship_lane =
        lanes.local_ownship_lane({sample.ownship_host, sample.status.ownship_lane}, self, kNoLane);
  }
}

// The state of one topic. The holder of a role writes it.
template <class Sample, class Field, class Record>
class State {
 public:
  using Slot = shm::LatestValue<Record> databuffer::SessionLayout::*;
  // `field`: of the record in a sample. `least_ns`: least time between two samples.
  State(databuffer::Role role, Field Sample::* field, Slot slot, std::int64_t least_ns = 0)
      : role_(role), field_(field), slot_(slot), least_ns_(least_ns) {}

  void send(Context& context, const LaneNames& lanes) {
    const auto& slot = std::as_const(context.session).layout().*slot_;
    if (!context.roles.exports(role_) || !slot.has_value()) return;
    const bool is_new = reader_.refresh(slot);
    if (!reader_.has_value() || !pace_.is_due(is_new, context.now_ns, context.lockstep ? 0 : least_ns_)) return;
    Sample sample{};
    context.hosts.stamp(sample);
    copy_record(sample.*field_, reader_.value());
    name_lanes(sample, lanes, context.hosts.self().id);
    context.write(sample);
  }
  void take(Context& context, const LaneNames& lanes) {
    context.link->take<Sample>([&](const Sample& sample) { receive(context, lanes, sample); });
  }
  // Publishes the record of the host that has the role. Samples of other hosts, or of other topics, are left out.
  template <class Other>
  void receive(Context& context, const LaneNames& lanes, const Other& other) {
    if constexpr (std::is_same_v<Other, Sample>) {
      if (!context.hosts.is_new(other) || context.roles.source(role_) != other.host) return;
      Sample sample = other;
      number_lanes(sample, lanes, context.hosts.self().id);
      const auto record = context.valid<Record>(sample, sample.*field_);
      if (!record) return;
      // A repeated state is no new version. What stands in the slot counts: a local process may have written there
      // since.
      auto& slot = context.session.layout().*slot_;
      Record present{};
      if (!slot.read(present) || !equal(*record, present)) slot.publish(*record);
    }
  }

 private:
  databuffer::Role role_;
  Field Sample::* field_;
  Slot slot_;
  std::int64_t least_ns_;
  Pace pace_{250'000'000};  // a host that joins, or takes a role, waits so long
  databuffer::Validated<Record> reader_;
};

inline auto all_states() {
  using databuffer::Role, databuffer::SessionLayout;
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
    for_each([&](auto& state) { state.take(context, *lanes_); });
  }
  template <class Sample>
  void receive(Context& context, const Sample& sample) {
    for_each([&](auto& state) { state.receive(context, *lanes_, sample); });
  }
  void receive(Context& context, const yars_net_OwnshipSample& sample);
  // Releases the lane of other hosts' ownship when they have been silent.
  void keep_lane(Context& context);

 private:
  template <class Call>
  void for_each(const Call& call) {
    std::apply([&](auto&... states) { (call(states), ...); }, states_);
  }
  void send_ownship(Context& context);

  struct SentLane {
    std::uint64_t version = 0;
    std::int64_t sent_ns = 0;
    bool is_held = false;
  };
  LaneNames* lanes_;
  decltype(all_states()) states_ = all_states();
  std::array<SentLane, databuffer::kOwnshipLanes> sent_lanes_;
  std::optional<databuffer::Claim> lane_;  // local ownship lane of the other hosts' ownship
  databuffer::Ownship last_ownship_{};
  std::int64_t ownship_heard_ns_ = 0;
};

}  // namespace yars::gateway
