// `yars trade`: error measures of scans against the ruler, candidates, tables, and refused input.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "lib/radar/configuration.hpp"
#include "lib/text/plain_text.hpp"
#include "model/terrain/sampling/analytic_terrain.hpp"
#include "tools/trade/scenes.hpp"
#include "tools/trade/trade_errors.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::tools::trade {
namespace {

radar::RadarConfiguration with(const radar::Fidelity& fidelity) {
  radar::RadarConfiguration configuration;
  configuration.fidelity = fidelity;
  return configuration;
}

// A scan of 10 degrees width; narrow, because the reference is slow.
model::kernel::ScanRequest narrow_scan(double range_nm) {
  return request_of({{37.0, -122.0}, 5000.0, 60.0, range_nm}, geo::Angle::degrees(10.0), {});
}

TEST(Scenes, LimitTheElevationToTheGimbalOfTheConfiguration) {
  const Scene scene{
      {37.0, -122.0}, 600'000.0, 60.0, 10.0};  // sea level at the end of the range lies 84 deg below the horizon
  for (const double limit_deg : {30.0, 60.0}) {
    radar::AntennaConfiguration antenna;
    antenna.elevation_limit_deg = limit_deg;
    EXPECT_NEAR(request_of(scene, geo::Angle::degrees(10.0), antenna).elevation.degrees(), -limit_deg, 1e-12);
  }
  EXPECT_NEAR(request_of({{37.0, -122.0}, 6076.115, 60.0, 1.0}, geo::Angle::degrees(10.0), {}).elevation.degrees(),
              -45.0, 1e-3);
}

TEST(Trade, TheReferenceAgainstItselfHasNoError) {
  const auto hills = model::terrain::AnalyticTerrain(model::terrain::built_in_hills());
  const auto configuration = with(*radar::fidelity_preset("reference"));
  const auto scan = narrow_scan(40.0);
  const Errors errors = errors_against(make_ruler(configuration, scan, hills), observe(configuration, scan, hills));
  EXPECT_EQ(errors.position_m, 0.0);
  EXPECT_EQ(errors.shadow_percent, 0.0);
  EXPECT_EQ(errors.power_db, 0.0);
  EXPECT_EQ(errors.gray_levels, 0.0);
  EXPECT_EQ(errors.brightness_db, 0.0);
}

TEST(Trade, StandardKeepsItsBoundsAgainstTheReferenceAlgorithmWithTheSameKnobs) {
  const auto hills = model::terrain::AnalyticTerrain(model::terrain::built_in_hills());
  auto fidelity = *radar::fidelity_preset("standard");
  const auto standard = with(fidelity);
  fidelity.algorithm = radar::Algorithm::reference;
  for (const double range_nm : {10.0, 40.0, 160.0}) {
    SCOPED_TRACE(range_nm);
    const auto scan = narrow_scan(range_nm);
    const Errors errors = errors_against(make_ruler(with(fidelity), scan, hills), observe(standard, scan, hills));
    // Hills without posts: `standard` finds no shadow between samples.
    EXPECT_LE(errors.shadow_percent, 0.6);
    EXPECT_LE(errors.gray_levels, 9.0);
    EXPECT_LE(errors.position_m, 0.5);
    EXPECT_GT(errors.position_m, 0.0);
  }
}

TEST(Trade, FineKeepsItsBoundsAgainstTheReference) {
  const auto hills = model::terrain::AnalyticTerrain(model::terrain::built_in_hills());
  for (const double range_nm : {10.0, 40.0}) {
    SCOPED_TRACE(range_nm);
    const auto scan = narrow_scan(range_nm);
    auto reference = *radar::fidelity_preset("reference");
    reference.diffraction = false;  // which fine has not
    const Ruler ruler = make_ruler(with(reference), scan, hills);
    const Errors errors = errors_against(ruler, observe(with(*radar::fidelity_preset("fine")), scan, hills));
    EXPECT_LE(errors.shadow_percent, 0.2);
    EXPECT_LE(errors.gray_levels, 0.8);
    EXPECT_LE(errors.power_db, 0.1);
  }
}

// Checks that the measures respond to a coarser picture.
TEST(Trade, FewerSamplesGiveLargerErrors) {
  const auto hills = model::terrain::AnalyticTerrain(model::terrain::built_in_hills());
  const auto scan = narrow_scan(40.0);
  const Ruler ruler = make_ruler(with(*radar::fidelity_preset("reference")), scan, hills);
  const auto sweep = *knob_candidates("samples=60,480", *radar::fidelity_preset("standard"), Subject::scan);
  const Errors coarse = errors_against(ruler, observe(with(sweep[0].fidelity), scan, hills));
  const Errors fine = errors_against(ruler, observe(with(sweep[1].fidelity), scan, hills));
  EXPECT_GT(coarse.gray_levels, fine.gray_levels);
  EXPECT_GT(coarse.shadow_percent, fine.shadow_percent);
  EXPECT_GT(fine.shadow_percent, 0.0);
}

// A sweep of two samples against a ruler of four: two samples of the ruler share one. Expected values are computed by
// hand.
TEST(Trade, ComparesOnTheRulersGridByTheNearestSample) {
  Ruler ruler;
  ruler.observation = {1, 4, {1.0F, 1.0F, 1.0F, 1.0F}, {10, 10, 20, 20}, {1, 1, 0, 1}, {1, 1, 0, 1}, 0.0, true};
  ruler.ground = {1, 1, 1, 0};
  const ScanObservation found{1, 2, {0.1F, 1.0F}, {10, 24}, {1, 1}, {1, 1}, 3.0, true};
  const Errors errors = errors_against(ruler, found);
  EXPECT_DOUBLE_EQ(errors.position_m, 3.0);
  EXPECT_DOUBLE_EQ(errors.shadow_percent, 100.0 / 3.0);  // the void does not count
  EXPECT_NEAR(errors.power_db, 10.0, 1e-6);  // over the first two samples: the third is in shadow, the fourth void
  EXPECT_DOUBLE_EQ(errors.gray_levels, std::sqrt(8.0));
  EXPECT_NEAR(errors.brightness_db, 10.0 * std::log10(2.2 / 4.0), 1e-6);
}

TEST(Trade, The1996PresetHasNoPowerError) {
  Ruler ruler;
  ruler.observation = {1, 1, {1.0F}, {10}, {1}, {1}, 0.0, true};
  ruler.ground = {1};
  EXPECT_TRUE(std::isnan(errors_against(ruler, {1, 1, {0.5F}, {9}, {1}, {1}, 0.0, false}).power_db));
}

TEST(Trade, AKnobSweepNamesEachCandidateAndSetsOnlyThatKnob) {
  const auto base = *radar::fidelity_preset("standard");
  const auto sweep = knob_candidates("geodesicKnots=2,3,5", base, Subject::scan);
  ASSERT_TRUE(sweep);
  ASSERT_EQ(sweep->size(), 3U);
  EXPECT_EQ((*sweep)[1].name, "geodesicKnots=3");
  EXPECT_EQ((*sweep)[1].family, "geodesicKnots");
  EXPECT_EQ((*sweep)[1].fidelity.geodesic_knots, 3);
  EXPECT_EQ((*sweep)[1].fidelity.samples, base.samples);
  EXPECT_EQ((*knob_candidates("interpolation=cubic", base, Subject::scan))[0].fidelity.interpolation,
            radar::Interpolation::cubic);
  EXPECT_TRUE((*knob_candidates("azimuthSmear=true", base, Subject::scan))[0].fidelity.azimuth_smear);
  EXPECT_EQ((*knob_candidates("beam=hard-edge", base, Subject::scan))[0].fidelity.beam, radar::BeamPattern::hard_edge);
}

TEST(Trade, AKnobHasTheLimitsOfItsSlot) {
  const auto base = *radar::fidelity_preset("standard");
  EXPECT_EQ((*knob_candidates("geodesicKnots=1", base, Subject::map))[0].fidelity.geodesic_knots, 1);
  EXPECT_EQ((*knob_candidates("mapSize=4096", base, Subject::map))[0].fidelity.map_size, 4096);
  EXPECT_EQ(knob_candidates("samples=4097", base, Subject::scan).error().message(),
            "knob: expected a whole number in [1, 4096] for samples, found '4097'");
}

TEST(Trade, PresetsAllNamesEveryPreset) {
  EXPECT_EQ(preset_candidates("all")->size(), radar::fidelity_names().size());
  EXPECT_EQ((*preset_candidates("draft,fine"))[1].name, "fine");
  EXPECT_TRUE(preset_candidates("none")->empty());
}

void expect_refused(const error::Error& error) {
  EXPECT_TRUE(error.bad_usage());
  EXPECT_FALSE(error.message().empty());
  EXPECT_EQ(error.message().find('\n'), std::string::npos) << error.message();
}

TEST(Trade, RefusesBadInputWithAMessageOfOneLine) {
  const radar::Fidelity base;
  for (const char* sweep :
       {"", "samples", "samples=", "samples=0", "samples=4097", "samples=12x", "samples=120,,240", "sample=5",
        "geodesicKnots=10", "earth=sphere :samples 3", "interpolation=best", "postsPerSample=-1", "postsPerSample=nan",
        "earth=disc", "subBeams=16", "sweepsPerRay=2", "azimuthSmear=1", "beam=hard", "mapSize=480"}) {
    const auto found = knob_candidates(sweep, base, Subject::scan);
    ASSERT_FALSE(found) << sweep;
    expect_refused(found.error());
  }
  for (const char* scene : {"", "37,-122,15000,60", "37,-122,15000,60,40,1", "91,0,0,0,40", "0,181,0,0,40",
                            "a,0,0,0,40", "0,0,0,0,0", "0,0,inf,0,40", "0,0,0,0,40 x"}) {
    const auto found = scene_of(scene);
    ASSERT_FALSE(found) << scene;
    expect_refused(found.error());
  }
  for (const char* presets : {"", "best", "draft,"}) {
    const auto found = preset_candidates(presets);
    ASSERT_FALSE(found) << presets;
    expect_refused(found.error());
  }
}

// Two candidates over two scenes. The gray-level error of the first candidate is larger in the second scene.
TradeTable small_table() {
  TradeTable table;
  table.candidates = {{"draft", "preset", {}}, {"samples=240", "samples", {}}};
  table.columns = kScanColumns;
  table.scene_fields = kScanFields;
  table.scenes = {row_of(Scene{{37.0, -122.0}, 15000.0, 60.0, 10.0}),
                  row_of(Scene{{37.0, -122.0}, 15000.0, 60.0, 160.0})};
  const double none = std::numeric_limits<double>::quiet_NaN();
  table.values = {{Values{1.0, 2e6, 5e6, 0.1, 1.0, 2.0, 3.0, 0.2}, Values{2.0, 1e6, 9e6, 0.3, 2.0, 3.0, 7.0, -0.4}},
                  {Values{4.0, 3e6, 5e6, 0.0, 0.5, none, 1.0, none}, Values{3.0, 4e6, 5e6, 0.0, 0.0, none, 0.0, none}}};
  return table;
}

TEST(Trade, TheWorstCaseIsTheMaximumOverTheScenesForSpeedTheMinimum) {
  const Summary gray = summary_of(small_table(), 0, kScanGray);
  EXPECT_DOUBLE_EQ(gray.mean, 5.0);
  EXPECT_DOUBLE_EQ(gray.worst, 7.0);
  EXPECT_EQ(gray.worst_scene, 1U);
  EXPECT_EQ(summary_of(small_table(), 1, kScanMs).worst_scene, 0U);
  EXPECT_DOUBLE_EQ(summary_of(small_table(), 0, kSamplesPerSecond).worst, 1e6);  // the lowest speed is the worst
  EXPECT_TRUE(std::isnan(summary_of(small_table(), 1, kScanPower).mean));
  EXPECT_DOUBLE_EQ(summary_of(small_table(), 0, kScanBrightness).worst, -0.4);  // farthest from 0
}

TEST(Trade, CsvHasOneCompleteRowPerCandidateAndScene) {
  std::istringstream csv(csv_text(small_table()));
  std::string line;
  ASSERT_TRUE(std::getline(csv, line));
  const auto names = text::fields_of(line, ',').size();
  EXPECT_EQ(line.substr(0, 12), "point,family");
  std::set<std::string> rows;
  while (std::getline(csv, line)) {
    const auto fields = text::fields_of(line, ',');
    ASSERT_EQ(fields.size(), names) << line;
    rows.insert(std::string(fields[0]) + " " + std::string(fields[2]));
    EXPECT_TRUE(text::finite_number(fields[names - 2])) << line;
    EXPECT_TRUE(text::finite_number(fields[names - 1]) || fields[names - 1].empty()) << line;
  }
  EXPECT_EQ(rows, (std::set<std::string>{"draft 1", "draft 2", "samples=240 1", "samples=240 2"}));
}

TEST(Trade, TheTableNamesTheWorstScene) {
  const std::string text = table_text(small_table());
  EXPECT_NE(text.find("5.00 / 7.00 @2"), std::string::npos) << text;
  EXPECT_NE(text.find("@2: 37 -122 15000 ft 60 deg 160 NM"), std::string::npos) << text;
}

}  // namespace
}  // namespace yars::tools::trade
