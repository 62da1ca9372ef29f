// `yars replay FILE`: from a recording the display draws the same frames as in the recorded run. The session ends at
// the end of the recording. Damaged recordings and bad arguments are reported.
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <iterator>

#include "radar/recording/recording_io.hpp"
#include "tests/endtoend/lockstep_run.hpp"

namespace yars::endtoend {
namespace {

constexpr const char* kReplaySource = "fixed:37.5,-123.0,15000,90,480";

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A recorded run of about 12 s of the real beam map, with a frame every 2 s.
const LockstepRun& run() {
  static const LockstepRun kRun("replay-run",
                                {{"power opr", true, "mode", "RBM"},
                                 {"elevation -3", true, "mode", "RBM", 0.5},
                                 {"pb 13", true, "mode", "RBM", 3.0},
                                 {"pb 2", true, "declutter", true, 4.0}},
                                kReplaySource);
  return kRun;
}

// Contents of the frame that radar-display draws from the recording, while the replay stands at `seconds` of sim time.
std::string frame_at(int seconds) {
  ProcessSet set("replay");
  set.start("replay", {"yars", "replay", run().recording().string(), "--seek", std::to_string(seconds), "--rate", "0"});
  EXPECT_TRUE(set.wait_until(
      [&](const auto& watch) { return watch["sim_time"] == seconds && watch["mode"] == "RBM" && watch["sweeps"] > 0; },
      60.0))
      << set.log_of("replay");
  const auto frames = set.folder() / "frames";
  std::filesystem::create_directories(frames);
  set.start("display", {"radar-display", "--headless", "--frames", frames.string(), "--every", "2"});
  char name[40];
  std::snprintf(name, sizeof name, "frame_%06d.png", seconds / 2);
  EXPECT_TRUE(eventually([&] { return std::filesystem::exists(frames / name); }, 60.0)) << set.log_of("display");
  // At its end radar-display writes the frame again, with all sweeps that it has read.
  set.kill("display", SIGTERM);
  EXPECT_EQ(set.wait("display"), 0);
  set.kill("replay", SIGTERM);
  EXPECT_EQ(set.wait("replay"), 0) << set.log_of("replay");
  EXPECT_FALSE(set.segment_exists());
  return bytes_of(frames / name);
}

TEST(ReplayToTheDisplay, DrawsTheFramesOfTheRunAtThreeTimes) {
  const auto drawn = run().frame_bytes();
  for (const int seconds : {10, 4, 8}) {
    SCOPED_TRACE(std::to_string(seconds) + " s");
    char name[40];
    std::snprintf(name, sizeof name, "frame_%06d.png", seconds / 2);
    const auto frame = drawn.find(name);
    ASSERT_TRUE(frame != drawn.end());
    EXPECT_GT(lit_pixels(run().frames() / name), 3000U);
    EXPECT_TRUE(frame_at(seconds) == frame->second);  // not EXPECT_EQ, which would print both pictures as text
  }
}

TEST(ReplayToTheDisplay, FollowsTheClockOfItsSession) {
  ProcessSet set("replay-clock");
  set.start("replay", {"yars", "replay", run().recording().string(), "--seek", "3"});
  ASSERT_TRUE(set.wait_until([](const auto& watch) { return watch["tick"] > 700; }, 60.0)) << set.log_of("replay");
  ASSERT_EQ(set.yars({"sim", "freeze"}).code, 0);
  EXPECT_EQ(set.watch()["sim_time"], set.watch()["sim_time"]);
  ASSERT_EQ(set.yars({"sim", "reset"}).code, 0);
  EXPECT_TRUE(set.wait_until([](const auto& watch) { return watch["tick"] < 10 && watch["power"] == "OFF"; }))
      << set.watch().dump();
  // While the clock is stopped, `sim reset` moves the replay forwards and back.
  for (const char* seconds : {"9", "5"}) {
    ASSERT_EQ(set.yars({"sim", "reset", seconds}).code, 0);
    EXPECT_TRUE(set.wait_until([&](const auto& watch) {
      return watch["tick"] >= std::stoi(seconds) * 200 && watch["tick"] < std::stoi(seconds) * 200 + 20 &&
             watch["mode"] == "RBM" && watch["sweeps"] > 100;
    })) << set.watch().dump();
  }
  ASSERT_EQ(set.yars({"sim", "rate", "10"}).code, 0);
  ASSERT_EQ(set.yars({"sim", "run"}).code, 0);
  // At ten times real time the replay reaches the end of the recording and ends by itself.
  EXPECT_EQ(set.wait("replay"), 0) << set.log_of("replay");
  EXPECT_NE(set.output_of("replay").find("played from 3.0"), std::string::npos) << set.output_of("replay");
  EXPECT_FALSE(set.segment_exists());
}

TEST(ReplayToTheDisplay, ACutFileIsPlayedToItsEndAndReported) {
  ProcessSet set("replay-cut");
  const std::string bytes = bytes_of(run().recording());
  const auto cut = set.folder() / "cut.yars";
  std::ofstream(cut, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  const auto played = set.yars({"replay", cut.string(), "--rate", "10"});
  EXPECT_EQ(played.code, 0) << played.errors;
  EXPECT_NE(played.errors.find("cut short"), std::string::npos) << played.errors;
}

// A damaged block costs only its own ticks. The error names the missing ticks, and the exit code is 1.
TEST(ReplayToTheDisplay, ADamagedBlockLosesOnlyThatBlockAndIsReportedWithItsTicks) {
  ProcessSet set("replay-damaged");
  std::string bytes = bytes_of(run().recording());
  auto reader = recording::RecordingReader::open(run().recording());
  ASSERT_TRUE(reader);
  const auto block = reader->blocks()[reader->blocks().size() / 2];
  bytes[block.offset + 200] ^= 1;
  const auto damaged = set.folder() / "damaged.yars";
  std::ofstream(damaged, std::ios::binary) << bytes;
  const std::string ticks = std::to_string(block.first_tick) + " to " + std::to_string(block.last_tick);
  const auto compared = set.yars({"replay", "--events", damaged.string()});
  EXPECT_EQ(compared.code, 1);
  EXPECT_NE(compared.errors.find("missing ticks: " + ticks), std::string::npos) << compared.errors;
  const auto result = nlohmann::json::parse(compared.output);
  const auto whole = nlohmann::json::parse(set.yars({"replay", "--events", run().recording().string()}).output);
  EXPECT_EQ(result["different"], 0);
  EXPECT_GT(result["equal"].get<int>(), whole["equal"].get<int>() / 2) << "sweeps before and after the block";
  ASSERT_EQ(result["missing_ticks"].size(), 1u);
  EXPECT_EQ(result["missing_ticks"][0][0], block.first_tick);
  const auto printed = set.yars({"replay", "--print", damaged.string()});
  EXPECT_EQ(printed.code, 1);
  EXPECT_NE(printed.errors.find(ticks), std::string::npos) << printed.errors;
  const auto played = set.yars({"replay", damaged.string(), "--rate", "10"});
  EXPECT_EQ(played.code, 1);
  EXPECT_NE(played.errors.find(ticks), std::string::npos) << played.errors;
}

TEST(ReplayToTheDisplay, RefusesBadArgumentsAndARunningSet) {
  ProcessSet set("replay-refused");
  const std::string recording = run().recording().string();
  for (const std::vector<std::string>& bad :
       {std::vector<std::string>{"--seek", "9999"}, {"--rate", "11"}, {"--rate", "2", "--print"}, {"--seek", "nan"}}) {
    std::vector<std::string> command{"replay", recording};
    command.insert(command.end(), bad.begin(), bad.end());
    EXPECT_EQ(set.yars(command).code, 2) << bad[1];
  }
  // A session with a running role refuses a replay.
  set.start("state-machine", {"state-machine"});
  ASSERT_TRUE(set.wait_until([](const auto& watch) { return watch["processes"].contains("state-machine"); }));
  const auto refused = set.yars({"replay", recording});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.errors.find("state-machine"), std::string::npos) << refused.errors;
}

}  // namespace
}  // namespace yars::endtoend
