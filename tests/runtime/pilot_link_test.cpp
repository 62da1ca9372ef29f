// Input lane of a program with a display, and which roles live.
#include <gtest/gtest.h>

#include <vector>

#include "runtime/claims.hpp"
#include "tests/databuffer/session/open_session.hpp"

namespace yars::runtime {
namespace {

class PilotLink : public databuffer::testing::OpenSessionTest {
 protected:
  static databuffer::InputEvent freeze() {
    databuffer::InputEvent event{};
    event.kind = static_cast<std::uint16_t>(databuffer::EventKind::freeze);
    return event;
  }
  // All events that wait in all lanes.
  static std::vector<databuffer::InputEvent> waiting(databuffer::Session& session) {
    std::vector<databuffer::InputEvent> events;
    databuffer::InputEvent event{};
    for (std::size_t lane = 0; lane < databuffer::kInputLanes; ++lane)
      while (session.layout().input.pop(lane, event)) events.push_back(event);
    return events;
  }
};

TEST_F(PilotLink, EventsAreNumberedAndStampedInTheirOrder) {
  databuffer::Session session = open();
  auto lane = InputLane::claim(session, "tester");
  ASSERT_TRUE(lane);
  const std::int64_t before_ns = databuffer::monotonic_ns();
  lane->send(freeze());
  lane->send(freeze());
  const auto events = waiting(session);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].number, 1U);
  EXPECT_EQ(events[1].number, 2U);
  EXPECT_GE(events[0].monotonic_ns, before_ns);
  EXPECT_LE(events[1].monotonic_ns, databuffer::monotonic_ns());
}

TEST_F(PilotLink, AFullLaneDropsTheEventAndKeepsTheOthers) {
  databuffer::Session session = open();
  auto lane = InputLane::claim(session, "tester");
  ASSERT_TRUE(lane);
  for (int i = 0; i < 5000; ++i) lane->send(freeze());
  const auto events = waiting(session);
  ASSERT_LT(events.size(), 5000U);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.front().number, 1U);
  EXPECT_EQ(events.back().number, events.size());
}

TEST_F(PilotLink, ARoleLivesWhileItsHeartbeatIsLessThanASecondOld) {
  constexpr std::int64_t kNow_ns = 10'000'000'000;
  const std::vector<databuffer::ProcessInfo> processes{{1, "state-machine", kNow_ns - 999'999'999, 0},
                                                       {2, "radar-model", kNow_ns - 1'000'000'000, 0}};
  EXPECT_TRUE(is_alive(processes, databuffer::Role::state_machine, kNow_ns));
  EXPECT_FALSE(is_alive(processes, databuffer::Role::radar_model, kNow_ns));
  EXPECT_FALSE(is_alive(processes, databuffer::Role::recorder, kNow_ns));
}

}  // namespace
}  // namespace yars::runtime
