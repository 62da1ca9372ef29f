// `scripts/start --fly-out`: live sets go on from a second of a recording. The recording of such a branch has the items
// of the original up to that second, and plays across the joint.
#include <unistd.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "lib/geo/geodesy.hpp"
#include "radar/recording/branch.hpp"
#include "radar/recording/recording_io.hpp"
#include "tests/endtoend/supervised_set.hpp"
#include "tests/radar/recording/made_recording.hpp"

namespace yars::endtoend {
namespace {

using databuffer::ModelTick;
using databuffer::RadarState;
using recording::RecordingItem;
using recording::RecordingReader;

constexpr double kAt_s = 9.0;  // within a turn

std::vector<RecordingItem> items_of(const std::filesystem::path& file) {
  auto reader = RecordingReader::open(file);
  EXPECT_TRUE(reader) << reader.error().message();
  EXPECT_FALSE(reader->cut_short());
  return test::rest_of(*reader);
}

std::optional<std::int64_t> tick_of(const RecordingItem& item) {
  if (const auto* change = std::get_if<recording::StateChange>(&item)) return change->state.tick;
  return std::visit([](const auto& record) { return recording::tick_of(record); }, item);
}

template <class T>
std::vector<T> all_of(const std::vector<RecordingItem>& items) {
  std::vector<T> found;
  for (const RecordingItem& item : items)
    if (const auto* record = std::get_if<T>(&item)) found.push_back(*record);
  return found;
}

// Folder of a recorded flight; it goes with this object.
class Flight {
 public:
  Flight() {
    std::filesystem::remove_all(folder_);  // of a killed run with the same process id
    std::filesystem::create_directory(folder_);
  }
  ~Flight() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Flight(const Flight&) = delete;
  Flight& operator=(const Flight&) = delete;
  std::filesystem::path terrain() const { return folder_ / "terrain"; }
  std::filesystem::path route() const { return folder_ / "turn.route"; }
  std::filesystem::path recording() const { return folder_ / "original.yars"; }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("yars-flight-" + std::to_string(::getpid()));
};

class FlyOut : public Supervision {
 protected:
  static void TearDownTestSuite() { flown_.reset(); }
  // A copy of the flight's recording in this test's folder. The first test that asks for it flies.
  void record() {
    if (!flown_) {
      ASSERT_NO_FATAL_FAILURE(fly());
    }
    terrain_ = flown_->terrain();
    original_ = set_.folder() / "original.yars";
    std::filesystem::copy_file(flown_->recording(), original_, std::filesystem::copy_options::overwrite_existing);
  }
  // A flight of 11 s: the power, three buttons, and a turn that begins at about 8 s.
  void fly() {
    auto flight = std::make_unique<Flight>();
    std::filesystem::rename(terrain_, flight->terrain());
    terrain_ = flight->terrain();
    const auto route = flight->route();
    std::ofstream(route) << "37.4 -122.9 15000 480\n37.4 -122.858 15000 480\n37.9 -122.858 15000 480\n";
    start({"--record", flight->recording().string()}, "route:" + route.string());
    ASSERT_TRUE(
        set_.wait_until([](const auto& watch) { return watch["power"] == "OPR" && watch["sweeps"] > 50; }, kTimeout_s))
        << start_log();
    for (const char* event : {"pb 13", "pb 2", "elevation -4"}) ASSERT_EQ(set_.yars({"inject", event}).code, 0);
    ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["sim_time"] > kAt_s + 2.0; }, kTimeout_s));
    ASSERT_EQ(end(), 0) << start_log();
    flown_ = std::move(flight);
  }
  std::string session_of(const std::string& name) const { return set_.session() + "-" + name; }
  std::filesystem::path branch_of(const std::string& name) const { return set_.folder() / (name + ".yars"); }
  std::vector<std::string> fly_out(const std::string& name, const std::vector<std::string>& more) const {
    std::vector<std::string> command{"env",
                                     "ASAN_OPTIONS=detect_leaks=0",
                                     std::string(YARS_SOURCE_DIR) + "/scripts/start",
                                     "--bin",
                                     YARS_BIN_DIR,
                                     "--session",
                                     session_of(name),
                                     "--fly-out",
                                     original_.string(),
                                     "--frames",
                                     (set_.folder() / (name + "-frames")).string(),
                                     "--log-dir",
                                     (set_.folder() / (name + "-logs")).string(),
                                     "--size",
                                     "240",
                                     "--headless",
                                     "3"};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  void expect_branch(const std::string& name);

  std::filesystem::path original_;
  static inline std::unique_ptr<Flight> flown_;
};

void expect_continuous(const ModelTick& before, const ModelTick& after) {
  const auto& a = before.ownship;
  const auto& b = after.ownship;
  const double moved_m =
      geo::geodesic_inverse({a.latitude_deg, a.longitude_deg}, {b.latitude_deg, b.longitude_deg}).distance.metres();
  // By the time of the flight, because a loaded machine is late.
  const double flown_s = 1e-9 * static_cast<double>(b.source_time_ns - a.source_time_ns);
  EXPECT_GE(flown_s, 0.0) << "tick " << after.tick;
  EXPECT_NEAR(moved_m, 247.0 * flown_s, 0.01 + 2.0 * flown_s) << "tick " << after.tick;
  EXPECT_LT(std::abs(std::remainder(b.heading_deg - a.heading_deg, 360.0)), 0.01 + 3.0 * flown_s) << after.tick;
  EXPECT_LT(std::abs(b.roll_deg - a.roll_deg), 0.01 + 16.0 * flown_s) << "tick " << after.tick;
  EXPECT_NEAR(a.altitude_msl_m, b.altitude_msl_m, 1.0) << "tick " << after.tick;
}

void FlyOut::expect_branch(const std::string& name) {
  SCOPED_TRACE(name);
  auto reader = RecordingReader::open(original_);
  const auto point =
      recording::find_branch_point(*reader, static_cast<std::int64_t>(kAt_s / radar::kTickSeconds), original_.string());
  ASSERT_TRUE(point);
  const auto items = items_of(branch_of(name));
  std::vector<RecordingItem> expected = items_of(original_);
  std::erase_if(expected, [&](const RecordingItem& item) { return tick_of(item).value_or(0) > point->tick; });
  ASSERT_GT(items.size(), expected.size());
  test::expect_same({items.begin(), items.begin() + static_cast<std::ptrdiff_t>(expected.size())}, expected);

  const std::vector<RecordingItem> live(items.begin() + static_cast<std::ptrdiff_t>(expected.size()), items.end());
  const auto ticks = all_of<ModelTick>(live);
  ASSERT_GT(ticks.size(), 100U);
  EXPECT_EQ(ticks.front().tick, point->tick + 1);
  EXPECT_EQ(ticks.front().resumed_tick, point->tick);
  EXPECT_NE(ticks.front().flags & databuffer::kTickOwnshipValid, 0U);
  ModelTick before = all_of<ModelTick>(expected).back();
  EXPECT_GT(std::abs(before.ownship.roll_deg), 5.0);
  for (const ModelTick& tick : ticks) {
    EXPECT_EQ(tick.epoch, point->epoch);
    expect_continuous(before, tick);
    before = tick;
  }
  const auto states = all_of<recording::StateChange>(live);
  ASSERT_FALSE(states.empty());
  // Whether a recorder runs is not of the recording.
  RadarState first = states.front().state, recorded = point->state;
  for (RadarState* state : {&first, &recorded}) {
    state->flags &= ~databuffer::kVtr;
    state->boxed &= ~(1U << 12U);
  }
  EXPECT_EQ(first.events_applied, recorded.events_applied);
  EXPECT_EQ(first.range_nm, recorded.range_nm);
  EXPECT_EQ(first.flags, recorded.flags);
  EXPECT_EQ(first.power, recorded.power);
  EXPECT_EQ(first.antenna_elevation_deg, recorded.antenna_elevation_deg);
  EXPECT_NEAR(first.cursor_latitude_deg, recorded.cursor_latitude_deg, 1e-3);
  EXPECT_FALSE(recording::switched(recorded, first));

  const auto events = run_program({"yars", "replay", "--events", branch_of(name).string()});
  EXPECT_EQ(events.code, 0) << events.errors;
  const auto compared = nlohmann::json::parse(events.output);
  EXPECT_EQ(compared["different"], 0);
  EXPECT_EQ(compared["pauses"], 0);
  EXPECT_GT(compared["equal"], 500);
  // Without a cut: each cut is a line of its log.
  const auto played = run_program(
      {"yars", "--session", session_of("play"), "replay", branch_of(name).string(), "--seek", "8", "--rate", "10"});
  EXPECT_EQ(played.code, 0) << played.errors;
  EXPECT_EQ(played.errors.find("continues at"), std::string::npos) << played.errors;
}

TEST_F(FlyOut, TwoBranchesGoOnFromTheSameSecondSideBySide) {
  ASSERT_NO_FATAL_FAILURE(record());
  for (const std::string name : {"left", "right"})
    set_.start_tool(name, fly_out(name, {"--at", "9", "--record", branch_of(name).string()}));
  for (const std::string name : {"left", "right"}) {
    EXPECT_EQ(set_.wait(name, 120.0), 0) << set_.log_of(name);
    EXPECT_EQ(set_.log_of(name).find("straight and level"), std::string::npos) << set_.log_of(name);
    expect_branch(name);
  }
}

TEST_F(FlyOut, NamesWhatIsWrong) {
  original_ = set_.folder() / "none.yars";
  const auto refused = [&](const std::vector<std::string>& more, int code, const std::string& reason) {
    const auto finished = run_tool(fly_out("refused", more));
    EXPECT_EQ(finished.code, code) << finished.errors;
    EXPECT_TRUE(finished.errors.starts_with("scripts/start: ")) << finished.errors;
    EXPECT_NE(finished.errors.find(reason), std::string::npos) << finished.errors;
  };
  refused({"--at", "9"}, 2, "expected a recording that can be read");
  original_ = set_.folder();
  refused({"--at", "9"}, 2, "expected a recording, found the folder");
  original_ /= "none.yars";
  std::ofstream(original_) << "no recording";
  refused({"--at", "9"}, 1, "expected a recording made by yars record");
  refused({}, 2, "expected --at SECONDS with it");
  refused({"--at", "9", "--lockstep"}, 2, "expected none of --tour, --network and --lockstep with it");
  ASSERT_NO_FATAL_FAILURE(record());
  refused({"--at", "1000"}, 2, "expected a time within");
  // Another set has the session.
  start();
  ASSERT_TRUE(set_.wait_until([](const auto& watch) { return watch["processes"].size() >= 3; }, kTimeout_s));
  const auto not_flown_out =
      set_.yars({"record", branch_of("not").string(), "--from", original_.string(), "--until", "9"});
  EXPECT_EQ(not_flown_out.code, 1);
  EXPECT_NE(not_flown_out.errors.find("a session that goes on from that recording"), std::string::npos)
      << not_flown_out.errors;
  EXPECT_FALSE(std::filesystem::exists(branch_of("not")));
  const auto taken = run_tool(fly_out("refused", {"--at", "9", "--session", set_.session()}));
  EXPECT_EQ(taken.code, 1);
  EXPECT_NE(taken.errors.find("is there already"), std::string::npos) << taken.errors;
}

TEST_F(FlyOut, ListsTheRecordingAndItsFlight) {
  ASSERT_NO_FATAL_FAILURE(record());
  const auto listed = run_program({"yars", "recordings", set_.folder().string(), "--json"});
  EXPECT_EQ(listed.code, 0) << listed.errors;
  const auto one = nlohmann::json::parse(listed.output)["recordings"][0];
  EXPECT_EQ(one["file"], original_.string());
  EXPECT_GT(one["end_s"], kAt_s);
  EXPECT_EQ(one["terrain"], terrain_.string());
  EXPECT_EQ(one["source"], "route:" + flown_->route().string());
  EXPECT_EQ(one["sweeps"], false);
  EXPECT_EQ(one["can_fly_out"], true);
  EXPECT_EQ(one["writing"], false);
  EXPECT_EQ(one["cut_short"], false);
  // Without the route's file the aircraft flies on straight and level.
  const std::filesystem::path kept = set_.folder() / "turn.route";
  std::filesystem::rename(flown_->route(), kept);
  const auto at = run_program({"yars", "recordings", original_.string(), "--at", "9", "--json"});
  std::filesystem::rename(kept, flown_->route());
  const auto fly_out = nlohmann::json::parse(at.output)["recordings"][0]["fly_out"];
  EXPECT_EQ(fly_out["continues"], false);
  EXPECT_TRUE(fly_out["source"].get<std::string>().starts_with("fixed:37.")) << fly_out;
  std::ofstream(set_.folder() / "bad.yars") << "no recording";
  EXPECT_EQ(run_program({"yars", "recordings", set_.folder().string()}).code, 0);
  const auto named =
      run_program({"yars", "recordings", (set_.folder() / "bad.yars").string(), original_.string(), "--json"});
  EXPECT_EQ(named.code, 1);
  const auto both = nlohmann::json::parse(named.output);
  EXPECT_EQ(both["recordings"].size(), 1U);
  EXPECT_EQ(both["refused"].size(), 1U);
}

}  // namespace
}  // namespace yars::endtoend
