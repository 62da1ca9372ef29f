// A map is bit-identical for any number of threads and for all sets of vector instructions.
#include <gtest/gtest.h>

#include "lib/radar/configuration.hpp"
#include "tests/lib/simd/vector_targets.hpp"
#include "tests/model/hrm/made_up_scene.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::test {
namespace {

// Map of hills with 60 boxes and a moving truck.
hrm::PatchFormation busy_map(std::size_t threads, int size) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.map_size = size;
  configuration.fidelity.map_double_bounce = true;
  configuration.world.movers.push_back({"truck", kTarget, 8.0, 30.0, 200.0, 2.0});
  const auto scene = std::make_shared<MadeUpScene>(kTarget, kGround_m);
  for (int i = 0; i < 60; ++i)
    scene->add({37.0 * (i % 9) - 150.0, 41.0 * i / 9.0 - 130.0, 17.0 * i, 20.0 + i % 7, 12.0, 4.0 + i % 11, 2});
  const hrm::PatchOrder order = order_from({});
  const auto hills = model::terrain::sine_hills({order.centre, geo::Bearing::degrees(20.0)}, 30.0, 700.0);
  return make_patch(configuration, order, ground_of([&](geo::GeoPoint position) { return 5.0 + hills(position); }),
                    scene, threads);
}

TEST(Patch, IsTheSameForAnyNumberOfThreads) {
  const auto one = busy_map(1, 240);
  for (const std::size_t threads : {2U, 3U, 4U}) {
    const auto many = busy_map(threads, 240);
    EXPECT_EQ(many.image().power, one.image().power) << threads;
    EXPECT_EQ(many.picture(), one.picture()) << threads;
    EXPECT_EQ(many.triangles(), one.triangles()) << threads;
  }
}

TEST(Patch, IsTheSameOnEveryVectorTarget) {
  memory::CacheAlignedVector<float> power;
  std::vector<std::uint8_t> picture;
  for_each_vector_target([&](const char* name) {
    const auto process = busy_map(1, 500);
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
