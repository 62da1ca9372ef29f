// The whole set in lockstep: state and legends after each event of the real beam map. Replay and frames of two runs are
// equal bit by bit.
#include <gtest/gtest.h>

#include <utility>

#include "tests/endtoend/lockstep_run.hpp"

namespace yars::endtoend {
namespace {

using nlohmann::json;

constexpr const char* kLockstepSource = "fixed:37.5,-123.0,15000,90,480";

const std::vector<ScriptedStep>& steps() {
  static const std::vector<ScriptedStep> kSteps{
      {"power opr", true, "mode", "RBM"},
      // Rule 1: without radar altimeter and sequence point the range follows from the altitude, 15,000 ft MSL.
      {"pb 1", false, "range_nm", 40.0},
      {"pb 14", true, "range_nm", 20.0},
      {"pb 13", true, "range_nm", 40.0},
      {"pb 13", true, "range_nm", 80.0},
      {"pb 13", true, "range_nm", 160.0},
      {"pb 13", false, "range_nm", 160.0},
      {"pb 9", true, "scan", "HALF"},
      {"pb 9", true, "scan", "QTR"},
      {"pb 9", true, "scan", "FULL"},
      {"pb 3", true, "gain", 2},
      {"pb 3", true, "gain", 1},
      {"pb 3", true, "gain", 0},
      {"pb 3", true, "gain", 3},
      {"pb 4", true, "brightness", 9},
      {"pb 5", true, "brightness", 8},
      {"pb 2", true, "declutter", true},
      {"pb 2", true, "declutter", false},
      {"pb 16", true, "ipvu", true},
      {"pb 16", true, "ipvu", false},
      {"pb 18", true, "sniff", true},
      {"pb 18", true, "sniff", false},
      {"pb 19", true, "channel", 2},
      {"pb 20", true, "band", "B"},
      {"pb 7", true, "cursor_function", "UPDT"},
      // Rule 1: the range changes only with cursor MAP.
      {"pb 14", false, "range_nm", 160.0},
      {"pb 7", true, "cursor_function", "CUE"},
      {"pb 7", true, "cursor_function", "TGT"},
      {"pb 7", true, "cursor_function", "MARK"},
      {"pb 7", true, "cursor_function", "MAP"},
      {"freeze", true, "freeze", true},
      {"pb 9", false, "scan", "FULL"},
      {"pb 14", false, "range_nm", 160.0},
      {"pb 6", false, "mode", "RBM"},
      {"freeze", true, "freeze", false},
      {"elevation -5", true, "range_nm", 160.0},
      {"elevation up", true, "range_nm", 160.0},
      {"contrast up", true, "contrast", 9},
      {"pb 11", true, "mode", "MENU"},
      {"pb 9", false, "scan", "FULL"},
      {"pb 6", true, "mode", "RBM"},
      {"mode aa", true, "master", "AA"},
      {"pb 9", false, "scan", "FULL"},
      {"mode ag", true, "mode", "RBM"},
      {"pb 6", true, "mode", "HRM"},
      {"pb 6", true, "mode", "BCN"},
      {"pb 6", true, "mode", "PVU"},
      {"pb 6", true, "mode", "RBM"},
      // A mode change by PB 6 sets the range by height.
      {"radar rbm", false, "range_nm", 40.0},
      {"nav ins", true, "nav_source", "INS"},
      {"nav mn", true, "nav_source", "MN"},
      {"power stby", true, "power", "STBY"},
      {"power opr", true, "power", "OPR"},
  };
  return kSteps;
}

// Expects the legends and boxes of the real beam map according to docs/pilots_manual.md#legends.
void expect_rbm_legends(const json& state) {
  const auto& legends = state["legends"];
  EXPECT_EQ(legends["2"], "DCL");
  EXPECT_EQ(legends["3"], "GAIN " + std::to_string(state["gain"].get<int>()));
  EXPECT_EQ(legends["4"], "BRT+");
  EXPECT_EQ(legends["5"], "BRT-");
  EXPECT_EQ(legends["6"], "RBM");
  EXPECT_EQ(legends["7"], state["cursor_function"]);
  EXPECT_EQ(legends["9"], state["scan"]);
  EXPECT_EQ(legends["11"], "M");
  EXPECT_EQ(legends["12"], "VTR");
  EXPECT_EQ(legends["13"], "^");
  EXPECT_EQ(legends["14"], "v");
  EXPECT_EQ(legends["16"], "IPVU");
  EXPECT_EQ(legends["18"], "SNIFF");
  EXPECT_EQ(legends["19"], std::to_string(state["channel"].get<int>()));
  EXPECT_EQ(legends["20"], state["band"]);
  for (const auto* none : {"1", "8", "10", "15"}) EXPECT_FALSE(legends.contains(none)) << none;
  json boxed = json::array();
  for (const auto& [button, field] : {std::pair{2, "declutter"}, {12, "vtr"}, {16, "ipvu"}, {18, "sniff"}})
    if (state[field] == true) boxed.push_back(button);
  EXPECT_EQ(state["boxed"], boxed);
}

TEST(Lockstep, EveryRealBeamMapEventHasItsEffectAndTheRunRepeatsBitForBit) {
  const LockstepRun first("lockstep-a", steps(), kLockstepSource);
  EXPECT_FALSE(first.segment_exists());
  const auto entries = first.entries();
  expect_steps(entries, steps());
  for (const Entry& entry : entries) {
    SCOPED_TRACE("tick " + std::to_string(entry.tick));
    // A recorded state implies that the recorder writes.
    EXPECT_EQ(entry.state["vtr"], true);
    if (entry.state["mode"] == "RBM" && entry.state["power"] == "OPR" && entry.state["freeze"] == false)
      expect_rbm_legends(entry.state);
  }
  const auto replayed = first.replayed();
  EXPECT_EQ(replayed["different"], 0);
  EXPECT_EQ(replayed["not_ready"], 0);
  EXPECT_EQ(replayed["ticks_lost"], 0);
  EXPECT_GT(replayed["equal"], 1000);

  const LockstepRun second("lockstep-b", steps(), kLockstepSource);
  EXPECT_EQ(second.replayed(), replayed);
  const auto frames = first.frame_bytes();
  EXPECT_GE(frames.size(), 7U);
  // With power OFF the first frame has only the dim words that say how to switch on. The last one shows the built-in
  // hills and the symbols.
  EXPECT_LT(lit_pixels(first.frames() / frames.begin()->first), 1500U);
  EXPECT_GT(lit_pixels(first.frames() / frames.rbegin()->first), 3000U);
  const auto again = second.frame_bytes();
  EXPECT_EQ(frames.size(), again.size());
  for (const auto& [name, bytes] : frames) {
    // Not EXPECT_EQ, which would print both pictures as text.
    const auto partner = again.find(name);
    EXPECT_TRUE(partner != again.end() && partner->second == bytes) << name << " differs between two runs";
  }
}

// PB 12 stops the recording and starts it again. The recording lacks the event of the pause, and its replay is equal.
TEST(Lockstep, TheVtrStopsAndStartsTheRecordingInOneFile) {
  const LockstepRun run("lockstep-vtr",
                        {{"power opr", true, "vtr", true, 0.25},
                         {"pb 9", true, "scan", "HALF", 2.0},
                         {"pb 12", true, "vtr", true, 2.0},
                         {"pb 9", true, "scan", "QTR", 1.0},
                         {"pb 12", true, "vtr", true, 3.0},
                         {"pb 3", true, "gain", 2, 2.0}},
                        kLockstepSource);
  const auto entries = run.entries();
  ASSERT_EQ(entries.size(), 4U);
  EXPECT_EQ(entries[2].state["vtr"], true) << "the press that stops the recording is the last recorded one";
  EXPECT_EQ(entries[3].state["scan"], "QTR") << "the scan width set in the pause applies after it";
  EXPECT_EQ(entries[3].state["vtr"], true);
  EXPECT_EQ(entries[3].state["boxed"], json::array({12}));
  const auto replayed = run.replayed();
  EXPECT_EQ(replayed["pauses"], 1);
  EXPECT_EQ(replayed["different"], 0);
  EXPECT_EQ(replayed["ticks_lost"], 0);
  const int seconds = 1 + 2 + 2 + 1 + 3 + 2 + 3;  // first step, times between steps, time after the last step
  EXPECT_EQ(replayed["ticks"], seconds * 200 + 1 - 4 * 200);
  EXPECT_GT(replayed["equal"], 1000);
}

TEST(Lockstep, APlanWithAnUnknownRoleIsRefused) {
  const auto finished =
      run_program({"state-machine", "--session", "lockstep-plan", "--lockstep", "radar-model,state-machin"});
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.errors.find("state-machin"), std::string::npos) << finished.errors;
}

}  // namespace
}  // namespace yars::endtoend
