// A map is bit-identical for any number of threads, for all sets of vector instructions, and for any size of the
// sectors in which it is computed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lib/radar/configuration.hpp"
#include "model/hrm/point_response.hpp"
#include "tests/lib/simd/vector_targets.hpp"
#include "tests/model/hrm/made_up_scene.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::test {
namespace {

// Map of hills with 60 boxes and a moving truck.
hrm::PatchFormation busy_map(std::size_t threads, int size, std::size_t sector_points = hrm::kMaxSectorPoints,
                             radar::RadarConfiguration configuration = {}, hrm::LabelUse labels = hrm::LabelUse::none) {
  configuration.fidelity.map_size = size;
  configuration.fidelity.map_double_bounce = true;
  configuration.world.movers.push_back({"truck", kTarget, 8.0, 30.0, 200.0, 2.0});
  const auto scene = std::make_shared<MadeUpScene>(kTarget, kGround_m);
  for (int i = 0; i < 60; ++i)
    scene->add({37.0 * (i % 9) - 150.0, 41.0 * i / 9.0 - 130.0, 17.0 * i, 20.0 + i % 7, 12.0, 4.0 + i % 11, 2});
  const hrm::PatchOrder order = order_from({});
  const auto hills = model::terrain::sine_hills({order.centre, geo::Bearing::degrees(20.0)}, 30.0, 700.0);
  return make_patch(configuration, order, ground_of([&](geo::GeoPoint position) { return 5.0 + hills(position); }),
                    scene, threads, sector_points, labels);
}

void expect_equal(const hrm::PixelLabels& found, const hrm::PixelLabels& expected, const std::string& what) {
  EXPECT_EQ(found.shadow, expected.shadow) << what;
  EXPECT_EQ(found.layover, expected.layover) << what;
  EXPECT_EQ(found.object, expected.object) << what;
  EXPECT_EQ(found.material, expected.material) << what;
  EXPECT_EQ(found.height_m.size(), expected.height_m.size()) << what;
  for (std::size_t i = 0; i < expected.height_m.size(); ++i) {
    if (std::isnan(expected.height_m[i])) {
      ASSERT_TRUE(std::isnan(found.height_m[i])) << what << ", pixel " << i;
      continue;
    }
    ASSERT_EQ(found.height_m[i], expected.height_m[i]) << what << ", pixel " << i;
    ASSERT_EQ(found.sin_grazing[i], expected.sin_grazing[i]) << what << ", pixel " << i;
  }
}

// Sectors of about a quarter of the grid of a map of 240 pixels, and sectors of three strips, the least.
constexpr std::size_t kFewPoints = 24'000, kFewestPoints = 1;

TEST(Patch, IsTheSameForAnyNumberOfThreads) {
  const auto one = busy_map(1, 160);
  for (const std::size_t threads : {2U, 3U, 4U}) {
    const auto many = busy_map(threads, 160);
    EXPECT_EQ(many.image().power, one.image().power) << threads;
    EXPECT_EQ(many.picture(), one.picture()) << threads;
    EXPECT_EQ(many.triangles(), one.triangles()) << threads;
  }
}

TEST(Patch, IsTheSameInSectors) {
  for (const radar::Algorithm algorithm : {radar::Algorithm::standard, radar::Algorithm::report_1996}) {
    radar::RadarConfiguration configuration;
    configuration.fidelity.algorithm = algorithm;
    const auto whole = busy_map(1, 160, hrm::kMaxSectorPoints, configuration);
    for (const auto& [points, threads] : {std::pair{kFewPoints, 3U}, std::pair{kFewestPoints, 1U}}) {
      const auto sectors = busy_map(threads, 160, points, configuration);
      EXPECT_EQ(sectors.image().power, whole.image().power) << points << ", threads " << threads;
      EXPECT_EQ(sectors.picture(), whole.picture()) << points << ", threads " << threads;
    }
  }
}

// Labels change no bit of the picture, and no bit of them depends on threads, sectors and vector target.
TEST(PatchLabels, AreTheSameForAnyThreadsSectorsAndVectorTargetAndChangeNoPicture) {
  for (const radar::Algorithm algorithm :
       {radar::Algorithm::standard, radar::Algorithm::report_1996, radar::Algorithm::reference}) {
    radar::RadarConfiguration configuration;
    configuration.fidelity.algorithm = algorithm;
    const int size = algorithm == radar::Algorithm::reference ? 48 : 160;
    const auto labelled = [&](std::size_t threads, std::size_t points) {
      return busy_map(threads, size, points, configuration, hrm::LabelUse::heights);
    };
    const auto whole = labelled(1, hrm::kMaxSectorPoints);
    const auto plain = busy_map(1, size, hrm::kMaxSectorPoints, configuration);
    EXPECT_EQ(whole.image().power, plain.image().power);
    EXPECT_EQ(whole.picture(), plain.picture());
    EXPECT_GT(std::count(whole.labels().shadow.begin(), whole.labels().shadow.end(), 1), size);
    EXPECT_GT(std::ranges::max(whole.labels().object), 50);
    expect_equal(labelled(3, hrm::kMaxSectorPoints).labels(), whole.labels(), "threads");
    if (algorithm == radar::Algorithm::reference) continue;  // has no sectors, and takes long
    expect_equal(labelled(1, kFewestPoints).labels(), whole.labels(), "least sectors");
    for_each_vector_target(
        [&](const char* name) { expect_equal(labelled(2, kFewPoints).labels(), whole.labels(), name); });
  }
}

TEST(Patch, IsTheSameInSectorsOnEveryVectorTarget) {
  const auto whole = busy_map(1, 160);
  for_each_vector_target(
      [&](const char* name) { EXPECT_EQ(busy_map(1, 160, kFewPoints).image().power, whole.image().power) << name; });
}

TEST(Patch, SectorsCoverTheGridInOrderAndHoldNoMorePoints) {
  hrm::PolarGrid grid;
  grid.rows = 1001;
  grid.columns = 100 * hrm::kStripColumns;
  grid.end_strip = grid.strips();
  EXPECT_EQ(hrm::sectors_of(grid, grid.size()), (std::vector<int>{0, 100}));
  for (const std::size_t strips : {3U, 4U, 10U, 99U}) {
    const std::vector<int> sectors = hrm::sectors_of(grid, strips * grid.strip_size());
    EXPECT_EQ(sectors.front(), 0);
    EXPECT_EQ(sectors.back(), grid.strips());
    for (std::size_t i = 1; i < sectors.size(); ++i) {
      EXPECT_GT(sectors[i], sectors[i - 1]);
      EXPECT_LE(sectors[i] - sectors[i - 1] + 2, static_cast<int>(strips));
    }
  }
  EXPECT_EQ(hrm::sectors_of(grid, 0).size(), 101U);
}

// Noise with points that are strong, in rows of 12 main lobes and sidelobes of 130 pixels on each side.
TEST(Patch, ResponseIsTheSameInSlabsOfRows) {
  hrm::MapImage drawn(500);
  for (int row = 0; row < drawn.size; ++row)
    for (int column = 0; column < drawn.size; ++column)
      drawn.power[drawn.at(column, row)] = static_cast<float>((row * 7919 + column * 104729) % 1000) * 1e-4F;
  for (int i = 0; i < 40; ++i) drawn.power[drawn.at(i * 12 + 3, i * 37 % 500)] = 1.0e4F;
  for (const double cells_per_pixel : {1.0, 480.0 / 4096.0}) {
    hrm::Response whole(-35.0, cells_per_pixel), in_slabs(-35.0, cells_per_pixel);
    hrm::MapImage expected = drawn;
    whole.apply(0.01F, {}, expected);
    EXPECT_NE(expected.power, drawn.power);
    for (const std::size_t threads : {1U, 3U}) {
      for (const std::size_t bytes : {std::size_t{1}, std::size_t{400'000}}) {
        hrm::MapImage found = drawn;
        in_slabs.apply(0.01F, executor_of(threads), found, bytes);
        EXPECT_EQ(found.power, expected.power) << cells_per_pixel << ", " << bytes << " bytes, threads " << threads;
      }
    }
  }
}

TEST(Patch, IsTheSameOnEveryVectorTarget) {
  memory::CacheAlignedVector<float> power;
  std::vector<std::uint8_t> picture;
  for_each_vector_target([&](const char* name) {
    const auto process = busy_map(1, 250);
    if (power.empty()) {
      power = process.image().power;
      picture = process.picture();
    }
    EXPECT_EQ(process.image().power, power) << name;
    EXPECT_EQ(process.picture(), picture) << name;
  });
}

}  // namespace
}  // namespace yars::test
