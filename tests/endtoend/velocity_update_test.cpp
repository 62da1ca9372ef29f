// IPVU by the whole set in lockstep: radar-model measures velocity by Doppler beams between scans, state-machine
// corrects the mission navigator, and a replay computes the same sweeps. The requirement is stated for one hour of
// flight, which would take minutes to compute. This test flies 70 s, enough for two updates.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "lib/geo/quantity.hpp"
#include "radar/recording/recording_io.hpp"
#include "tests/endtoend/lockstep_run.hpp"

namespace yars::endtoend {
namespace {

// Configuration file of a navigator with velocity errors of 6, -6 and 3 ft/s (north, east, down) and a random walk.
class DriftingNavigator {
 public:
  DriftingNavigator()
      : path_(std::filesystem::temp_directory_path() / ("yars_drift_" + std::to_string(getpid()) + ".guf")) {
    std::ofstream(path_) << "( Navigation :driftNorth 6 :driftEast -6 :driftDown 3 :velocityWalk 2 )\n";
  }
  ~DriftingNavigator() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  DriftingNavigator(const DriftingNavigator&) = delete;
  DriftingNavigator& operator=(const DriftingNavigator&) = delete;

  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

// Greatest absolute component of the velocity error [ft/s].
double worst_component_fps(const databuffer::NavigatorError& error) {
  const double worst_mps = std::max(
      {std::abs(error.velocity_north_mps), std::abs(error.velocity_east_mps), std::abs(error.velocity_down_mps)});
  return geo::Length::metres(worst_mps).feet();
}

TEST(InterleavedVelocityUpdates, HoldTheNavigatorsVelocityInTheRunningSet) {
  const DriftingNavigator navigator;
  const std::vector<ScriptedStep> steps{
      {"power opr", true, "power", "OPR"}, {"pb 16", true, "ipvu", true}, {"pb 2", true, "declutter", true, 66.0}};
  const LockstepRun run("ipvu", steps, "fixed:36.5,-121.5,10000,300,250", {{}, navigator.path()});
  auto reader = recording::RecordingReader::open(run.recording());
  ASSERT_TRUE(reader) << reader.error().message();
  std::set<std::int64_t> updates;
  int states = 0;
  while (const auto item = reader->next()) {
    const auto* change = std::get_if<recording::StateChange>(&*item);
    if (change == nullptr) continue;
    const databuffer::RadarState& state = change->state;
    if (state.velocity_updated_tick < 0) {
      EXPECT_GT(worst_component_fps(state.mission), 2.0) << "the initial error lasts until the first update";
      continue;
    }
    ++states;
    updates.insert(state.velocity_updated_tick);
    EXPECT_LT(worst_component_fps(state.mission), 2.0) << "at tick " << state.tick;
    EXPECT_GT(worst_component_fps(state.ins), 4.0) << "the INS keeps its error";
  }
  EXPECT_EQ(updates.size(), 2U) << "one at once, one after a minute";
  EXPECT_GT(states, 100);
  const nlohmann::json replayed = run.replayed();
  EXPECT_EQ(replayed["different"], 0);
  EXPECT_EQ(replayed["not_ready"], 0);
}

}  // namespace
}  // namespace yars::endtoend
