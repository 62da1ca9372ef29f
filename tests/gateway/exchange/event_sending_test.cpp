// Input events on their way to another host, and the events that it applied.
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "gateway/exchange/event_exchange.hpp"
#include "tests/gateway/exchange/event_fixture.hpp"

namespace yars::gateway {
namespace {

using databuffer::Role;
using testing::bit;
using testing::EventExchangeTest;
using testing::good_event;

class SendingTest : public EventExchangeTest {
 protected:
  void SetUp() override {
    EventExchangeTest::SetUp();
    announce("beta", bit(Role::state_machine));
    ASSERT_EQ(roles_.source(Role::state_machine), host_id("beta"));
    lane_.emplace(*session_.claim_input_lane("keyboard"));
    for (std::uint32_t number = 0; number < 5; ++number) session_.layout().input.push(lane(), good_event(number));
  }
  std::size_t lane() const { return static_cast<std::size_t>(lane_->lane()); }
  std::uint64_t sent() const { return hosts_.written()[dds::index_of(dds::Topic::input_events)]; }
  void receipt(const std::string& host, std::uint64_t next_event) {
    auto sample = from<yars_net_EventReceiptSample>(host);
    sample.sender = host_id("alpha");
    sample.segment = kSegment;
    sample.lane = static_cast<std::uint32_t>(lane());
    sample.next_event = next_event;
    exchange_->receive(context_, sample);
  }
  std::optional<databuffer::Claim> lane_;
};

TEST_F(SendingTest, EventsStayInTheirLaneUntilTheReceipt) {
  exchange_->send(context_);
  exchange_->send(context_);
  EXPECT_EQ(sent(), 5u);
  EXPECT_EQ(layout().input.popped(lane()), 0u);
  receipt("beta", 3);
  EXPECT_EQ(layout().input.popped(lane()), 3u);
  receipt("beta", 2);
  EXPECT_EQ(layout().input.popped(lane()), 3u) << "an old receipt";
  receipt("beta", 6);
  EXPECT_EQ(layout().input.popped(lane()), 3u) << "for an event that was never sent";
  receipt("beta", 5);
  EXPECT_EQ(layout().input.popped(lane()), 5u);
}

TEST_F(SendingTest, AReceiptOfAHostWithoutTheRoleIsLeftOut) {
  announce("gamma", 0);
  receipt("gamma", 5);
  EXPECT_EQ(layout().input.popped(lane()), 0u);
}

TEST_F(SendingTest, WithoutAReceiptTheEventsAreSentAgainEachSecond) {
  exchange_->send(context_);
  pass(900'000'000);
  exchange_->send(context_);
  EXPECT_EQ(sent(), 5u);
  pass(200'000'000);
  exchange_->send(context_);
  EXPECT_EQ(sent(), 10u);
}

TEST_F(SendingTest, AnotherMachineGetsWhatHasNoReceipt) {
  exchange_->send(context_);
  receipt("beta", 2);
  announce("beta", 0);
  announce("gamma", bit(Role::state_machine), 4004);
  ASSERT_EQ(roles_.source(Role::state_machine), host_id("gamma"));
  exchange_->send(context_);
  EXPECT_EQ(sent(), 8u);
}

class AppliedTest : public EventExchangeTest {
 protected:
  void SetUp() override {
    EventExchangeTest::SetUp();
    announce("beta", bit(Role::state_machine));
  }
  yars_net_AppliedEventSample applied(const std::string& host, const std::string& sender) {
    auto sample = from<yars_net_AppliedEventSample>(host);
    sample.sender = host_id(sender);
    databuffer::AppliedEvent record{};
    record.lane = 3;
    record.event = good_event(9);
    copy_record(sample.applied, record);
    return sample;
  }
  std::uint64_t published() const { return layout().applied_events.next(); }
  databuffer::AppliedEvent last() const {
    databuffer::AppliedEvent record{};
    std::uint64_t cursor = published() - 1;
    EXPECT_TRUE(layout().applied_events.read(cursor, record).delivered);
    return record;
  }
};

TEST_F(AppliedTest, EventsOfTheHolderAreTakenOnce) {
  const auto sample = applied("beta", "beta");
  exchange_->receive(context_, sample);
  exchange_->receive(context_, sample);
  EXPECT_EQ(published(), 1u);
}

TEST_F(AppliedTest, OnlyEventsOfThisHostHaveALaneHere) {
  exchange_->receive(context_, applied("beta", "beta"));
  EXPECT_EQ(last().lane, kNoLane);
  exchange_->receive(context_, applied("beta", "alpha"));
  EXPECT_EQ(last().lane, 3u);
}

TEST_F(AppliedTest, EventsOfAHostWithoutTheRoleAreLeftOut) {
  announce("gamma", 0);
  exchange_->receive(context_, applied("gamma", "gamma"));
  EXPECT_EQ(published(), 0u);
}

TEST_F(AppliedTest, AnInvalidEventIsRefused) {
  auto sample = applied("beta", "beta");
  sample.applied.event.kind = 0xFFFF;
  exchange_->receive(context_, sample);
  EXPECT_EQ(published(), 0u);
  EXPECT_EQ(refusals(), 1u);
}

TEST(LaneId, NamesEachLaneOfEachSegmentOfEachHost) {
  EXPECT_EQ(lane_id(1, 2, 3), lane_id(1, 2, 3));
  EXPECT_NE(lane_id(1, 2, 3), lane_id(2, 1, 3));
  EXPECT_NE(lane_id(1, 2, 3), lane_id(1, 2, 4));
  EXPECT_NE(lane_id(0, 0, 0), 0u);
}

}  // namespace
}  // namespace yars::gateway
