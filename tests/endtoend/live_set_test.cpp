// A live set: a button changes state and legend; a sweep reaches segment, display and PNG. Roles that are killed and
// restarted resume their state. After the end the segment is gone.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <utility>

#include "databuffer/session/session.hpp"
#include "lib/imageio/png.hpp"
#include "tests/endtoend/process_set.hpp"
#include "tests/lib/imageio/read_png.hpp"

namespace yars::endtoend {
namespace {

// Number of pixels with a green channel above 40 of 255.
std::size_t lit_pixels(const std::filesystem::path& path) {
  const auto image = test::read_png(path);
  if (!image) return 0;
  std::size_t lit = 0;
  for (std::size_t i = 1; i < image->pixels.size(); i += static_cast<std::size_t>(image->channels))
    lit += image->pixels[i] > 40 ? 1 : 0;
  return lit;
}

std::filesystem::path newest_frame(const std::filesystem::path& folder) {
  std::filesystem::path newest;
  if (!std::filesystem::exists(folder)) return newest;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".png" && entry.path() > newest) newest = entry.path();
  return newest;
}

class LiveSet : public ::testing::Test {
 protected:
  LiveSet() : set_("live"), frames_(set_.folder() / "frames") { std::filesystem::create_directories(frames_); }

  void start(const std::string& role) {
    if (role == "state-machine" || role == "radar-model") set_.start(role, {role});
    if (role == "flight-model") set_.start(role, {role, "--source", "fixed:37.5,-123.0,15000,90,480"});
    if (role == "recorder") set_.start(role, {"yars", "record", "--overwrite", (set_.folder() / "recording").string()});
    if (role == "input-monitor") {
      // An event at a sim time that no test reaches.
      std::ofstream(set_.folder() / "script") << "100000 pb 1\n";
      set_.start(role, {role, "--source", "script:" + (set_.folder() / "script").string()});
    }
    if (role == "radar-display") set_.start(role, {role, "--headless", "--frames", frames_.string(), "--every", "0.5"});
  }

  void start_all() {
    for (const auto* role : {"state-machine", "radar-model", "flight-model", "radar-display"}) start(role);
    ASSERT_TRUE(set_.wait_until([](const auto& watch) {
      return watch["processes"].size() >= 4 && !watch["ownship"].is_null();
    })) << set_.watch().dump();
  }

  void inject(const std::vector<std::string>& events) {
    std::vector<std::string> arguments{"inject"};
    arguments.insert(arguments.end(), events.begin(), events.end());
    const auto finished = set_.yars(arguments);
    ASSERT_EQ(finished.code, 0) << finished.errors;
  }

  ProcessSet set_;
  std::filesystem::path frames_;
};

TEST_F(LiveSet, AButtonReachesTheLegendAndASweepReachesTheFrame) {
  start_all();
  EXPECT_EQ(set_.watch()["power"], "OFF");
  inject({"power opr"});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["mode"] == "RBM" && watch["sweeps"] > 300; }));
  const double before_nm = set_.watch()["range_nm"];
  inject({"pb 13"});
  EXPECT_GT(set_.watch()["range_nm"].get<double>(), before_nm);
  EXPECT_EQ(set_.watch()["legends"]["9"], "FULL");
  inject({"pb 9"});
  EXPECT_EQ(set_.watch()["legends"]["9"], "HALF");
  ASSERT_TRUE(eventually([&] { return lit_pixels(newest_frame(frames_)) > 5000; }, 20.0))
      << newest_frame(frames_) << set_.log_of("radar-display");
  for (const auto& [role, code] : set_.end_all()) EXPECT_EQ(code, 0) << role << ": " << set_.log_of(role);
  EXPECT_FALSE(set_.segment_exists());
}

// `yars inject` distinguishes events without effect from refused events, and gives the reason of each.
TEST_F(LiveSet, EventsWithoutEffectAreListedAndARefusedEventIsAnError) {
  start_all();
  inject({"power opr", "radar pvu"});
  const auto mixed = set_.yars({"inject", "pb 2", "pb 3", "nav mn"});
  EXPECT_EQ(mixed.code, 0) << mixed.errors;
  EXPECT_EQ(mixed.output,
            "3 events: 1 done, 2 without effect\n"
            "  pb 3: dead in PVU; live in RBM, HRM PPI, patch map, BCN\n"
            "  nav mn: changed nothing: already at this value or at its limit\n");
  EXPECT_EQ(set_.yars({"inject", "pb 2"}).output, "1 event: 1 done\n");
  const auto unknown = set_.yars({"inject", "sp 99"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_NE(unknown.errors.find("'sp 99' refused: NO POINT 99"), std::string::npos) << unknown.errors;
  const auto watch = set_.watch();
  EXPECT_EQ(watch["message"], "NO POINT 99");
  const auto remedy = watch["remedy"].get<std::string>();
  EXPECT_FALSE(remedy.empty());
  EXPECT_NE(unknown.errors.find(remedy), std::string::npos) << unknown.errors;
  EXPECT_NE(set_.yars({"status"}).output.find("display says: NO POINT 99; " + remedy), std::string::npos);
}

TEST_F(LiveSet, WatchHasMarksCueTargetAndRanging) {
  start_all();
  EXPECT_EQ(set_.watch()["marks"], nlohmann::json::array());
  for (const char* field : {"cue", "target", "ranging"}) EXPECT_TRUE(set_.watch()[field].is_null()) << field;
  inject({"power opr"});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["cursor"].is_object(); }));
  inject({"pb 7", "pb 7", "pb 7", "tdc release", "pb 7", "tdc release"});  // TGT, then MARK
  ASSERT_TRUE(set_.wait_until([](const auto& watch) {
    return watch["marks"].size() == 1 && !watch["ranging"].is_null();
  })) << set_.watch().dump();
  const auto watch = set_.watch();
  EXPECT_EQ(watch["target"]["name"], "1.");
  EXPECT_EQ(watch["cue"]["count"], 1);
  EXPECT_EQ(watch["cue"]["lat"], watch["target"]["lat"]);
  EXPECT_GT(watch["ranging"]["slant_range_nm"].get<double>(), 1.0);
  EXPECT_GT(watch["ranging"]["depression_deg"].get<double>(), 0.0);
  const std::string line = set_.yars({"watch", "--once"}).output;
  EXPECT_NE(line.find("MARKS 1  CUE "), std::string::npos) << line;
  EXPECT_NE(line.find("TGT 1. "), std::string::npos) << line;
}

// The test publishes the model status itself. Source: docs/conventions.md: below 1 m/s the track is the heading.
TEST_F(LiveSet, WatchHasTheGroundTrackThatTheRadarUses) {
  auto session = databuffer::Session::open(set_.session(), "tester");
  ASSERT_TRUE(session) << session.error().message();
  databuffer::ModelStatus model{};
  model.map_timer_s = model.map_progress = std::nan("");
  model.ownship.heading_deg = 80.0;
  for (const auto& [east_mps, track_deg] : {std::pair{-0.9, 80.0}, std::pair{-1.1, 270.0}}) {
    model.ownship.velocity_east_mps = east_mps;
    session->layout().model_status.publish(model);
    const auto watch = set_.watch();
    ASSERT_FALSE(watch["ownship"].is_null()) << watch.dump();
    EXPECT_NEAR(watch["ownship"]["track_deg"].get<double>(), track_deg, 1e-9) << east_mps;
  }
}

TEST_F(LiveSet, ASecondInstanceOfAOneWriterRoleEndsWithCodeTwoAndNamesTheHolder) {
  start_all();
  set_.start("second", {"radar-model"});
  EXPECT_EQ(set_.wait("second"), 2);
  EXPECT_NE(set_.log_of("second").find(std::to_string(set_.pid("radar-model"))), std::string::npos)
      << set_.log_of("second");
}

TEST_F(LiveSet, KilledRolesResumeTheirState) {
  start_all();
  inject({"power opr", "pb 9", "pb 3", "pb 3", "freeze"});  // HALF, GAIN 1, frozen
  const auto as_set = [](const nlohmann::json& watch) {
    return watch["scan"] == "HALF" && watch["gain"] == 1 && watch["freeze"] == true && watch["power"] == "OPR";
  };
  ASSERT_TRUE(set_.wait_until(as_set));
  constexpr unsigned kSeed = 20260101;
  constexpr int kKillsOfEach = 20;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  for (const auto* role : {"input-monitor", "recorder"}) start(role);
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].size() >= 6; })) << set_.watch().dump();
  const std::vector<std::string> roles{"state-machine", "radar-model",   "flight-model",
                                       "radar-display", "input-monitor", "recorder"};
  std::vector<std::string> order;
  for (int round = 0; round < kKillsOfEach; ++round) order.insert(order.end(), roles.begin(), roles.end());
  std::shuffle(order.begin(), order.end(), std::mt19937(kSeed));
  for (const auto& role : order) {
    SCOPED_TRACE(role);
    set_.kill(role, SIGKILL);
    EXPECT_EQ(set_.wait(role), 128 + SIGKILL);
    for (const auto& other : roles) EXPECT_EQ(set_.runs(other), other != role) << other << set_.log_of(other);
    start(role);
    ASSERT_TRUE(set_.wait_until([&](const auto& watch) {
      return watch["processes"].contains(role) && !watch["ownship"].is_null() && as_set(watch);
    })) << set_.watch().dump();
  }
  // In spite of the deaths of flight-model, the position is that of 480 kt (246.9 m/s) east since sim time 0.
  const auto flown = set_.watch();
  const double expected_deg =
      -123.0 + flown["sim_time"].get<double>() * 246.9 / (111320.0 * std::cos(37.5 * 0.0174533));
  EXPECT_NEAR(flown["ownship"]["lon"].get<double>(), expected_deg, 0.06) << flown.dump();
  inject({"freeze"});
  const std::uint64_t sweeps = set_.watch()["sweeps"];
  EXPECT_TRUE(set_.wait_until([&](const auto& watch) { return watch["sweeps"] > sweeps + 100; }));
  for (const auto& [role, code] : set_.end_all()) EXPECT_EQ(code, 0) << role << ": " << set_.log_of(role);
  EXPECT_FALSE(set_.segment_exists());
}

TEST_F(LiveSet, ARecordingReplaysTheSameSweeps) {
  for (const auto* role : {"state-machine", "flight-model"}) start(role);
  const auto recording = (set_.folder() / "run.yars").string();
  set_.start("recorder", {"yars", "record", recording});
  ASSERT_TRUE(eventually([&] { return set_.is_recorded(); }, 60.0)) << set_.log_of("recorder");
  start("radar-model");
  inject({"power opr"});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["sweeps"] > 400; }));
  inject({"pb 9", "pb 13", "elevation -3"});
  const std::uint64_t sweeps = set_.watch()["sweeps"];
  ASSERT_TRUE(set_.wait_until([&](const auto& watch) { return watch["sweeps"] > sweeps + 300; }));
  set_.kill("recorder", SIGTERM);
  EXPECT_EQ(set_.wait("recorder"), 0);
  const auto replay = set_.yars({"replay", "--events", recording});
  ASSERT_EQ(replay.code, 0) << replay.output << replay.errors;
  const auto result = nlohmann::json::parse(replay.output);
  EXPECT_EQ(result["different"], 0);
  EXPECT_GT(result["equal"], 600);
  EXPECT_GE(result["events"], 4);
}

// A full disk ends the recording, not the flight. The box around the legend VTR disappears; the display's message and
// `yars status` report the end.
TEST_F(LiveSet, AFullDiskRemovesTheVtrBox) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  start_all();
  inject({"power opr"});
  EXPECT_EQ(set_.watch()["vtr"], false);
  const auto small = (set_.folder() / "small").string();
  set_.start_tool("recorder", {"prlimit", "--fsize=40000", "env", "--ignore-signal=SIGXFSZ",
                               std::string(YARS_BIN_DIR) + "/yars", "--session", set_.session(), "record", small});
  EXPECT_TRUE(set_.wait_until([](const auto& watch) { return watch["vtr"] == true; })) << set_.log_of("recorder");
  EXPECT_TRUE(set_.wait_until([](const auto& watch) { return watch["message"] == "VTR FULL"; }))
      << set_.log_of("recorder");
  const auto watch = set_.watch();
  EXPECT_EQ(watch["vtr"], false);
  EXPECT_TRUE(watch["processes"].contains("recorder")) << "the recorder runs on and reports why";
  const auto recorder = nlohmann::json::parse(set_.yars({"status", "--json"}).output)["recorder"];
  EXPECT_EQ(recorder["writing"], false);
  EXPECT_TRUE(recorder["problem"].is_string()) << recorder.dump();
  set_.kill("recorder", SIGTERM);
  EXPECT_EQ(set_.wait("recorder"), 1);
  EXPECT_EQ(set_.yars({"replay", "--print", small}).code, 0) << "the part before the disk was full";
}

TEST_F(LiveSet, PushButton12StopsAndStartsTheRecorder) {
  start_all();
  start("recorder");
  inject({"power opr"});
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["vtr"] == true; }));
  const auto boxed = [](const auto& watch) { return watch["boxed"].dump().find("12") != std::string::npos; };
  EXPECT_TRUE(set_.wait_until(boxed));
  inject({"pb 12"});
  EXPECT_TRUE(set_.wait_until([](const auto& watch) { return watch["vtr"] == false; }));
  EXPECT_FALSE(boxed(set_.watch()));
  inject({"pb 12"});
  EXPECT_TRUE(set_.wait_until(boxed));
  set_.kill("recorder", SIGKILL);
  EXPECT_TRUE(set_.wait_until([&](const auto& watch) { return watch["vtr"] == false; }));
}

TEST_F(LiveSet, TheClockFreezesStepsAndRepositions) {
  start_all();
  inject({"power opr"});
  ASSERT_EQ(set_.yars({"sim", "freeze"}).code, 0);
  const auto frozen = set_.watch();
  EXPECT_EQ(frozen["running"], false);
  EXPECT_EQ(set_.watch()["sim_time"], frozen["sim_time"]);
  ASSERT_EQ(set_.yars({"sim", "step", "40"}).code, 0);
  const double stepped_s = set_.watch()["sim_time"].get<double>() - frozen["sim_time"].get<double>();
  EXPECT_NEAR(stepped_s, 0.2, 0.0051);
  EXPECT_TRUE(set_.wait_until([&](const auto& watch) { return watch["tick"] >= frozen["tick"].get<int>() + 39; }));
  EXPECT_EQ(set_.watch()["late_ticks"], frozen["late_ticks"]);
  ASSERT_EQ(set_.yars({"sim", "run"}).code, 0);
  ASSERT_EQ(set_.yars({"sim", "reposition", "36.5", "-122.5", "20000", "45"}).code, 0);
  EXPECT_TRUE(set_.wait_until([](const auto& watch) {
    return !watch["ownship"].is_null() && std::abs(watch["ownship"]["lat"].template get<double>() - 36.5) < 0.05;
  })) << set_.watch().dump();
}

// A share of a core that is too small for every preset selects the coarsest, `draft`. `yars status` has its name, and
// the replay follows the changes from scan to scan.
TEST_F(LiveSet, AutomaticFidelityObeysTheCoreShareAndReplays) {
  const auto configuration = (set_.folder() / "automatic.guf").string();
  std::ofstream(configuration) << "( Apg70 :fidelity ( Fidelity :preset auto :coreShare 0.001 ) )\n";
  const auto recording = (set_.folder() / "run.yars").string();
  for (const auto* role : {"state-machine", "flight-model"}) start(role);
  // --sweeps: the recording also has the video of each sweep.
  set_.start("recorder", {"yars", "--config", configuration, "record", "--sweeps", recording});
  ASSERT_TRUE(eventually([&] { return set_.is_recorded(); }, 60.0)) << set_.log_of("recorder");
  set_.start("radar-model", {"radar-model", "--config", configuration});
  inject({"power opr", "elevation -3"});
  const auto fidelity = [this] { return set_.status()["model"]["fidelity"].get<std::string>(); };
  EXPECT_TRUE(eventually([&] { return fidelity() == "draft"; }, 20.0)) << fidelity();
  const std::uint64_t sweeps = set_.watch()["sweeps"];
  ASSERT_TRUE(set_.wait_until([&](const auto& watch) { return watch["sweeps"] > sweeps + 300; }));
  set_.kill("recorder", SIGTERM);
  EXPECT_EQ(set_.wait("recorder"), 0);
  const auto replay = set_.yars({"replay", "--events", recording});
  ASSERT_EQ(replay.code, 0) << replay.output << replay.errors;
  const auto result = nlohmann::json::parse(replay.output);
  EXPECT_EQ(result["different"], 0) << replay.output;
  EXPECT_EQ(result["missing"], 0) << replay.output;
  EXPECT_GT(result["equal"], 300) << replay.output;
}

TEST_F(LiveSet, ARepositioningWithoutAFlightModelAppliesToTheNextOne) {
  start_all();
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return !watch["ownship"].is_null(); }));
  set_.kill("flight-model", SIGKILL);
  set_.wait("flight-model");
  ASSERT_EQ(set_.yars({"sim", "reposition", "36.5", "-122.5", "20000", "45"}).code, 0);
  start("flight-model");
  EXPECT_TRUE(set_.wait_until([](const auto& watch) {
    return !watch["ownship"].is_null() && std::abs(watch["ownship"]["lat"].template get<double>() - 36.5) < 0.05;
  })) << set_.watch().dump();
}

TEST_F(LiveSet, WatchHasTheAgeOfTheOwnshipRecord) {
  start_all();
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return !watch["ownship"].is_null(); }));
  // The age grows from 150 ms to 500 ms of sim time, at which the record is stale. At 1/20 of real time this takes 7 s,
  // enough for several reads on a loaded machine.
  ASSERT_EQ(set_.yars({"sim", "rate", "0.05"}).code, 0);
  set_.kill("flight-model", SIGSTOP);
  EXPECT_TRUE(set_.wait_until([](const auto& watch) {
    return !watch["ownship"].is_null() && watch["ownship"]["age_ms"].template get<double>() > 150.0;
  })) << set_.watch().dump();
  set_.kill("flight-model", SIGCONT);
}

TEST(Usage, BadArgumentsEndWithCodeTwoAndOneLine) {
  for (const auto& command : std::vector<std::vector<std::string>>{{"radar-model", "--samples", "0"},
                                                                   {"flight-model", "--source", "nonsense"},
                                                                   {"state-machine", "--no-such-option"},
                                                                   {"yars", "inject", "pb 21"},
                                                                   {"yars", "sim", "rate", "11"}}) {
    SCOPED_TRACE(command.front() + " " + command[1]);
    const auto finished = run_program(command);
    EXPECT_EQ(finished.code, 2) << finished.errors;
    EXPECT_EQ(std::count(finished.errors.begin(), finished.errors.end(), '\n'), 1) << finished.errors;
  }
}

TEST(Usage, TheErrorNamesASessionThatDoesNotRun) {
  const auto finished = run_program({"yars", "--session", "nobody-here", "status"});
  EXPECT_EQ(finished.code, 1);
  EXPECT_NE(finished.errors.find("nobody-here"), std::string::npos) << finished.errors;
}

}  // namespace
}  // namespace yars::endtoend
