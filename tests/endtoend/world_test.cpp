// Changes of the world while a set flies: the picture changes, a restart of radar-model keeps the world, and a replay
// of the recording computes the same sweeps.
#include <gtest/gtest.h>
#include <signal.h>

#include <string>
#include <vector>

#include "databuffer/session/session_world.hpp"
#include "tests/endtoend/process_set.hpp"
#include "tools/recording/recording_reader.hpp"

namespace yars::endtoend {
namespace {

std::vector<std::uint64_t> edits_in(const std::filesystem::path& file) {
  std::vector<std::uint64_t> edits;
  auto reader = tools::recording::RecordingReader::open(file);
  if (!reader) return edits;
  while (const auto item = reader->next())
    if (const auto* world = std::get_if<databuffer::WorldState>(&*item)) edits.push_back(world->edit);
  return edits;
}

// Mean video of the newest sweeps of a session.
double mean_video(const databuffer::SessionLayout& layout) {
  databuffer::Sweep sweep{};
  std::uint64_t cursor = layout.sweeps.next() - std::min<std::uint64_t>(layout.sweeps.next(), 180);
  double sum = 0.0, count = 0.0;
  while (layout.sweeps.read(cursor, sweep).delivered)
    for (std::uint32_t i = 0; i < sweep.samples; ++i, ++count) sum += sweep.video[i];
  return count > 0.0 ? sum / count : 0.0;
}

class ChangedWorld : public ::testing::Test {
 protected:
  void start() {
    set.start("state", {"state-machine"});
    set.start("model", {"radar-model"});
    set.start("flight", {"flight-model", "--source", "fixed:37.5,-123.0,15000,90,480"});
    set.start("recorder", {"yars", "record", recording.string()});
    ASSERT_TRUE(set.wait_until([](const auto& watch) { return watch["tick"] > 20; })) << set.log_of("model");
    ASSERT_EQ(set.yars({"inject", "power opr"}).code, 0);
  }
  void await_sweeps(int more) {
    const auto sweeps = set.watch()["sweeps"].get<int>();
    EXPECT_TRUE(set.wait_until([&](const auto& watch) { return watch["sweeps"] > sweeps + more; }, 60.0));
  }
  nlohmann::json world() { return nlohmann::json::parse(set.yars({"world", "--json"}).output); }

  ProcessSet set{"world"};
  const std::filesystem::path recording = set.folder() / "world.yarsrec";
};

TEST_F(ChangedWorld, IsSeenOutlastsTheModelAndIsReplayed) {
  ASSERT_NO_FATAL_FAILURE(start());
  EXPECT_TRUE(world()["configured"].get<bool>());
  EXPECT_EQ(world()["edit"], 0);
  const auto session = databuffer::Session::open_read_only(set.session());
  ASSERT_TRUE(session);
  await_sweeps(400);
  const double dry = mean_video(session->layout());
  const auto rain = set.yars({"world", "rain", "add", "37.5", "-122.8", "--radius-nm", "20", "--rate", "60"});
  ASSERT_EQ(rain.code, 0) << rain.errors;
  await_sweeps(400);
  EXPECT_TRUE(world()["in_effect"].get<bool>());
  EXPECT_LT(mean_video(session->layout()), 0.7 * dry) << "the rain attenuates the ground behind it";

  set.kill("model", SIGKILL);
  set.start_again("model");
  ASSERT_TRUE(eventually([&] { return session->layout().world_latched.next() >= 3; }, 60.0));
  EXPECT_EQ(world()["rain"].size(), 1U) << "the new process has the world of the old one";
  await_sweeps(400);
  EXPECT_LT(mean_video(session->layout()), 0.7 * dry);
  ASSERT_EQ(set.yars({"world", "sea", "6"}).code, 0);
  ASSERT_EQ(set.yars({"world", "mover", "add", "37.5", "-122.9", "--speed-kt", "20", "--heading", "45"}).code, 0);
  ASSERT_EQ(set.yars({"world", "jammer", "add", "37.6", "-122.6", "--name", "noise"}).code, 0);
  await_sweeps(200);
  ASSERT_EQ(set.yars({"world", "reset"}).code, 0);
  await_sweeps(200);
  EXPECT_TRUE(world()["configured"].get<bool>());
  EXPECT_EQ(world()["rain"].size(), 0U);

  set.kill("recorder", SIGTERM);
  ASSERT_EQ(set.wait("recorder"), 0) << set.log_of("recorder");
  set.end_all();
  EXPECT_EQ(edits_in(recording), (std::vector<std::uint64_t>{0, 1, 1, 2, 3, 4, 5}));
  const auto replay = nlohmann::json::parse(set.yars({"replay", recording.string(), "--events"}, 240.0).output);
  EXPECT_EQ(replay["different"], 0) << replay.dump();
  EXPECT_GT(replay["equal"].get<int>(), 1000) << replay.dump();
}

TEST_F(ChangedWorld, RefusesWhatIsOutOfRangeAndNeedsARadarModel) {
  ASSERT_NO_FATAL_FAILURE(start());
  EXPECT_EQ(set.yars({"world", "sea", "rough"}).code, 2);
  EXPECT_EQ(set.yars({"world", "rain", "add", "95", "0"}).code, 2);
  const auto unknown = set.yars({"world", "rain", "remove", "4"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_NE(unknown.errors.find("id 4"), std::string::npos) << unknown.errors;
  EXPECT_EQ(world()["edit"], 0) << "a refused change is none";
  set.kill("model", SIGTERM);
  set.wait("model");
  const auto without = set.yars({"world", "sea", "3"});
  EXPECT_EQ(without.code, 1);
  EXPECT_NE(without.errors.find("radar-model"), std::string::npos) << without.errors;
}

}  // namespace
}  // namespace yars::endtoend
