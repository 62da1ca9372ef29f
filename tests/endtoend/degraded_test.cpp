// A set continues without power, input, frames, recording, flight model or clock, and reports each loss to the user.
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "databuffer/session/session.hpp"
#include "tests/endtoend/supervised_set.hpp"

namespace yars::endtoend {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Degraded : public Supervision {
 protected:
  // Kills all roles and removes the segment while the supervisor stands: the set goes on in a fresh session. Without
  // that it depends on who looks at the old segment, such as `yars watch`, whether the next roles find it in use.
  void kill_all_and_the_segment() {
    const auto watch = set_.watch();
    ::kill(set_.pid("start"), SIGSTOP);
    for (const auto& process : watch["processes"]) ::kill(process["pid"].get<int>(), SIGKILL);
    for (const auto& process : watch["processes"])
      EXPECT_TRUE(eventually([&] { return has_ended(process["pid"].get<int>()); }, kTimeout_s));
    EXPECT_TRUE(std::filesystem::remove("/dev/shm/yars." + std::to_string(::geteuid()) + "." + set_.session()));
    ::kill(set_.pid("start"), SIGCONT);
  }
  // True for a zombie, too, which has given back its locks.
  static bool has_ended(int pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::size_t name_end = text.rfind(')');
    return name_end == std::string::npos || text.substr(name_end, 3) == ") Z";
  }
  bool is_on_and_scans() {
    const auto first = set_.watch();
    if (first.is_null() || first["power"] != "OPR") return false;
    const auto sweeps = first["sweeps"].get<std::uint64_t>();
    return set_.wait_until([&](const auto& watch) { return watch["sweeps"] > sweeps; }, kTimeout_s);
  }
};

// state-machine dies twice, then all programs die. A power-on that is sent meanwhile reaches no state-machine, and must
// be sent again.
TEST_F(Degraded, PowerOnIsSentUntilTheRadarIsOnAgain) {
  start_and_wait();
  ASSERT_NO_FATAL_FAILURE(kill_and_wait_for_the_next("state-machine"));
  const int second = pid_of("state-machine");
  ::kill(second, SIGKILL);
  kill_all_and_the_segment();
  EXPECT_TRUE(eventually([&] { return is_on_and_scans(); }, kTimeout_s)) << start_log() << set_.watch().dump();
  EXPECT_THAT(start_log(), HasSubstr("power-on is sent again"));
}

TEST_F(Degraded, ARadarThatThePilotSwitchedOffStaysOffAndTheStatusReportsIt) {
  start_and_wait();
  ASSERT_EQ(set_.yars({"inject", "power off"}).code, 0);
  ASSERT_NO_FATAL_FAILURE(kill_and_wait_for_the_next("radar-model"));
  ASSERT_NO_FATAL_FAILURE(kill_and_wait_for_the_next("state-machine"));
  EXPECT_THAT(reasons(), HasSubstr("the radar is off"));
  EXPECT_EQ(set_.yars({"status"}).code, 3) << "exit code of DEGRADED";
  EXPECT_EQ(set_.watch()["power"], "OFF");
}

TEST_F(Degraded, ARoleThatEndsUnrequestedIsStartedAgain) {
  start_and_wait();
  const int before = pid_of("flight-model");
  ASSERT_GT(before, 0);
  ::kill(before, SIGTERM);
  EXPECT_TRUE(set_.wait_until(
      [&](const auto& watch) {
        return watch["processes"].contains("flight-model") && watch["processes"]["flight-model"]["pid"] != before;
      },
      kTimeout_s))
      << start_log();
  EXPECT_THAT(start_log(), HasSubstr("flight-model ended with code 0; starting it again (1 of 5"));
  EXPECT_TRUE(set_.runs("start"));
  EXPECT_EQ(end(), 0) << start_log();
}

TEST_F(Degraded, ARoleThatTheRadarDoesNotNeedIsRetriedEvery30SecondsAfterItsSixthDeath) {
  start_and_wait();
  for (int death = 0; death < 5; ++death) ASSERT_NO_FATAL_FAILURE(kill_and_wait_for_the_next("flight-model"));
  ::kill(pid_of("flight-model"), SIGKILL);
  EXPECT_TRUE(eventually([&] { return start_log().find("tried again every 30 s") != std::string::npos; }, kTimeout_s));
  EXPECT_TRUE(set_.runs("start"));
  EXPECT_TRUE(
      eventually([&] { return reasons().find("no ownship: no source runs") != std::string::npos; }, kTimeout_s));
  EXPECT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].contains("flight-model"); }, 120.0));
  EXPECT_EQ(end(), 0) << start_log();
}

// Frames and recording go to a tmpfs of 4 MiB. A file of 3.9 MB leaves no room for both; then the test removes it.
TEST_F(Degraded, AFullDiskStopsOnlyFramesAndRecording) {
  const auto disk = set_.folder() / "disk";
  std::filesystem::create_directories(disk);
  const std::string mount = "mount -t tmpfs -o size=4m tmpfs " + disk.string();
  if (run_tool({"unshare", "-m", "sh", "-c", mount}).code != 0) GTEST_SKIP() << "needs root";
  const std::string ballast = "head -c 3900000 /dev/zero >" + disk.string() + "/ballast";
  start({"--record", (disk / "flight").string(), "--frames", (disk / "frames").string(), "--every", "0.2"},
        "fixed:37.5,-122.9,15000,90,480",
        {"unshare", "-m", "sh", "-c", mount + " && " + ballast + " && exec \"$@\"", "sh"});
  EXPECT_TRUE(eventually(
      [&] {
        const auto now = reasons();
        return now.find("the recorder does not write") != std::string::npos &&
               now.find("the display cannot write its frames") != std::string::npos;
      },
      kTimeout_s))
      << reasons() << start_log();
  const double found_s = set_.watch()["sim_time"];
  EXPECT_TRUE(set_.wait_until([&](const auto& watch) { return watch["sim_time"] > found_s + 2.0; }, kTimeout_s))
      << "time for ten more frames";
  EXPECT_TRUE(is_on_and_scans()) << start_log();
  EXPECT_EQ(occurrences(start_log(), "each frame tries again"), 1u) << "reported once";
  EXPECT_THAT(start_log(), Not(HasSubstr("starting it again")));
  const auto inside = std::filesystem::path("/proc") / std::to_string(pid_of("recorder")) / "root";
  std::filesystem::remove(inside.string() + (disk / "ballast").string());
  EXPECT_TRUE(eventually([&] { return faults().empty(); }, kTimeout_s)) << reasons() << start_log();
  EXPECT_THAT(start_log(), HasSubstr("frames are written again"));
  EXPECT_EQ(end(), 0) << start_log();
}

TEST_F(Degraded, KeepFramesKeepsOnlyTheNewest) {
  start_and_wait({"--every", "0.1", "--keep-frames", "5"});
  const auto frames = set_.folder() / "frames";
  const auto newest = [&] {
    std::string name;
    for (const auto& entry : std::filesystem::directory_iterator(frames))
      name = std::max(name, entry.path().filename().string());
    return name;
  };
  const std::string before = newest();
  ASSERT_TRUE(eventually([&] { return newest() > before; }, kTimeout_s));
  const std::string later = newest();
  ASSERT_TRUE(eventually([&] { return newest() > later; }, kTimeout_s));
  EXPECT_EQ(end(), 0) << start_log();
  std::ptrdiff_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(frames)) count += entry.is_regular_file() ? 1 : 0;
  EXPECT_LE(count, 5);
}

TEST_F(Degraded, AnExistingRecordingIsNotOverwritten) {
  const auto recording = set_.folder() / "flight";
  std::ofstream(recording) << "somebody's flight";
  start({"--record", recording.string()});
  EXPECT_EQ(set_.wait("start"), 2);
  EXPECT_THAT(start_log(), HasSubstr("--overwrite"));
  EXPECT_EQ(std::filesystem::file_size(recording), 17u);
}

TEST_F(Degraded, ASimTimeAboveTheLimitIsRefusedAndTheSetContinues) {
  for (const auto* role : {"state-machine", "radar-model"}) set_.start(role, {role});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].size() == 2; }, kTimeout_s));
  EXPECT_EQ(set_.yars({"sim", "reset", "6e8"}).code, 2);
  EXPECT_EQ(set_.yars({"sim", "reset", "576460752"}).code, 0) << "the greatest time allowed";
  EXPECT_EQ(set_.yars({"inject", "power opr"}).code, 0) << "a program joins";
  EXPECT_EQ(set_.yars({"sim", "reset", "0"}).code, 0);
  EXPECT_LT(set_.watch()["sim_time"].get<double>(), 600.0);
}

// A clock record out of range: state-machine repairs it at its next tick. Without state-machine, `yars sim reset` or
// the next program that joins repairs it.
TEST_F(Degraded, ADamagedClockIsRepaired) {
  set_.start("state-machine", {"state-machine"});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].size() == 1; }, kTimeout_s));
  const auto session = databuffer::Session::open(set_.session(), "vandal");
  ASSERT_TRUE(session);
  auto& clock = const_cast<databuffer::Session&>(*session).layout().clock;
  const auto spoil = [&] {
    databuffer::ClockState bad = session->clock();
    bad.base_sim_ns = -1;
    clock.publish(bad);
  };
  spoil();
  EXPECT_TRUE(eventually([&] { return !session->clock_problem(); }, kTimeout_s));
  set_.kill("state-machine", SIGKILL);
  set_.wait("state-machine");
  spoil();
  EXPECT_THAT(reasons(), HasSubstr("the session's clock is damaged"));
  EXPECT_EQ(set_.yars({"sim", "reset", "5"}).code, 0) << "the repair that `yars status` proposes";
  EXPECT_FALSE(session->clock_problem());
  spoil();
  set_.start("radar-model", {"radar-model"});
  EXPECT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].contains("radar-model"); }));
  EXPECT_FALSE(session->clock_problem());
}

TEST_F(Degraded, AnInputMonitorThatDiedIsReported) {
  const auto script = set_.folder() / "script";
  std::ofstream(script) << "0.1 power opr\n3000 freeze\n";
  set_.start("state-machine", {"state-machine"});
  set_.start("input-monitor", {"input-monitor", "--source", "script:" + script.string()});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["power"] == "OPR"; }, kTimeout_s));
  EXPECT_THAT(reasons(), Not(HasSubstr("no input")));
  set_.kill("input-monitor", SIGKILL);
  set_.wait("input-monitor");
  EXPECT_THAT(reasons(), HasSubstr("no input: all senders of events have died"));
}

// Up to 500 invalid records a second are counted and reported. The earlier note of a restart stays in the status.
TEST_F(Degraded, AFloodOfInvalidRecordsHidesNoOtherNote) {
  for (const auto* role : {"state-machine", "radar-model"}) set_.start(role, {role});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].size() == 2; }, kTimeout_s));
  ASSERT_EQ(set_.yars({"note", "--restarted", "radar-model", "was killed"}).code, 0);
  auto session = databuffer::Session::open(set_.session(), "hostile");
  ASSERT_TRUE(session);
  const auto claim = session->claim_ownship_lane(99);
  ASSERT_TRUE(claim);
  databuffer::Ownship bad{};
  const auto lane = static_cast<std::size_t>(claim->lane());
  nlohmann::json report;
  const auto is_reported = [&] {
    for (int i = 0; i < 100; ++i) {
      bad.latitude_deg += 91.0;
      session->layout().ownship[lane].publish(bad);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    report = status();
    return report["note_counts"]["refusal"] > 100 &&
           report["health"]["reasons"].dump().find("records are being refused") != std::string::npos;
  };
  EXPECT_TRUE(eventually(is_reported, kTimeout_s)) << report.dump(1).substr(0, 2000);
  EXPECT_LT(report["notes"].size(), 40u) << report["notes"].dump(1).substr(0, 2000);
  for (const auto& role : report["roles"]) EXPECT_EQ(role["restarts"], role["name"] == "radar-model" ? 1 : 0);
}

// Writes the counts that a slow radar-model would write, because no test can rely on a slow machine.
TEST_F(Degraded, ARoleThatSkipsManyTicksIsTooSlowWithARemedy) {
  for (const auto* role : {"state-machine", "radar-model"}) set_.start(role, {role});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].size() == 2; }, kTimeout_s));
  auto session = databuffer::Session::open(set_.session(), "slow");
  ASSERT_TRUE(session);
  // The input monitor does not run, so nobody else counts there.
  auto& skipped = session->layout().skipped_ticks[1];
  const std::int64_t now_ns = databuffer::monotonic_ns();
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  skipped.add(190, now_ns);
  EXPECT_THAT(reasons(), Not(HasSubstr("input-monitor skipped"))) << "one stall";
  for (const int ago : {1, 2}) skipped.add(20, now_ns - ago * kSecond_ns);
  EXPECT_THAT(reasons(),
              HasSubstr("too slow: input-monitor skipped 12 % of its ticks in the last 10 s; end other programs"));
  EXPECT_EQ(set_.yars({"status"}).code, 3);
  auto& model = session->layout().skipped_ticks[3];
  for (const int ago : {0, 1, 2}) model.add(100, now_ns - ago * kSecond_ns);
  EXPECT_THAT(reasons(), HasSubstr("too slow: radar-model skipped"));
  EXPECT_THAT(reasons(), HasSubstr("choose a lower fidelity"));
}

}  // namespace
}  // namespace yars::endtoend
