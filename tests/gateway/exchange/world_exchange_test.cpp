// The world of the host that has the radar model: what the others get of it, and what becomes of their requests.
#include "gateway/exchange/world_exchange.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "databuffer/session/session_changes.hpp"
#include "gateway/exchange/history_progress.hpp"
#include "tests/gateway/exchange/two_hosts.hpp"
#include "world/world_edit.hpp"
#include "world/world_values.hpp"

namespace yars::gateway {
namespace {

using databuffer::Role;
using databuffer::WorldAnswer;
using databuffer::WorldState;
using testing::bit;

WorldState world_with(std::uint64_t edit, double sea_state) {
  WorldState world = world::world_state_from(radar::WorldConfiguration{});
  world.flags = {};
  world.edit = edit;
  world.sea_state = sea_state;
  world.source_time_ns = databuffer::monotonic_ns();
  return world;
}

class WorldExchangeTest : public testing::TwoHosts {
 protected:
  yars_net_WorldSample state(const WorldState& newest, const std::string& host = "beta") {
    auto sample = from<yars_net_WorldSample>(host);
    copy_record(sample.newest, newest);
    copy_record(sample.configured, world_with(0, 1.0));
    sample.has_configured = 1;
    return sample;
  }
  yars_net_LatchedWorldSample latched(std::uint64_t ring_number, const WorldState& world,
                                      const std::string& host = "beta", std::uint64_t segment = kBetaSegment) {
    auto sample = from<yars_net_LatchedWorldSample>(host);
    sample.segment = segment;
    sample.ring_number = ring_number;
    copy_record(sample.world, world);
    return sample;
  }
  template <class Sample>
  void receive(const Sample& sample) {
    exchange_.receive(context_, sample);
    exchange_.publish(context_);
  }
  std::uint64_t latched_here() const { return layout().world_latched.next(); }
  double sea_in_effect() const { return databuffer::world_in_effect(layout())->sea_state; }

  WorldNumbers numbers_;
  WorldExchange exchange_{numbers_};
};

// ---- A host whose radar model is on beta
class WorldOfBeta : public WorldExchangeTest {
 protected:
  void SetUp() override { announce("beta", bit(Role::radar_model)); }
};

TEST_F(WorldOfBeta, IsTheNewestHereAndIsInEffect) {
  receive(latched(4, world_with(3, 5.0)));
  receive(state(world_with(3, 5.0)));
  EXPECT_EQ(sea_in_effect(), 5.0);
  EXPECT_EQ(databuffer::newest_world(layout())->edit, 3U);
  WorldState configured{};
  ASSERT_TRUE(layout().world_configured.read(configured));
  EXPECT_EQ(configured.sea_state, 1.0);
  receive(state(world_with(4, 6.0)));
  EXPECT_EQ(databuffer::newest_world(layout())->sea_state, 6.0) << "beta has not latched it, as with a frozen clock";
  EXPECT_EQ(sea_in_effect(), 5.0);
}

TEST_F(WorldOfBeta, HasTheNumberThatItHasInTheRingHere) {
  session_.layout().world_latched.publish(world_with(0, 0.0));
  receive(latched(4, world_with(3, 5.0)));
  receive(latched(5, world_with(4, 6.0)));
  EXPECT_EQ(numbers_.local(host_id("beta"), 5), 2U);
  EXPECT_EQ(numbers_.local(host_id("beta"), 6), 3U);
  EXPECT_EQ(numbers_.local(host_id("beta"), 4), std::nullopt) << "it has not come";
  EXPECT_EQ(numbers_.local(host_id("beta"), 0), 0U) << "the configuration's";
  EXPECT_EQ(numbers_.local(host_id("gamma"), 5), std::nullopt);
}

TEST_F(WorldOfBeta, IsWrittenOnceAlsoByANewGateway) {
  const WorldState first = world_with(3, 5.0), second = world_with(4, 6.0);
  const auto sample = latched(4, first);
  receive(sample);
  receive(sample);
  receive(latched(4, first));
  receive(latched(5, second));
  EXPECT_EQ(latched_here(), 2U);
  WorldNumbers numbers;
  WorldExchange next(numbers);
  next.receive(context_, latched(4, first));  // DDS delivers all that beta has sent
  EXPECT_EQ(sea_in_effect(), 6.0);
  next.receive(context_, latched(5, second));
  EXPECT_EQ(latched_here(), 2U);
  EXPECT_EQ(numbers.local(host_id("beta"), 6), 2U);
  next.receive(context_, latched(6, first));
  EXPECT_EQ(latched_here(), 3U);
  EXPECT_EQ(numbers.local(host_id("beta"), 7), 3U);
}

TEST_F(WorldOfBeta, ComesAfterTheDeathOfAGatewayThatWasAboutToWriteIt) {
  receive(latched(4, world_with(3, 5.0)));
  auto& progress = session_.layout().world_requests.latched.progress;
  progress = progress_of(6, 1);  // of record 5, which is not in the ring yet
  WorldNumbers numbers;
  WorldExchange next(numbers);
  next.receive(context_, latched(5, world_with(4, 6.0)));
  EXPECT_EQ(latched_here(), 2U);
  EXPECT_EQ(sea_in_effect(), 6.0);
}

TEST_F(WorldOfBeta, IsWhatGammaHasHadFromBetaAndSaysAgain) {
  const WorldState world = world_with(3, 5.0);
  receive(latched(4, world));
  announce("beta", 0);
  announce("gamma", bit(Role::radar_model));
  receive(latched(9, world, "gamma"));
  EXPECT_EQ(latched_here(), 1U);
  EXPECT_EQ(numbers_.local(host_id("gamma"), 10), 1U);
}

TEST_F(WorldOfBeta, ComesAgainWhenAnotherProcessHasWrittenTheRing) {
  const auto sample = latched(4, world_with(3, 5.0));
  receive(sample);
  session_.layout().world_latched.publish(world_with(1, 2.0));
  exchange_.publish(context_);
  EXPECT_EQ(sea_in_effect(), 5.0);
  EXPECT_EQ(latched_here(), 3U);
}

TEST_F(WorldOfBeta, IsKeptUntilBetaHasTheRole) {
  announce("beta", 0);
  announce("gamma", bit(Role::radar_model));
  pass(kSecond_ns);
  receive(latched(1, world_with(1, 2.0), "gamma"));
  receive(latched(4, world_with(3, 5.0)));
  receive(state(world_with(3, 5.0)));
  EXPECT_EQ(sea_in_effect(), 2.0) << "gamma has the role";
  EXPECT_FALSE(layout().world.has_value());
  announce("gamma", 0);
  announce("beta", bit(Role::radar_model));
  exchange_.publish(context_);
  EXPECT_EQ(sea_in_effect(), 5.0);
  EXPECT_EQ(databuffer::newest_world(layout())->edit, 3U);
}

TEST_F(WorldOfBeta, IsRefusedWhenItIsInvalid) {
  auto bad = latched(0, world_with(1, 5.0));
  bad.world.rain_count = 0xFFFF'FFFFU;
  receive(bad);
  EXPECT_EQ(refusals(), 1U);
  auto bad_state = state(world_with(1, 5.0));
  bad_state.newest.wind_speed_mps = -1.0;
  receive(bad_state);
  bad_state = state(world_with(1, 5.0));
  bad_state.configured.sea_state = 99.0;
  receive(bad_state);
  EXPECT_EQ(refusals(), 3U);
  EXPECT_EQ(latched_here(), 0U);
  EXPECT_FALSE(layout().world.has_value());
  EXPECT_FALSE(layout().world_configured.has_value());
}

TEST_F(WorldOfBeta, OfAReplayHasNoConfiguration) {
  receive(state(world_with(1, 5.0)));
  auto replay = state(world_with(2, 5.0));
  replay.has_configured = 0;
  receive(replay);
  EXPECT_FALSE(layout().world_configured.has_value());
}

TEST_F(WorldOfBeta, IsAskedForAChangeOnce) {
  receive(state(world_with(3, 5.0)));
  EXPECT_FALSE(exchange_.request(context_));
  session_.layout().world_request.publish(world_with(4, 6.0));
  session_.layout().world_requests.asked = 7;
  context_.now_ns = databuffer::monotonic_ns();
  const auto request = exchange_.request(context_);
  ASSERT_TRUE(request);
  EXPECT_EQ(request->owner, host_id("beta"));
  EXPECT_EQ(request->segment, kSegment);
  EXPECT_EQ(request->request, 7U);
  EXPECT_EQ(request->world.edit, 4U);
  EXPECT_FALSE(exchange_.request(context_));
  auto answer = state(world_with(4, 6.0));
  answer.answers[2] = {host_id("gamma"), kSegment, 7, 1, 0};
  receive(answer);
  EXPECT_EQ(layout().world_requests.answered, 0U) << "the answer of another host's request";
  answer = state(world_with(4, 6.0));
  answer.answers[2] = {host_id("alpha"), kSegment, 6, 1, 0};
  answer.answers[3] = {host_id("alpha"), kSegment + 1, 7, 1, 0};
  receive(answer);
  EXPECT_EQ(layout().world_requests.answered, 0U) << "answers of earlier requests";
  answer = state(world_with(4, 6.0));
  answer.answers[2] = {host_id("alpha"), kSegment, 7, 2, 0};
  receive(answer);
  EXPECT_EQ(layout().world_requests.answered, 7U << 8 | 2U);
}

TEST_F(WorldOfBeta, IsNotAskedForAnOldChange) {
  session_.layout().world_request.publish(world_with(4, 6.0));
  session_.layout().world_requests.asked = 7;
  context_.now_ns = databuffer::monotonic_ns() + 2 * kSecond_ns;
  EXPECT_FALSE(exchange_.request(context_));
}

TEST_F(WorldOfBeta, IsNotSaidByThisHost) {
  receive(state(world_with(3, 5.0)));
  receive(latched(4, world_with(3, 5.0)));
  exchange_.send(context_);
  EXPECT_EQ(hosts_.written()[dds::index_of(dds::Topic::world)], 0U);
  EXPECT_EQ(hosts_.written()[dds::index_of(dds::Topic::world_latched)], 0U);
}

// ---- A host that has the radar model
class WorldOfThisHost : public WorldExchangeTest {
 protected:
  static constexpr std::int64_t kOffset_ns = 700'000'000'000;  // of the others' CLOCK_MONOTONIC

  void SetUp() override {
    hold(Role::radar_model);
    session_.layout().world_configured.publish(world_with(0, 1.0));
    session_.layout().world_latched.publish(world_with(0, 1.0));
    for (const char* name : {"beta", "gamma"}) {
      announce(name, 0);
      measure_offset(name);
    }
    ASSERT_TRUE(exchange_.news(context_));
  }
  void measure_offset(const std::string& name) {
    for (int i = 0; i < 8; ++i) {
      const std::int64_t now_ns = databuffer::monotonic_ns();
      yars_net_ProbeSample answer{};
      answer.from = hosts_.self().id;
      answer.to = host_id(name);
      answer.stage = 1;
      answer.asked_ns = now_ns - 200'000;
      answer.received_ns = answer.answered_ns = now_ns - 100'000 + kOffset_ns;
      hosts_.receive(answer, now_ns);
    }
  }
  yars_net_WorldRequestSample request(const WorldState& world, std::uint64_t number, const std::string& host = "beta") {
    auto sample = from<yars_net_WorldRequestSample>(host);
    sample.owner = hosts_.self().id;
    sample.segment = kBetaSegment;
    sample.request = number;
    copy_record(sample.world, world);
    sample.world.source_time_ns = databuffer::monotonic_ns() + kOffset_ns;
    return sample;
  }
  // Hands the request over and returns the answer; none: it waits, or is left out.
  WorldAnswer ask(const yars_net_WorldRequestSample& sample) {
    context_.now_ns += kSecond_ns / 10;  // each request has its turn
    receive(sample);
    const auto news = exchange_.news(context_);
    if (!news) return WorldAnswer::none;
    for (const auto& answer : news->answers)
      if (answer.host == sample.host && answer.segment == sample.segment && answer.request == sample.request)
        return static_cast<WorldAnswer>(answer.answer);
    return WorldAnswer::none;
  }
  WorldState wanted() const {
    WorldState world{};
    EXPECT_TRUE(layout().world.read(world));
    return world;
  }
  void latch() { session_.layout().world_latched.publish(wanted()); }
};

TEST_F(WorldOfThisHost, IsSaidWhenItChanges) {
  EXPECT_FALSE(exchange_.news(context_));
  session_.layout().world.publish(world_with(1, 4.0));
  const auto news = exchange_.news(context_);
  ASSERT_TRUE(news);
  EXPECT_EQ(news->newest.sea_state, 4.0);
  EXPECT_EQ(news->has_configured, 1U);
  EXPECT_EQ(news->configured.sea_state, 1.0);
  EXPECT_FALSE(exchange_.news(context_));
}

TEST_F(WorldOfThisHost, IsSentFromTheOneInEffectOn) {
  session_.layout().world_latched.publish(world_with(1, 4.0));
  exchange_.send(context_);
  EXPECT_EQ(hosts_.written()[dds::index_of(dds::Topic::world_latched)], 1U);
  session_.layout().world_latched.publish(world_with(2, 4.0));
  session_.layout().world_latched.publish(world_with(3, 4.0));
  exchange_.send(context_);
  exchange_.send(context_);
  EXPECT_EQ(hosts_.written()[dds::index_of(dds::Topic::world_latched)], 3U);
}

TEST_F(WorldOfThisHost, IsChangedByAnotherHost) {
  EXPECT_EQ(ask(request(world_with(1, 4.0), 1)), WorldAnswer::applied);
  EXPECT_EQ(wanted().sea_state, 4.0);
  EXPECT_EQ(wanted().edit, 1U);
  EXPECT_FALSE(session_.role_is_held(Role::instructor));
}

TEST_F(WorldOfThisHost, KeepsTheEditOfOneHostWhenAnotherDidNotKnowIt) {
  EXPECT_EQ(ask(request(world_with(1, 4.0), 1)), WorldAnswer::applied);
  EXPECT_EQ(ask(request(world_with(1, 6.0), 1, "gamma")), WorldAnswer::outdated);
  EXPECT_EQ(wanted().sea_state, 4.0);
  EXPECT_EQ(ask(request(world_with(1, 4.0), 2, "gamma")), WorldAnswer::outdated) << "an equal edit is another one";
  EXPECT_EQ(ask(request(world_with(2, 6.0), 3, "gamma")), WorldAnswer::applied);
  EXPECT_EQ(wanted().sea_state, 6.0);
}

TEST_F(WorldOfThisHost, TakesARepeatedRequestOnceAlsoWithANewGateway) {
  const auto first = request(world_with(1, 4.0), 1);
  EXPECT_EQ(ask(first), WorldAnswer::applied);
  const auto again = [&] {
    auto sample = request(world_with(1, 4.0), 1);
    sample.world = first.world;
    return sample;
  };
  EXPECT_EQ(ask(again()), WorldAnswer::none) << "it has its answer";
  latch();
  WorldExchange next(numbers_);
  next.receive(context_, again());
  next.publish(context_);
  const auto news = next.news(context_);
  ASSERT_TRUE(news);
  EXPECT_EQ(news->answers[0].answer, static_cast<std::uint32_t>(WorldAnswer::applied));
  EXPECT_EQ(wanted().edit, 1U);
}

TEST_F(WorldOfThisHost, DoesNotObeyAnInvalidOrAnOldRequest) {
  EXPECT_EQ(ask(request(world_with(1, 99.0), 1)), WorldAnswer::refused);
  EXPECT_EQ(refusals(), 1U);
  const std::int64_t now_ns = databuffer::monotonic_ns() + kOffset_ns;
  std::uint64_t number = 1;
  for (const std::int64_t time_ns :
       {now_ns - 3 * kSecond_ns, now_ns + 3 * kSecond_ns, std::int64_t{0}, std::numeric_limits<std::int64_t>::min(),
        std::numeric_limits<std::int64_t>::max()}) {
    auto old = request(world_with(1, 4.0), ++number);
    old.world.source_time_ns = time_ns;
    EXPECT_EQ(ask(old), WorldAnswer::late) << time_ns;
  }
  EXPECT_FALSE(layout().world.has_value());
}

TEST_F(WorldOfThisHost, IsNotChangedInAReplay) {
  session_.layout().world_configured.clear();
  EXPECT_EQ(ask(request(world_with(1, 4.0), 1)), WorldAnswer::refused);
  EXPECT_FALSE(layout().world.has_value());
}

TEST_F(WorldOfThisHost, IgnoresRequestsToOthersAndOfStrangers) {
  auto sample = request(world_with(1, 4.0), 1);
  sample.owner = host_id("gamma");
  EXPECT_EQ(ask(sample), WorldAnswer::none);
  EXPECT_EQ(ask(request(world_with(1, 4.0), 1, "nobody")), WorldAnswer::none);
  release(Role::radar_model);
  EXPECT_EQ(ask(request(world_with(1, 4.0), 2)), WorldAnswer::none) << "the radar model has ended";
  EXPECT_FALSE(layout().world.has_value());
}

TEST_F(WorldOfThisHost, LetsARequestWaitForItsTurnAndForALocalEditor) {
  EXPECT_EQ(ask(request(world_with(1, 4.0), 1)), WorldAnswer::applied);
  receive(request(world_with(2, 5.0), 2));
  EXPECT_EQ(wanted().edit, 1U) << "one change in 50 ms";
  auto editor = open("editor");
  auto claim = editor.claim(Role::instructor);
  ASSERT_TRUE(claim);
  pass(kSecond_ns / 10);
  exchange_.publish(context_);
  EXPECT_EQ(wanted().edit, 1U) << "a local editor is at it";
  *claim = databuffer::Claim();
  exchange_.publish(context_);
  EXPECT_EQ(wanted().edit, 2U);
}

TEST_F(WorldOfThisHost, IsNotWrittenByOthers) {
  receive(state(world_with(8, 6.0)));
  receive(latched(9, world_with(8, 6.0)));
  EXPECT_FALSE(layout().world.has_value());
  EXPECT_EQ(latched_here(), 1U);
}

}  // namespace
}  // namespace yars::gateway
