// The whole set in lockstep: every event of the real beam map at its own tick, the state and legends after it, the
// picture, and the same bits in every run.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include "lib/imageio/png.hpp"
#include "tests/endtoend/process_set.hpp"

namespace yars::endtoend {
namespace {

using nlohmann::json;

// An event of the script, whether it does something there, and one field of the state after it (pvi.md).
struct Step {
  std::string event;
  bool effective;
  std::string field;
  json expected;
};

const std::vector<Step>& steps() {
  static const std::vector<Step> kSteps{
      {"power opr", true, "mode", "RBM"},
      // Rule 1: no radar altimeter, no sequence point; 15,000 ft above the sea.
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
      {"pb 12", true, "vtr", true},
      {"pb 12", true, "vtr", false},
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

// Legends and boxes of the real beam map, as pvi.md's table "Bezel buttons" words them.
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

// Pixels of a frame that are lit well.
std::size_t lit_pixels(const std::filesystem::path& path) {
  const auto image = imageio::read_png(path);
  EXPECT_TRUE(image.has_value()) << path;
  std::size_t lit = 0;
  for (std::size_t i = 1; image && i < image->pixels.size(); i += static_cast<std::size_t>(image->channels))
    lit += image->pixels[i] > 60 ? 1 : 0;
  return lit;
}

struct Entry {
  std::int64_t tick = 0;
  bool effective = false;
  json state;  // in force at the end of that tick
};

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class LockstepRun {
 public:
  explicit LockstepRun(const std::string& name) : set_(name), recording_(set_.folder() / "run.yars") {
    constexpr double kFirst_s = 1.0, kApart_s = 0.25;
    std::ofstream script(set_.folder() / "script");
    for (std::size_t i = 0; i < steps().size(); ++i)
      script << kFirst_s + kApart_s * static_cast<double>(i) << " " << steps()[i].event << "\n";
    script.close();
    const auto seconds = static_cast<int>(kFirst_s + kApart_s * static_cast<double>(steps().size())) + 3;
    const std::string plan =
        "flight-model,input-monitor,state-machine,radar-model,radar-display,recorder@" + std::to_string(seconds * 200);
    std::filesystem::create_directories(frames());
    const auto start = [&](const std::string& role, std::vector<std::string> arguments) {
      arguments.insert(arguments.end(), {"--lockstep", plan});
      set_.start(role, arguments);
    };
    start("recorder", {"yars", "record", recording_.string()});
    start("flight-model", {"flight-model", "--source", "fixed:37.5,-123.0,15000,90,480"});
    start("input-monitor", {"input-monitor", "--source", "script:" + (set_.folder() / "script").string()});
    start("state-machine", {"state-machine"});
    start("radar-model", {"radar-model"});
    start("radar-display", {"radar-display", "--headless", "--frames", frames().string(), "--every", "2"});
    for (const auto* role :
         {"flight-model", "input-monitor", "state-machine", "radar-model", "radar-display", "recorder"})
      EXPECT_EQ(set_.wait(role, 240.0), 0) << role << ": " << set_.log_of(role);
  }

  std::filesystem::path frames() const { return set_.folder() / "frames"; }
  bool segment_exists() const { return set_.segment_exists(); }

  std::map<std::string, std::string> frame_bytes() const {
    std::map<std::string, std::string> bytes;
    for (const auto& entry : std::filesystem::directory_iterator(frames()))
      bytes[entry.path().filename()] = bytes_of(entry.path());
    return bytes;
  }

  // The script's events in order, each with the state at the end of its tick.
  std::vector<Entry> entries() const {
    const auto printed = set_.yars({"replay", "--print", recording_.string()});
    EXPECT_EQ(printed.code, 0) << printed.errors;
    std::map<std::int64_t, json> states;
    std::vector<Entry> entries;
    std::istringstream lines(printed.output);
    for (std::string line; std::getline(lines, line);) {
      const auto object = json::parse(line);
      if (object.contains("event"))
        entries.push_back({object["tick"], object["effective"], {}});
      else
        states[object["tick"]] = object["state"];
    }
    for (auto& entry : entries) {
      auto state = states.upper_bound(entry.tick);
      if (state != states.begin()) entry.state = (--state)->second;
    }
    return entries;
  }

  json replayed() const {
    const auto finished = set_.yars({"replay", "--events", recording_.string()}, 120.0);
    EXPECT_EQ(finished.code, 0) << finished.output << finished.errors;
    return json::parse(finished.output);
  }

 private:
  ProcessSet set_;
  std::filesystem::path recording_;
};

TEST(Lockstep, EveryRealBeamMapEventHasItsEffectAndTheRunRepeatsBitForBit) {
  const LockstepRun first("lockstep-a");
  EXPECT_FALSE(first.segment_exists());
  const auto entries = first.entries();
  ASSERT_EQ(entries.size(), steps().size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const auto& step = steps()[i];
    SCOPED_TRACE("step " + std::to_string(i) + ": " + step.event + " at tick " + std::to_string(entries[i].tick));
    EXPECT_EQ(entries[i].effective, step.effective);
    ASSERT_TRUE(entries[i].state.contains(step.field));
    EXPECT_EQ(entries[i].state[step.field], step.expected);
    if (entries[i].state["mode"] == "RBM" && entries[i].state["power"] == "OPR" && entries[i].state["freeze"] == false)
      expect_rbm_legends(entries[i].state);
  }
  const auto replayed = first.replayed();
  EXPECT_EQ(replayed["different"], 0);
  EXPECT_EQ(replayed["not_ready"], 0);
  EXPECT_EQ(replayed["ticks_lost"], 0);
  EXPECT_GT(replayed["equal"], 1000);

  const LockstepRun second("lockstep-b");
  EXPECT_EQ(second.replayed(), replayed);
  const auto frames = first.frame_bytes();
  EXPECT_GE(frames.size(), 7U);
  // Dark before power comes on; the built-in hills and the symbols after.
  EXPECT_LT(lit_pixels(first.frames() / frames.begin()->first), 200U);
  EXPECT_GT(lit_pixels(first.frames() / frames.rbegin()->first), 3000U);
  const auto again = second.frame_bytes();
  EXPECT_EQ(frames.size(), again.size());
  for (const auto& [name, bytes] : frames) {
    // Not EXPECT_EQ: nobody wants to read two pictures as text.
    const auto partner = again.find(name);
    EXPECT_TRUE(partner != again.end() && partner->second == bytes) << name << " differs between two runs";
  }
}

TEST(Lockstep, APartnerOutsideThePlanIsRefused) {
  const auto finished =
      run_program({"state-machine", "--session", "lockstep-plan", "--lockstep", "radar-model,state-machin"});
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.errors.find("state-machin"), std::string::npos) << finished.errors;
}

}  // namespace
}  // namespace yars::endtoend
