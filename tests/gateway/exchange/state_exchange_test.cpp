// States of other hosts: taken from the host that has the role, after validation, once.
#include "gateway/exchange/state_exchange.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/gateway/exchange/two_hosts.hpp"

namespace yars::gateway {
namespace {

using databuffer::Role;
using testing::bit;
using testing::good_ownship;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class StateExchangeTest : public testing::TwoHosts {
 protected:
  // What holds for every state: `sample` is valid and of beta, which has `role`; spoil(sample) makes it invalid.
  template <class Sample, class Slot, class Spoil>
  void check(Role role, const Slot& slot, Sample sample, const Spoil& spoil) {
    SCOPED_TRACE(dds::settings_of(dds::kTopicOf<Sample>).name);
    const auto next = [&](const std::string& host) {
      const auto empty = from<Sample>(host);
      sample.host = empty.host;
      sample.start = empty.start;
      sample.number = empty.number;
      return sample;
    };
    exchange_.receive(context_, next("beta"));
    EXPECT_EQ(slot.version(), 0u) << "beta does not hold the role";
    announce("beta", bit(role));
    announce("gamma", 0);
    exchange_.receive(context_, next("gamma"));
    EXPECT_EQ(slot.version(), 0u) << "gamma does not hold the role";
    const Sample good = next("beta");
    exchange_.receive(context_, good);
    EXPECT_EQ(slot.version(), 1u);
    exchange_.receive(context_, good);
    exchange_.receive(context_, next("beta"));
    EXPECT_EQ(slot.version(), 1u) << "a repeated state is no new version";
    const std::uint64_t before = refusals();
    Sample bad = next("beta");
    spoil(bad);
    exchange_.receive(context_, bad);
    EXPECT_EQ(slot.version(), 1u) << "an invalid state";
    EXPECT_EQ(refusals(), before + 1);
    end("beta");
    pass(kSecond_ns);
    pass(kSecond_ns);
    exchange_.receive(context_, next("beta"));
    EXPECT_LE(slot.version(), 2u) << "beta has left; its role may have been cleared";
  }
  yars_net_OwnshipSample ownship(const std::string& host) {
    auto sample = from<yars_net_OwnshipSample>(host);
    copy_record(sample.ownship, good_ownship());
    sample.priority = 30;
    sample.lane = 1;
    sample.nav.mission_latitude_deg = kNaN;
    return sample;
  }
  LaneNames lanes_;
  StateExchange exchange_{lanes_};
};

TEST_F(StateExchangeTest, Outputs) {
  check(Role::state_machine, layout().outputs, yars_net_OutputsSample{}, [](auto& bad) {
    databuffer::Outputs outputs{};
    outputs.mark_count = 0xFF;
    copy_record(bad.outputs, outputs);
  });
}

TEST_F(StateExchangeTest, PilotAdvice) {
  check(Role::state_machine, layout().advice, yars_net_AdviceSample{},
        [](auto& bad) { std::memset(&bad.advice, 0xFF, sizeof bad.advice); });
}

TEST_F(StateExchangeTest, ModelStatus) {
  yars_net_ModelStatusSample sample{};
  databuffer::ModelStatus status{};
  status.ownship = good_ownship();
  copy_record(sample.status, status);
  check(Role::radar_model, layout().model_status, sample, [](auto& bad) { bad.status.load = kNaN; });
}

TEST_F(StateExchangeTest, Traffic) {
  check(Role::traffic, layout().traffic, yars_net_TrafficSample{}, [](auto& bad) { bad.traffic.count = 0xFFFF'FFFFU; });
}

TEST_F(StateExchangeTest, Caption) {
  yars_net_CaptionSample sample{};
  sample.caption.step = sample.caption.steps = 1;
  check(Role::tour, layout().caption, sample, [](auto& bad) { bad.caption.lines[0].text[0] = '\x1b'; });
}

TEST_F(StateExchangeTest, RecorderStatus) {
  check(Role::recorder, layout().recorder_status, yars_net_RecorderStatusSample{},
        [](auto& bad) { bad.status.problem[0] = '\n'; });
}

TEST_F(StateExchangeTest, AStateThatALocalProcessReplacedIsWrittenAgain) {
  announce("beta", bit(Role::state_machine));
  exchange_.receive(context_, from<yars_net_OutputsSample>("beta"));
  databuffer::Outputs other{};
  other.mark_count = 1;
  session_.layout().outputs.publish(other);
  exchange_.receive(context_, from<yars_net_OutputsSample>("beta"));
  databuffer::Outputs present{};
  ASSERT_TRUE(layout().outputs.read(present));
  EXPECT_EQ(present.mark_count, 0u);
}

TEST_F(StateExchangeTest, LanesOfOtherHostsHaveNoNumberHere) {
  announce("beta", bit(Role::state_machine) | bit(Role::radar_model));
  auto advice = from<yars_net_AdviceSample>("beta");
  advice.advice.idle_lane = 4;
  advice.sender = host_id("beta");
  exchange_.receive(context_, advice);
  databuffer::PilotAdvice taken{};
  ASSERT_TRUE(layout().advice.read(taken));
  EXPECT_EQ(taken.idle_lane, kNoLane);
  auto ours = from<yars_net_AdviceSample>("beta");
  ours.advice.idle_lane = 4;
  ours.sender = host_id("alpha");
  exchange_.receive(context_, ours);
  ASSERT_TRUE(layout().advice.read(taken));
  EXPECT_EQ(taken.idle_lane, 4u);
}

TEST_F(StateExchangeTest, OwnshipOfAnotherHostFillsALaneOfItsPriority) {
  exchange_.receive(context_, ownship("beta"));
  EXPECT_FALSE(lanes_.ownship_lane) << "a host that has not announced itself";
  announce("beta", 0);
  exchange_.receive(context_, ownship("beta"));
  ASSERT_TRUE(lanes_.ownship_lane);
  const std::size_t lane = *lanes_.ownship_lane;
  EXPECT_EQ(layout().ownship_priority[lane].load(), 30u);
  EXPECT_TRUE(session_.ownship_lane_is_held(lane));
  EXPECT_TRUE(layout().ownship[lane].has_value());
  EXPECT_FALSE(layout().nav[lane].has_value());
  // The model of beta names the lane by its number there.
  EXPECT_EQ(lanes_.local_ownship_lane({host_id("beta"), 1}, host_id("alpha"), kNoLane), lane);
  EXPECT_EQ(lanes_.local_ownship_lane({host_id("beta"), 0}, host_id("alpha"), kNoLane), kNoLane);
  EXPECT_EQ(lanes_.local_ownship_lane({host_id("alpha"), 2}, host_id("alpha"), kNoLane), 2u);
  EXPECT_EQ(lanes_.ownship_name(static_cast<std::uint32_t>(lane), host_id("alpha")).lane, 1u);
}

TEST_F(StateExchangeTest, InvalidOwnshipOrNavIsRefused) {
  announce("beta", 0);
  auto bad = ownship("beta");
  bad.ownship.latitude_deg = 91.0;
  exchange_.receive(context_, bad);
  bad = ownship("beta");
  bad.nav.mission_latitude_deg = 91.0;
  exchange_.receive(context_, bad);
  EXPECT_EQ(refusals(), 2u);
  EXPECT_FALSE(lanes_.ownship_lane);
}

TEST_F(StateExchangeTest, ASilentOwnshipLaneIsReleased) {
  announce("beta", 0);
  exchange_.receive(context_, ownship("beta"));
  const std::size_t lane = *lanes_.ownship_lane;
  pass(4 * kSecond_ns);
  exchange_.keep_lane(context_);
  EXPECT_TRUE(session_.ownship_lane_is_held(lane));
  pass(2 * kSecond_ns);
  exchange_.keep_lane(context_);
  EXPECT_FALSE(session_.ownship_lane_is_held(lane));
  EXPECT_FALSE(lanes_.ownship_lane);
}

TEST_F(StateExchangeTest, OwnshipThatFindsNoLaneIsRefused) {
  std::vector<databuffer::Claim> held;
  while (auto claim = session_.claim_ownship_lane(1)) held.push_back(std::move(*claim));
  announce("beta", 0);
  exchange_.receive(context_, ownship("beta"));
  EXPECT_EQ(refusals(), 1u);
  held.pop_back();
  exchange_.receive(context_, ownship("beta"));
  EXPECT_TRUE(lanes_.ownship_lane);
}

}  // namespace
}  // namespace yars::gateway
