// Branch of a recording: the point at which it begins, and its items.
#include "radar/recording/branch.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "tests/radar/recording/made_recording.hpp"
#include "tests/shm/child_process.hpp"

namespace yars::recording {
namespace {

constexpr std::int64_t kFirstTick = 100, kLastTick = 2000;
constexpr std::int64_t kBetweenStatuses = 20;

databuffer::AppliedEvent event_at(std::int64_t tick) {
  databuffer::AppliedEvent event{};
  event.tick = tick;
  return event;
}

// Items as the recorder writes them: in polls of 10 ticks, kind by kind. A status every 20 ticks, of a tick that is
// recorded in the next poll; a radar state with it, and after each event.
std::vector<RecordingItem> made_items(std::uint32_t epoch, const std::set<std::int64_t>& events = {}) {
  std::vector<RecordingItem> items;
  std::uint32_t number = 0;
  for (std::int64_t begin = kFirstTick; begin < kLastTick; begin += 10) {
    for (std::int64_t tick = begin; tick < begin + 10; ++tick) {
      auto model_tick = test::tick_at(tick);
      model_tick.epoch = epoch;
      items.emplace_back(model_tick);
    }
    bool pressed = false;
    for (std::int64_t tick = begin; tick < begin + 10; ++tick) {
      if (!events.contains(tick)) continue;
      items.emplace_back(event_at(tick));
      pressed = true;
    }
    const bool due = begin % kBetweenStatuses == 0;
    if (due || pressed) {
      StateChange change{};
      change.state.tick = begin + 9;
      change.state.epoch = epoch;
      items.emplace_back(change);
    }
    if (due) {
      StatusReport report{};
      report.status.tick = begin + 10;
      report.status.epoch = epoch;
      items.emplace_back(report);
    }
    items.emplace_back(SweepDigest{begin + 11, 1, epoch, number++, 0, 0});
  }
  return items;
}

std::int64_t own_tick_of(const RecordingItem& item) {
  if (const auto* change = std::get_if<StateChange>(&item)) return change->state.tick;
  return std::visit([](const auto& record) { return tick_of(record); }, item).value_or(0);
}

error::Expected<BranchPoint> point_of(const std::vector<RecordingItem>& items, std::int64_t tick) {
  auto reader = test::reader_of(test::recorded(items));
  return find_branch_point(*reader, tick, "made");
}

std::vector<RecordingItem> branch_of(const std::vector<RecordingItem>& items, std::int64_t tick) {
  auto reader = test::reader_of(test::recorded(items));
  const auto point = find_branch_point(*reader, tick, "made");
  const test::TemporaryFile file;
  auto writer = RecordingWriter::create(file.path(), {}, Existing::overwritten);
  EXPECT_TRUE(copy_until(*reader, *point, *writer));
  EXPECT_TRUE(writer->close());
  auto branch = test::reader_of(file.bytes());
  EXPECT_FALSE(branch->cut_short());
  return test::rest_of(*branch);
}

TEST(BranchPoint, IsTheNewestStatusUpToTheTick) {
  const auto items = made_items(3);
  for (const std::int64_t tick : {150, 1130, 1149, 1990}) {
    const auto point = point_of(items, tick);
    ASSERT_TRUE(point) << point.error().message();
    EXPECT_EQ(point->tick, (tick - 10) / kBetweenStatuses * kBetweenStatuses + 10) << tick;
    EXPECT_EQ(point->status.tick, point->tick);
    EXPECT_EQ(point->state.tick, point->tick - 1);
    EXPECT_EQ(point->epoch, 3U);
  }
}

TEST(BranchPoint, BeforeTheFirstStatusIsTheFirstStatus) {
  const auto point = point_of(made_items(1), kFirstTick);
  ASSERT_TRUE(point) << point.error().message();
  EXPECT_EQ(point->tick, kFirstTick + 10);
}

TEST(BranchPoint, AvoidsAStateThatLacksAnEvent) {
  // The state at tick 1129 is older than the event at tick 1130, the tick of the status.
  const auto point = point_of(made_items(1, {1130}), 1135);
  ASSERT_TRUE(point) << point.error().message();
  EXPECT_EQ(point->tick, 1110);
}

TEST(BranchPoint, NeedsARadarStateAndATickOfTheStatus) {
  auto items = made_items(1);
  std::erase_if(items, [](const RecordingItem& item) { return std::holds_alternative<StateChange>(item); });
  const auto without_state = point_of(items, 1000);
  ASSERT_FALSE(without_state);
  EXPECT_NE(without_state.error().message().find("no radar state"), std::string::npos)
      << without_state.error().message();
  items = made_items(1);
  std::erase_if(items, [](const RecordingItem& item) { return std::holds_alternative<StatusReport>(item); });
  EXPECT_FALSE(point_of(items, 1000));
}

TEST(BranchPoint, NamesTheTrafficAndTheFlightInForce) {
  auto items = made_items(1);
  databuffer::Traffic traffic{};
  traffic.epoch = 1;
  traffic.count = 1;
  traffic.tick = kFirstTick;
  items.insert(items.begin(), traffic);
  items.insert(items.begin(), flight_source("route:/made.route"));
  traffic.tick = 1500;
  items.insert(std::ranges::find_if(items, [](const auto& item) { return own_tick_of(item) == 1500; }), traffic);
  const auto before = point_of(items, 1400), after = point_of(items, 1600);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(before->traffic->tick, kFirstTick);
  EXPECT_EQ(after->traffic->tick, 1500);
  EXPECT_EQ(after->flight_source, "route:/made.route");
}

TEST(Branch, HasTheItemsUpToItsPointAndNoOthers) {
  const auto items = made_items(2, {500, 1111});
  for (const std::int64_t tick : {kFirstTick, std::int64_t{777}, std::int64_t{1500}, kLastTick - 1}) {
    const std::int64_t end = point_of(items, tick)->tick;
    std::vector<RecordingItem> expected = items;
    std::erase_if(expected, [end](const RecordingItem& item) { return own_tick_of(item) > end; });
    test::expect_same(branch_of(items, tick), expected);
  }
}

TEST(Branch, OfASecondEpochHasTheFirstEpochWhole) {
  auto items = made_items(1);
  // The second epoch begins at a later time, so that a tick names one of them.
  for (RecordingItem item : made_items(2)) {
    std::visit(
        [](auto& record) {
          if constexpr (requires { record.state.tick; })
            record.state.tick += 10'000;
          else if constexpr (requires { record.status.tick; })
            record.status.tick += 10'000;
          else if constexpr (requires { record.tick; })
            record.tick += 10'000;
        },
        item);
    items.push_back(item);
  }
  const auto point = point_of(items, 11'000);
  ASSERT_TRUE(point) << point.error().message();
  EXPECT_EQ(point->epoch, 2U);
  std::vector<RecordingItem> expected = items;
  std::erase_if(expected, [&](const RecordingItem& item) { return own_tick_of(item) > point->tick; });
  test::expect_same(branch_of(items, 11'000), expected);
}

TEST(TickAt, IsWithinTheRecording) {
  const auto reader = test::reader_of(test::recorded(made_items(1)));
  EXPECT_EQ(tick_at(*reader, 5.0, "made", "--at").value_or(0), 1000);
  for (const double outside : {0.0, 11.0, -1.0, std::nan("")}) {
    const auto tick = tick_at(*reader, outside, "made", "--at");
    ASSERT_FALSE(tick);
    EXPECT_TRUE(tick.error().bad_usage());
    EXPECT_NE(tick.error().message().find("0.500 to 10.005 s"), std::string::npos) << tick.error().message();
  }
  const auto empty = test::reader_of(test::recorded({}));
  const auto none = tick_at(*empty, 1.0, "made", "--at");
  ASSERT_FALSE(none);
  EXPECT_FALSE(none.error().bad_usage());
}

TEST(RecordingWriter, LocksItsFileWhileItWrites) {
  const test::TemporaryFile file;
  EXPECT_FALSE(is_being_written(file.path()));
  auto writer = RecordingWriter::create(file.path(), {}, Existing::overwritten);
  ASSERT_TRUE(writer);
  EXPECT_TRUE(is_being_written(file.path()));
  ASSERT_TRUE(writer->close());
  EXPECT_FALSE(is_being_written(file.path()));
}

TEST(RecordingWriter, AKilledWriterLeavesNoLockAndAFileThatIsCutShort) {
  const test::TemporaryFile file;
  shm::testing::ChildProcess writer([&file] {
    auto written = RecordingWriter::create(file.path(), {}, Existing::overwritten);
    if (written && written->append(test::tick_at(1)) && written->flush()) pause();
    return 1;
  });
  ASSERT_TRUE(shm::testing::wait_until(
      [&file] { return is_being_written(file.path()) && std::filesystem::file_size(file.path()) > 200; }));
  writer.kill_now();
  EXPECT_FALSE(is_being_written(file.path()));
  const auto reader = RecordingReader::open(file.path());
  ASSERT_TRUE(reader);
  EXPECT_TRUE(reader->cut_short());
}

}  // namespace
}  // namespace yars::recording
