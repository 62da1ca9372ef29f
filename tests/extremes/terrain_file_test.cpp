// Extreme elevation files: no post, one post, one row, only voids. Files too small are refused. Scans over such cells
// continue.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/terrain/formats/dted.hpp"
#include "model/terrain/formats/hgt.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/extremes/islands.hpp"
#include "tests/model/kernel/cockpit.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"

namespace yars::model {
namespace {

using test::geometry_from;
using test::seen;
using ::testing::HasSubstr;

constexpr geo::GeoPoint kMiddle{50.5, 10.5};
constexpr double kFileRange_m = 20000.0;

// A DTED file whose header states these numbers of columns and rows; all posts are at 7 m.
test::DtedFile dted_of(int columns, int rows) {
  const auto text = [](int number) {
    std::string digits = std::to_string(number);
    return std::string(4 - digits.size(), '0') + digits;
  };
  test::DtedFile file;
  file.longitude_count = text(columns);
  file.latitude_count = text(rows);
  for (int column = 0; column < columns; ++column)
    file.columns.push_back(
        {.longitude_index = column, .words = std::vector<std::uint16_t>(static_cast<std::size_t>(rows), 7)});
  return file;
}

TEST(ExtremeFiles, DtedOfOnePostRowOrColumnIsRefusedWithTheNumberOfPostsNeeded) {
  for (const auto& [columns, rows] : {std::pair{1, 1}, {5, 1}, {1, 5}, {0, 5}, {5, 0}, {0, 0}}) {
    SCOPED_TRACE(std::to_string(columns) + " x " + std::to_string(rows));
    const auto bytes = dted_of(columns, rows).bytes();
    const auto reading = terrain::parse_dted(bytes, "tiny.dt0", {50, 10});
    ASSERT_FALSE(reading.has_value());
    EXPECT_THAT(reading.error().message(), HasSubstr("2 to 3601 a side"));
  }
}

TEST(ExtremeFiles, HgtOfOnePostOrOneRowIsRefusedWithTheNumberOfBytesNeeded) {
  for (const std::size_t bytes :
       {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{2 * 1201}, std::size_t{2 * 3601}}) {
    const auto reading = terrain::parse_hgt(std::vector<std::byte>(bytes), "N50E010.hgt", {50, 10});
    ASSERT_FALSE(reading.has_value());
    EXPECT_THAT(reading.error().message(), HasSubstr("2884802"));
  }
}

TEST(ExtremeFiles, AFileOfOnePostIsReportedOnceAndASweepSeesTheLandBesideIt) {
  const test::TemporaryFolder folder;
  folder.write("e010/n50.dt0", dted_of(1, 1).bytes());
  folder.write("e011/n50.dt0", test::level_dted(50, 11, 100).bytes());
  auto store = terrain::DirectoryTerrainStore::open(folder.path(), {});
  ASSERT_TRUE(store.has_value()) << store.error().message();
  std::vector<std::string> problems;
  terrain::TerrainViewPointer view;
  for (int time = 0; time < 3; ++time) {
    view = (*store)->prepare({kMiddle, 100000.0});
    for (auto& problem : (*store)->take_problems()) problems.push_back(problem);
  }
  EXPECT_EQ(problems.size(), 1U);
  test::for_each_algorithm(200, [&](const radar::RadarConfiguration& configuration) {
    // The sweep begins in the cell of the refused file, which is void or sea. The land begins 35 km to the east.
    const auto power = seen(configuration, geometry_from(kMiddle, 90.0, 3000.0, 80000.0), *view);
    EXPECT_GT(power[150], 0.0F);
    const bool sea = view->elevation_m(kMiddle) == 0.0;
    EXPECT_EQ(power[40] > 0.0F, sea);
  });
}

TEST(ExtremeFiles, OverACellOfVoidsNoPowerReturnsAndNoGroundElevationIsReported) {
  const test::TemporaryFolder folder;
  folder.write("e010/n50.dt0", test::level_dted(50, 10, 0xFFFF).bytes());
  auto store = terrain::DirectoryTerrainStore::open(folder.path(), {});
  ASSERT_TRUE(store.has_value()) << store.error().message();
  const auto view = (*store)->prepare({kMiddle, kFileRange_m});
  test::for_each_algorithm_and_beam(200, [&](radar::RadarConfiguration& configuration) {
    for (const bool slant : {false, true}) {
      configuration.fidelity.slant_range = slant;
      EXPECT_TRUE(test::is_dark(seen(configuration, geometry_from(kMiddle, 30.0, 3000.0, kFileRange_m), *view)));
    }
    kernel::RadarKernel kernel(configuration);
    test::Cockpit cockpit;  // only its tick and sweep are used
    cockpit.tick.ownship.latitude_deg = kMiddle.latitude_deg;
    cockpit.tick.ownship.longitude_deg = kMiddle.longitude_deg;
    cockpit.tick.command.range_nm = 10.0;
    int sweeps = 0;
    for (int tick = 0; tick < 150; ++tick) {
      ++cockpit.tick.tick;
      if (!kernel.step(cockpit.tick, *view, cockpit.sweep)) continue;
      ++sweeps;
      // Without noise every sample has the level of the noise floor; with the algorithm of the 1996 report it is black.
      const auto* video = cockpit.sweep.video;
      ASSERT_TRUE(std::all_of(video, video + 200, [video](std::uint8_t level) { return level == video[0]; }));
    }
    EXPECT_GT(sweeps, 50);
    databuffer::ModelStatus status{};
    kernel.describe(*view, status);
    EXPECT_TRUE(std::isnan(status.ground_elevation_m) && std::isnan(status.height_above_ground_m));
  });
}

}  // namespace
}  // namespace yars::model
