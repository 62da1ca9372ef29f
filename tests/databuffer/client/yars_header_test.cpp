// Tests of databuffer/client/yars.h: a C program in a live session, and its functions called from this process.
#include <gtest/gtest.h>
#include <spawn.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "databuffer/client/yars.h"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/session.hpp"
#include "tests/databuffer/client/yars_header_layout.hpp"
#include "tests/databuffer/session/session_name.hpp"
#include "tests/databuffer/session/set_clock.hpp"
#include "tests/shm/child_process.hpp"

namespace yars::databuffer {
namespace {

class YarsHeaderTest : public testing::SessionTest {};

// Runs each test with two C programs: compiled with the current header, and with the header of the first release.
class YarsClientTest : public testing::SessionTest, public ::testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(ByHeader, YarsClientTest, ::testing::Values(YARS_C_CLIENT, YARS_FIRST_CLIENT),
                         [](const auto& test) { return test.index == 0 ? "OfToday" : "OfTheFirstRelease"; });

// The C program as a child process, with pipes to its standard input and from its standard output.
class CClient {
 public:
  CClient(const char* path, const std::string& session, const char* mode) {
    std::array<int, 2> in{}, out{};
    if (pipe2(in.data(), O_CLOEXEC) != 0 || pipe2(out.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in[0], 0);
    posix_spawn_file_actions_adddup2(&actions, out[1], 1);
    std::string program = path, name = session, mode_argument = mode;
    char* arguments[] = {program.data(), name.data(), mode_argument.data(), nullptr};
    if (posix_spawn(&pid_, path, &actions, nullptr, arguments, environ) != 0) throw std::runtime_error("spawn");
    posix_spawn_file_actions_destroy(&actions);
    close(in[0]);
    close(out[1]);
    to_child_ = in[1];
    from_child_ = out[0];
  }
  CClient(const CClient&) = delete;
  CClient& operator=(const CClient&) = delete;
  ~CClient() {
    end();
    close(from_child_);
  }

  pid_t pid() const { return pid_; }
  // Next line of output. Blocks until the client has printed it, or has ended.
  std::string line() const {
    std::string text;
    for (char letter = 0; read(from_child_, &letter, 1) == 1 && letter != '\n';) text += letter;
    return text;
  }
  // Closes the client's standard input and waits for its end. Returns its exit code, or minus the signal that ended it.
  int end() {
    if (to_child_ >= 0) close(std::exchange(to_child_, -1));
    int status = 0;
    if (pid_ > 0) waitpid(std::exchange(pid_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t pid_ = -1;
  int to_child_ = -1, from_child_ = -1;
};

TEST_P(YarsClientTest, ACProgramReadsAndPublishesRecords) {
  auto session = Session::open(name_, "tester");
  ASSERT_TRUE(session);
  ClockState clock = session->clock();
  clock.epoch = 4;
  clock.running = 0;
  clock.base_sim_ns = 77;
  ASSERT_TRUE(test::set_clock(*session, clock));
  RadarState state{};
  state.range_nm = 40.0;
  session->layout().radar_state.publish(state);

  CClient client(GetParam(), name_, "stay");
  EXPECT_EQ(client.line(), "77") << "sim time as the C program reads it";
  Ownship ownship{};
  ASSERT_EQ(session->layout().ownship[0].read(ownship), 2u) << "cleared once, published once";
  EXPECT_EQ(ownship.latitude_deg, 34.5);
  EXPECT_EQ(ownship.altitude_msl_m, 40.0) << "copied from the radar state";
  EXPECT_EQ(ownship.epoch, 4u);
  EXPECT_STREQ(ownship.source, "c client");
  EXPECT_EQ(session->layout().ownship_priority[0], 70u);
  Nav nav{};
  ASSERT_TRUE(session->layout().nav[0].read(nav));
  EXPECT_EQ(nav.ins_longitude_deg, -120.25);
  Traffic traffic{};
  ASSERT_TRUE(session->layout().traffic.read(traffic));
  EXPECT_EQ(traffic.count, 1u);
  EXPECT_EQ(traffic.entities[0].latitude_deg, 34.25);
  EXPECT_EQ(traffic.entities[0].id, 9u);
  EXPECT_TRUE(session->role_is_held(Role::traffic));
  InputEvent event{};
  ASSERT_TRUE(session->layout().input.pop(0, event));
  EXPECT_EQ(event.kind, static_cast<std::uint16_t>(EventKind::push_button));
  EXPECT_EQ(event.argument, 13);
  EXPECT_EQ(event.number, 1u);
  EXPECT_EQ(event.session_time_ns, 77);
  EXPECT_STREQ(event.text, "from C");
  EXPECT_EQ(session->layout().input.source(0), "c input");

  EXPECT_TRUE(session->ownship_lane_is_held(0));
  EXPECT_TRUE(session->input_lane_is_held(0));
  EXPECT_EQ(session->claim_ownship_lane(1)->lane(), 1) << "the C program has locked lane 0";
  ASSERT_EQ(session->processes().size(), 2u);
  EXPECT_EQ(session->processes()[1].name, "c-client");
  EXPECT_EQ(session->processes()[1].pid, client.pid());

  EXPECT_EQ(client.end(), 0);
  EXPECT_FALSE(session->ownship_lane_is_held(0));
  EXPECT_FALSE(session->layout().ownship[0].has_value()) << "withdrawn";
  EXPECT_FALSE(session->layout().traffic.has_value()) << "withdrawn";
  EXPECT_FALSE(session->role_is_held(Role::traffic));
  EXPECT_EQ(session->processes().size(), 1u);
  EXPECT_TRUE(file_exists());
}

TEST_P(YarsClientTest, ACProgramReadsTheNewestFrameOfTheDisplay) {
  auto session = Session::open(name_, "tester");
  ASSERT_TRUE(session);
  EXPECT_EQ(CClient(GetParam(), name_, "look").end(), 4) << "no frame yet";
  GlassFrame frame{};
  frame.width = 3;
  frame.height = 5;  // 60 bytes: the last word is half full
  for (frame.id = 1; frame.id <= 4; ++frame.id)
    publish_frame(session->layout(), frame, std::vector<std::uint8_t>(60, static_cast<std::uint8_t>(frame.id)));
  CClient client(GetParam(), name_, "look");
  EXPECT_EQ(client.line(), "3 x 5: 240") << "the fourth frame: 60 bytes of 4";
  EXPECT_EQ(client.end(), 0);
}

TEST_P(YarsClientTest, ACProgramThatLeavesLastRemovesTheSegment) {
  auto session = std::make_unique<Session>(std::move(*Session::open(name_, "tester")));
  session->layout().radar_state.publish(RadarState{});
  CClient client(GetParam(), name_, "stay");
  EXPECT_FALSE(client.line().empty());
  session.reset();
  EXPECT_TRUE(file_exists());
  EXPECT_EQ(client.end(), 0);
  EXPECT_FALSE(file_exists());
}

TEST_F(YarsHeaderTest, AttachingWithoutASessionIsAnError) {
  yars_session s;
  EXPECT_EQ(yars_attach(&s, name_.c_str(), "tester"), -1);
  EXPECT_NE(std::string(s.error).find("no such session"), std::string::npos) << s.error;
  EXPECT_NE(std::string(s.error).find("start the set with --session " + name_ + ","), std::string::npos) << s.error;
  EXPECT_TRUE(std::string(s.error).ends_with("(`yars --session NAME status`)")) << s.error;
}

TEST_F(YarsHeaderTest, AnotherLayoutIsRefused) {
  auto session = Session::open(name_, "tester");
  ASSERT_TRUE(session);
  session->layout().header.hash += 1;
  yars_session s;
  EXPECT_EQ(yars_attach(&s, name_.c_str(), "tester"), -1);
  EXPECT_NE(std::string(s.error).find("expected layout version 3"), std::string::npos) << s.error;
  EXPECT_TRUE(file_exists());
}

TEST_F(YarsHeaderTest, EventsForAFullLaneAreDroppedAndCounted) {
  auto session = Session::open(name_, "tester");
  yars_session s;
  ASSERT_EQ(yars_attach(&s, name_.c_str(), "c"), 0) << s.error;
  ASSERT_EQ(yars_claim_input_lane(&s, "c"), 0);
  yars_input_event event{};
  for (std::size_t n = 0; n < kInputLaneDepth; ++n) ASSERT_EQ(yars_push_event(&s, &event), 0);
  EXPECT_EQ(yars_push_event(&s, &event), -1);
  EXPECT_EQ(session->layout().input.dropped(0), 1u);
  InputEvent out{};
  for (std::size_t n = 0; n < kInputLaneDepth; ++n) {
    ASSERT_TRUE(session->layout().input.pop(0, out));
    EXPECT_EQ(out.number, n + 1);
  }
  EXPECT_FALSE(session->layout().input.pop(0, out));
  EXPECT_EQ(yars_push_event(&s, &event), 0);
  yars_detach(&s);
}

TEST_F(YarsHeaderTest, ASetRunsWhileRadarModelOrStateMachineHoldsItsRole) {
  auto session = Session::open(name_, "tester");
  ASSERT_TRUE(session);
  yars_session s;
  ASSERT_EQ(yars_attach(&s, name_.c_str(), "c"), 0) << s.error;
  EXPECT_EQ(yars_set_runs(&s), 0) << "neither radar-model nor state-machine runs";
  {
    const auto model = session->claim(Role::radar_model);
    ASSERT_TRUE(model);
    EXPECT_EQ(yars_set_runs(&s), 1);
    const auto state_machine = session->claim(Role::state_machine);
    ASSERT_TRUE(state_machine);
    EXPECT_EQ(yars_set_runs(&s), 1);
  }
  EXPECT_EQ(yars_set_runs(&s), 0) << "both have ended";
  {
    const auto state_machine = session->claim(Role::state_machine);
    ASSERT_TRUE(state_machine);
    EXPECT_EQ(yars_set_runs(&s), 1);
  }
  yars_detach(&s);
  EXPECT_EQ(yars_set_runs(&s), 0) << "without a session";
}

Sweep sweep_of(std::uint32_t number, std::uint32_t samples) {
  Sweep sweep{};
  sweep.number = number;
  sweep.samples = samples;
  sweep.range_m = 1000.0 * number;
  std::fill_n(std::begin(sweep.video), std::min<std::size_t>(samples, radar::kMaxSamples),
              static_cast<std::uint8_t>(number % 200));
  return sweep;
}

// One session opened by C++ and by yars.h. C++ publishes sweeps, and yars.h reads them.
class YarsSweepTest : public YarsHeaderTest {
 protected:
  YarsSweepTest() : session_(std::move(*Session::open(name_, "tester"))) {
    if (yars_attach(&s_, name_.c_str(), "c") != 0) throw std::runtime_error(s_.error);
  }
  ~YarsSweepTest() override { yars_detach(&s_); }
  void publish(std::uint32_t first, std::uint32_t sweeps) {
    for (std::uint32_t n = 0; n < sweeps; ++n) session_.layout().sweeps.publish(sweep_of(first + n, 5));
  }
  // Reads all unread sweeps and returns their numbers.
  std::vector<std::uint32_t> read_all() {
    std::vector<std::uint32_t> numbers;
    while (yars_read_sweep(&s_, &cursor_, &sweep_) == 1) numbers.push_back(sweep_.number);
    return numbers;
  }

  Session session_;
  yars_session s_{};
  yars_sweep_cursor cursor_{};
  yars_sweep sweep_{};
};

TEST_F(YarsSweepTest, EachSweepIsReadOnceWithItsSamples) {
  EXPECT_EQ(yars_read_sweep(&s_, &cursor_, &sweep_), 0) << "none yet";
  publish(7, 2);
  ASSERT_EQ(yars_read_sweep(&s_, &cursor_, &sweep_), 1);
  EXPECT_EQ(sweep_.number, 7u);
  EXPECT_EQ(sweep_.range_m, 7000.0);
  EXPECT_EQ(sweep_.samples, 5u);
  EXPECT_EQ(std::vector<int>(sweep_.video, sweep_.video + 5), std::vector<int>(5, 7));
  EXPECT_EQ(read_all(), std::vector<std::uint32_t>{8});
  EXPECT_EQ(yars_read_sweep(&s_, &cursor_, &sweep_), 0);
  EXPECT_EQ(cursor_.lost, 0u);
}

TEST_F(YarsSweepTest, ALateReaderBeginsWithTheOldestAndHasLostNone) {
  publish(1, YARS_SWEEPS + 10);
  const auto numbers = read_all();
  ASSERT_EQ(numbers.size(), YARS_SWEEPS - 1u);
  EXPECT_EQ(numbers.front(), 12u);
  EXPECT_EQ(numbers.back(), YARS_SWEEPS + 10u);
  EXPECT_EQ(cursor_.lost, 0u);
}

TEST_F(YarsSweepTest, SweepsOverwrittenBeforeTheyAreReadAreCounted) {
  EXPECT_EQ(yars_read_sweep(&s_, &cursor_, &sweep_), 0) << "the cursor starts here";
  publish(1, YARS_SWEEPS + 10);
  EXPECT_EQ(read_all().size(), YARS_SWEEPS - 1u);
  EXPECT_EQ(cursor_.lost, 11u);
}

TEST_F(YarsSweepTest, AFrameLargerThanItsSlotIsNotRead) {
  GlassFrame frame{};
  frame.id = 1;
  frame.width = frame.height = kMaxFramePixels + 1;
  publish_frame(session_.layout(), frame, std::vector<std::uint8_t>(16));
  yars_glass_frame found{};
  std::vector<std::uint8_t> pixels(YARS_MOST_FRAME_BYTES);
  EXPECT_EQ(yars_read_frame(&s_, 0, &found, pixels.data()), 0);
}

TEST_F(YarsSweepTest, AClockWithoutARateStandsStill) {
  ClockState clock = session_.clock();
  clock.base_sim_ns = 5;
  clock.rate = std::numeric_limits<double>::quiet_NaN();
  session_.layout().clock.publish(clock);
  EXPECT_EQ(yars_sim_time_ns(&s_), 5);
}

TEST_F(YarsSweepTest, ASweepWithMoreSamplesThanTheMaximumIsSkipped) {
  session_.layout().sweeps.publish(sweep_of(1, YARS_MOST_SAMPLES + 1));
  publish(2, 1);
  EXPECT_EQ(read_all(), std::vector<std::uint32_t>{2});
  EXPECT_EQ(cursor_.lost, 1u);
}

}  // namespace
}  // namespace yars::databuffer
