// Cross sections of scatterers in vectors against double precision, within the bound stated in
// model/rbm/scene_simd.hpp.
#include "model/rbm/scene_simd.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "tests/lib/simd/vector_targets.hpp"

namespace yars::model::rbm {
namespace {

constexpr double kMaxError = 1e-4;

// `count` facings in all directions, and the spare ones behind them.
std::vector<scene::Facing> facings(std::size_t count) {
  constexpr unsigned kSeed = 5;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> turn_rad(0.0, 2.0 * std::numbers::pi), area_m2(0.5, 900.0);
  std::vector<scene::Facing> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double azimuth_rad = turn_rad(random), size_m2 = area_m2(random);
    const bool wall = i % 3 != 0;
    const double up = wall ? 0.1 : 0.9, side = std::sqrt(1.0 - up * up);
    all.push_back({static_cast<float>(size_m2 * side * std::sin(azimuth_rad)),
                   static_cast<float>(size_m2 * side * std::cos(azimuth_rad)), static_cast<float>(size_m2 * up),
                   static_cast<std::uint8_t>(i % 32), wall});
  }
  // Spare entries that would count if they were not left out.
  all.insert(all.end(), scene::kFacingSlack, scene::Facing{1e6F, 1e6F, 1e6F, 3, true});
  return all;
}

double in_double(std::span<const scene::Facing> facings, const physics::SceneSurface& surface,
                 const simd::SceneView& view) {
  const auto e = static_cast<double>(view.east), n = static_cast<double>(view.north);
  double sum_m2 = 0.0;
  for (const scene::Facing& facing : facings) {
    const auto east = static_cast<double>(facing.east_m2), north = static_cast<double>(facing.north_m2);
    const double towards = east * e + north * n;
    const double area = towards * static_cast<double>(view.cos_grazing) +
                        static_cast<double>(facing.up_m2) * static_cast<double>(view.sin_grazing);
    if (!(area > 0.0)) continue;
    sum_m2 += area * (facing.wall && towards > 0.0 ? surface.wall_gamma(facing.material, north * e - east * n, towards)
                                                   : surface.gamma(facing.material));
  }
  return sum_m2;
}

TEST(SceneCrossSection, IsWithinItsBoundAndEqualOnEveryVectorTarget) {
  const radar::RadarConfiguration configuration;
  const physics::SceneSurface surface(configuration);
  const simd::SceneTables tables(surface);
  for (const std::size_t count : {0U, 1U, 7U, 15U, 16U, 17U, 33U, 400U}) {
    const std::vector<scene::Facing> all = facings(count);
    const std::span<const scene::Facing> some = std::span(all).first(count);
    for (double azimuth_rad = 0.0; azimuth_rad < 6.28; azimuth_rad += 0.19)
      for (const double grazing_rad : {-0.05, 0.0, 0.02, 0.6, 1.5}) {
        const simd::SceneView view{static_cast<float>(std::sin(azimuth_rad)), static_cast<float>(std::cos(azimuth_rad)),
                                   static_cast<float>(std::cos(grazing_rad)),
                                   static_cast<float>(std::sin(grazing_rad))};
        const double exact = in_double(some, surface, view);
        const float found = simd::cross_section_m2(some, tables, view);
        EXPECT_NEAR(static_cast<double>(found), exact, kMaxError * exact) << count << ", " << azimuth_rad;
        test::for_each_vector_target([&](const char* target) {
          EXPECT_EQ(simd::cross_section_m2(some, tables, view), found) << target << ", " << count;
        });
      }
  }
}

}  // namespace
}  // namespace yars::model::rbm
