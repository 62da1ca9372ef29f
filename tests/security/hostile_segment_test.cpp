// What another program of the same user may have left in a segment: nobody hangs over it, nobody believes it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <limits>
#include <memory>

#include "databuffer/records/model_validation.hpp"
#include "databuffer/records/radar_state_validation.hpp"
#include "databuffer/session.hpp"
#include "databuffer/tick_loop.hpp"
#include "tests/databuffer/session_name.hpp"

namespace yars::databuffer {
namespace {

constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();

class HostileSegment : public testing::SessionTest {
 protected:
  HostileSegment() : owner_(*Session::open(name_, "owner")) {}
  SessionLayout& layout() { return owner_.layout(); }
  // The words of a clock that nobody has published in order.
  void wipe_clock() { std::memset(static_cast<void*>(&layout().clock), 0, sizeof layout().clock); }
  std::string refusal() const {
    const auto opened = Session::open_read_only(name_);
    return opened ? "none" : opened.error().message();
  }
  Session owner_;
};

TEST_F(HostileSegment, ASessionWithoutAClockIsRefusedAndHangsNobody) {
  wipe_clock();
  EXPECT_NE(refusal().find("session clock: expected one that can be read"), std::string::npos) << refusal();
  EXPECT_FALSE(Session::open(name_, "another"));
}

TEST_F(HostileSegment, ASessionWhoseClockIsOutOfRangeIsRefused) {
  for (const double rate : {-1.0, 11.0, std::numeric_limits<double>::quiet_NaN()}) {
    ClockState clock = owner_.clock();
    clock.rate = rate;
    layout().clock.publish(clock);
    EXPECT_NE(refusal().find("rate"), std::string::npos) << refusal();
  }
  ClockState clock = owner_.clock();
  clock.base_sim_ns = kMost;
  layout().clock.publish(clock);
  EXPECT_NE(refusal().find("base_sim_ns"), std::string::npos) << refusal();
}

TEST_F(HostileSegment, WhoIsInsideGoesOnByTheLastGoodClockAndNotesTheOther) {
  const ClockState good = owner_.clock();
  ClockState bad = good;
  bad.base_monotonic_ns = kLeast;
  layout().clock.publish(bad);
  EXPECT_EQ(owner_.clock().base_monotonic_ns, good.base_monotonic_ns);
  EXPECT_GE(owner_.sim_time_ns(), 0);
  owner_.sim_time_ns();
  EXPECT_EQ(layout().note_counts[static_cast<std::size_t>(NoteKind::refusal)].load(), 1U) << "told once";
}

TEST_F(HostileSegment, AClockWhoseBaseIsYetToComeStands) {
  ClockState clock = owner_.clock();
  clock.base_sim_ns = 7;
  clock.base_monotonic_ns = monotonic_ns() + 1'000'000'000'000;
  layout().clock.publish(clock);
  EXPECT_EQ(owner_.sim_time_ns(), 7);
}

TEST_F(HostileSegment, ALaneWithCursorsThatNoSourceLeavesIsEmptiedAtOnce) {
  auto& input = layout().input;
  auto* words = reinterpret_cast<std::atomic<std::uint64_t>*>(&input);
  words[0] = std::uint64_t{1} << 63U;  // pushed
  InputEvent event{};
  int taken = 0;
  while (taken < 1000 && input.pop(0, event)) ++taken;
  EXPECT_EQ(taken, 0);
  EXPECT_TRUE(input.empty(0));
  ASSERT_TRUE(input.push(0, event));
  EXPECT_TRUE(input.pop(0, event)) << "the next source finds it whole";
}

TEST_F(HostileSegment, AHeartbeatYetToComeIsNoLaterThanNow) {
  for (ProcessEntry& entry : layout().processes)
    if (entry.pid == getpid()) entry.heartbeat_ns = kMost;
  const auto here = owner_.processes();
  ASSERT_EQ(here.size(), 1U);
  EXPECT_LE(here[0].heartbeat_ns, monotonic_ns());
}

TEST_F(HostileSegment, ALockstepSetGoesOnAfterNoTickThatCannotBe) {
  for (const std::int64_t tick : {kLeast, std::int64_t{-2}, kMost}) {
    layout().lockstep.done_tick[0] = tick;
    const auto loop = TickLoop::create(owner_, LockstepRole::flight_model, "flight-model@10");
    ASSERT_FALSE(loop) << tick;
    EXPECT_NE(loop.error().message().find("the session is damaged"), std::string::npos) << loop.error().message();
  }
}

TEST(ModelBorder, AStatusOrASweepOutOfRangeIsRefusedByName) {
  ModelStatus status{};
  EXPECT_FALSE(why_refused(status));
  status.antenna_azimuth_deg = 1e9;
  EXPECT_EQ(why_refused(status), "antenna_azimuth_deg: expected [-180, 180], found 1e+09");
  status = {};
  status.sim_time_ns = kMost;
  EXPECT_TRUE(why_refused(status));
  status = {};
  std::memset(status.why_not, 'x', sizeof status.why_not);
  EXPECT_TRUE(why_refused(status));
  status = {};
  status.ownship.latitude_deg = 91.0;
  EXPECT_TRUE(why_refused(status)->starts_with("ownship: latitude_deg"));
  Sweep sweep{};
  EXPECT_FALSE(why_refused(sweep));
  sweep.samples = radar::kMaxSamples + 1;
  EXPECT_EQ(why_refused(sweep), "samples: expected [0, 4096], found 4097");
}

TEST(ModelBorder, ARadarStateWithTicksAtTheEndsOfTheirTypeIsRefused) {
  RadarState state{};
  state.channel = 1;
  ASSERT_EQ(why_refused(state).value_or(""), "");
  state.cursor_moved_tick = kLeast;
  EXPECT_TRUE(why_refused(state)->starts_with("cursor_moved_tick"));
}

}  // namespace
}  // namespace yars::databuffer
