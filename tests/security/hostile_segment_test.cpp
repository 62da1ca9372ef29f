// Invalid records that another program of the same user may leave in a segment. No reader hangs or accepts such a
// record, and the session's programs repair it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <limits>
#include <memory>
#include <thread>
#include <vector>

#include "databuffer/messages/validation.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/session.hpp"
#include "runtime/tick_loop.hpp"
#include "tests/databuffer/session/session_name.hpp"
#include "tests/databuffer/session/set_clock.hpp"
#include "tests/shm/child_process.hpp"

namespace yars::databuffer {
namespace {

using shm::testing::ChildProcess;
using shm::testing::SharedMemory;
using shm::testing::wait_until;

constexpr std::int64_t kLowest = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kHighest = std::numeric_limits<std::int64_t>::max();

class HostileSegment : public testing::SessionTest {
 protected:
  HostileSegment() : owner_(*Session::open(name_, "owner")) {}
  SessionLayout& layout() { return owner_.layout(); }
  // Zeroes the clock, as if it had never been published.
  void wipe_clock() { std::memset(static_cast<void*>(&layout().clock), 0, sizeof layout().clock); }
  Session owner_;
};

TEST_F(HostileSegment, AMissingClockStandsAtZeroForAReaderAndIsRepairedByAJoiningProgram) {
  wipe_clock();
  const auto reader = Session::open_read_only(name_);
  ASSERT_TRUE(reader) << reader.error().message();
  EXPECT_EQ(reader->sim_time_ns(), 0);
  EXPECT_EQ(reader->clock().running, 0U);
  EXPECT_TRUE(reader->clock_problem());
  const auto joined = Session::open(name_, "another");
  ASSERT_TRUE(joined) << joined.error().message();
  EXPECT_FALSE(joined->clock_problem());
  EXPECT_LT(joined->sim_time_ns(), 600'000'000'000);
  EXPECT_EQ(reader->clock().running, 1U) << "the reader sees the repaired clock";
}

TEST_F(HostileSegment, AJoiningProgramRepairsAClockOutOfRangeInANewEpoch) {
  std::uint32_t epoch = 0;
  const auto spoil = [&](auto change) {
    ClockState clock = owner_.clock();
    change(clock);
    clock.epoch = epoch += 7;
    layout().clock.publish(clock);
    const auto reader = Session::open_read_only(name_);
    ASSERT_TRUE(reader) << reader.error().message();
    EXPECT_TRUE(reader->clock_problem());
    const auto joined = Session::open(name_, "another");
    ASSERT_TRUE(joined) << joined.error().message();
    EXPECT_FALSE(joined->clock_problem()) << *joined->clock_problem();
    EXPECT_EQ(joined->clock().epoch, epoch + 1);
  };
  for (const double rate : {-1.0, 11.0, std::numeric_limits<double>::quiet_NaN()})
    spoil([rate](ClockState& clock) { clock.rate = rate; });
  for (const std::int64_t base_ns : {kLowest, std::int64_t{-1}, kLatestClockBase_ns + 1, kHighest}) {
    spoil([base_ns](ClockState& clock) { clock.base_sim_ns = base_ns; });
    spoil([base_ns](ClockState& clock) { clock.base_monotonic_ns = base_ns; });
  }
}

TEST_F(HostileSegment, AJoiningProgramRepairsAClockWhoseVersionIsTheLastOne) {
  for (const std::uint64_t state : {~std::uint64_t{0}, ~std::uint64_t{0} - 1}) {
    reinterpret_cast<std::atomic<std::uint64_t>*>(&layout().clock)->store(state);
    const auto joined = Session::open(name_, "another");
    ASSERT_TRUE(joined) << joined.error().message();
    EXPECT_FALSE(joined->clock_problem()) << *joined->clock_problem();
  }
}

TEST_F(HostileSegment, AClockThatBeginsInTheFutureIsDamaged) {
  const ClockState good = owner_.clock();
  for (const std::int64_t ahead_ns : {std::int64_t{3'000'000'000}, kLatestClockBase_ns / 2}) {
    ClockState bad = good;
    bad.base_monotonic_ns = monotonic_ns() + ahead_ns;
    EXPECT_FALSE(test::set_clock(owner_, bad));
    layout().clock.publish(bad);
    ASSERT_TRUE(owner_.clock_problem());
    EXPECT_NE(owner_.clock_problem()->find("s in the future"), std::string::npos) << *owner_.clock_problem();
    EXPECT_EQ(owner_.clock().base_monotonic_ns, good.base_monotonic_ns) << "the last valid clock stays in use";
    owner_.restore_clock();
    EXPECT_FALSE(owner_.clock_problem());
    EXPECT_EQ(owner_.clock().epoch, good.epoch);
  }
}

// Here the heartbeat of a state-machine stands for another CLOCK_MONOTONIC, 100 s ahead or behind.
TEST_F(HostileSegment, AProgramWithAnotherMonotonicClockIsToldByTheHeartbeatsOfTheStateMachine) {
  for (const std::int64_t offset_ns : {std::int64_t{100'000'000'000}, std::int64_t{-100'000'000'000}}) {
    SharedMemory<std::atomic<int>> phase;
    ChildProcess leader([&] {
      Session own = *Session::open(name_, "state-machine");
      const auto claim = own.claim(Role::state_machine);
      for (*phase = 1;; std::this_thread::sleep_for(std::chrono::milliseconds(1)))
        for (ProcessEntry& entry : own.layout().processes)
          if (entry.pid == getpid()) entry.heartbeat_ns = monotonic_ns() + (*phase == 2 ? offset_ns : 0);
    });
    ASSERT_TRUE(wait_until([&] { return *phase == 1; }));
    EXPECT_FALSE(owner_.has_foreign_clock());
    *phase = 2;
    EXPECT_TRUE(wait_until([&] { return owner_.has_foreign_clock(); }));
    if (offset_ns < 0) continue;
    // The session's clock was set by that state-machine. This program must not take it for damaged.
    ClockState theirs = owner_.clock();
    theirs.base_monotonic_ns = monotonic_ns() + offset_ns / 2;
    EXPECT_TRUE(test::set_clock(owner_, theirs));
    EXPECT_FALSE(owner_.clock_problem());
    leader.kill_now();
    EXPECT_TRUE(owner_.clock_problem());
    owner_.restore_clock();
  }
}

TEST_F(HostileSegment, RestoreClockPublishesTheLastValidClockAgain) {
  const ClockState good = owner_.clock();
  ClockState bad = good;
  bad.rate = 99.0;
  layout().clock.publish(bad);
  owner_.restore_clock();
  EXPECT_FALSE(owner_.clock_problem());
  const auto joined = Session::open(name_, "another");
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->clock().epoch, good.epoch) << "the time continues in the same epoch";
  EXPECT_EQ(joined->clock().base_monotonic_ns, good.base_monotonic_ns);
  wipe_clock();
  owner_.restore_clock();
  EXPECT_FALSE(owner_.clock_problem());
  // The version (state word / 2) overflows to 0, which means that no value was ever published.
  reinterpret_cast<std::atomic<std::uint64_t>*>(&layout().clock)->store(~std::uint64_t{0});
  for (int tick = 0; tick < 3; ++tick) owner_.restore_clock();
  EXPECT_FALSE(owner_.clock_problem());
}

TEST_F(HostileSegment, ASettingOfTheClockOutOfRangeIsRefused) {
  const ClockState good = owner_.clock();
  for (const std::int64_t base_ns : {std::int64_t{-1}, kLatestClockBase_ns + 1, kHighest}) {
    ClockState bad = good;
    bad.base_sim_ns = base_ns;
    const auto refused = test::set_clock(owner_, bad);
    ASSERT_FALSE(refused) << base_ns;
    EXPECT_NE(refused.error().message().find("base_sim_ns"), std::string::npos) << refused.error().message();
  }
  EXPECT_EQ(owner_.clock().base_sim_ns, good.base_sim_ns);
  ClockState last = good;
  last.base_sim_ns = kLatestClockBase_ns;
  EXPECT_TRUE(test::set_clock(owner_, last)) << "the latest valid time can be set";
  EXPECT_TRUE(Session::open(name_, "another"));
  EXPECT_FALSE(owner_.clock_problem());
}

TEST_F(HostileSegment, ADamagedEntryOfTheProcessTableIsRewrittenByHeartbeats) {
  for (ProcessEntry& entry : layout().processes) {
    entry.pid = 0;
    for (auto& word : entry.name) word = 0;
  }
  EXPECT_TRUE(owner_.processes().empty());
  const auto is_back = [&] {
    owner_.heartbeat();
    const auto here = owner_.processes();
    return here.size() == 1 && here[0].pid == getpid() && here[0].name == "owner";
  };
  const std::int64_t deadline_ns = monotonic_ns() + 60'000'000'000;
  while (!is_back() && monotonic_ns() < deadline_ns) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(is_back());
}

// A frame with the greatest 64-bit number as its id would stay the newest for ever.
TEST_F(HostileSegment, AFrameWithAnIdAboveTheLimitIsIgnoredAndOverwritten) {
  const std::vector<std::uint8_t> pixels(16);
  GlassFrame frame{};
  frame.width = frame.height = 2;
  frame.id = 1;
  publish_frame(layout(), frame, pixels);
  for (const std::uint64_t id : {~std::uint64_t{0}, kLatestPictureId + 1, kLatestPictureId}) {
    FrameSlot& slot = layout().frames[2];
    GlassFrame hostile = frame;
    hostile.id = id;
    shm::store_words<shm::PlainAccess>(slot.frame.data(), &hostile, shm::kWordsOf<GlassFrame>);
    slot.id = id;
    std::uint64_t seen = 0;
    GlassFrame found{};
    std::vector<std::uint8_t> there;
    if (read_newest_frame(layout(), seen, found, there)) seen = found.id;
    frame.id += 1;
    publish_frame(layout(), frame, pixels);
    ASSERT_TRUE(read_newest_frame(layout(), seen, found, there)) << id << ": the reader found no new frame";
    EXPECT_EQ(found.id, frame.id) << id;
  }
}

TEST(ModelValidation, APictureWithAnIdAboveTheLimitIsRefused) {
  GlassFrame frame{};
  frame.width = frame.height = 2;
  frame.id = kLatestPictureId;
  EXPECT_FALSE(validate(frame));
  ++frame.id;
  EXPECT_TRUE(validate(frame)->starts_with("id: expected at most 9007199254740992, found"));
  ModelStatus status{};
  status.map_newest = kHighest;
  EXPECT_TRUE(validate(status)->starts_with("map_newest"));
}

TEST_F(HostileSegment, AParticipantUsesTheLastValidClockAndNotesTheInvalidOneOnce) {
  const ClockState good = owner_.clock();
  ClockState bad = good;
  bad.base_monotonic_ns = kLowest;
  layout().clock.publish(bad);
  EXPECT_EQ(owner_.clock().base_monotonic_ns, good.base_monotonic_ns);
  EXPECT_GE(owner_.sim_time_ns(), 0);
  owner_.sim_time_ns();
  EXPECT_EQ(layout().note_counts[static_cast<std::size_t>(NoteKind::refusal)].load(), 1U) << "noted once";
}

TEST_F(HostileSegment, AClockThatBeginsWithinASecondStandsUntilThen) {
  ClockState clock = owner_.clock();
  clock.base_sim_ns = 7;
  clock.base_monotonic_ns = monotonic_ns() + 900'000'000;
  layout().clock.publish(clock);
  EXPECT_EQ(owner_.sim_time_ns(), 7);
}

TEST_F(HostileSegment, ALaneWithImpossibleCursorsIsEmptiedAtOnce) {
  auto& input = layout().input;
  auto* words = reinterpret_cast<std::atomic<std::uint64_t>*>(&input);
  words[0] = std::uint64_t{1} << 63U;  // number of pushed events of lane 0
  InputEvent event{};
  int taken = 0;
  while (taken < 1000 && input.pop(0, event)) ++taken;
  EXPECT_EQ(taken, 0);
  EXPECT_TRUE(input.empty(0));
  ASSERT_TRUE(input.push(0, event));
  EXPECT_TRUE(input.pop(0, event)) << "the next source can use the lane";
}

TEST_F(HostileSegment, AHeartbeatInTheFutureIsReadAsNotLaterThanNow) {
  for (ProcessEntry& entry : layout().processes)
    if (entry.pid == getpid()) entry.heartbeat_ns = kHighest;
  const auto here = owner_.processes();
  ASSERT_EQ(here.size(), 1U);
  EXPECT_LE(here[0].heartbeat_ns, monotonic_ns());
}

TEST_F(HostileSegment, ALockstepSetDoesNotContinueFromAnInvalidTick) {
  for (const std::int64_t tick : {kLowest, std::int64_t{-2}, kHighest}) {
    layout().lockstep.done_tick[0] = tick;
    const auto loop = runtime::TickLoop::create(owner_, LockstepRole::flight_model, "flight-model@10");
    ASSERT_FALSE(loop) << tick;
    EXPECT_NE(loop.error().message().find("the session is damaged"), std::string::npos) << loop.error().message();
  }
}

TEST(ModelValidation, AStatusOrASweepOutOfRangeIsRefusedByName) {
  ModelStatus status{};
  EXPECT_FALSE(validate(status));
  status.antenna_azimuth_deg = 1e9;
  EXPECT_EQ(validate(status), "antenna_azimuth_deg: expected [-180, 180], found 1e+09");
  status = {};
  status.sim_time_ns = kHighest;
  EXPECT_TRUE(validate(status));
  status = {};
  std::memset(status.why_not, 'x', sizeof status.why_not);
  EXPECT_TRUE(validate(status));
  status = {};
  status.ownship.latitude_deg = 91.0;
  EXPECT_TRUE(validate(status)->starts_with("ownship: latitude_deg"));
  Sweep sweep{};
  EXPECT_FALSE(validate(sweep));
  sweep.samples = radar::kMaxSamples + 1;
  EXPECT_EQ(validate(sweep), "samples: expected [0, 4096], found 4097");
}

TEST(ModelValidation, ARadarStateWithTicksAtTheEndsOfTheirTypeIsRefused) {
  RadarState state{};
  state.channel = 1;
  ASSERT_EQ(validate(state).value_or(""), "");
  state.cursor_moved_tick = kLowest;
  EXPECT_TRUE(validate(state)->starts_with("cursor_moved_tick"));
}

}  // namespace
}  // namespace yars::databuffer
