// Tests of the clients in C: a C program in a live session, and what only databuffer/client/yars.h does.
#include <gtest/gtest.h>
#include <spawn.h>

#include <array>
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

// Runs each test with three C programs: compiled with the current header, with the header of the first release, and
// linked with libyars-client.
class YarsClientTest : public testing::SessionTest, public ::testing::WithParamInterface<const char*> {};
std::string header_of(const ::testing::TestParamInfo<const char*>& test) {
  return std::array{"OfToday", "OfTheFirstRelease", "OfTheLibrary"}.at(test.index);
}
INSTANTIATE_TEST_SUITE_P(ByHeader, YarsClientTest,
                         ::testing::Values(YARS_C_CLIENT, YARS_FIRST_CLIENT, YARS_LIBRARY_CLIENT), header_of);

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

TEST_F(YarsHeaderTest, AClockWithoutARateStandsStill) {
  auto session = Session::open(name_, "tester");
  ASSERT_TRUE(session);
  yars_session s;
  ASSERT_EQ(yars_attach(&s, name_.c_str(), "c"), 0) << s.error;
  ClockState clock = session->clock();
  clock.base_sim_ns = 5;
  clock.rate = std::numeric_limits<double>::quiet_NaN();
  session->layout().clock.publish(clock);
  EXPECT_EQ(yars_sim_time_ns(&s), 5);
  yars_detach(&s);
}

}  // namespace
}  // namespace yars::databuffer
