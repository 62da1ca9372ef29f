// physics::Ground, the vector code for the reflectivity of a sweep's ground, against the scalar physics::SurfaceReturn.
#include "tests/model/physics/ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/physics/ground_return.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/reflectivity.hpp"
#include "tests/lib/simd/vector_targets.hpp"

namespace yars::model::rbm {
namespace {

constexpr std::size_t kCount = 1000;
constexpr double kRange_m = 200'000.0;  // spans some degrees of latitude and longitude
constexpr physics::TextureSweep kTexture{300.0, kRange_m / kCount, 3000.0, 0.03};
constexpr geo::Duration kTime = geo::Duration::seconds(123.4);

physics::SweepGeometry geometry_from(geo::GeoPoint apex, double azimuth_deg) {
  return {apex, geo::AltitudeMsl::metres(3000.0), geo::Bearing::degrees(azimuth_deg), geo::Angle(),
          geo::Length::metres(kRange_m)};
}

physics::PositionArrays positions_of(const physics::SweepGeometry& geometry) {
  physics::PositionArrays positions(kCount);
  std::vector<float> distance_m(kCount + terrain::kRunSlack);
  for (std::size_t i = 0; i < distance_m.size(); ++i)
    distance_m[i] = static_cast<float>((static_cast<double>(i) + 0.5) * kRange_m / kCount);
  physics::sample_positions(geometry.apex, geometry.azimuth, geometry.range, physics::kSeriesKnots, distance_m.data(),
                            positions);
  return positions;
}

// Material codes 0 to 15 in stripes of 7 samples. Every fifth sample is a quarter water.
void fill(std::vector<std::int32_t>& code, std::vector<float>& water) {
  for (std::size_t i = 0; i < kCount; ++i) {
    code[i] = static_cast<std::int32_t>(i / 7 % 16);
    water[i] = i % 5 == 0 ? 0.25F : 0.0F;
  }
}

// Reflectivity by sample.
struct Returns {
  std::vector<float> land, sea;
  bool operator==(const Returns&) const = default;
};

Returns returns_of(const radar::RadarConfiguration& configuration, const physics::SweepGeometry& geometry,
                   const physics::PositionArrays& positions, double sin_grazing = 0.02) {
  constexpr std::size_t kPaddedCount = kCount + terrain::kRunSlack;
  physics::Ground ground(configuration, kCount);
  ground.use_texture(kTexture, kTime);
  std::vector<std::int32_t> code(kPaddedCount);
  std::vector<float> water(kPaddedCount);
  const std::vector<float> sine(kPaddedCount, static_cast<float>(sin_grazing));
  fill(code, water);
  std::copy(code.begin(), code.end(), ground.materials().begin());
  const physics::Ground::Sample found = ground.reflect(geometry, positions.run(), water.data(), sine.data(), true);
  return {{found.land, found.land + kCount}, {found.sea, found.sea + kCount}};
}

TEST(Ground, EqualsTheScalarVersion) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.samples = kCount;
  for (const geo::GeoPoint apex : {geo::GeoPoint{37.6, -122.4}, {-0.3, 179.2}, {-66.0, 10.0}, {85.1, 40.0}}) {
    for (const double azimuth_deg : {20.0, 65.0, 190.0, 300.0}) {
      const physics::SweepGeometry geometry = geometry_from(apex, azimuth_deg);
      const physics::PositionArrays positions = positions_of(geometry);
      const double sin_grazing = azimuth_deg < 100.0 ? 0.02 : 0.95;  // 72 degrees: with the specular echo of the sea
      const Returns fast = returns_of(configuration, geometry, positions, sin_grazing);
      physics::SurfaceReturn exact(configuration);
      exact.use_texture(kTexture, kTime);
      std::vector<std::int32_t> code(kCount + terrain::kRunSlack);
      std::vector<float> water(code.size());
      fill(code, water);
      const geo::Bearing azimuth =
          geo::GeodesicRay(apex, geometry.azimuth).position_and_azimuth(0.5 * geometry.range).azimuth;
      int different = 0;
      // Near a pole the azimuth at half the range differs by more, and with it the return of walls.
      const double within = std::abs(apex.latitude_deg) > 80.0 ? 0.03 : 0.02;
      for (std::size_t i = 0; i < kCount; ++i) {
        const physics::SurfaceReturn::Reflectivity expected =
            exact.at({terrain::position_of(positions.run(), i), azimuth, sin_grazing, static_cast<double>(water[i]),
                      static_cast<std::uint8_t>(code[i]), i});
        const double found = static_cast<double>(fast.land[i]) * sin_grazing + static_cast<double>(fast.sea[i]);
        different += std::abs(found / (expected.gamma * sin_grazing + expected.sigma0) - 1.0) < within ? 0 : 1;
      }
      // Within a centimetre of the edge of a part of a texture cell, rounding may select the neighbouring part.
      EXPECT_LE(different, 2) << apex.latitude_deg << ", " << azimuth_deg;
    }
  }
}

TEST(Ground, IsTheSameOnEveryVectorTarget) {
  const physics::SweepGeometry geometry = geometry_from({37.6, -122.4}, 65.0);
  const physics::PositionArrays positions = positions_of(geometry);
  Returns first;
  radar::RadarConfiguration configuration;
  configuration.fidelity.samples = kCount;
  test::for_each_vector_target([&](const char* name) {
    const Returns found = returns_of(configuration, geometry, positions);
    if (first.land.empty()) first = found;
    EXPECT_EQ(found, first) << name;
  });
}

TEST(Ground, GivesNoArraysForLandWithoutCultureTextureAndWater) {
  radar::RadarConfiguration configuration;
  configuration.world.land.texture = 0.0;
  const physics::SweepGeometry geometry = geometry_from({37.6, -122.4}, 65.0);
  const physics::PositionArrays positions = positions_of(geometry);
  physics::Ground ground(configuration, kCount);
  const std::vector<float> none(kCount + terrain::kRunSlack, 0.0F);
  const physics::Ground::Sample found = ground.reflect(geometry, positions.run(), none.data(), none.data(), false);
  EXPECT_EQ(found.land, nullptr);
  EXPECT_EQ(found.sea, nullptr);
}

}  // namespace
}  // namespace yars::model::rbm
