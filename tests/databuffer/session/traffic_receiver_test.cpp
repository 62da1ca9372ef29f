// Tests of TrafficReceiver, with which radar-model validates and latches surface traffic.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "databuffer/session/receivers.hpp"

namespace yars::databuffer {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

class TrafficReceiverTest : public ::testing::Test {
 protected:
  void publish_traffic(std::uint32_t count, std::uint32_t epoch = 3) {
    Traffic traffic{};
    traffic.count = count;
    traffic.epoch = epoch;
    for (std::uint32_t i = 0; i < count; ++i) traffic.entities[i].id = i + 1;
    layout_->traffic.publish(traffic);
  }
  bool refresh(double time_s, std::uint32_t epoch = 3) {
    const auto time_ns = static_cast<std::int64_t>(time_s * static_cast<double>(kSecond_ns));
    return receiver_.refresh(*layout_, time_ns / 5'000'000, time_ns, epoch);
  }

  std::unique_ptr<SessionLayout> layout_ = std::make_unique<SessionLayout>();
  TrafficReceiver receiver_;
};

TEST_F(TrafficReceiverTest, WithoutASourceThereIsNoTraffic) {
  EXPECT_FALSE(refresh(1.0));
  EXPECT_EQ(receiver_.latched().count, 0U);
}

TEST_F(TrafficReceiverTest, ARecordIsLatchedOnceWithTheTickOfTheLatch) {
  publish_traffic(2);
  EXPECT_TRUE(refresh(1.0));
  EXPECT_EQ(receiver_.latched().count, 2U);
  EXPECT_EQ(receiver_.latched().tick, 200);
  EXPECT_FALSE(refresh(1.005));
  EXPECT_EQ(receiver_.latched().tick, 200);
}

TEST_F(TrafficReceiverTest, TrafficOfASilentSourceIsDroppedAfterTwelveSeconds) {
  publish_traffic(2);
  ASSERT_TRUE(refresh(1.0));
  EXPECT_FALSE(refresh(13.0));
  EXPECT_TRUE(refresh(13.005));
  EXPECT_EQ(receiver_.latched().count, 0U);
  EXPECT_FALSE(refresh(14.0));
  publish_traffic(1);
  EXPECT_TRUE(refresh(15.0)) << "the source sends again";
  EXPECT_EQ(receiver_.latched().count, 1U);
}

TEST_F(TrafficReceiverTest, WithdrawnTrafficIsDroppedAtOnce) {
  publish_traffic(2);
  ASSERT_TRUE(refresh(1.0));
  layout_->traffic.clear();
  EXPECT_TRUE(refresh(1.005));
  EXPECT_EQ(receiver_.latched().count, 0U);
}

TEST_F(TrafficReceiverTest, ANewEpochDropsTheTrafficOfTheOldOne) {
  publish_traffic(2);
  ASSERT_TRUE(refresh(100.0));
  EXPECT_TRUE(refresh(0.0, 4));
  EXPECT_EQ(receiver_.latched().count, 0U);
  publish_traffic(2, 3);
  EXPECT_FALSE(refresh(0.005, 4));
  EXPECT_EQ(receiver_.refusal(), "traffic: epoch: expected 4, found 3");
  publish_traffic(2, 4);
  EXPECT_TRUE(refresh(0.01, 4));
}

TEST_F(TrafficReceiverTest, AnInvalidRecordIsRefusedAndTheLastValidOneStays) {
  publish_traffic(2);
  ASSERT_TRUE(refresh(1.0));
  Traffic bad = receiver_.latched();
  bad.entities[1].latitude_deg = std::numeric_limits<double>::infinity();
  layout_->traffic.publish(bad);
  EXPECT_FALSE(refresh(1.005));
  EXPECT_EQ(receiver_.refused(), 1U);
  EXPECT_EQ(receiver_.refusal(), "traffic: entities.latitude_deg: expected [-90, 90], found inf");
  EXPECT_EQ(receiver_.latched().count, 2U);
  EXPECT_FALSE(refresh(1.01));
  EXPECT_EQ(receiver_.refused(), 1U) << "counted once";
}

}  // namespace
}  // namespace yars::databuffer
