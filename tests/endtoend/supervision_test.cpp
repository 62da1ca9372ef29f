// A set that scripts/start supervises: dead roles are restarted and reported, a role that cannot start ends the set,
// and a segment whose file name was removed keeps working. Also real-time priority of single roles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "tests/endtoend/supervised_set.hpp"

namespace yars::endtoend {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST_F(Supervision, ADeadRoleIsStartedAgainAndReported) {
  start_and_wait();
  EXPECT_THAT(faults(), ElementsAre()) << status().dump(1);
  kill_and_wait_for_the_next("radar-model");
  EXPECT_THAT(start_log(), HasSubstr("radar-model was killed by SIGKILL; starting it again (1 of 5"));
  kill_and_wait_for_the_next("radar-display");
  EXPECT_THAT(start_log(), HasSubstr("radar-display was killed by SIGKILL; starting it again (1 of 5"));
  const auto sweeps = set_.watch()["sweeps"].get<std::uint64_t>();
  EXPECT_TRUE(set_.wait_until([&](const auto& watch) { return watch["sweeps"] > sweeps + 50; })) << "no scan";
  const auto roles = status()["roles"];
  for (const auto& role : roles) {
    const bool died = role["name"] == "radar-model" || role["name"] == "radar-display";
    EXPECT_EQ(role["restarts"], died ? 1 : 0) << role.dump();
  }
  EXPECT_THAT(reasons(), HasSubstr("radar-model was started again once in the last minute"));
  EXPECT_THAT(set_.yars({"status"}).output, HasSubstr("started again: was killed by SIGKILL (1 of 5"));
  EXPECT_EQ(end(), 0) << start_log();
  EXPECT_FALSE(set_.segment_exists());
}

TEST_F(Supervision, ARecorderThatDiesKeepsWhatItWrote) {
  const auto recording = set_.folder() / "recording";
  start_and_wait({"--record", recording.string()});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["vtr"] == true; }, kTimeout_s)) << start_log();
  ASSERT_TRUE(eventually([&] { return std::filesystem::file_size(recording) > 10000; }, kTimeout_s));
  const auto before = std::filesystem::file_size(recording);
  kill_and_wait_for_the_next("recorder");
  EXPECT_GE(std::filesystem::file_size(recording.string() + ".1"), before);
  EXPECT_EQ(end(), 0) << start_log();
  EXPECT_TRUE(std::filesystem::exists(recording));
}

TEST_F(Supervision, OnlyTheOwnerMayReadTheLogFolder) {
  start_and_wait();
  EXPECT_EQ(end(), 0) << start_log();
  for (const auto* role : {"state-machine", "radar-model", "flight-model", "radar-display"}) {
    const auto log = logs_ / (std::string(role) + ".log");
    EXPECT_THAT(text_of_file(log), HasSubstr("info: ")) << log;
    struct stat file{};
    ASSERT_EQ(stat(log.c_str(), &file), 0) << log;
    EXPECT_EQ(file.st_mode & 0777, 0600u) << log;
  }
  struct stat folder{};
  ASSERT_EQ(stat(logs_.c_str(), &folder), 0);
  EXPECT_EQ(folder.st_mode & 0777, 0700u);
  EXPECT_THAT(set_.output_of("start"), HasSubstr("Logs are in " + logs_.string()));
}

TEST_F(Supervision, TheSixthDeathOfANeededRoleWithinAMinuteEndsTheSet) {
  start_and_wait();
  for (int death = 0; death < 5; ++death) ASSERT_NO_FATAL_FAILURE(kill_and_wait_for_the_next("state-machine"));
  // The role takes part in the session, so that the supervisor does not report a failed start.
  const int last = pid_of("state-machine");
  ASSERT_GT(last, 0);
  ::kill(last, SIGKILL);
  EXPECT_EQ(set_.wait("start"), 1);
  EXPECT_THAT(start_log(), HasSubstr("state-machine was killed by SIGKILL, the 6th time within 60 s"));
  EXPECT_THAT(start_log(), HasSubstr("its log is " + (logs_ / "state-machine.log").string()));
  EXPECT_FALSE(set_.segment_exists()) << "all other roles were ended";
}

TEST_F(Supervision, AFaultyConfigurationIsReportedOnceAndNothingIsStarted) {
  std::ofstream(set_.folder() / "bad.guf") << "( Apg70 :ranges ( 10 \n";
  start({"--config", (set_.folder() / "bad.guf").string()});
  EXPECT_EQ(set_.wait("start"), 1);
  const std::string log = start_log();
  const std::size_t first = log.find("bad.guf:");
  EXPECT_NE(first, std::string::npos) << log;
  EXPECT_EQ(log.find("bad.guf:", first + 1), std::string::npos) << log;
  EXPECT_THAT(log, HasSubstr("nothing was started"));
}

TEST_F(Supervision, ARoleThatCannotStartEndsTheSetAtOnceWithItsOwnError) {
  std::ofstream(set_.folder() / "bad.route") << "no route\n";
  start({}, "route:" + (set_.folder() / "bad.route").string());
  EXPECT_EQ(set_.wait("start"), 1);
  EXPECT_THAT(start_log(), HasSubstr("bad.route:"));
  EXPECT_THAT(start_log(), HasSubstr("before it took part"));
  EXPECT_THAT(start_log(), Not(HasSubstr("starting it again")));
}

TEST_F(Supervision, ARoleThatRefusesItsArgumentsIsNotStartedAgain) {
  start({}, "nonsense");
  EXPECT_EQ(set_.wait("start"), 1);
  EXPECT_THAT(start_log(), HasSubstr("flight-model refused its arguments"));
  EXPECT_THAT(start_log(), Not(HasSubstr("starting it again")));
}

TEST_F(Supervision, AHeadlessSetEndsAfterItsTimeWithCodeZero) {
  start({"--headless", "1"});
  EXPECT_EQ(set_.wait("start"), 0) << start_log();
  EXPECT_FALSE(set_.segment_exists());
  EXPECT_FALSE(std::filesystem::is_empty(set_.folder() / "frames"));
}

TEST_F(Supervision, ALockstepSetThatLosesARoleEnds) {
  start({"--lockstep", "--headless", "100000"});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["sweeps"] > 0; }, kTimeout_s)) << start_log();
  ::kill(pid_of("radar-model"), SIGKILL);
  EXPECT_EQ(set_.wait("start"), 1);
  EXPECT_THAT(start_log(), HasSubstr("radar-model was killed by SIGKILL"));
  EXPECT_THAT(start_log(), Not(HasSubstr("starting it again")));
}

TEST_F(Supervision, AnUnwritableLogFolderIsOneWarning) {
  std::ofstream(set_.folder() / "file") << "in the way";
  start({"--log-dir", (set_.folder() / "file" / "logs").string(), "--headless", "1"});
  EXPECT_EQ(set_.wait("start"), 0) << start_log();
  EXPECT_EQ(occurrences(start_log(), "--log-dir: expected a folder to write to"), 1u) << start_log();
}

// With RemoveIPC=yes systemd-logind removes the segment's file name at the user's last logout.
TEST_F(Supervision, ASegmentWithoutItsNameIsUsedFurtherAndProgramsCanJoin) {
  start_and_wait();
  ASSERT_EQ(set_.yars({"inject", "elevation -7"}).code, 0);
  ASSERT_TRUE(set_.segment_exists());
  std::filesystem::remove("/dev/shm/yars." + std::to_string(getuid()) + "." + set_.session());
  const std::vector<std::string> roles{"state-machine", "radar-model", "flight-model", "radar-display"};
  EXPECT_TRUE(eventually([&] { return occurrences(start_log(), "RemoveIPC") >= roles.size(); }, kTimeout_s))
      << start_log();
  const auto lost = status();
  EXPECT_EQ(lost["named"], false);
  EXPECT_THAT(reasons(), HasSubstr("name was removed"));
  const double before_s = set_.watch()["sim_time"];
  kill_and_wait_for_the_next("radar-model");
  kill_and_wait_for_the_next("state-machine");
  const auto sweeps = set_.watch()["sweeps"].get<std::uint64_t>();
  EXPECT_TRUE(set_.wait_until([&](const auto& watch) { return watch["sweeps"] > sweeps + 50; })) << start_log();
  const auto watch = set_.watch();
  EXPECT_GT(watch["sim_time"].get<double>(), before_s) << "the clock of the same session";
  EXPECT_EQ(watch["power"], "OPR");
  EXPECT_EQ(set_.yars({"inject", "elevation -5"}).code, 0) << "a new program joins the session";
  EXPECT_FALSE(set_.segment_exists()) << "no second segment was made";
  EXPECT_EQ(end(), 0) << start_log();
  const auto after = set_.yars({"status"});
  EXPECT_EQ(after.code, 1);
  EXPECT_THAT(after.output, HasSubstr("NOTHING RUNS"));
}

TEST_F(Supervision, StatusNamesHangingAndMissingRoles) {
  for (const auto* role : {"state-machine", "radar-model"}) set_.start(role, {role});
  set_.start("radar-display", {"radar-display", "--headless", "--frames", (set_.folder() / "frames").string()});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].size() == 3; }, kTimeout_s));
  EXPECT_THAT(reasons(), HasSubstr("the radar is off"));
  ASSERT_EQ(set_.yars({"inject", "power opr"}).code, 0);
  const std::vector<std::string> no_source{"no ownship: no source runs"};
  EXPECT_TRUE(eventually([&] { return faults() == no_source; }, kTimeout_s)) << reasons();
  const auto says = [&] { return set_.yars({"status"}).output; };
  EXPECT_THAT(says(), HasSubstr("display says: NO OWNSHIP; see yars status, or start a flight-model\n"));
  set_.kill("radar-display", SIGSTOP);
  EXPECT_TRUE(eventually([&] { return reasons().find("the display hangs") != std::string::npos; }, kTimeout_s));
  set_.kill("radar-display", SIGCONT);
  set_.kill("radar-model", SIGKILL);
  set_.wait("radar-model");
  EXPECT_TRUE(eventually([&] { return reasons() == R"(["radar-model is not running"])"; }, kTimeout_s)) << reasons();
  EXPECT_EQ(says().rfind("DEGRADED: radar-model is not running\n", 0), 0u) << says();
  EXPECT_THAT(says(), HasSubstr("display says: NO MODEL; start radar-model"));
  EXPECT_THAT(says(), ::testing::Not(HasSubstr("NO OWNSHIP"))) << "without a model nobody knows";
}

TEST_F(Supervision, ADeadSourceIsReportedAsNoOwnship) {
  for (const auto* role : {"state-machine", "radar-model"}) set_.start(role, {role});
  set_.start("flight-model", {"flight-model", "--source", "fixed:37.5,-122.9,15000,90,480"});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return !watch["ownship"].is_null(); }));
  ASSERT_EQ(set_.yars({"inject", "power opr"}).code, 0);
  set_.kill("flight-model", SIGSTOP);
  EXPECT_TRUE(eventually([&] { return reasons().find("its source is silent") != std::string::npos; }, kTimeout_s));
  EXPECT_EQ(status()["ownship_lanes"].size(), 1u) << "a stopped source keeps its lane";
  set_.kill("flight-model", SIGKILL);
  set_.wait("flight-model");
  EXPECT_TRUE(eventually([&] { return reasons() == R"(["no ownship: no source runs"])"; }, kTimeout_s)) << reasons();
  EXPECT_EQ(status()["ownship_lanes"].size(), 0u) << "the status does not list the lane of a dead source";
}

TEST_F(Supervision, ANoteIsInTheFlightRecorder) {
  EXPECT_EQ(set_.yars({"note", "nobody is there"}).code, 1);
  EXPECT_FALSE(set_.segment_exists()) << "a note makes no session";
  set_.start("state-machine", {"state-machine"});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].size() == 1; }, kTimeout_s));
  ASSERT_EQ(set_.yars({"note", "the cockpit door is open"}).code, 0);
  const auto note = status()["notes"].back();
  EXPECT_EQ(note["text"], "the cockpit door is open");
  EXPECT_EQ(note["kind"], "supervision");
  EXPECT_GE(note["age_s"], 0.0);
}

class Realtime : public Supervision {
 protected:
  // A command prefix that forbids real-time priority and locked memory. As root it drops the capabilities that would
  // override the limits.
  static std::vector<std::string> without_rights() {
    std::vector<std::string> command;
    if (geteuid() == 0) command = {"setpriv", "--bounding-set=-sys_nice,-ipc_lock"};
    command.insert(command.end(), {"prlimit", "--rtprio=0", "--memlock=65536"});
    return command;
  }
};

TEST_F(Realtime, ARefusedRightIsReportedAndTheRoleRunsWithoutIt) {
  auto command = without_rights();
  if (!tool_exists("setpriv") || !tool_exists("prlimit")) GTEST_SKIP() << "no setpriv or prlimit here";
  command.insert(command.end(), {std::string(YARS_BIN_DIR) + "/state-machine", "--session", set_.session(),
                                 "--realtime", "--cpus", "0,1001"});
  set_.start_tool("state-machine", command);
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].size() == 1; }, kTimeout_s))
      << set_.log_of("state-machine");
  const auto log = set_.log_of("state-machine");
  EXPECT_THAT(log, HasSubstr("CPU 1001 is not available"));
  EXPECT_THAT(log, HasSubstr("memory is not locked: expected RLIMIT_MEMLOCK unlimited, found 65536"));
  EXPECT_THAT(log, HasSubstr("with RLIMIT_RTPRIO 0; raise rtprio"));
  EXPECT_EQ(sched_getscheduler(set_.pid("state-machine")), SCHED_OTHER);
}

TEST_F(Realtime, OnlyTheThreadOfTheTicksHasRealTimePriority) {
  if (run_tool({"chrt", "-f", "1", "true"}).code != 0) GTEST_SKIP() << "SCHED_FIFO is not permitted here";
  set_.start("radar-model", {"radar-model", "--realtime"});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].size() == 1; }, kTimeout_s));
  const pid_t pid = set_.pid("radar-model");
  int real_time = 0;
  int threads = 0;
  for (const auto& task : std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/task")) {
    ++threads;
    const int policy = sched_getscheduler(std::stoi(task.path().filename().string())) & ~SCHED_RESET_ON_FORK;
    if (policy == SCHED_FIFO) ++real_time;
  }
  EXPECT_EQ(real_time, 1);
  EXPECT_GT(threads, 1);
  EXPECT_EQ(sched_getscheduler(pid) & ~SCHED_RESET_ON_FORK, SCHED_FIFO);
}

TEST_F(Realtime, AnInvalidCpuListIsRefused) {
  const auto finished = run_program({"state-machine", "--cpus", "two"});
  EXPECT_EQ(finished.code, 2);
  EXPECT_THAT(finished.errors, HasSubstr("--cpus"));
}

}  // namespace
}  // namespace yars::endtoend
