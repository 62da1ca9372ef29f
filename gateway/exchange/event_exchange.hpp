// Input events on their way to the host of the state machine, each delivered once; and the events that it applied.
// Inputs: the local input lanes while the state machine runs on another host; samples of other hosts.
// Outputs: each waiting event as a sample until its receipt arrives; events of other hosts in local input lanes, one
//   for each remote lane; the ring of applied events on every host.
// Errors: an invalid event is refused, counted and noted, and its receipt is given all the same. Without a free
//   input lane the events wait on their host.
// Source: docs/network.md#each-event-once.
#pragma once

#include "gateway/exchange/context.hpp"
#include "gateway/exchange/history_progress.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::gateway {

// Name of an input lane in the whole session, for ever.
inline std::uint64_t lane_id(std::uint64_t host, std::uint64_t segment, std::uint32_t lane) {
  return source_id({host, segment, lane});
}

class EventExchange {
 public:
  explicit EventExchange(LaneNames& lanes) : lanes_(&lanes) {}
  void send(Context& context) {
    const auto machine = context.roles.source(Role::state_machine);
    // Events that were sent to an earlier term may arrive after a partition, from the history that DDS keeps. By then
    // their host has sent them to another state machine, or again to this one.
    const bool here = context.roles.exports(Role::state_machine);
    if (here != (context.hosts.machine_term() != 0))
      context.hosts.set_machine_term(here ? context.hosts.identity().start + ++terms_ : 0);
    if (machine) drop_remote_events(context);
    if (machine && context.writes(dds::Topic::input_events))
      for (std::size_t lane = 0; lane < databuffer::kInputLanes; ++lane) send_waiting(context, lane, *machine);
    release_lanes(context);
    send_receipts(context);
    applied_.send(context, [this](auto& sample, const auto& applied) {
      copy_record(sample.applied, applied);
      lanes_->input_name(applied.lane, sample.host).write_to(sample.sender, sample.applied.lane);
    });
  }

  void receive(Context& context) {
    context.take<yars_net_InputEventSample, yars_net_EventReceiptSample>(*this);
    // Applied events wait in DDS until it is known which host has the state machine, and until their age can be judged.
    const auto holder = context.roles.holder(Role::state_machine);
    const auto newest = [&context] {
      const auto outputs = databuffer::read_valid(context.layout().outputs);
      return outputs ? std::optional(outputs->tick) : std::nullopt;
    };
    if (holder ? may_begin(context, dds::Topic::applied_events, *holder, newest) : is_last_tick(context))
      context.take<yars_net_AppliedEventSample>(*this);
  }

  void receive(Context& context, const yars_net_InputEventSample& sample) {
    context.hosts.is_new(sample);  // counted only: whether the event is new depends on its number in its lane
    if (sample.machine_term != context.hosts.machine_term() || sample.lane >= databuffer::kInputLanes ||
        !context.roles.exports(Role::state_machine) || !context.hosts.has_announced(sample.host))
      return;
    Receiving* receiving = receiving_from(context, sample);
    if (receiving == nullptr) return;
    receiving->heard_ns = context.now_ns;
    receiving->receipt_due = true;
    // A stored history of DDS may begin in the middle: then an earlier event comes later. The sender says how many have
    // no receipt. Those before them have reached a state machine on another host.
    const std::uint64_t first = sample.event_number - std::min<std::uint64_t>(sample.preceding, sample.event_number);
    if (sample.event_number != std::max(first, receiving->next_event)) return;
    if (receiving->claim || take_lane(context, *receiving, sample)) push(context, *receiving, sample);
  }

  void receive(Context& context, const yars_net_EventReceiptSample& sample) {
    if (!context.hosts.is_new(sample)) return;
    if (sample.sender != context.hosts.self().id || sample.segment != context.segment() ||
        sample.lane >= sending_.size() || context.roles.source(Role::state_machine) != sample.host)
      return;
    auto& input = context.session.layout().input;
    const std::uint64_t waiting = input.pushed(sample.lane) - input.popped(sample.lane);
    const std::uint64_t received = sample.next_event - input.popped(sample.lane);
    if (received > waiting) return;  // also a receipt older than the last one
    databuffer::InputEvent event{};
    for (std::uint64_t i = 0; i < received; ++i) input.pop(sample.lane, event);
  }

  void receive(Context& context, const yars_net_AppliedEventSample& sample) {
    // Also what a part of the session applied that yields is taken note of, so that it is not delivered later.
    if (!applied_.is_wanted(context, sample, sample.applied.tick)) return;
    auto applied = context.valid<databuffer::AppliedEvent>(sample, sample.applied);
    if (!applied) return;
    applied->monotonic_ns = local_time_ns(context, sample.host, applied->monotonic_ns);
    if (sample.sender == context.hosts.self().id)
      pop_applied(context, *applied);
    else
      applied->lane = kNoLane;
    applied->event.monotonic_ns = local_time_ns(context, sample.host, applied->event.monotonic_ns);
    applied_.publish(context, sample, *applied);
  }

 private:
  // [ns] Without a receipt for so long, the waiting events are sent again: the receiver leaves out what it has.
  static constexpr std::int64_t kRepeatAfter_ns = 1'000'000'000;
  static constexpr std::int64_t kLaneSilence_ns = 30'000'000'000;  // then the lane here is free for others

  // Translates a CLOCK_MONOTONIC time of another host; without a measured offset the result is the present time.
  static std::int64_t local_time_ns(const Context& context, std::uint64_t host, std::int64_t time_ns) {
    const auto offset_ns = context.hosts.offset_ns(host);
    if (!offset_ns) return context.now_ns;
    return std::clamp<std::int64_t>(difference_ns(time_ns, *offset_ns), 0, databuffer::monotonic_ns());
  }

  struct Sending {
    std::uint64_t next = 0;          // number of the next event to send
    std::uint64_t popped = 0;        // number of events taken from the lane, at the last change
    std::int64_t progress_ns = 0;    // CLOCK_MONOTONIC of that change
    std::uint64_t machine_term = 0;  // to which the events were sent
  };
  struct Receiving {
    std::uint64_t sender;
    std::uint32_t lane;
    std::uint64_t segment;
    std::optional<databuffer::Claim> claim = std::nullopt;
    std::uint64_t next_event = 0;
    std::optional<std::size_t> local_lane = std::nullopt;  // in which its last events are, claimed or not
    std::uint64_t receipted = 0;
    bool receipt_due = false;
    std::int64_t heard_ns = 0;
  };

  // Events of other hosts that the state machine of this host has not taken before it yielded. They have no receipt, so
  // that their hosts send them to the state machine that stays.
  void drop_remote_events(Context& context) {
    auto& layout = context.session.layout();
    for (databuffer::RemoteProgress& entry : layout.network.input) {
      const std::uint64_t progress = entry.progress.load();
      const std::size_t lane = lane_of(progress);
      if (entry.source.load() == 0 || lane >= databuffer::kInputLanes || layout.input.empty(lane)) continue;
      // A local source claims a lane only when it is empty. So a lane with a remote event at its end has no others.
      const std::uint64_t pushed = layout.input.pushed(lane);
      if (!ends_with(progress, pushed)) continue;
      // If the role comes back, they are taken again. A low entry is harmless: the sender names its oldest.
      const std::uint64_t waiting = pushed - layout.input.popped(lane);
      entry.progress.store(progress_of(next_of(progress, pushed, progress >> 32) - waiting, pushed - 1, lane));
      databuffer::InputEvent event{};
      while (layout.input.pop(lane, event)) {
      }
    }
  }

  // Sends the events of a lane that have no receipt yet. This gateway is the consumer of the lanes, because it holds
  // the role of the state machine. Events stay in the lane until the receipt, so that no death of a gateway loses one.
  void send_waiting(Context& context, std::size_t lane, std::uint64_t machine) {
    auto& input = context.session.layout().input;
    Sending& sending = sending_[lane];
    const std::uint64_t popped = input.popped(lane);
    const std::uint64_t end = input.pushed(lane);
    const std::uint64_t term = context.hosts.said_by(machine).machine_term;
    if (term == 0) return;  // it has not announced the role yet
    const bool other_machine = sending.machine_term != term;
    if (other_machine || sending.popped != popped || popped == end) {
      sending.progress_ns = context.now_ns;
      sending.popped = popped;
    }
    const bool stalled = context.now_ns - sending.progress_ns > kRepeatAfter_ns;
    if (other_machine || stalled || sending.next < popped || sending.next > end) sending.next = popped;
    if (stalled) sending.progress_ns = context.now_ns;
    sending.machine_term = term;
    databuffer::InputEvent event{};
    for (; sending.next != end; ++sending.next) {
      if (!input.peek_at(lane, sending.next, event)) return;
      auto sample = context.made<yars_net_InputEventSample>();
      sample.lane = static_cast<std::uint32_t>(lane);
      sample.segment = context.segment();
      sample.event_number = sending.next;
      sample.preceding = static_cast<std::uint32_t>(sending.next - popped);
      sample.machine_term = term;
      input.source(lane).copy(sample.source, sizeof sample.source - 1);
      copy_record(sample.event, event);
      if (!context.write(sample)) return;
    }
  }

  Receiving* receiving_from(Context& context, const yars_net_InputEventSample& sample) {
    const std::uint64_t id = lane_id(sample.host, sample.segment, sample.lane);
    if (const auto found = receiving_.find(id); found != receiving_.end()) return &found->second;
    constexpr std::size_t kMaxRemoteLanes = databuffer::kMaxHosts * databuffer::kInputLanes;
    if (receiving_.size() >= kMaxRemoteLanes) return nullptr;
    Receiving receiving{sample.host, sample.lane, sample.segment};
    // An entry of this gateway's predecessor says what has been delivered. Without one this is the first event.
    const auto& layout = context.layout();
    if (const auto* entry = find_entry(layout.network.input, id)) {
      const std::uint64_t progress = entry->progress.load();
      const std::size_t lane = lane_of(progress);
      if (lane < databuffer::kInputLanes) {
        receiving.next_event = next_of(progress, layout.input.pushed(lane), sample.event_number);
        if (ends_with(progress, layout.input.pushed(lane))) receiving.local_lane = lane;
      }
    }
    return &receiving_.emplace(id, std::move(receiving)).first->second;
  }

  // Claims a local input lane. All events before the sample's are delivered.
  bool take_lane(Context& context, Receiving& receiving, const yars_net_InputEventSample& sample) {
    std::string source(text::text_of(sample.source));
    std::ranges::replace_if(source, [](char letter) { return letter < ' ' || letter > '~'; }, '?');
    const HostView* host = context.hosts.find(sample.host);
    const std::string name = (host == nullptr ? "?" : host->name) + "/" + source;
    auto claim = context.session.claim_input_lane(name);
    if (!claim) {
      context.session.note(databuffer::NoteKind::loss, "events of " + name + " wait: " + claim.error().message());
      return false;
    }
    const auto lane = static_cast<std::size_t>(claim->lane());
    auto& layout = context.session.layout();
    keep_progress(context, receiving, progress_of(sample.event_number, layout.input.pushed(lane) - 1, lane));
    receiving.local_lane = lane;
    lanes_->input[lane] = RemoteName{receiving.sender, receiving.lane};
    receiving.claim.emplace(std::move(*claim));
    return true;
  }

  // Writes the entry of a remote lane. A new entry replaces one of a lane that is no longer known.
  void keep_progress(Context& context, const Receiving& receiving, std::uint64_t progress) {
    const std::uint64_t id = lane_id(receiving.sender, receiving.segment, receiving.lane);
    const auto is_known = [this](std::uint64_t source) { return receiving_.contains(source); };
    store_progress(entry_of(context.session.layout().network.input, id, is_known), id, progress);
  }

  // An event that finds no room is repeated by its sender.
  void push(Context& context, Receiving& receiving, const yars_net_InputEventSample& sample) {
    auto event = context.valid<databuffer::InputEvent>(sample, sample.event);
    if (!event) {
      receiving.next_event = sample.event_number + 1;
      return;
    }
    event->monotonic_ns = local_time_ns(context, sample.host, event->monotonic_ns);
    const auto lane = static_cast<std::size_t>(receiving.claim->lane());
    auto& layout = context.session.layout();
    const std::uint64_t pushed = layout.input.pushed(lane);
    if (pushed - layout.input.popped(lane) >= databuffer::kInputLaneDepth) return;
    keep_progress(context, receiving, progress_of(sample.event_number + 1, pushed, lane));
    layout.input.push(lane, *event);
    receiving.next_event = sample.event_number + 1;
  }

  // An event has its receipt when the state machine has taken it from the lane.
  void send_receipts(Context& context) {
    const auto& input = context.layout().input;
    for (auto& [id, receiving] : receiving_) {
      const std::uint64_t waiting =
          receiving.local_lane ? input.pushed(*receiving.local_lane) - input.popped(*receiving.local_lane) : 0;
      const std::uint64_t taken = receiving.next_event - std::min(waiting, receiving.next_event);
      if (taken == 0 || (taken == receiving.receipted && !receiving.receipt_due)) continue;
      receiving.receipt_due = false;
      receiving.receipted = taken;
      auto sample = context.made<yars_net_EventReceiptSample>();
      sample.sender = receiving.sender;
      sample.lane = receiving.lane;
      sample.segment = receiving.segment;
      sample.next_event = taken;
      context.write(sample);
    }
  }

  // Releases silent lanes, and all when the state machine runs elsewhere. Those of hosts that have left, and of earlier
  // segments, are forgotten.
  void release_lanes(Context& context) {
    const bool here = context.roles.exports(Role::state_machine);
    for (auto item = receiving_.begin(); item != receiving_.end();) {
      Receiving& receiving = item->second;
      // A lane with events that the state machine has not taken is kept, because they have no receipt yet.
      const bool is_empty = !receiving.local_lane || context.session.layout().input.empty(*receiving.local_lane);
      const bool silent = is_empty && context.now_ns - receiving.heard_ns > kLaneSilence_ns;
      const bool forgotten =
          !here || (silent && (context.hosts.find(receiving.sender) == nullptr ||
                               context.hosts.said_by(receiving.sender).segment != receiving.segment));
      if (receiving.claim && (forgotten || silent)) {
        lanes_->input[static_cast<std::size_t>(receiving.claim->lane())].reset();
        receiving.claim.reset();
        receiving.local_lane.reset();
      }
      item = forgotten ? receiving_.erase(item) : std::next(item);
    }
  }

  // An event that is seen as applied needs no receipt, so that no other host gets it if that one takes the role now.
  void pop_applied(Context& context, const databuffer::AppliedEvent& applied) {
    auto& input = context.session.layout().input;
    databuffer::InputEvent oldest{};
    if (applied.lane >= databuffer::kInputLanes || !input.peek(applied.lane, oldest)) return;
    const databuffer::InputEvent& event = applied.event;
    if (oldest.number == event.number && oldest.kind == event.kind && oldest.session_time_ns == event.session_time_ns)
      input.pop(applied.lane, oldest);
  }

  LaneNames* lanes_;
  std::array<Sending, databuffer::kInputLanes> sending_;
  std::map<std::uint64_t, Receiving> receiving_;  // by lane_id()
  History<yars_net_AppliedEventSample, databuffer::AppliedEvent, &databuffer::SessionLayout::applied_events,
          Role::state_machine>
      applied_{256};
  std::uint64_t terms_ = 0;  // number of times that this gateway found the state machine here
};

}  // namespace yars::gateway
