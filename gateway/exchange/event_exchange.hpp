// Input events on their way to the host of the state machine, each delivered once; and the events that it applied.
// Inputs: the local input lanes while the state machine runs on another host; events, receipts and applied events of
//   other hosts.
// Outputs: each waiting event as a sample until its receipt arrives; events of other hosts in local input lanes, one
//   for each remote lane; the ring of applied events on every host.
// Units: CLOCK_MONOTONIC times of other hosts are translated by the measured offset.
// Errors: an invalid event is refused, counted and noted, and its receipt is given all the same. Without a free
//   input lane the events wait on their host.
// Source: docs/network.md#each-event-once.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "databuffer/session/session_layout.hpp"
#include "gateway/exchange/context.hpp"
#include "gateway/exchange/history_progress.hpp"

namespace yars::gateway {

// Name of an input lane in the whole session, for ever.
std::uint64_t lane_id(std::uint64_t host, std::uint64_t segment, std::uint32_t lane);

class EventExchange {
 public:
  explicit EventExchange(LaneNames& lanes) : lanes_(&lanes) {}
  void send(Context& context);
  void receive(Context& context);
  void receive_inputs(Context& context) { context.take<yars_net_InputEventSample>(*this); }  // they are awaited

  void receive(Context& context, const yars_net_InputEventSample& sample);
  void receive(Context& context, const yars_net_EventReceiptSample& sample);
  void receive(Context& context, const yars_net_AppliedEventSample& sample);

 private:
  struct Sending {
    std::uint64_t next = 0;          // number of the next event to send
    std::uint64_t popped = 0;        // number of events taken from the lane, at the last change
    std::int64_t progress_ns = 0;    // CLOCK_MONOTONIC of that change
    std::uint64_t machine_term = 0;  // to which the events were sent
  };
  struct Receiving {
    std::uint64_t sender = 0;
    std::uint32_t lane = 0;
    std::uint64_t segment = 0;
    std::optional<databuffer::Claim> claim = std::nullopt;
    std::uint64_t next_event = 0;
    std::optional<std::size_t> local_lane = std::nullopt;  // in which its last events are, claimed or not
    std::uint64_t receipted = 0;
    bool receipt_due = false;
    std::int64_t heard_ns = 0;
  };
  void send_waiting(Context& context, std::size_t lane, std::uint64_t machine);
  void update_term(Context& context);
  void drop_remote_events(Context& context);
  void keep_progress(Context& context, const Receiving& receiving, std::uint64_t progress);
  void send_receipts(Context& context);
  Receiving* receiving_from(Context& context, const yars_net_InputEventSample& sample);
  bool take_lane(Context& context, Receiving& receiving, const yars_net_InputEventSample& sample);
  void push(Context& context, Receiving& receiving, const yars_net_InputEventSample& sample);
  void release_lanes(Context& context);
  void pop_applied(Context& context, const databuffer::AppliedEvent& applied);

  LaneNames* lanes_;
  std::array<Sending, databuffer::kInputLanes> sending_;
  std::map<std::uint64_t, Receiving> receiving_;  // by lane_id()
  History<yars_net_AppliedEventSample, databuffer::AppliedEvent> applied_{256};
  std::uint64_t terms_ = 0;  // number of times that this gateway found the state machine here
};

}  // namespace yars::gateway
