#include "gateway/exchange/state_exchange.hpp"

#include <cstring>
#include <utility>

#include "databuffer/messages/validation.hpp"
#include "lib/log/log.hpp"

namespace yars::gateway {

using databuffer::Role;

namespace {

// [ns] After this silence of all other hosts the local lane of their ownship is released.
constexpr std::int64_t kOwnshipSilence_ns = 5'000'000'000;
constexpr std::int64_t kLockstepRefresh_ns = 250'000'000;

template <class Record>
bool equal(const Record& first, const Record& second) {
  return std::memcmp(&first, &second, sizeof first) == 0;
}

}  // namespace

// Sends the local value if a local process holds `role`. fill(sample, record) adds what is not part of the record.
template <class Record, class Sample, class Fill>
void StateExchange::send_state(Context& context, Role role, const shm::LatestValue<Record>& slot,
                               databuffer::Validated<Record>& reader, Pace& pace, const Fill& fill) {
  if (!context.roles.exports(role) || !slot.has_value()) return;
  const bool is_new = reader.refresh(slot);
  if (!reader.has_value() || !pace.is_due(is_new, context)) return;
  Sample sample{};
  context.hosts.stamp(sample);
  fill(sample, reader.value());
  context.link->write(sample);
}

void StateExchange::send(Context& context) {
  const auto& layout = std::as_const(context.session).layout();
  send_ownship(context);
  send_state<databuffer::RadarState, yars_net_RadarStateSample>(
      context, Role::state_machine, layout.radar_state, radar_state_, radar_state_pace_,
      [](auto& sample, const auto& record) { copy_record(sample.state, record); });
  send_state<databuffer::Outputs, yars_net_OutputsSample>(
      context, Role::state_machine, layout.outputs, outputs_, outputs_pace_,
      [](auto& sample, const auto& record) { copy_record(sample.outputs, record); });
  send_state<databuffer::PilotAdvice, yars_net_AdviceSample>(
      context, Role::state_machine, layout.advice, advice_, advice_pace_, [&](auto& sample, const auto& record) {
        copy_record(sample.advice, record);
        const RemoteName name = lanes_->input_name(record.idle_lane, context.hosts.self().id);
        sample.sender = name.host;
        sample.advice.idle_lane = name.lane;
      });
  send_state<databuffer::ModelStatus, yars_net_ModelStatusSample>(
      context, Role::radar_model, layout.model_status, model_status_, model_status_pace_,
      [&](auto& sample, const auto& record) {
        copy_record(sample.status, record);
        const RemoteName name = lanes_->ownship_name(record.ownship_lane, context.hosts.self().id);
        sample.ownship_host = name.host;
        sample.status.ownship_lane = name.lane;
      });
  send_state<databuffer::Traffic, yars_net_TrafficSample>(
      context, Role::traffic, layout.traffic, traffic_, traffic_pace_,
      [](auto& sample, const auto& record) { copy_record(sample.traffic, record); });
  send_state<databuffer::Caption, yars_net_CaptionSample>(
      context, Role::tour, layout.caption, caption_, caption_pace_,
      [](auto& sample, const auto& record) { copy_record(sample.caption, record); });
  send_state<databuffer::RecorderStatus, yars_net_RecorderStatusSample>(
      context, Role::recorder, layout.recorder_status, recorder_status_, recorder_status_pace_,
      [](auto& sample, const auto& record) { copy_record(sample.status, record); });
}

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

void StateExchange::receive(Context& context) {
  const auto take = [&](const auto& sample) { receive(context, sample); };
  context.link->take<yars_net_OwnshipSample>(take);
  context.link->take<yars_net_RadarStateSample>(take);
  context.link->take<yars_net_OutputsSample>(take);
  context.link->take<yars_net_AdviceSample>(take);
  context.link->take<yars_net_ModelStatusSample>(take);
  context.link->take<yars_net_TrafficSample>(take);
  context.link->take<yars_net_CaptionSample>(take);
  context.link->take<yars_net_RecorderStatusSample>(take);
}

// Publishes the record of the host that has the role. Samples of other hosts are left out.
template <class Record, class Sample, class Field>
void StateExchange::receive_state(Context& context, Role role, const Sample& sample, const Field& field,
                                  shm::LatestValue<Record>& slot) {
  if (!context.hosts.is_new(sample) || context.roles.source(role) != sample.host) return;
  Record record{};
  copy_record(record, field);
  if (const auto reason = validate(record)) return context.hosts.refuse(sample.host, dds::kTopicOf<Sample>, *reason);
  // A repeated state is no new version. What stands in the slot counts: a local process may have written there since.
  Record present{};
  if (slot.read(present) && equal(record, present)) return;
  slot.publish(record);
}

void StateExchange::receive(Context& context, const yars_net_OwnshipSample& sample) {
  if (!context.hosts.is_new(sample) || context.hosts.find(sample.host) == nullptr) return;
  databuffer::Ownship ownship{};
  databuffer::Nav nav{};
  copy_record(ownship, sample.ownship);
  copy_record(nav, sample.nav);
  const bool has_nav = !(nav.mission_latitude_deg != nav.mission_latitude_deg);
  auto reason = validate(ownship);
  if (!reason && has_nav) reason = validate(nav);
  if (reason) return context.hosts.refuse(sample.host, dds::Topic::ownship, *reason);
  if (!lane_) {
    auto claim = context.session.claim_ownship_lane(sample.priority);
    if (!claim) return context.hosts.refuse(sample.host, dds::Topic::ownship, claim.error().message());
    lane_.emplace(std::move(*claim));
    last_ownship_ = {};
  }
  const auto lane = static_cast<std::size_t>(lane_->lane());
  auto& layout = context.session.layout();
  const RemoteName name{sample.host, sample.lane};
  if (lanes_->ownship_lane != lane || lanes_->ownship.host != name.host || lanes_->ownship.lane != name.lane)
    layout.ownship_priority[lane].store(sample.priority, std::memory_order_release);
  lanes_->ownship_lane = lane;
  lanes_->ownship = name;
  ownship_heard_ns_ = context.now_ns;
  if (context.lockstep && equal(ownship, last_ownship_)) return;  // a repetition
  last_ownship_ = ownship;
  if (has_nav)
    layout.nav[lane].publish(nav);
  else
    layout.nav[lane].clear();
  layout.ownship[lane].publish(ownship);
}

void StateExchange::keep_lane(Context& context) {
  if (!lane_ || context.lockstep || context.now_ns - ownship_heard_ns_ < kOwnshipSilence_ns) return;
  lane_.reset();
  lanes_->ownship_lane.reset();
}

void StateExchange::receive(Context& context, const yars_net_RadarStateSample& sample) {
  receive_state(context, Role::state_machine, sample, sample.state, context.session.layout().radar_state);
}

void StateExchange::receive(Context& context, const yars_net_OutputsSample& sample) {
  receive_state(context, Role::state_machine, sample, sample.outputs, context.session.layout().outputs);
}

void StateExchange::receive(Context& context, const yars_net_AdviceSample& sample) {
  yars_net_AdviceSample local = sample;
  if (sample.sender != context.hosts.self().id) local.advice.idle_lane = kNoLane;
  receive_state(context, Role::state_machine, local, local.advice, context.session.layout().advice);
}

void StateExchange::receive(Context& context, const yars_net_ModelStatusSample& sample) {
  yars_net_ModelStatusSample local = sample;
  local.status.ownship_lane =
      lanes_->local_ownship_lane({sample.ownship_host, sample.status.ownship_lane}, context.hosts.self().id, kNoLane);
  receive_state(context, Role::radar_model, local, local.status, context.session.layout().model_status);
}

void StateExchange::receive(Context& context, const yars_net_TrafficSample& sample) {
  receive_state(context, Role::traffic, sample, sample.traffic, context.session.layout().traffic);
}

void StateExchange::receive(Context& context, const yars_net_CaptionSample& sample) {
  receive_state(context, Role::tour, sample, sample.caption, context.session.layout().caption);
}

void StateExchange::receive(Context& context, const yars_net_RecorderStatusSample& sample) {
  receive_state(context, Role::recorder, sample, sample.status, context.session.layout().recorder_status);
}

}  // namespace yars::gateway
