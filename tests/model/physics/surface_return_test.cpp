// Return of the ground by the algorithm `reference`: materials, sea, walls and texture.
#include <gtest/gtest.h>

#include <cmath>

#include "model/physics/clutter.hpp"
#include "model/physics/ground_return.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/reflectivity.hpp"
#include "tests/model/physics/decibels.hpp"
#include "tests/model/physics/ground.hpp"

namespace yars::model::rbm {
namespace {

// Sample in the middle of a sweep over level ground of one material.
Reference::Sample middle_sample(const radar::RadarConfiguration& configuration, std::uint8_t material,
                                double height_m = 100.0,
                                const physics::SweepGeometry& geometry = test::geometry_north(2000.0, 40000.0)) {
  const terrain::AnalyticTerrain ground(terrain::flat(height_m), 1, [material](geo::GeoPoint) { return material; });
  return test::seen_by_reference(configuration, geometry, ground)[500];
}

TEST(SurfaceReturn, OfMaterialsDiffersByTheirGammas) {
  const radar::RadarConfiguration configuration = test::bare_configuration(1000);
  const double land = middle_sample(configuration, 0).power;
  for (const radar::Material& material : configuration.world.land.materials) {
    if (material.cardinal_db > 0.0) continue;
    EXPECT_NEAR(decibels(middle_sample(configuration, static_cast<std::uint8_t>(material.code)).power / land),
                material.gamma_db - configuration.receiver.land_gamma_db, 0.01)
        << material.name;
  }
  EXPECT_NEAR(middle_sample(configuration, 30).power, land, 1e-9 * land) << "an undefined code returns as land";
}

TEST(SurfaceReturn, OfWaterIsTheSeasAtAnyHeight) {
  const radar::RadarConfiguration configuration = test::bare_configuration(1000);
  // Sea by its elevation of 0 m, and a lake at 100 m by its material. The aircraft is 2000 m above each.
  const Reference::Sample sea = middle_sample(configuration, 0, 0.0);
  const Reference::Sample lake =
      middle_sample(configuration, radar::kWaterMaterial, 100.0, test::geometry_north(2100.0, 40000.0));
  EXPECT_EQ(sea.water, 1.0);
  EXPECT_EQ(lake.water, 0.0);
  EXPECT_NEAR(lake.power / sea.power, 1.0, 1e-6);
}

TEST(SurfaceReturn, OfWallsDependsOnTheStreetsBearing) {
  const radar::RadarConfiguration configuration = test::bare_configuration(1000);
  physics::SweepGeometry geometry = test::geometry_north(2000.0, 40000.0);
  double least = 1e9, most = 0.0;
  for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 1.0) {
    // The middle of the sweep is the same position for each azimuth.
    geometry.azimuth = geo::Bearing::degrees(azimuth_deg);
    geometry.apex = geo::geodesic_direct(test::kMidLatitude, geo::Bearing::degrees(azimuth_deg + 180.0),
                                         geo::Length::metres(500.5 * 40.0));
    const Reference::Sample sample = middle_sample(configuration, 1, 100.0, geometry);
    const double off_deg =
        physics::off_street_deg(sample.azimuth.degrees(), physics::street_bearing_deg(sample.position));
    if (std::abs(off_deg) < 1.0) most = std::max(most, sample.power);
    if (std::abs(off_deg) > 12.0) least = std::min(least, sample.power);
  }
  EXPECT_NEAR(decibels(most / least), 12.0, 0.5);
}

struct Moments {
  double mean = 0.0, variance = 0.0;
};

// Moments of K-distributed clutter, decoded from the video: power of a sample divided by its power without texture.
Moments k_clutter(double shape, int looks) {
  radar::RadarConfiguration configuration = test::bare_configuration(250);
  configuration.fidelity.noise = true;
  configuration.receiver.dynamic_range_db = 120.0;
  configuration.receiver.noise_floor_db = -120.0;
  configuration.receiver.gain_step_db = 10.0;  // at gain 0 no sample clips
  configuration.world.land.texture = shape;
  physics::SweepGeometry geometry = test::geometry_north(3000.0, 80000.0);
  const terrain::AnalyticTerrain plain(terrain::flat(100.0));
  Reference textured(configuration);
  configuration.world.land.texture = 0.0;
  Reference untextured(configuration);
  std::vector<float> power(250), mean(250);
  std::vector<std::uint8_t> video(250);
  untextured.measure(geometry, plain, mean);  // the same at every longitude
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (std::uint32_t sweep = 0; sweep < 1000; ++sweep) {
    geometry.apex.longitude_deg = 0.36 * sweep - 180.0;  // different ground for each sweep
    textured.measure(geometry, plain, power);
    textured.form_video({power, power, power, 0.0, 0.0, looks}, geometry.range, 0, {5, 1, sweep}, video);
    for (std::size_t i = 25; i < 250; ++i) {
      const double relative = std::pow(10.0, 12.0 * (video[i] / 255.0 - 1.0) + 3.0) / static_cast<double>(mean[i]);
      sum += relative;
      squares += relative * relative;
      count += 1.0;
    }
  }
  return {sum / count, squares / count - sum / count * sum / count};
}

TEST(SurfaceReturn, WithTextureIsKDistributed) {
  using Case = std::pair<double, int>;
  for (const auto& [shape, looks] : {Case{0.0, 1}, Case{2.0, 4}, Case{4.0, 1}}) {
    const Moments found = k_clutter(shape, looks);
    const double texture = shape > 0.0 ? 1.0 + 1.0 / shape : 1.0;
    EXPECT_NEAR(found.mean, 1.0, 0.02) << shape << ", " << looks;
    EXPECT_NEAR(found.variance / (found.mean * found.mean) / (texture * (1.0 + 1.0 / looks) - 1.0), 1.0, 0.03)
        << shape << ", " << looks;
  }
}

TEST(Speckle, LevelsAscendAndHaveTheMomentsOfTheirLooks) {
  for (int looks = 1; looks <= physics::kMaxLooks; ++looks) {
    double sum = 0.0, squares = 0.0, last = 0.0;
    for (const float entry : physics::speckle_levels(looks)) {
      const auto level = static_cast<double>(entry);
      EXPECT_GE(level, last) << looks;
      last = level;
      sum += level;
      squares += level * level;
    }
    const double mean = sum / physics::kSpeckleLevels;
    EXPECT_NEAR(mean, 1.0, 1e-6) << looks;
    EXPECT_NEAR(looks * (squares / physics::kSpeckleLevels - mean * mean), 1.0, 1e-3) << looks;
  }
}

TEST(SurfaceReturn, HasTheSameTextureFromEveryDirection) {
  radar::RadarConfiguration configuration = test::bare_configuration(1000);
  configuration.fidelity.noise = true;
  configuration.world.land.texture = 1.0;
  physics::SurfaceReturn surface(configuration);
  surface.use_texture({.pulse_length_m = 300.0, .spacing_m = 40.0});
  physics::Facet facet{{37.2, -122.3}, geo::Bearing(), 0.1, 0.0, 0};
  const double once = surface.at(facet).gamma;
  facet.azimuth = geo::Bearing::degrees(200.0);
  EXPECT_EQ(surface.at(facet).gamma, once);
  facet.position.latitude_deg += 0.1;
  EXPECT_NE(surface.at(facet).gamma, once);
}

}  // namespace
}  // namespace yars::model::rbm
