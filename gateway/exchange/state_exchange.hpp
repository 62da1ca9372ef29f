// States on several hosts: ownship, radar state, outputs, advice, model status, traffic, caption, recorder status.
// Inputs: the latest values of the local segment whose writer is a local process; samples of other hosts.
// Outputs: a sample for each new value, and at least one each 0.25 s; the values of other hosts in the local segment,
//   written by the holder of the role, which is this gateway.
// Errors: a value that fails validate() is refused, counted and noted; the last valid one stays.
// Units: times [ns].
// Threads: one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "databuffer/session/session_layout.hpp"
#include "databuffer/session/validated.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/exchange/lane_names.hpp"

namespace yars::gateway {

// Pace of one state: the least time between two samples, and the greatest.
class Pace {
 public:
  explicit Pace(std::int64_t least_ns) : least_ns_(least_ns) {}
  // `changed`: there is a new value. True: it is to be sent now.
  bool is_due(bool changed, const Context& context) {
    pending_ = pending_ || changed;
    const std::int64_t since_ns = context.now_ns - sent_ns_;
    if (pending_ ? since_ns < least_ns_ && !context.lockstep : since_ns < kRefresh_ns) return false;
    pending_ = false;
    sent_ns_ = context.now_ns;
    return true;
  }

 private:
  static constexpr std::int64_t kRefresh_ns = 250'000'000;  // a host that joins, or takes a role, waits so long
  std::int64_t least_ns_, sent_ns_ = 0;
  bool pending_ = false;
};

class StateExchange {
 public:
  explicit StateExchange(LaneNames& lanes) : lanes_(&lanes) {}

  void send(Context& context);
  void receive(Context& context);
  // Writes records of other hosts' ownship lanes here, and releases the lane when they have been silent.
  void keep_lane(Context& context);

  void receive(Context& context, const yars_net_OwnshipSample& sample);
  void receive(Context& context, const yars_net_RadarStateSample& sample);
  void receive(Context& context, const yars_net_OutputsSample& sample);
  void receive(Context& context, const yars_net_AdviceSample& sample);
  void receive(Context& context, const yars_net_ModelStatusSample& sample);
  void receive(Context& context, const yars_net_TrafficSample& sample);
  void receive(Context& context, const yars_net_CaptionSample& sample);
  void receive(Context& context, const yars_net_RecorderStatusSample& sample);

 private:
  template <class Record, class Sample, class Fill>
  void send_state(Context& context, databuffer::Role role, const shm::LatestValue<Record>& slot,
                  databuffer::Validated<Record>& reader, Pace& pace, const Fill& fill);
  template <class Record, class Sample, class Field>
  void receive_state(Context& context, databuffer::Role role, const Sample& sample, const Field& field,
                     shm::LatestValue<Record>& slot);
  void send_ownship(Context& context);
  void send_model_status(Context& context);

  LaneNames* lanes_;
  static constexpr std::int64_t kTick_ns = 20'000'000;  // of states that change in every tick: 50 Hz

  struct SentLane {
    std::uint64_t version = 0;
    std::int64_t sent_ns = 0;
    bool is_held = false;
  };
  std::array<SentLane, databuffer::kOwnshipLanes> sent_lanes_;
  std::optional<databuffer::Claim> lane_;  // local ownship lane of the other hosts' ownship
  databuffer::Ownship last_ownship_{};
  std::int64_t ownship_heard_ns_ = 0;

  databuffer::Validated<databuffer::RadarState> radar_state_;
  databuffer::Validated<databuffer::Outputs> outputs_;
  databuffer::Validated<databuffer::PilotAdvice> advice_;
  databuffer::Validated<databuffer::ModelStatus> model_status_;
  databuffer::Validated<databuffer::Traffic> traffic_;
  databuffer::Validated<databuffer::Caption> caption_;
  databuffer::Validated<databuffer::RecorderStatus> recorder_status_;
  Pace radar_state_pace_{0}, outputs_pace_{kTick_ns}, advice_pace_{0}, model_status_pace_{kTick_ns}, traffic_pace_{0},
      caption_pace_{0}, recorder_status_pace_{kTick_ns};
};

}  // namespace yars::gateway
