// The high resolution map from the first command to the return to RBM, by the whole set in lockstep: RBM, cursor, MAP
// command, timer, patch, a second patch, freeze, OLD, STO, PPI (docs/pilots_manual.md#rule-4, #rule-5, #rule-6,
// #rule-7, #rule-8).
#include <gtest/gtest.h>

#include "tests/endtoend/lockstep_run.hpp"

namespace yars::endtoend {
namespace {

using nlohmann::json;

// Flight at 480 kt and 15,000 ft. The cursor starts straight ahead at half of the range, in the blind zone. The TDC
// moves it to the right.
constexpr const char* kSource = "fixed:37.5,-123.0,15000,90,480";

const std::vector<ScriptedStep>& flow() {
  static const std::vector<ScriptedStep> kFlow{
      {"power opr", true, "mode", "RBM"},
      {"pb 14", true, "range_nm", 20.0},
      {"tdc release", true, "message", "BLIND ZONE"},
      {"tdc 1 0", true, "mode", "RBM"},
      {"tdc 0 0", true, "mode", "RBM", 0.6},
      {"tdc release", true, "mode", "RBM"},   // the old picture stays while the map forms
      {"pb 2", true, "mode", "PATCH", 14.0},  // the map has formed
      {"pb 2", true, "recall", nullptr},
      {"tdc -0.5 0.3", true, "mode", "PATCH"},
      {"tdc 0 0", true, "mode", "PATCH", 0.4},
      {"tdc release", true, "mode", "PATCH"},
      {"freeze", true, "freeze", true, 20.0},
      {"pb 3", true, "multi_look", "ML2", 20.0},
      {"pb 10", true, "recall", "OLD"},
      {"pb 15", true, "recall", "STORE"},
      {"pb 10", true, "recall", "NEW"},
      {"freeze", true, "freeze", false},
      {"pb 14", true, "mode", "HRM"},
      {"pb 2", true, "declutter", true, 3.0},
  };
  return kFlow;
}

TEST(MapFlow, APatchIsCommandedFormedFrozenRecalledStoredAndLeft) {
  const LockstepRun run("map-flow", flow(), kSource);
  expect_steps(run.entries(), flow());

  // The map appears when the radar would have it: two looks over two strips at this squint take 1 to 14 s.
  constexpr std::size_t kCommand = 5;  // in the flow
  const std::int64_t commanded = run.entries()[kCommand].tick;
  std::int64_t shown = 0;
  for (const auto& [tick, state] : run.states())
    if (shown == 0 && tick > commanded && state["mode"] == "PATCH") shown = tick;
  EXPECT_GT(shown - commanded, 200) << "ticks of 5 ms";
  EXPECT_LT(shown - commanded, 14 * 200);

  const json replayed = run.replayed();
  EXPECT_EQ(replayed["different"], 0);
  EXPECT_GT(replayed["equal"], 100);

  // The recording has each completed map once.
  std::vector<std::uint64_t> ids;
  for (const json& object : run.printed())
    if (object.contains("patch")) ids.push_back(object["patch"]["id"]);
  ASSERT_GE(ids.size(), 2U);
  for (std::size_t i = 1; i < ids.size(); ++i) EXPECT_EQ(ids[i], ids[i - 1] + 1);
  EXPECT_GT(lit_pixels(run.frames() / run.frame_bytes().rbegin()->first), 3000U);
}

TEST(MapFlow, EveryRunShowsTheSameFrames) {
  const LockstepRun first("map-flow-a", flow(), kSource);
  const LockstepRun second("map-flow-b", flow(), kSource);
  const auto frames = first.frame_bytes();
  const auto again = second.frame_bytes();
  ASSERT_EQ(frames.size(), again.size());
  for (const auto& [name, bytes] : frames) {
    const auto partner = again.find(name);
    EXPECT_TRUE(partner != again.end() && partner->second == bytes) << name << " differs between two runs";
  }
}

}  // namespace
}  // namespace yars::endtoend
