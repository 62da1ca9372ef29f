// Tests of Session: clock, claims of roles and lanes, process table, notes, read-only sessions, life of the segment.
#include "databuffer/session/session.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "tests/databuffer/session/open_session.hpp"
#include "tests/databuffer/session/set_clock.hpp"
#include "tests/shm/child_process.hpp"

namespace yars::databuffer {
namespace {

using shm::testing::ChildProcess;
using shm::testing::SharedMemory;
using shm::testing::wait_until;

using SessionTest = testing::OpenSessionTest;

TEST_F(SessionTest, AFreshSessionRunsAtRateOneFromSimTimeZero) {
  const std::int64_t before = monotonic_ns();
  Session session = open();
  const std::int64_t sim = session.sim_time_ns();
  const std::int64_t after = monotonic_ns();
  EXPECT_GE(sim, 0);
  EXPECT_LE(sim, after - before);
  const ClockState clock = session.clock();
  EXPECT_EQ(clock.base_sim_ns, 0);
  EXPECT_EQ(clock.rate, 1.0);
  EXPECT_EQ(clock.running, 1u);
  EXPECT_EQ(clock.epoch, 0u);
  EXPECT_TRUE(std::isnan(clock.reposition_latitude_deg));
  EXPECT_EQ(session.layout().lockstep.end_tick, -1);
  for (const auto& done : session.layout().lockstep.done_tick) EXPECT_EQ(done, -1);
  EXPECT_EQ(session.layout().lockstep.enabled, 0u);
}

TEST_F(SessionTest, AllSessionsOfANameShareOneClock) {
  Session first = open();
  Session second = open();
  ClockState clock = first.clock();
  clock.running = 0;
  clock.base_sim_ns = 123'456;
  clock.epoch = 9;
  ASSERT_TRUE(test::set_clock(first, clock));
  EXPECT_EQ(second.sim_time_ns(), 123'456);
  EXPECT_EQ(second.clock().epoch, 9u);
}

TEST_F(SessionTest, InLockstepTheSessionHasComeToTheLastTickOfAllRoles) {
  Session session = open();
  EXPECT_GE(session.reached_sim_time_ns(), 0);
  auto& lockstep = session.layout().lockstep;
  lockstep.roles = 1U << 0 | 1U << 3;
  lockstep.enabled = 1;
  EXPECT_EQ(session.reached_sim_time_ns(), 0);
  lockstep.done_tick[0] = 8;
  EXPECT_EQ(session.reached_sim_time_ns(), 0) << "role 3 has done nothing";
  lockstep.done_tick[3] = 7;
  EXPECT_EQ(session.reached_sim_time_ns(), 35'000'000);
}

TEST_F(SessionTest, TheClockCannotBeSetWhileItsRoleIsHeld) {
  Session first = open("holder");
  Session second = open();
  auto claim = first.claim(Role::clock);
  ASSERT_TRUE(claim);
  const auto refused = test::set_clock(second, second.clock());
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find(std::to_string(getpid())), std::string::npos) << refused.error().message();
  *claim = Claim();
  EXPECT_TRUE(test::set_clock(second, second.clock()));
}

TEST(SimTime, FollowsRateAndFreeze) {
  ClockState clock{};
  clock.base_sim_ns = 1'000;
  clock.base_monotonic_ns = 500;
  clock.rate = 1.0;
  EXPECT_EQ(sim_time_at(clock, 700), 1'000) << "frozen";
  clock.running = 1;
  EXPECT_EQ(sim_time_at(clock, 700), 1'200);
  clock.rate = 2.5;
  EXPECT_EQ(sim_time_at(clock, 700), 1'500);
  clock.rate = 0.0;
  EXPECT_EQ(sim_time_at(clock, 700), 1'000);
  clock.rate = 1.0;
  constexpr std::int64_t kYears = std::int64_t{1} << 58;
  EXPECT_EQ(sim_time_at(clock, 500 + kYears + 1), 1'000 + kYears + 1) << "exact to 1 ns after nine years";
}

TEST_F(SessionTest, InvalidSessionNamesAreRefused) {
  for (const std::string& bad : {std::string(), std::string("a.b"), std::string("a/b"), std::string("../x"),
                                 std::string("with space"), std::string("\xc3\xa4"), std::string(41, 'a')}) {
    EXPECT_FALSE(Session::open(bad, "tester")) << bad;
    EXPECT_FALSE(Session::open_read_only(bad)) << bad;
  }
  EXPECT_TRUE(Session::open(name_ + "_-" + std::string(38 - name_.size(), 'Z'), "tester"))
      << "40 characters are allowed";
}

TEST_F(SessionTest, ARoleHasOneHolderWhoIsNamedToOthersUntilItDies) {
  Session session = open();
  SharedMemory<std::atomic<int>> held;
  ChildProcess child([&] {
    Session own = open("first-model");
    const auto claim = own.claim(Role::radar_model);
    *held = claim ? 1 : 2;
    for (;;) pause();
  });
  ASSERT_TRUE(wait_until([&] { return *held != 0; }));
  const auto refused = session.claim(Role::radar_model);
  ASSERT_FALSE(refused);
  const std::string message = refused.error().message();
  EXPECT_NE(message.find("radar-model"), std::string::npos) << message;
  EXPECT_NE(message.find("first-model, pid " + std::to_string(child.pid())), std::string::npos) << message;
  EXPECT_TRUE(session.role_is_held(Role::radar_model));
  EXPECT_FALSE(session.role_is_held(Role::state_machine));
  EXPECT_TRUE(session.claim(Role::state_machine));

  child.send(SIGSTOP);
  EXPECT_FALSE(session.claim(Role::radar_model)) << "a stopped process keeps its role";
  const std::int32_t dead = child.pid();
  child.kill_now();
  EXPECT_FALSE(session.role_is_held(Role::radar_model));
  EXPECT_TRUE(session.claim(Role::radar_model));
  EXPECT_NE(last_note(session).find(std::to_string(dead) + " died"), std::string::npos) << last_note(session);
  EXPECT_EQ(session.layout().note_counts[static_cast<std::size_t>(NoteKind::restart)], 1u);
}

TEST_F(SessionTest, AClaimEndsWithItsObjectAndCanBeMoved) {
  Session session = open();
  {
    auto claim = session.claim(Role::recorder);
    ASSERT_TRUE(claim);
    const Claim moved = std::move(*claim);
    EXPECT_TRUE(session.role_is_held(Role::recorder));
    EXPECT_FALSE(session.claim(Role::recorder)) << "the same process cannot claim it twice";
  }
  EXPECT_FALSE(session.role_is_held(Role::recorder));
  EXPECT_TRUE(session.claim(Role::recorder));
  EXPECT_EQ(session.layout().notes.total(), 0u) << "a released role is no restart";
}

TEST_F(SessionTest, ThereAreFourOwnshipLanesWithOneWriterEach) {
  Session session = open("pilot");
  std::vector<Claim> claims;
  for (std::size_t lane = 0; lane < kOwnshipLanes; ++lane) {
    auto claim = session.claim_ownship_lane(10 + static_cast<std::uint32_t>(lane));
    ASSERT_TRUE(claim);
    EXPECT_EQ(claim->lane(), static_cast<int>(lane));
    EXPECT_EQ(session.layout().ownship_priority[lane], 10 + lane);
    EXPECT_TRUE(session.ownship_lane_is_held(lane));
    claims.push_back(std::move(*claim));
  }
  const auto refused = session.claim_ownship_lane(99);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("pilot"), std::string::npos) << refused.error().message();
  claims.erase(claims.begin() + 2);
  EXPECT_EQ(session.claim_ownship_lane(99)->lane(), 2);
}

TEST_F(SessionTest, AnOwnshipLaneIsClearedWhenItsWriterLeavesAndWhenItIsClaimedAgain) {
  Session session = open();
  Ownship out{};
  {
    const auto claim = session.claim_ownship_lane(1);
    session.layout().ownship[0].publish(Ownship{});
    EXPECT_TRUE(session.layout().ownship[0].read(out).has_value());
  }
  EXPECT_FALSE(session.layout().ownship[0].read(out).has_value());

  ChildProcess writer([&] {
    Session own = open();
    const auto claim = own.claim_ownship_lane(1);
    own.layout().ownship[0].publish(Ownship{});
    own.layout().nav[0].publish(Nav{});
    kill(getpid(), SIGKILL);
  });
  EXPECT_EQ(writer.wait(), -SIGKILL);
  EXPECT_TRUE(session.layout().ownship[0].has_value()) << "the last value of a dead writer remains";
  EXPECT_FALSE(session.ownship_lane_is_held(0));
  const auto claim = session.claim_ownship_lane(5);
  EXPECT_EQ(claim->lane(), 0);
  EXPECT_FALSE(session.layout().ownship[0].has_value());
  EXPECT_FALSE(session.layout().nav[0].has_value());
}

TEST_F(SessionTest, AnInputLaneIsReusedOnlyWhenItIsFreeAndEmpty) {
  Session session = open();
  auto first = session.claim_input_lane("window");
  ASSERT_TRUE(first);
  EXPECT_EQ(first->lane(), 0);
  EXPECT_EQ(session.layout().input.source(0), "window");
  EXPECT_TRUE(session.input_lane_is_held(0));
  EXPECT_EQ(session.claim_input_lane("script")->lane(), 1);
  ASSERT_TRUE(session.layout().input.push(0, InputEvent{}));
  *first = Claim();
  EXPECT_EQ(session.claim_input_lane("script")->lane(), 1) << "lane 0 still has an unread event";
  InputEvent out{};
  ASSERT_TRUE(session.layout().input.pop(0, out));
  EXPECT_EQ(session.claim_input_lane("script")->lane(), 0);
}

TEST_F(SessionTest, WhenAllInputLanesAreTakenTheMessageNamesTheirSources) {
  Session session = open();
  std::vector<Claim> claims;
  for (std::size_t lane = 0; lane < kInputLanes; ++lane) {
    auto claim = session.claim_input_lane("source" + std::to_string(lane));
    ASSERT_TRUE(claim);
    claims.push_back(std::move(*claim));
  }
  const auto refused = session.claim_input_lane("one too many");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("source15"), std::string::npos) << refused.error().message();
}

TEST_F(SessionTest, TheProcessTableShowsLiveProcesses) {
  Session session = open("parent");
  SharedMemory<std::atomic<int>> ready;
  ChildProcess child([&] {
    Session own = open("a name of more than twenty-three letters");
    ++*ready;
    for (;;) pause();
  });
  ASSERT_TRUE(wait_until([&] { return *ready == 1; }));
  const auto processes = session.processes();
  ASSERT_EQ(processes.size(), 2u);
  EXPECT_EQ(processes[0].name, "parent");
  EXPECT_EQ(processes[0].pid, getpid());
  EXPECT_EQ(processes[1].name, "a name of more than twe");
  EXPECT_EQ(processes[1].pid, child.pid());
  child.kill_now();
  EXPECT_EQ(session.processes().size(), 1u);
  EXPECT_EQ(open("next").processes().size(), 2u) << "the entry of the dead process is reused";
  const std::int64_t before = session.processes()[0].heartbeat_ns;
  session.heartbeat();
  EXPECT_GT(session.processes()[0].heartbeat_ns, before);
}

TEST_F(SessionTest, ProcessesBeyondTheSizeOfTheTableStillTakePart) {
  std::vector<Session> sessions;
  for (std::size_t n = 0; n < kProcesses + 2; ++n) sessions.push_back(open());
  EXPECT_EQ(sessions[0].processes().size(), kProcesses);
  EXPECT_TRUE(sessions.back().claim(Role::recorder));
  sessions.back().heartbeat();
  sessions.clear();
  EXPECT_FALSE(file_exists());
}

TEST_F(SessionTest, NotesHaveProcessTimeKindAndText) {
  Session session = open("state-machine");
  session.note(NoteKind::refusal, "latitude: expected [-90, 90], found 91");
  session.note(NoteKind::loss, std::string(200, 'x'));
  const auto& notes = session.layout().notes;
  Note note{};
  ASSERT_TRUE(notes.read(0, note));
  EXPECT_STREQ(note.text, "latitude: expected [-90, 90], found 91");
  EXPECT_STREQ(note.process, "state-machine");
  EXPECT_EQ(note.pid, getpid());
  EXPECT_EQ(note.kind, static_cast<std::uint32_t>(NoteKind::refusal));
  EXPECT_LE(note.monotonic_ns, monotonic_ns());
  ASSERT_TRUE(notes.read(1, note));
  EXPECT_EQ(std::string(note.text), std::string(sizeof note.text - 1, 'x')) << "cut to the length of the field";
  EXPECT_EQ(session.layout().note_counts[static_cast<std::size_t>(NoteKind::refusal)], 1u);
  EXPECT_EQ(session.layout().note_counts[static_cast<std::size_t>(NoteKind::loss)], 1u);
}

TEST_F(SessionTest, ARemovedSegmentFileIsNotedOnceAndTheSessionContinues) {
  Session session = open("radar-model");
  EXPECT_TRUE(session.has_name());
  session.heartbeat();
  EXPECT_EQ(session.layout().notes.total(), 0u);
  ASSERT_EQ(unlink(path().c_str()), 0);
  EXPECT_FALSE(session.has_name());
  EXPECT_TRUE(wait_until([&] {
    session.heartbeat();
    return session.layout().notes.total() > 0;
  }));
  EXPECT_NE(last_note(session).find("RemoveIPC"), std::string::npos) << last_note(session);
  Session newcomer = open();
  EXPECT_EQ(newcomer.processes().size(), 2u) << "the newcomer joins the same session";
  const auto before_ns = session.layout().processes[0].heartbeat_ns.load();
  EXPECT_TRUE(wait_until([&] {
    session.heartbeat();
    return session.layout().processes[0].heartbeat_ns > before_ns + 1'100'000'000;
  }));
  EXPECT_EQ(session.layout().notes.total(), 1u);
}

TEST_F(SessionTest, ANoteMayBeAboutAnotherProcess) {
  Session session = open("yars note");
  session.note(NoteKind::supervision, "started again", "radar-model");
  Note note{};
  ASSERT_TRUE(session.layout().notes.read(0, note));
  EXPECT_STREQ(note.process, "radar-model");
  EXPECT_EQ(note.kind, static_cast<std::uint32_t>(NoteKind::supervision));
}

TEST_F(SessionTest, AReadOnlySessionReadsAllAndChangesNothing) {
  auto session = std::make_unique<Session>(open("owner"));
  const auto claim = std::make_unique<Claim>(std::move(*session->claim(Role::radar_model)));
  session->note(NoteKind::loss, "one");
  auto reader = Session::open_read_only(name_);
  ASSERT_TRUE(reader) << reader.error().message();
  EXPECT_TRUE(reader->role_is_held(Role::radar_model));
  EXPECT_FALSE(reader->role_is_held(Role::state_machine));
  EXPECT_EQ(reader->processes().size(), 1u);
  EXPECT_GE(reader->sim_time_ns(), 0);
  EXPECT_FALSE(reader->claim(Role::state_machine));
  EXPECT_FALSE(reader->claim_ownship_lane(1));
  EXPECT_FALSE(reader->claim_input_lane("reader"));
  EXPECT_FALSE(test::set_clock(*reader, reader->clock()));
  reader->note(NoteKind::loss, "two");
  reader->heartbeat();
  EXPECT_EQ(session->layout().notes.total(), 1u);
}

TEST_F(SessionTest, TwoSessionsAreIndependent) {
  Session first = open();
  auto other = Session::open(name_ + "x", "tester");
  ASSERT_TRUE(other);
  EXPECT_TRUE(first.claim(Role::radar_model));
  const auto first_claim = first.claim(Role::radar_model);
  const auto other_claim = other->claim(Role::radar_model);
  EXPECT_TRUE(first_claim && other_claim);
  first.layout().radar_state.publish(RadarState{});
  EXPECT_FALSE(other->layout().radar_state.has_value());
}

TEST_F(SessionTest, TheLastProcessToLeaveRemovesTheSegment) {
  {
    const Session first = open();
    {
      const Session second = open();
    }
    EXPECT_TRUE(file_exists());
  }
  EXPECT_FALSE(file_exists());
  EXPECT_FALSE(Session::open_read_only(name_));
}

TEST_F(SessionTest, OnlyTheUsedSamplesOfASweepAreCopied) {
  Session session = open();
  auto sweep = std::make_unique<Sweep>();
  auto out = std::make_unique<Sweep>();
  sweep->samples = 100;
  std::fill(std::begin(sweep->video), std::end(sweep->video), std::uint8_t{7});
  session.layout().sweeps.publish(*sweep);
  std::uint64_t cursor = 0;
  ASSERT_TRUE(session.layout().sweeps.read(cursor, *out).delivered);
  EXPECT_EQ(out->samples, 100u);
  EXPECT_EQ(out->video[99], 7);
  EXPECT_EQ(out->video[200], 0) << "the rest of the reader's buffer is unchanged";
}

}  // namespace
}  // namespace yars::databuffer
