// Facts about the public library (radar/yars): requests, errors, calls from many threads, and equal pictures by each
// way.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <thread>
#include <vector>

#include "tests/endtoend/process_set.hpp"
#include "yars/radar.hpp"

namespace yars {
namespace {

using testing::HasSubstr;

Radar radar_of(const std::string& preset) {
  return *Radar::make({.preset = preset});
}
Terrain hills() {
  return *Terrain::open({});
}
ScanRequest near_scan() {
  ScanRequest request;
  request.range_nm = 5.0;
  request.width_deg = 10.0;
  return request;
}
PatchRequest small_map() {
  PatchRequest request;
  request.window_nm = 1.3;
  request.size = 64;
  request.threads = 1;
  return request;
}

TEST(Library, GivesTheScanAndTheMapOfTheCommands) {
  const Radar radar = radar_of("draft");
  const auto scan = radar.scan(hills(), near_scan());
  ASSERT_TRUE(scan) << scan.error().message();
  EXPECT_THAT(
      endtoend::run_program({"yars", "scan", "--fidelity", "draft", "--range-nm", "5", "--scan-width", "10"}).output,
      HasSubstr("hash    " + std::to_string(scan->hash())));
  const auto patch = radar.patch(hills(), small_map());
  ASSERT_TRUE(patch) << patch.error().message();
  EXPECT_THAT(
      endtoend::run_program({"yars", "patch", "--fidelity", "draft", "--window-nm", "1.3", "--size", "64"}).output,
      HasSubstr("hash    " + std::to_string(patch->hash())));
}

TEST(Library, AnErrorHasCodeFieldAndLimits) {
  const Radar radar = radar_of("draft");
  ScanRequest request = near_scan();
  request.latitude_deg = 91.0;
  const auto beyond = radar.scan(hills(), request);
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error().code, ErrorCode::range);
  EXPECT_EQ(beyond.error().subject, "latitude_deg");
  EXPECT_EQ(beyond.error().low, -90.0);
  EXPECT_EQ(beyond.error().high, 90.0);
  EXPECT_EQ(beyond.error().message(), "latitude_deg: expected -90 to 90 deg, found 91");
  request.latitude_deg = std::nan("");
  EXPECT_EQ(radar.scan(hills(), request).error().code, ErrorCode::range);

  PatchRequest map = small_map();
  map.heading_deg = 150.0;
  const auto limit = radar.patch(hills(), map);
  ASSERT_FALSE(limit);
  EXPECT_EQ(limit.error().code, ErrorCode::limit);
  EXPECT_THAT(limit.error().message(), HasSubstr("give `heading_deg=103`, or give `force=true`"));
  EXPECT_FALSE(limit.error().bad_usage());

  EXPECT_EQ(Terrain::open({.folder = "/nowhere"}).error().code, ErrorCode::failed);
  EXPECT_EQ(Radar::make({.preset = "quick"}).error().code, ErrorCode::argument);
  EXPECT_EQ(Radar::make({.knobs = {{"samples", 0.5}}}).error().code, ErrorCode::argument);
  EXPECT_EQ(Radar::make({.guf = "( Sea :state 9 )"}).error().code, ErrorCode::argument);
  EXPECT_EQ(Scene::read({"/nowhere.flt"}, hills()).error().code, ErrorCode::failed);
}

TEST(Library, KnobsGoBeforeThePresetAndForms) {
  const auto radar =
      Radar::make({.preset = "fine",
                   .guf = "( Fidelity :samples 100 )",
                   .knobs = {{"samples", 99.0}, {"mapLayover", false}, {"earth", std::string("sphere")}}});
  ASSERT_TRUE(radar) << radar.error().message();
  EXPECT_EQ(radar->samples(), 99);
  EXPECT_THAT(radar->guf(), HasSubstr(":earth sphere"));
}

TEST(Library, OneRadarAndOneTerrainServeManyThreads) {
  const Radar radar = radar_of("draft");
  const Terrain terrain = hills();
  const std::uint64_t wanted = radar.scan(terrain, near_scan())->hash();
  std::array<std::uint64_t, 4> found{};
  std::vector<std::thread> threads;
  for (std::uint64_t& hash : found)
    threads.emplace_back(
        [&] { hash = radar.scan(terrain, near_scan()).map([](const Scan& s) { return s.hash(); }).value_or(0); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(found, testing::Each(wanted));
}

TEST(Library, ACallCanBeEndedAndMadeAgain) {
  const Radar radar = radar_of("draft");
  const Terrain terrain = hills();
  auto patch = Patch::prepare(radar, terrain, small_map());
  ASSERT_TRUE(patch);
  int asked = 0;
  const auto ended = patch->run({.goes_on = [&] { return ++asked < 3; }});
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().code, ErrorCode::cancelled);
  std::vector<std::string> steps;
  double last = 0.0;
  ASSERT_TRUE(patch->run({.progress = [&](std::string_view step, double share) {
    steps.emplace_back(step);
    EXPECT_GE(share, last);
    last = share;
  }}));
  EXPECT_EQ(steps.size(), Patch::steps().size());
  EXPECT_EQ(last, 1.0);
  EXPECT_EQ(patch->hash(), radar.patch(terrain, small_map())->hash());

  ScanRequest wide = near_scan();
  wide.range_nm = 80.0;
  EXPECT_EQ(radar.scan(terrain, wide, nullptr, {.goes_on = [] { return false; }}).error().code, ErrorCode::cancelled);
}

TEST(Library, APatchIsUsedAgainForAnotherRequest) {
  const Radar radar = radar_of("draft");
  const Terrain terrain = hills();
  PatchRequest other = small_map();
  other.map = 7;
  auto patch = Patch::prepare(radar, terrain, small_map());
  ASSERT_TRUE(patch->run());
  ASSERT_TRUE(patch->prepare_next(terrain, other));
  ASSERT_TRUE(patch->run());
  EXPECT_EQ(patch->hash(), radar.patch(terrain, other)->hash());
  EXPECT_NE(patch->hash(), radar.patch(terrain, small_map())->hash());
  other.latitude_deg = 200.0;
  EXPECT_EQ(patch->prepare_next(terrain, other).error().subject, "latitude_deg");
}

TEST(Library, ResultsStayAfterTheThreadsHaveEnded) {
  const Radar radar = radar_of("draft");
  auto scan = Scan::prepare(radar, hills(), near_scan());
  ASSERT_TRUE(scan->run());
  const std::uint64_t hash = scan->hash();
  const float power = scan->power()[7];
  scan->finish();
  EXPECT_EQ(scan->hash(), hash);
  EXPECT_EQ(scan->power()[7], power);
  EXPECT_EQ(scan->sweep(0)->video.size(), scan->samples());
  const auto beyond = scan->sweep(scan->sweeps());
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error().code, ErrorCode::argument);
  const auto labels = scan->labels();
  ASSERT_TRUE(labels);
  EXPECT_EQ((*labels)->shadow.size(), scan->power().size());
  ASSERT_TRUE(scan->run());
  EXPECT_EQ(scan->hash(), hash);
}

TEST(Library, ResultsThatAreAskedForTooEarlyAreEmptyOrFromTheRequest) {
  const Radar radar = radar_of("draft");
  auto scan = Scan::prepare(radar, hills(), near_scan());
  EXPECT_EQ(scan->sweeps(), 0U);
  EXPECT_EQ(scan->samples(), 0U);
  const ScanFacts facts = scan->facts();
  EXPECT_EQ(facts.latitude_deg, near_scan().latitude_deg);
  auto labelled = Scan::prepare(radar, hills(), near_scan());
  const auto labels = labelled->labels();
  ASSERT_TRUE(labels);
  EXPECT_FALSE((*labels)->shadow.empty());
  ASSERT_TRUE(scan->run());
  EXPECT_EQ(scan->facts().range_m, facts.range_m);
  const auto patch = Patch::prepare(radar, hills(), small_map());
  EXPECT_EQ(patch->facts().looks, radar.patch(hills(), small_map())->facts().looks);
  EXPECT_TRUE(patch->positions().latitude_deg.empty());
  patch->hash();
}

TEST(Library, ElevationsAreCheckedAndMeasured) {
  const std::array<double, 2> latitude{37.5, 37.6}, longitude{-122.5, -122.5};
  std::array<double, 2> height{};
  ASSERT_TRUE(hills().elevations(latitude, longitude, height));
  EXPECT_TRUE(std::isfinite(height[0]) && std::isfinite(height[1]));
  const std::array<double, 2> beyond{37.5, 90.5};
  EXPECT_EQ(hills().elevations(beyond, longitude, height).error().message(),
            "latitude_deg: expected -90 to 90 deg, found 90.5");
  EXPECT_EQ(hills().elevations(latitude, longitude, std::span(height).first(1)).error().code, ErrorCode::argument);
}

TEST(Library, MoversChangeTheMap) {
  const Radar radar = radar_of("draft");
  const Terrain terrain = hills();
  const std::array movers{Mover{37.9, -122.3, 90.0, 0.0, 1e6, 5.0}};
  auto patch = Patch::prepare(radar, terrain, small_map(), {.movers = movers});
  ASSERT_TRUE(patch) << patch.error().message();
  ASSERT_TRUE(patch->run());
  EXPECT_NE(patch->hash(), radar.patch(terrain, small_map())->hash());
}

}  // namespace
}  // namespace yars
