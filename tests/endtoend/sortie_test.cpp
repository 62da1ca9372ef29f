// A sortie from the runway and back, by the whole set in lockstep over a generated coast: range by height, update of
// the navigator, mark, target, steering line, cue, two patch maps, recall, SET, beacon mode. With YARS_PICTURES=FOLDER
// the test copies 28 frames of the display into the folder.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "lib/geo/geodesy.hpp"
#include "lib/imageio/png.hpp"
#include "radar/recording/recording_io.hpp"
#include "tests/endtoend/lockstep_run.hpp"
#include "tests/endtoend/sortie_flight.hpp"
#include "tests/lib/imageio/read_png.hpp"

namespace yars::endtoend {
namespace {

using nlohmann::json;

constexpr geo::GeoPoint kLagoon{37.3067, -122.2008};  // point 2 of config/sortie.guf
constexpr geo::GeoPoint kTarget{37.2970, -122.1540};  // 1 NM south of point 3; position of the airfield scene
constexpr geo::GeoPoint kRunway{37.475, -122.608};    // point 1, and the beacon
constexpr double kError_ft = 2500.0;                  // error of the mission navigator to the north, before the update

// An event at a sim time, and the expected value of one field of the state after it.
struct Moment {
  double time_s;
  std::string event;
  bool effective;
  std::string field;
  json expected;
};

// Each `tdc` that moves the cursor over a known distance lasts 0.25 s, 50 ticks.
const std::vector<Moment>& moments() {
  // Full deflection moves the cursor across the display, 1.2 x 20 NM, in 400 ticks: 0.06 NM per tick. The track is
  // east, so up on the display is east and right is south.
  static const std::string kNorthByTheError = "tdc -" + std::to_string(kError_ft * 0.3048 / 1852.0 / 0.06 / 50) + " 0";
  static const std::string kSouthByAMile = "tdc " + std::to_string(1.0 / 0.06 / 50) + " 0";
  static const std::vector<Moment> kMoments{
      {1, "power opr", true, "range_nm", 10.0},  // on the runway
      {2, "nav error mn 2500 0", true, "nav_source", "MN"},
      {32, "pb 13", true, "range_nm", 20.0},  // climbing
      {32.25, "pb 13", true, "range_nm", 40.0},
      {32.5, "pb 13", true, "range_nm", 80.0},
      {32.75, "elevation -3", true, "range_nm", 80.0},
      {56, "pb 14", true, "range_nm", 40.0},
      {56.25, "pb 14", true, "range_nm", 20.0},
      {56.5, "elevation -5", true, "range_nm", 20.0},
      {57, "sp 2", true, "sequence_point", "2"},
      {57.25, "pb 7", true, "cursor_function", "UPDT"},
      {60.25, kNorthByTheError, true, "cursor_function", "UPDT"},
      {60.5, "tdc 0 0", true, "cursor_function", "UPDT"},
      {62.25, "tdc release", true, "cursor_function", "UPDT"},
      {64.25, "pb 7", true, "cursor_function", "CUE"},
      {64.5, "pb 7", true, "cursor_function", "TGT"},
      {64.75, "pb 7", true, "cursor_function", "MARK"},
      {65, "tdc release", true, "message", "MARK 1"},
      {66.25, "sp 3", true, "sequence_point", "3"},
      {66.5, kSouthByAMile, true, "sequence_point", "3"},
      {66.75, "tdc 0 0", true, "sequence_point", "3"},
      {67, "pb 7", true, "cursor_function", "MAP"},
      {67.25, "pb 7", true, "cursor_function", "UPDT"},
      {67.5, "pb 7", true, "cursor_function", "CUE"},
      {67.75, "pb 7", true, "cursor_function", "TGT"},
      {68, "tdc release", true, "points_drawn", json::array({"1", "2", "3", "4."})},
      {70.25, "acq aft", true, "cursor_function", "TGT"},
      {70.5, "tdc 0.5 0", true, "cursor_function", "TGT"},
      {71.5, "tdc 0 0", true, "cursor_function", "TGT"},
      {72.25, "tdc release", true, "cursor_function", "TGT"},
      {74.25, "pb 7", true, "cursor_function", "MARK"},
      {74.5, "pb 7", true, "cursor_function", "MAP"},
      {74.75, "pb 7", true, "cursor_function", "UPDT"},
      {75, "pb 7", true, "cursor_function", "CUE"},
      {75.25, "sp 2", true, "sequence_point", "2"},
      {75.5, "tdc release", true, "cursor_function", "CUE"},
      {76.25, "pb 7", true, "cursor_function", "TGT"},
      {76.5, "pb 7", true, "cursor_function", "MARK"},
      {76.75, "pb 7", true, "cursor_function", "MAP"},
      {77, "sp 4.", true, "sequence_point", "4."},
      {77.25, "tdc release", true, "window_nm", 4.7},
      {86.25, "acq aft", true, "window_nm", 3.3},
      {86.5, "acq aft", true, "window_nm", 1.3},
      {86.75, "acq aft", true, "window_nm", 0.67},
      {87, "tdc release", true, "mode", "PATCH"},
      {96.25, "freeze", true, "freeze", true},
      {98.25, "pb 10", true, "recall", "OLD"},
      {98.5, "pb 15", true, "recall", "STORE"},
      {100.25, "pb 10", true, "recall", "NEW"},
      {100.5, "pb 10", true, "recall", "STORE"},
      {102.25, "mode aa", true, "mode", "AA"},
      {104.25, "pb 18", true, "set", true},
      {104.5, "pb 7", true, "cursor_function", "CUE"},
      {104.75, "tdc 0.2 0.3", true, "set", true},
      {105.25, "tdc 0 0", true, "set", true},
      {105.5, "tdc release", true, "cursor_function", "CUE"},
      {108.25, "pb 18", true, "set", false},
      {108.5, "mode ag", true, "mode", "PATCH"},
      {110.25, "freeze", true, "freeze", false},
      {110.5, "radar bcn", true, "mode", "BCN"},
      {132.25, "radar rbm", true, "mode", "RBM"},
      {218.25, "radar bcn", true, "mode", "BCN"},
      {218.5, "radar rbm", true, "range_nm", 10.0},  // low on the approach
      {218.75, "elevation 0", true, "range_nm", 10.0},
      {256.25, "power stby", true, "power", "STBY"},
  };
  return kMoments;
}

std::vector<ScriptedStep> script() {
  std::vector<ScriptedStep> steps;
  double before_s = 0.0;
  for (const Moment& moment : moments()) {
    steps.push_back({moment.event, moment.effective, moment.field, moment.expected, moment.time_s - before_s});
    before_s = moment.time_s;
  }
  return steps;
}

struct Picture {
  int time_s;  // even
  const char* name;
};
constexpr Picture kPictures[] = {
    {4, "runway"},           {20, "take_off"},     {34, "climb"},     {50, "rbm_80"},        {60, "error_shows"},
    {62, "cursor_on_coast"}, {64, "updated"},      {66, "mark"},      {70, "target_los"},    {72, "line_slews"},
    {74, "line_fixed"},      {76, "cue"},          {78, "map_forms"}, {86, "patch_4_7"},     {88, "patch_forms"},
    {96, "patch_0_67"},      {98, "frozen"},       {100, "store"},    {102, "store_again"},  {104, "air_to_air"},
    {106, "set_cue"},        {110, "back_frozen"}, {130, "beacon"},   {140, "rbm_homeward"}, {220, "approach"},
    {240, "touched_down"},   {256, "stopped"},     {258, "standby"},
};

// Records of one run, from its recording.
struct Recorded {
  std::map<std::int64_t, databuffer::RadarState> states;
  std::map<std::int64_t, databuffer::ModelStatus> statuses;
  std::map<std::int64_t, databuffer::Outputs> outputs;
  std::vector<databuffer::PatchMap> maps;
};

Recorded read_recording(const std::filesystem::path& path) {
  auto reader = recording::RecordingReader::open(path);
  if (!reader) throw std::runtime_error(reader.error().message());
  Recorded recorded;
  while (const auto item = reader->next()) {
    if (const auto* change = std::get_if<recording::StateChange>(&*item))
      recorded.states[change->state.tick] = change->state;
    else if (const auto* report = std::get_if<recording::StatusReport>(&*item))
      recorded.statuses[report->status.tick] = report->status;
    else if (const auto* outputs = std::get_if<databuffer::Outputs>(&*item))
      recorded.outputs[outputs->tick] = *outputs;
    else if (const auto* patch = std::get_if<recording::Patch>(&*item))
      recorded.maps.push_back(patch->map);
  }
  return recorded;
}

// The record that applies at a sim time.
template <class Record>
Record at(const std::map<std::int64_t, Record>& records, double time_s) {
  auto after = records.upper_bound(std::llround(time_s / radar::kTickSeconds));
  return after == records.begin() ? Record{} : std::prev(after)->second;
}

double metres_between(geo::GeoPoint a, double latitude_deg, double longitude_deg) {
  return geo::geodesic_inverse(a, {latitude_deg, longitude_deg}).distance.metres();
}

// Files of the test in a temporary folder: terrain, scene of the target, flight, and the configuration with the scene.
class SortieGround {
 public:
  SortieGround() : folder_(std::filesystem::temp_directory_path() / ("yars_sortie_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    make({"yars", "terrain", "generate", "--out", terrain(), "--south", "37", "--west", "-123", "--cells-lat", "1",
          "--cells-lon", "2", "--seed", "5"});
    make({"yars", "scene", "generate", "--kind", "airfield", "--triangles", "3000", "--origin",
          std::to_string(kTarget.latitude_deg) + "," + std::to_string(kTarget.longitude_deg), "--out",
          (folder_ / "target.flt").string()});
    std::ofstream(folder_ / "flight.csv") << sortie_track();
    // An include cannot name a file outside the folder of the including file.
    for (const auto& file : std::filesystem::directory_iterator(YARS_SOURCE_DIR "/config"))
      if (file.path().extension() == ".guf") std::filesystem::copy(file.path(), folder_);
    std::ofstream(folder_ / "with_target.guf") << "( include \"sortie.guf\" )\n"
                                               << "( Scenes `( ( Scene \"target.flt\" ) ) )\n";
  }
  ~SortieGround() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  SortieGround(const SortieGround&) = delete;
  SortieGround& operator=(const SortieGround&) = delete;

  std::string flight() const { return "csv:" + (folder_ / "flight.csv").string(); }
  Place place() const { return {terrain(), (folder_ / "with_target.guf").string()}; }

 private:
  std::string terrain() const { return (folder_ / "terrain").string(); }
  static void make(const std::vector<std::string>& command) {
    const Finished finished = run_program(command, 200.0);
    if (finished.code != 0) throw std::runtime_error(finished.errors);
  }

  std::filesystem::path folder_;
};

void keep_pictures(const LockstepRun& run) {
  const char* folder = std::getenv("YARS_PICTURES");
  int number = 0;
  for (const Picture& picture : kPictures) {
    ASSERT_TRUE(std::filesystem::exists(run.frame(picture.time_s))) << picture.name;
    const std::string two_digits = std::to_string(100 + ++number).substr(1);
    if (folder != nullptr)
      std::filesystem::copy_file(run.frame(picture.time_s),
                                 std::filesystem::path(folder) / ("sortie_" + two_digits + "_" + picture.name + ".png"),
                                 std::filesystem::copy_options::overwrite_existing);
  }
}

void expect_update(const Recorded& recorded) {
  const auto feet_of_error = [&](double time_s) {
    return at(recorded.states, time_s).mission.north_m / geo::kMetresPerFoot;
  };
  const auto feet_shown = [&](double time_s) {
    const auto state = at(recorded.states, time_s);
    EXPECT_TRUE((state.flags & databuffer::kUpdateShown) != 0) << time_s;
    return std::hypot(state.update_north_m, state.update_east_m) / geo::kMetresPerFoot;
  };
  EXPECT_NEAR(feet_of_error(3), kError_ft, 0.5);
  EXPECT_LT(feet_shown(60), 1.0) << "the cursor is at the symbol of point 2, not at the video of the lagoon";
  EXPECT_NEAR(feet_shown(62), kError_ft, 10.0) << "the cursor is at the video of the lagoon";
  EXPECT_LT(feet_shown(64), 1.0);
  EXPECT_NEAR(feet_of_error(64), 0.0, 20.0);
  const auto cursor = at(recorded.states, 64);
  EXPECT_LT(metres_between(kLagoon, cursor.cursor_latitude_deg, cursor.cursor_longitude_deg), 10.0);
}

void expect_outputs(const Recorded& recorded) {
  EXPECT_EQ(at(recorded.outputs, 64).mark_count, 0);
  const auto marked = at(recorded.outputs, 66);
  ASSERT_EQ(marked.mark_count, 1);
  EXPECT_LT(metres_between(kLagoon, marked.marks[0].latitude_deg, marked.marks[0].longitude_deg), 10.0);
  EXPECT_EQ(marked.marks[0].sim_time_ns, 65'000'000'000);

  const auto designated = at(recorded.outputs, 70);
  EXPECT_STREQ(designated.target_name, "4.");
  EXPECT_EQ(designated.target_count, 1U);
  EXPECT_EQ(designated.cue_count, 1U) << "TGT also cues";
  EXPECT_LT(metres_between(kTarget, designated.target_latitude_deg, designated.target_longitude_deg), 60.0);
  EXPECT_GT(designated.slant_range_m, 0.0);
  EXPECT_EQ(designated.steering, static_cast<std::uint8_t>(databuffer::SteeringCommand::azimuth));

  EXPECT_EQ(at(recorded.outputs, 74).steering, static_cast<std::uint8_t>(databuffer::SteeringCommand::bank));
  const auto cued = at(recorded.outputs, 76.5);
  EXPECT_EQ(cued.cue_count, 2U);
  EXPECT_LT(metres_between(kLagoon, cued.cue_latitude_deg, cued.cue_longitude_deg), 1.0);
  EXPECT_EQ(at(recorded.outputs, 107).cue_count, 3U) << "on the map that A/A still shows";
}

void expect_steering_line(const LockstepRun& run) {
  const auto states = run.states();
  const auto psl = [&](double time_s) { return at(states, time_s)["psl"]; };
  EXPECT_TRUE(psl(67.5).is_null());
  EXPECT_EQ(psl(70)["state"], "LOS");
  EXPECT_EQ(psl(72)["state"], "SLEW");
  EXPECT_EQ(psl(74)["state"], "FIXED");
  const double turned_deg = psl(72)["heading_deg"].get<double>() - psl(70.5)["heading_deg"].get<double>();
  EXPECT_NEAR(turned_deg, 22.5, 0.5) << "half deflection for a second";
  EXPECT_EQ(psl(74)["heading_deg"], psl(72)["heading_deg"]);
  EXPECT_EQ(at(states, 108)["cursor_function"], "CUE");
}

void expect_maps(const Recorded& recorded) {
  const auto shown_at = [&](double time_s) { return at(recorded.states, time_s).map_shown; };
  // A map that is forming at the freeze is completed, so that `small` need not be the map after `large`.
  const std::uint64_t large = shown_at(100), small = shown_at(100.4);
  ASSERT_GT(large, 0U);
  ASSERT_GT(small, large);
  EXPECT_EQ(at(recorded.states, 98).map_old, large) << "STORE has stored the map OLD";
  EXPECT_EQ(shown_at(102), large);
  EXPECT_EQ(shown_at(106), large) << "A/A still shows the map";
  const auto window_of = [&](std::uint64_t id) {
    for (const auto& map : recorded.maps)
      if (map.id == id) return map.window_nm;
    return 0.0;
  };
  EXPECT_NEAR(window_of(large), 4.7, 1e-6);
  EXPECT_NEAR(window_of(small), 0.67, 1e-6);
  for (const auto& map : recorded.maps)
    EXPECT_LT(metres_between(kTarget, map.latitude_deg, map.longitude_deg), 60.0) << map.id;
}

void expect_flight(const Recorded& recorded) {
  const auto height_ft = [&](double time_s) {
    return at(recorded.statuses, time_s).height_above_ground_m / geo::kMetresPerFoot;
  };
  EXPECT_NEAR(height_ft(5), 8.0, 4.0);
  EXPECT_NEAR(height_ft(20), 8.0, 4.0) << "take-off run";
  EXPECT_GT(height_ft(80), 8000.0);
  const auto landed = recorded.statuses.rbegin()->second;
  EXPECT_NEAR(landed.height_above_ground_m / geo::kMetresPerFoot, 8.0, 4.0);
  EXPECT_EQ(std::hypot(landed.ownship.velocity_north_mps, landed.ownship.velocity_east_mps), 0.0);
  EXPECT_LT(metres_between(kRunway, landed.ownship.latitude_deg, landed.ownship.longitude_deg), 400.0);
}

// Looks for the last of the beacon's three replies on the display, where no symbol is. Its delay is 3 us + 2 x 12 us.
// At 150 m of range per microsecond the reply is 4050 m behind the beacon.
void expect_beacon(const LockstepRun& run, const Recorded& recorded) {
  constexpr int kTime_s = 130;
  constexpr double kBehind_m = 150.0 * (3 + 2 * 12), kPixels = 480.0;
  const databuffer::Ownship ownship = at(recorded.statuses, kTime_s).ownship;
  const auto line = geo::geodesic_inverse({ownship.latitude_deg, ownship.longitude_deg}, kRunway);
  const double track_rad = std::atan2(ownship.velocity_east_mps, ownship.velocity_north_mps);
  const double turn_rad = line.azimuth_at_start.radians() - track_rad;
  // Width and height of the display are 1.2 ranges. The aircraft is 0.1 range above the lower edge.
  const double edge_m = 1.2 * at(recorded.states, kTime_s).range_nm * geo::kMetresPerNauticalMile;
  const double away_m = line.distance.metres() + kBehind_m;
  const int column = static_cast<int>(kPixels * (0.5 + away_m * std::sin(turn_rad) / edge_m));
  const int row = static_cast<int>(kPixels * (1.1 / 1.2 - away_m * std::cos(turn_rad) / edge_m));
  const auto frame = test::read_png(run.frame(kTime_s));
  ASSERT_TRUE(frame.has_value());
  constexpr int kAround = 4;  // [pixels] on each side of the expected pixel
  const auto green = [&](int x, int y) {
    const auto pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(frame->width) + static_cast<std::size_t>(x);
    return frame->pixels[pixel * static_cast<std::size_t>(frame->channels) + 1];
  };
  int lit = 0;
  for (int y = row - kAround; y <= row + kAround; ++y)
    for (int x = column - kAround; x <= column + kAround; ++x) lit += green(x, y) > 120 ? 1 : 0;
  EXPECT_GE(lit, 5) << "about column " << column << ", row " << row;
  EXPECT_LT(lit_pixels(run.frame(kTime_s)), lit_pixels(run.frame(140)) / 2) << "BCN has no ground video, RBM has";
}

TEST(Sortie, UsesTheFunctionsOfTheRadarBetweenTakeOffAndLanding) {
  const SortieGround ground;
  const std::vector<ScriptedStep> steps = script();
  const LockstepRun run("sortie", steps, ground.flight(), ground.place());
  ASSERT_NO_FATAL_FAILURE(keep_pictures(run));
  expect_steps(run.entries(), steps);
  const Recorded recorded = read_recording(run.recording());
  ASSERT_FALSE(recorded.statuses.empty());
  expect_flight(recorded);
  expect_update(recorded);
  expect_outputs(recorded);
  expect_steering_line(run);
  expect_maps(recorded);
  expect_beacon(run, recorded);

  const json replayed = run.replayed();
  EXPECT_EQ(replayed["different"], 0);
  EXPECT_EQ(replayed["not_ready"], 0);
  EXPECT_EQ(replayed["ticks_lost"], 0);
  EXPECT_GT(replayed["equal"], 10'000);
}

}  // namespace
}  // namespace yars::endtoend
