// Tests of select_ownship(), which selects the lane from which the radar takes the aircraft.
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <random>
#include <string>

#include "databuffer/session/receivers.hpp"

namespace yars::databuffer {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kTick = 5 * kMillisecond;
constexpr std::int64_t kPeriod = 20 * kMillisecond;  // a 50 Hz source

// Simulated lanes: each source publishes at 50 Hz or is silent. select_ownship() runs at each tick.
class Lanes {
 public:
  void open(std::size_t lane, std::uint32_t priority) { lanes_[lane] = {true, priority, 1}; }
  void close(std::size_t lane) { lanes_[lane].present = false; }
  void deliver(std::size_t lane, bool on) { delivering_[lane] = on; }
  void set_priority(std::size_t lane, std::uint32_t priority) { lanes_[lane].priority = priority; }
  // Changes the time at once.
  void jump(std::int64_t by_ns) { now_ns_ += by_ns; }

  // Lets the time pass and returns the lane that is selected at its end.
  std::optional<std::size_t> run(std::int64_t duration_ns) {
    for (std::int64_t elapsed = 0; elapsed < duration_ns; elapsed += kTick) {
      now_ns_ += kTick;
      for (std::size_t lane = 0; lane < lanes_.size(); ++lane)
        if (delivering_[lane] && now_ns_ % kPeriod == 0) ++lanes_[lane].version;
      const auto before = selection_.lane;
      selection_ = select_ownship(lanes_, now_ns_, selection_);
      if (before != selection_.lane) ++changes_;
    }
    return selection_.lane;
  }
  int changes() const { return changes_; }

 private:
  std::array<OwnshipLane, 4> lanes_{};
  std::array<bool, 4> delivering_{};
  std::int64_t now_ns_ = 1'000'000 * kMillisecond;
  OwnshipSelection selection_{};
  int changes_ = 0;
};

using Lane = std::optional<std::size_t>;

TEST(SelectOwnship, NoLaneIsSelectedWithoutRecords) {
  Lanes lanes;
  EXPECT_EQ(lanes.run(1'000 * kMillisecond), std::nullopt);
  lanes.open(2, 10);
  EXPECT_EQ(select_ownship({}, 0, {}).lane, std::nullopt);
}

TEST(SelectOwnship, ARecordLeftByADeadWriterIsNotSelected) {
  std::array<OwnshipLane, 1> left{OwnshipLane{true, 10, 77}};
  OwnshipSelection selection;
  for (std::int64_t now = 0; now < 1'000 * kMillisecond; now += kTick) {
    selection = select_ownship(left, now, selection);
    ASSERT_EQ(selection.lane, std::nullopt);
  }
}

TEST(SelectOwnship, TheOnlyLaneIsSelectedAtItsFirstNewRecord) {
  Lanes lanes;
  lanes.run(kPeriod);
  lanes.open(1, 10);
  lanes.deliver(1, true);
  EXPECT_EQ(lanes.run(kPeriod), Lane(1));
}

TEST(SelectOwnship, AHigherPriorityTakesOverAfterAQuarterSecondOfRecords) {
  Lanes lanes;
  lanes.open(0, 10);
  lanes.deliver(0, true);
  lanes.run(1'000 * kMillisecond);
  lanes.open(3, 20);
  lanes.deliver(3, true);
  EXPECT_EQ(lanes.run(240 * kMillisecond), Lane(0));
  EXPECT_EQ(lanes.run(60 * kMillisecond), Lane(3));
  EXPECT_EQ(lanes.changes(), 2);
}

TEST(SelectOwnship, ALowerPriorityNeverDisplacesAFreshOne) {
  Lanes lanes;
  lanes.open(1, 20);
  lanes.deliver(1, true);
  lanes.run(100 * kMillisecond);
  lanes.open(0, 10);
  lanes.deliver(0, true);
  EXPECT_EQ(lanes.run(5'000 * kMillisecond), Lane(1));
}

TEST(SelectOwnship, AStaleLaneIsReplacedByTheNextPriority) {
  Lanes lanes;
  for (const std::size_t lane : {0, 1, 2}) {
    lanes.open(lane, static_cast<std::uint32_t>(10 * (lane + 1)));
    lanes.deliver(lane, true);
  }
  ASSERT_EQ(lanes.run(1'000 * kMillisecond), Lane(2));
  lanes.deliver(2, false);
  EXPECT_EQ(lanes.run(490 * kMillisecond), Lane(2));
  EXPECT_EQ(lanes.run(40 * kMillisecond), Lane(1));
  lanes.deliver(1, false);
  lanes.deliver(0, false);
  EXPECT_EQ(lanes.run(600 * kMillisecond), std::nullopt);
}

TEST(SelectOwnship, AClosedLaneIsReplacedAtOnce) {
  Lanes lanes;
  lanes.open(0, 10);
  lanes.open(1, 20);
  lanes.deliver(0, true);
  lanes.deliver(1, true);
  ASSERT_EQ(lanes.run(1'000 * kMillisecond), Lane(1));
  lanes.close(1);
  EXPECT_EQ(lanes.run(kTick), Lane(0));
}

TEST(SelectOwnship, AnIntermittentSourceNeverDisplacesASteadyOne) {
  Lanes lanes;
  lanes.open(0, 10);
  lanes.open(1, 20);
  lanes.deliver(0, true);
  lanes.run(1'000 * kMillisecond);
  for (int interval = 0; interval < 20; ++interval) {
    lanes.deliver(1, true);
    EXPECT_EQ(lanes.run(200 * kMillisecond), Lane(0));
    lanes.deliver(1, false);
    EXPECT_EQ(lanes.run(600 * kMillisecond), Lane(0));
  }
  EXPECT_EQ(lanes.changes(), 1);
}

TEST(SelectOwnship, ShortGapsOfTheSelectedLaneChangeNothing) {
  Lanes lanes;
  lanes.open(0, 10);
  lanes.open(1, 20);
  lanes.deliver(0, true);
  lanes.deliver(1, true);
  ASSERT_EQ(lanes.run(1'000 * kMillisecond), Lane(1));
  const int changes = lanes.changes();
  for (int gap = 0; gap < 20; ++gap) {
    lanes.deliver(1, false);
    lanes.run(450 * kMillisecond);
    lanes.deliver(1, true);
    lanes.run(100 * kMillisecond);
  }
  EXPECT_EQ(lanes.changes(), changes);
}

TEST(SelectOwnship, ASingleRecordDoesNotTakeOver) {
  Lanes lanes;
  lanes.open(0, 10);
  lanes.open(1, 20);
  lanes.deliver(0, true);
  lanes.run(1'000 * kMillisecond);
  lanes.deliver(1, true);
  lanes.run(kPeriod);
  lanes.deliver(1, false);
  EXPECT_EQ(lanes.run(400 * kMillisecond), Lane(0));
}

TEST(SelectOwnship, AtEqualPriorityTheSelectedLaneStaysAndElseTheLowestIsSelected) {
  Lanes lanes;
  lanes.open(1, 10);
  lanes.deliver(1, true);
  ASSERT_EQ(lanes.run(500 * kMillisecond), Lane(1));
  lanes.open(0, 10);
  lanes.deliver(0, true);
  EXPECT_EQ(lanes.run(2'000 * kMillisecond), Lane(1));
  Lanes together;
  together.open(2, 10);
  together.open(3, 10);
  together.deliver(2, true);
  together.deliver(3, true);
  EXPECT_EQ(together.run(kPeriod), Lane(2));
}

TEST(SelectOwnship, ARaisedPriorityTakesEffect) {
  Lanes lanes;
  lanes.open(0, 10);
  lanes.open(1, 5);
  lanes.deliver(0, true);
  lanes.deliver(1, true);
  ASSERT_EQ(lanes.run(1'000 * kMillisecond), Lane(0));
  lanes.set_priority(1, 30);
  EXPECT_EQ(lanes.run(kTick), Lane(1));
}

TEST(SelectOwnship, TimeThatGoesBackChangesNothingWhileAllLanesDeliver) {
  Lanes lanes;
  lanes.open(0, 10);
  lanes.open(1, 20);
  lanes.deliver(0, true);
  lanes.deliver(1, true);
  ASSERT_EQ(lanes.run(1'000 * kMillisecond), Lane(1));
  const int changes = lanes.changes();
  lanes.jump(-900'000 * kMillisecond);
  EXPECT_EQ(lanes.run(2'000 * kMillisecond), Lane(1));
  EXPECT_EQ(lanes.changes(), changes);
}

TEST(SelectOwnship, ASourceThatEndsWhenTimeGoesBackBecomesStale) {
  Lanes lanes;
  lanes.open(0, 10);
  lanes.deliver(0, true);
  lanes.run(1'000 * kMillisecond);
  lanes.deliver(0, false);
  lanes.jump(-900'000 * kMillisecond);
  EXPECT_EQ(lanes.run(520 * kMillisecond), std::nullopt);
}

TEST(SelectOwnship, TheSelectedLaneIsPresentAndNoFreshProvenLaneHasAHigherPriority) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::array<OwnshipLane, 4> lanes{};
  OwnshipSelection selection;
  std::int64_t now = 0;
  for (int round = 0; round < 50'000; ++round) {
    auto& lane = lanes[random() % 4];
    const auto action = random() % 200;
    if (action == 0) lane.present = !lane.present;
    if (action == 1) lane.priority = static_cast<std::uint32_t>(random() % 3);
    if (action > 40) ++lane.version;
    now += kTick;
    selection = select_ownship(lanes, now, selection);
    if (!selection.lane) continue;
    const auto& memory = selection.memory;
    ASSERT_TRUE(lanes[*selection.lane].present);
    ASSERT_LE(now - *memory[*selection.lane].received_ns, kStaleAfter_ns);
    for (std::size_t other = 0; other < lanes.size(); ++other) {
      if (!lanes[other].present || lanes[other].priority <= lanes[*selection.lane].priority) continue;
      const auto& candidate = memory[other];
      const bool proven = candidate.received_ns && now - *candidate.received_ns <= kStaleAfter_ns &&
                          *candidate.received_ns - candidate.delivering_since_ns >= kTakeoverAfter_ns;
      ASSERT_FALSE(proven) << "lane " << other << " should have taken over";
    }
  }
}

}  // namespace
}  // namespace yars::databuffer
