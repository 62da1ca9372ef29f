// Input events of other hosts: each is delivered once, in order, also across restarts of the gateway.
#include "gateway/exchange/event_exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "gateway/exchange/history_progress.hpp"
#include "tests/gateway/exchange/event_fixture.hpp"
#include "tests/gateway/random_seed.hpp"

namespace yars::gateway {
namespace {

using databuffer::InputEvent;
using databuffer::Role;
using testing::bit;
using testing::EventExchangeTest;
using testing::good_event;

TEST_F(EventExchangeTest, EventsOfAnotherHostReachTheStateMachineOnceAndInOrder) {
  hold(Role::state_machine);
  announce("beta", 0);
  for (std::uint32_t number = 0; number < 3; ++number) receive(number, number);
  receive(1, 1);
  EXPECT_EQ(take(), (Numbers{0, 1, 2}));
  receive(2);
  EXPECT_EQ(take(), Numbers{});
  EXPECT_EQ(layout().input.source(0), "beta/keyboard");
  EXPECT_EQ(lanes_->input[0]->host, host_id("beta"));
  EXPECT_EQ(lanes_->input[0]->lane, 2u);
  exchange_->send(context_);
  EXPECT_EQ(receipts(), 1u) << "one receipt a lane and pass";
}

TEST_F(EventExchangeTest, WithoutTheStateMachineNothingIsTaken) {
  announce("beta", 0);
  receive(0);
  EXPECT_EQ(take(), Numbers{});
  exchange_->send(context_);
  EXPECT_EQ(receipts(), 0u);
}

TEST_F(EventExchangeTest, EventsForAnotherMachineOrOfAnUnknownHostAreLeftOut) {
  hold(Role::state_machine);
  receive(0);
  announce("beta", 0);
  auto sample = event(0);
  sample.machine_term = kTerm + 1;
  exchange_->receive(context_, sample);
  sample = event(0);
  sample.lane = databuffer::kInputLanes;
  exchange_->receive(context_, sample);
  EXPECT_EQ(take(), Numbers{});
}

// After a partition DDS delivers events that were sent before it. Their host has sent them elsewhere meanwhile.
TEST_F(EventExchangeTest, EventsOfAnEarlierTermAreLeftOut) {
  hold(Role::state_machine);
  announce("beta", 0);
  exchange_->send(context_);
  const std::uint64_t first_term = hosts_.machine_term();
  EXPECT_NE(first_term, 0u);
  release(Role::state_machine);
  exchange_->send(context_);
  EXPECT_EQ(hosts_.machine_term(), 0u);
  hold(Role::state_machine);
  auto sample = event(0);
  exchange_->send(context_);
  hosts_.set_machine_term(0);
  exchange_->send(context_);
  EXPECT_NE(hosts_.machine_term(), first_term);
  sample.machine_term = first_term;
  exchange_->receive(context_, sample);
  EXPECT_EQ(take(), Numbers{});
  sample.machine_term = hosts_.machine_term();
  exchange_->receive(context_, sample);
  EXPECT_EQ(take(), Numbers{0});
}

TEST_F(EventExchangeTest, AnInvalidEventIsRefusedAndDoesNotStopTheLane) {
  hold(Role::state_machine);
  announce("beta", 0);
  auto sample = event(0);
  sample.event.kind = 0xFFFF;
  exchange_->receive(context_, sample);
  receive(1);
  EXPECT_EQ(refusals(), 1u);
  EXPECT_EQ(take(), Numbers{1});
}

// DDS delivers the last samples of its history when two hosts meet again. They may begin within a repetition.
TEST_F(EventExchangeTest, AHistoryThatBeginsInTheMiddleLosesNoEvent) {
  hold(Role::state_machine);
  announce("beta", 0);
  for (std::uint32_t number = 7; number < 10; ++number) receive(number, number);
  EXPECT_EQ(take(), Numbers{}) << "0 to 6 are still missing";
  for (std::uint32_t number = 0; number < 10; ++number) receive(number, number);
  EXPECT_EQ(take(), (Numbers{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST_F(EventExchangeTest, ALaneMayBeginWithAnyEvent) {
  hold(Role::state_machine);
  announce("beta", 0);
  receive(50, 1);
  receive(49, 0);
  receive(50, 1);
  EXPECT_EQ(take(), (Numbers{49, 50})) << "0 to 48 were applied by an earlier state machine";
  receive(80, 0);
  EXPECT_EQ(take(), Numbers{80}) << "51 to 79 reached another machine";
}

TEST_F(EventExchangeTest, EventsBeyondTheRoomOfALaneAreTakenWhenTheyAreRepeated) {
  hold(Role::state_machine);
  announce("beta", 0);
  constexpr std::uint32_t kDepth = databuffer::kInputLaneDepth;
  for (std::uint32_t number = 0; number < kDepth + 5; ++number) receive(number);
  EXPECT_EQ(take().size(), kDepth);
  receive(kDepth + 4, 4);
  EXPECT_EQ(take(), Numbers{}) << "its predecessors come first";
  for (std::uint32_t i = 0; i < 5; ++i) receive(kDepth + i, i);
  EXPECT_EQ(take().size(), 5u);
  EXPECT_EQ(layout().input.dropped(0), 0u);
}

TEST_F(EventExchangeTest, RandomRepetitionsRestartsAndLocalEventsDeliverEachEventOnce) {
  const std::uint64_t seed = testing::random_seed();
  SCOPED_TRACE("YARS_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  hold(Role::state_machine);
  announce("beta", 0);
  const auto local = session_.claim_input_lane("local");
  ASSERT_TRUE(local);
  constexpr std::uint32_t kEvents = 400, kLocal = 1'000'000;
  std::uint32_t receipt = 0;  // the sender's; it may be old
  Numbers delivered;
  std::uint32_t local_events = 0;
  for (int step = 0; step < 6000; ++step) {
    const std::uint32_t number = receipt + static_cast<std::uint32_t>(random() % 8);
    if (number < kEvents) receive(number, number - receipt);
    if (random() % 20 == 0) {
      // A restarted gateway may have another lane, and lanes have no common order.
      for (const std::uint32_t event : take())
        if (event < kLocal) delivered.push_back(event);
      restart();
      // A local program may take the lane that the gateway had.
      if (auto other = session_.claim_input_lane("inject"); other && random() % 2 == 0)
        session_.layout().input.push(static_cast<std::size_t>(other->lane()), good_event(kLocal + local_events++));
    }
    if (random() % 10 == 0) {
      for (const std::uint32_t event : take())
        if (event < kLocal) delivered.push_back(event);
      if (random() % 2 == 0) receipt = static_cast<std::uint32_t>(delivered.size());
    }
  }
  for (const std::uint32_t event : take())
    if (event < kLocal) delivered.push_back(event);
  Numbers expected(delivered.size());
  for (std::uint32_t i = 0; i < expected.size(); ++i) expected[i] = i;
  EXPECT_EQ(delivered, expected);
  EXPECT_EQ(delivered.size(), kEvents);
}

// The gateway is killed after the entry and before the push: what it leaves is written here by hand.
TEST_F(EventExchangeTest, AnEventOfWhichOnlyTheEntryWasWrittenIsDelivered) {
  hold(Role::state_machine);
  announce("beta", 0);
  receive(0);
  EXPECT_EQ(take(), Numbers{0});
  restart();
  auto& network = session_.layout().network;
  network.input[0].progress.store(progress_of(2, layout().input.pushed(0)));
  receive(1);
  EXPECT_EQ(take(), Numbers{1});
  restart();
  receive(1);
  EXPECT_EQ(take(), Numbers{});
  receive(2);
  EXPECT_EQ(take(), Numbers{2});
}

TEST_F(EventExchangeTest, AGatewayKilledBeforeTheEntryDeliversTheEventAgain) {
  hold(Role::state_machine);
  announce("beta", 0);
  receive(0);
  receive(1);
  EXPECT_EQ(take(), (Numbers{0, 1}));
  restart();
  receive(2, 2);
  EXPECT_EQ(take(), Numbers{2}) << "0 and 1 are known from the entry";
}

TEST_F(EventExchangeTest, LanesOfASilentHostAreFreeForOthersAndRemembered) {
  hold(Role::state_machine);
  announce("beta", 0);
  receive(0);
  EXPECT_EQ(held_lanes(), 1u);
  take();
  pass(31 * kSecond_ns);
  announce("beta", 0);
  exchange_->send(context_);
  EXPECT_EQ(held_lanes(), 0u);
  EXPECT_FALSE(lanes_->input[0]);
  receive(0);
  EXPECT_EQ(take(), Numbers{}) << "still known";
  receive(1);
  EXPECT_EQ(take(), Numbers{1});
  EXPECT_EQ(held_lanes(), 1u);
}

// A host that starts its set again and again has new segments. Their lanes must not use up those of this host.
TEST_F(EventExchangeTest, LanesOfEarlierSegmentsAreForgotten) {
  hold(Role::state_machine);
  for (std::uint64_t segment = 1; segment <= 40; ++segment) {
    announce("beta", 0, segment);
    auto sample = event(0);
    sample.segment = segment;
    exchange_->receive(context_, sample);
    EXPECT_EQ(take(), Numbers{0});
    pass(31 * kSecond_ns);
    exchange_->send(context_);
    EXPECT_EQ(held_lanes(), 0u);
  }
}

// The table of entries has room for 32 lanes. New lanes replace those that are no longer known.
TEST_F(EventExchangeTest, ManySegmentsOfOneHostLeaveTheProgressOfAnother) {
  hold(Role::state_machine);
  announce("beta", 0);
  constexpr std::uint32_t kSegments = 200;
  for (std::uint32_t segment = 1; segment <= kSegments; ++segment) {
    announce("gamma", 0, segment);
    auto sample = event(0);
    sample.host = host_id("gamma");
    sample.segment = segment;
    exchange_->receive(context_, sample);
    pass(20 * kSecond_ns);
    receive(segment - 1);  // beta keeps its lane
    EXPECT_EQ(take().size(), 2u);
    pass(11 * kSecond_ns);
    exchange_->send(context_);
    EXPECT_EQ(held_lanes(), 1u);
  }
  restart();
  receive(kSegments - 1);
  EXPECT_EQ(take(), Numbers{}) << "delivered before";
}

// The role goes to another host and comes back: what the state machine here had not taken, and nobody else, is not
// lost.
TEST_F(EventExchangeTest, EventsThatTheStateMachineHadNotTakenAreTakenAgain) {
  announce("beta", 0);
  for (const bool restarts : {false, true}) {
    const std::uint64_t first = restarts ? 10 : 0;
    {
      databuffer::Session machine = open("state-machine");
      const auto role = machine.claim(Role::state_machine);
      pass(0);
      for (std::uint32_t i = 0; i < 3; ++i) receive(first + i, i);
      InputEvent taken{};
      ASSERT_TRUE(session_.layout().input.pop(0, taken));
      EXPECT_EQ(taken.number, first);
    }
    announce("gamma", bit(Role::state_machine), 4004);
    ASSERT_EQ(roles_.source(Role::state_machine), host_id("gamma"));
    exchange_->send(context_);
    exchange_->send(context_);
    EXPECT_TRUE(layout().input.empty(0)) << "gamma gets them";
    announce("gamma", 0, 4004);
    pass(2 * kSecond_ns);
    pass(2 * kSecond_ns);
    if (restarts) restart();
    databuffer::Session machine = open("state-machine");
    const auto role = machine.claim(Role::state_machine);
    ASSERT_TRUE(role);
    pass(0);
    receive(first);
    EXPECT_EQ(take(), Numbers{}) << "taken before; its receipt was lost";
    receive(first + 1, 1);
    receive(first + 2, 2);
    EXPECT_EQ(take(), (Numbers{static_cast<std::uint32_t>(first + 1), static_cast<std::uint32_t>(first + 2)}));
    exchange_->send(context_);
  }
}

TEST_F(EventExchangeTest, AnEventHasItsReceiptWhenTheStateMachineHasTakenIt) {
  hold(Role::state_machine);
  announce("beta", 0);
  receive(0);
  exchange_->send(context_);
  EXPECT_EQ(receipts(), 0u);
  pass(31 * kSecond_ns);
  announce("beta", 0);
  exchange_->send(context_);
  EXPECT_EQ(receipts(), 0u) << "the state machine stands still; the lane is kept";
  EXPECT_EQ(held_lanes(), 1u);
  take();
  exchange_->send(context_);
  EXPECT_EQ(receipts(), 1u);
}

TEST_F(EventExchangeTest, LanesEndWithTheRole) {
  announce("beta", 0);
  {
    databuffer::Session machine = open("state-machine");
    const auto role = machine.claim(Role::state_machine);
    pass(0);
    receive(0);
    EXPECT_EQ(held_lanes(), 1u);
  }
  pass(0);
  exchange_->send(context_);
  EXPECT_EQ(held_lanes(), 0u);
}

}  // namespace
}  // namespace yars::gateway
