// Fixture: the exchange of input events of host `alpha`, with events of host `beta`.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include "gateway/exchange/event_exchange.hpp"
#include "tests/gateway/exchange/two_hosts.hpp"

namespace yars::gateway::testing {

using databuffer::InputEvent;

class EventExchangeTest : public TwoHosts {
 protected:
  void restart() { exchange_.emplace(*lanes_ = LaneNames{}); }
  void SetUp() override {
    lanes_.emplace();
    restart();
  }
  // Event `number` of a lane of beta. `preceding`: events before it without a receipt.
  yars_net_InputEventSample event(std::uint64_t number, std::uint32_t preceding = 0, std::uint32_t lane = 2) {
    auto sample = from<yars_net_InputEventSample>("beta");
    sample.lane = lane;
    sample.preceding = preceding;
    sample.segment = kBetaSegment;
    sample.event_number = number;
    if (roles_.exports(Role::state_machine)) hosts_.set_machine_term(kTerm);
    sample.machine_term = kTerm;
    std::strcpy(sample.source, "keyboard");
    copy_record(sample.event, good_event(static_cast<std::uint32_t>(number)));
    return sample;
  }
  void receive(std::uint64_t number, std::uint32_t preceding = 0, std::uint32_t lane = 2) {
    exchange_->receive(context_, event(number, preceding, lane));
  }
  // Takes all events of all lanes as the state machine does.
  std::vector<std::uint32_t> take() {
    std::vector<std::uint32_t> numbers;
    InputEvent event{};
    for (std::size_t lane = 0; lane < databuffer::kInputLanes; ++lane)
      while (session_.layout().input.pop(lane, event)) numbers.push_back(event.number);
    return numbers;
  }
  std::uint64_t receipts() const { return hosts_.written()[dds::index_of(dds::Topic::event_receipts)]; }
  std::size_t held_lanes() const {
    std::size_t held = 0;
    for (std::size_t lane = 0; lane < databuffer::kInputLanes; ++lane)
      held += session_.input_lane_is_held(lane) ? 1 : 0;
    return held;
  }
  using Numbers = std::vector<std::uint32_t>;
  static constexpr std::uint64_t kTerm = 4004;

  std::optional<LaneNames> lanes_;
  std::optional<EventExchange> exchange_;
};

}  // namespace yars::gateway::testing
