// Changes of the world while a set flies: the picture changes, a restart of radar-model keeps the world, and a replay
// of the recording computes the same sweeps.
#include <gtest/gtest.h>
#include <signal.h>

#include <optional>
#include <string>
#include <vector>

#include "databuffer/messages/inspection.hpp"
#include "databuffer/session/session_changes.hpp"
#include "lib/radar/modes.hpp"
#include "radar/recording/recording_io.hpp"
#include "tests/endtoend/process_set.hpp"

namespace yars::endtoend {
namespace {

std::vector<std::uint64_t> edits_in(const std::filesystem::path& file) {
  std::vector<std::uint64_t> edits;
  auto reader = recording::RecordingReader::open(file);
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
    ASSERT_TRUE(eventually([&] { return set.is_recorded(); }, 60.0)) << set.log_of("recorder");
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

// The drawn sequence point with this name; nullopt: it is not drawn.
std::optional<databuffer::DrawnPoint> drawn(const databuffer::SessionLayout& layout, const std::string& name) {
  databuffer::RadarState state{};
  if (!layout.radar_state.read(state)) return std::nullopt;
  for (const auto& point : databuffer::used(state.points, state.points_drawn))
    if (point.name == name) return point;
  return std::nullopt;
}

TEST_F(ChangedWorld, SequencePointsChangeOutlastTheStateMachineAndAreRecorded) {
  ASSERT_NO_FATAL_FAILURE(start());
  const auto session = databuffer::Session::open_read_only(set.session());
  ASSERT_TRUE(session);
  const auto& layout = session->layout();
  const auto is_at = [&](const std::string& name, double latitude_deg) {
    return eventually(
        [&] { return drawn(layout, name).value_or(databuffer::DrawnPoint{}).latitude_deg == latitude_deg; }, 20.0);
  };
  EXPECT_EQ(world()["points"].size(), 0U);
  const auto steer = set.yars({"world", "point", "add", "37.5", "-122.9"});
  ASSERT_EQ(steer.code, 0) << steer.errors;
  EXPECT_NE(steer.output.find("point 1 \"1\" added"), std::string::npos) << steer.output;
  ASSERT_EQ(set.yars({"world", "point", "add", "37.5", "-122.8", "--name", "7.", "--elevation-ft", "300"}).code, 0);
  ASSERT_TRUE(is_at("7.", 37.5));
  EXPECT_NEAR(drawn(layout, "7.")->elevation_m, 91.44, 1e-9);
  EXPECT_EQ(drawn(layout, "1")->kind, static_cast<std::uint8_t>(radar::PointKind::initial));
  ASSERT_EQ(set.yars({"inject", "sp 7."}).code, 0);
  ASSERT_TRUE(eventually([&] { return drawn(layout, "7.").value_or(databuffer::DrawnPoint{}).selected == 1; }, 20.0));
  const auto id = std::to_string(world()["points"][1]["id"].get<int>());
  ASSERT_EQ(set.yars({"world", "point", "move", id, "37.4", "-122.8"}).code, 0);
  EXPECT_TRUE(is_at("7.", 37.4));

  set.kill("state", SIGKILL);
  set.start_again("state");
  ASSERT_EQ(set.yars({"world", "point", "change", id, "--name", "8.", "--elevation-ft", "200"}).code, 0);
  EXPECT_TRUE(is_at("8.", 37.4)) << "the new process has the points of the old one";
  EXPECT_TRUE(is_at("1", 37.5));
  const auto taken = set.yars({"world", "point", "add", "37.5", "-122.8", "--name", "8"});
  EXPECT_EQ(taken.code, 1);
  EXPECT_NE(taken.errors.find("8 beside 8."), std::string::npos) << taken.errors;
  ASSERT_EQ(set.yars({"world", "point", "remove", id}).code, 0);
  EXPECT_TRUE(eventually([&] { return !drawn(layout, "8."); }, 20.0));
  ASSERT_EQ(set.yars({"world", "reset"}).code, 0);
  EXPECT_TRUE(eventually([&] { return !drawn(layout, "1"); }, 20.0)) << "the configured route has no points";

  set.kill("recorder", SIGTERM);
  ASSERT_EQ(set.wait("recorder"), 0) << set.log_of("recorder");
  EXPECT_EQ(edits_in(recording), (std::vector<std::uint64_t>{0, 1, 2, 3, 4, 5, 6}));
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
