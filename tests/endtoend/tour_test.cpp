// `scripts/start --tour` in lockstep: both tours of config/tours over the generated coast. The radar's state after each
// event and each caption are as the tours say. With YARS_PICTURES=FOLDER the test copies a frame of each caption there.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/text/plain_text.hpp"
#include "tests/endtoend/lockstep_run.hpp"

namespace yars::endtoend {
namespace {

using nlohmann::json;

constexpr geo::GeoPoint kApron{38.10558, -121.31794};        // point 4. of config/coast.guf
constexpr geo::GeoPoint kTransport{38.105022, -121.317160};  // the easternmost transport on the apron

// The terrain of scripts/start, with fewer posts, and its scenes; made once for all tests of this file.
class Coast : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::filesystem::temp_directory_path() / ("yars_tour_" + std::to_string(getpid()));
    make({"yars", "terrain", "generate", "--out", terrain(), "--airfields", "soil", "--level", "0"});
    std::filesystem::create_directories(terrain() + "/scenes");
    std::ifstream list(YARS_SOURCE_DIR "/config/coast.scenes");
    for (std::string line; std::getline(list, line);) {
      std::istringstream words(line);
      std::string file, kind, triangles, origin;
      words >> file >> kind >> triangles >> origin;
      if (file.empty() || file.starts_with('#')) continue;
      make({"yars", "scene", "generate", "--kind", kind, "--triangles", triangles, "--origin", origin, "--out",
            terrain() + "/scenes/" + file});
    }
  }
  static void TearDownTestSuite() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  static std::string terrain() { return (folder_ / "terrain").string(); }

 private:
  static void make(const std::vector<std::string>& command) {
    const Finished finished = run_program(command, 240.0);
    if (finished.code != 0) throw std::runtime_error(finished.errors);
  }
  static inline std::filesystem::path folder_;
};

// One run of a tour: what was recorded, and the captions in the order in which they came up.
struct TourRun {
  TourRun(const std::string& name, const std::string& file, const std::string& configuration,
          const std::string& terrain, int seconds)
      : run(name, "tour:" YARS_SOURCE_DIR "/config/tours/" + file, seconds,
            "route:" YARS_SOURCE_DIR "/config/routes/default.route",
            {terrain, YARS_SOURCE_DIR "/config/" + configuration}, [this](const ProcessSet& set) { look(set); }) {}

  void look(const ProcessSet& set) {
    if (!session) {
      auto opened = databuffer::Session::open_read_only(set.session());
      if (!opened) return;
      session = std::make_unique<databuffer::Session>(std::move(*opened));
    }
    const auto caption = databuffer::read_valid(std::as_const(*session).layout().caption);
    if (!caption || caption->step == 0) return;
    EXPECT_EQ(caption->waiting, 0U);
    steps = caption->steps;
    captions.emplace(caption->step, *caption);
  }

  std::unique_ptr<databuffer::Session> session;
  std::map<std::uint32_t, databuffer::Caption> captions;  // by number
  std::uint32_t steps = 0;
  LockstepRun run;
};

// The texts of a tour's captions, as the file has them.
std::vector<std::string> captions_in(const std::string& file) {
  std::vector<std::string> texts;
  std::ifstream lines(YARS_SOURCE_DIR "/config/tours/" + file);
  constexpr std::string_view kWord = " caption ";
  for (std::string line; std::getline(lines, line);)
    if (const auto at = line.find(kWord); at != std::string::npos && !line.starts_with('#'))
      texts.push_back(line.substr(at + kWord.size()));
  return texts;
}

void expect_captions(const TourRun& tour, const std::string& file) {
  const auto texts = captions_in(file);
  EXPECT_EQ(tour.steps, texts.size());
  ASSERT_EQ(tour.captions.size(), texts.size()) << "each caption was seen in the segment";
  for (const auto& [number, caption] : tour.captions) {
    std::string shown;
    for (const auto& line : caption.lines)
      if (line.text[0] != '\0') shown += (shown.empty() ? "" : "|") + std::string(text::text_of(line.text));
    EXPECT_EQ(shown, texts[number - 1]);
  }
}

// A frame of each caption, taken 2 s before the next one.
void keep_pictures(const TourRun& tour, const std::string& prefix, int end_s) {
  const char* folder = std::getenv("YARS_PICTURES");
  if (folder == nullptr) return;
  for (auto caption = tour.captions.begin(); caption != tour.captions.end(); ++caption) {
    const auto next = std::next(caption);
    const double until_s = next == tour.captions.end() ? end_s : static_cast<double>(next->second.sim_time_ns) * 1e-9;
    const int time_s = static_cast<int>((until_s - 1.0) / 2.0) * 2;
    const std::string number = std::to_string(100 + caption->first).substr(1);
    std::filesystem::copy_file(tour.run.frame(time_s), std::filesystem::path(folder) / (prefix + "_" + number + ".png"),
                               std::filesystem::copy_options::overwrite_existing);
  }
}

// Value of a field of the state that applies at a time of the tour [s].
json field_at(const std::map<std::int64_t, json>& states, double time_s, const std::string& field) {
  auto state = states.upper_bound(std::llround(time_s * 200.0));
  return state == states.begin() ? json() : std::prev(state)->second[field];
}

double metres_between(const json& position, geo::GeoPoint point) {
  return geo::geodesic_inverse({position["lat"], position["lon"]}, point).distance.metres();
}

// Effect of each event of radar.tour, and a field of the state after it.
const std::vector<ScriptedStep>& radar_steps() {
  static const std::vector<ScriptedStep> kSteps{
      {"power opr", true, "power", "OPR"},
      {"elevation -3", true, "mode", "RBM"},
      {"pb 14", true, "range_nm", 20.0},
      {"pb 14", true, "range_nm", 10.0},
      {"pb 13", true, "range_nm", 20.0},
      {"pb 13", true, "range_nm", 40.0},
      {"pb 13", true, "range_nm", 80.0},
      {"pb 14", true, "range_nm", 40.0},
      {"pb 17", true, "sequence_point", "2"},
      {"pb 17", true, "sequence_point", "3"},
      {"pb 17", true, "sequence_point", "4."},
      {"tdc release", true, "window_nm", 4.7},
      {"acq aft", true, "window_nm", 3.3},
      {"acq aft", true, "window_nm", 1.3},
      {"acq aft", true, "window_nm", 0.67},
      {"tdc release", true, "mode", "PATCH"},
      {"pb 7", true, "cursor_function", "UPDT"},
      {"pb 7", true, "cursor_function", "CUE"},
      {"pb 7", true, "cursor_function", "TGT"},
      {"tdc -0.6 -0.07", true, "mode", "PATCH"},
      {"tdc 0 0", true, "mode", "PATCH"},
      {"tdc release", true, "cursor_function", "TGT"},
      {"nav error mn 500 -300", true, "nav_source", "MN"},
      {"sp 4.", true, "sequence_point", "4."},
      {"pb 7", true, "cursor_function", "MARK"},
      {"pb 7", true, "cursor_function", "MAP"},
      {"pb 7", true, "cursor_function", "UPDT"},
      {"tdc 0.568 -0.085", true, "mode", "PATCH"},
      {"tdc 0 0", true, "mode", "PATCH"},
      {"tdc release", true, "cursor_function", "UPDT"},
      {"freeze", true, "freeze", true},
      {"pb 10", true, "recall", "OLD"},
      {"pb 15", true, "recall", "STORE"},
      {"pb 10", true, "recall", "NEW"},
      {"pb 10", true, "recall", "STORE"},
      {"freeze", true, "freeze", false},
      {"pb 14", true, "mode", "HRM"},
      {"pb 7", true, "cursor_function", "CUE"},
      {"pb 7", true, "cursor_function", "TGT"},
      {"pb 7", true, "cursor_function", "MARK"},
      {"pb 7", true, "cursor_function", "MAP"},
      {"pb 14", true, "range_nm", 20.0},
      {"pb 14", true, "range_nm", 10.0},
      {"pb 9", true, "scan", "HALF"},
      {"pb 9", true, "scan", "QTR"},
      {"pb 9", true, "scan", "FULL"},
      {"sp 5", true, "sequence_point", "5"},
      {"pb 6", true, "mode", "BCN"},
      {"pb 6", true, "mode", "PVU"},
      {"pb 6", true, "mode", "RBM"},
      {"elevation 2", true, "mode", "RBM"},
      {"elevation -3", true, "mode", "RBM"},
      {"pb 20", true, "band", "B"},
      {"pb 18", true, "sniff", true},
      {"pb 18", true, "sniff", false},
      {"pb 20", true, "band", "C"},
  };
  return kSteps;
}

TEST_F(Coast, TheTourOfTheRadarDoesWhatItsCaptionsSay) {
  constexpr int kEnd_s = 225;
  const TourRun tour("tour-radar", "radar.tour", "default.guf", terrain(), kEnd_s);
  expect_captions(tour, "radar.tour");
  keep_pictures(tour, "tour", kEnd_s);
  expect_steps(tour.run.entries(), radar_steps());
  const auto states = tour.run.states();
  const json target = field_at(states, 90.0, "target");
  ASSERT_TRUE(target.is_object());
  EXPECT_LT(metres_between(target, kTransport), 25.0) << "a transport is 24 m long and wide";
  // The update corrects what the instructor has spoiled: 583 ft.
  const json error = field_at(states, 105.0, "update_error");
  ASSERT_TRUE(error.is_object());
  EXPECT_NEAR(error["value"].get<double>(), 583.0, 25.0);
  EXPECT_EQ(error["unit"], "ft");
  EXPECT_LT(field_at(states, 110.0, "update_error")["value"].get<double>(), 1.0);
  EXPECT_LT(metres_between(field_at(states, 110.0, "cursor"), kApron), 10.0);
  // Sea, land and town: neither an empty picture nor a full one.
  for (const int time_s : {10, 24, 32, 60, 70}) {
    EXPECT_GT(lit_pixels(tour.run.frame(time_s)), 20'000U) << time_s;
    EXPECT_LT(lit_pixels(tour.run.frame(time_s)), 200'000U) << time_s;
  }
  // On band B the jammer's strobe; with SNIFF the strobe alone.
  EXPECT_LT(lit_pixels(tour.run.frame(208)), lit_pixels(tour.run.frame(202)) / 2);
}

TEST_F(Coast, TheTourOfTheSecondRadarShowsItsOwnRangesAndWindows) {
  constexpr int kEnd_s = 41;
  const TourRun tour("tour-second", "second_radar.tour", "default_apg68.guf", terrain(), kEnd_s);
  expect_captions(tour, "second_radar.tour");
  keep_pictures(tour, "tour_second", kEnd_s);
  expect_steps(tour.run.entries(), {{"power opr", true, "power", "OPR"},
                                    {"sp 4.01", true, "window_nm", 5.0},
                                    {"tdc release", true, "range_nm", 40.0}});
  EXPECT_EQ(field_at(tour.run.states(), 32.0, "mode"), "PATCH");
}

// The events of docs/first_sortie.md: the rows "| key | `event` | ..." of its tables, by section.
std::vector<std::vector<std::string>> events_of_the_page() {
  std::vector<std::vector<std::string>> sections;
  std::ifstream page(YARS_SOURCE_DIR "/docs/first_sortie.md");
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) sections.emplace_back();
    const auto cells = text::fields_of(line, '|');
    if (sections.empty() || cells.size() < 5 || cells[2].size() < 3 || !cells[2].starts_with('`')) continue;
    sections.back().emplace_back(cells[2].substr(1, cells[2].size() - 2));
  }
  std::erase_if(sections, [](const auto& section) { return section.empty(); });
  return sections;
}

// What the state is after each event of the page.
const std::vector<ScriptedStep>& sortie_steps() {
  static const std::vector<ScriptedStep> kSteps{{"pb 14", true, "range_nm", 20.0},
                                                {"pb 13", true, "range_nm", 40.0},
                                                {"pb 17", true, "sequence_point", "2"},
                                                {"pb 17", true, "sequence_point", "3"},
                                                {"pb 17", true, "sequence_point", "4."},
                                                {"tdc press", true, "mode", "RBM"},
                                                {"tdc release", true, "window_nm", 4.7},
                                                {"acq aft", true, "window_nm", 3.3},
                                                {"acq aft", true, "window_nm", 1.3},
                                                {"acq aft", true, "window_nm", 0.67},
                                                {"tdc press", true, "mode", "PATCH"},
                                                {"tdc release", true, "mode", "PATCH"},
                                                {"pb 7", true, "cursor_function", "UPDT"},
                                                {"pb 7", true, "cursor_function", "CUE"},
                                                {"pb 7", true, "cursor_function", "TGT"},
                                                {"tdc -1 0", true, "mode", "PATCH"},
                                                {"tdc 0 0", true, "mode", "PATCH"},
                                                {"tdc press", true, "cursor_function", "TGT"},
                                                {"tdc release", true, "cursor_function", "TGT"}};
  return kSteps;
}

TEST_F(Coast, TheFirstSortieOfTheDocumentsDesignatesAnAircraftOnTheApron) {
  constexpr double kReading_s = 12.0, kTap_s = 0.15;  // before each section; a short tap of an arrow key
  std::vector<ScriptedStep> steps{{"power opr", true, "power", "OPR"}, {"elevation -3", true, "range_nm", 40.0, 1.0}};
  std::size_t row = 0;
  for (const auto& section : events_of_the_page()) {
    double after_s = kReading_s;
    for (const std::string& event : section) {
      ASSERT_LT(row, sortie_steps().size()) << event;
      steps.push_back(sortie_steps()[row++]);
      EXPECT_EQ(steps.back().event, event) << "row " << row << " of docs/first_sortie.md";
      steps.back().after_s = after_s;
      after_s = event == "tdc -1 0" ? kTap_s : 1.0;
    }
  }
  ASSERT_EQ(row, sortie_steps().size());
  const LockstepRun run("first-sortie", steps, "route:" YARS_SOURCE_DIR "/config/routes/default.route",
                        {terrain(), YARS_SOURCE_DIR "/config/default.guf"});
  expect_steps(run.entries(), steps);
  // From the first seconds there is something to see: RBM, 40 NM, coast, towns, mountains, ships.
  for (const int time_s : {4, 8, 12}) {
    EXPECT_GT(lit_pixels(run.frame(time_s)), 30'000U) << time_s;
    EXPECT_LT(lit_pixels(run.frame(time_s)), 120'000U) << time_s;
  }
  const json target = run.states().rbegin()->second["target"];
  ASSERT_TRUE(target.is_object());
  EXPECT_EQ(target["name"], "4.02");
  EXPECT_LT(metres_between(target, kTransport), 25.0) << "a transport is 24 m long and wide";
}

}  // namespace
}  // namespace yars::endtoend
