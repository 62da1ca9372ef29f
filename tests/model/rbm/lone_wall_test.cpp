// Shadow of a wall as wide as one post, far narrower than a sample. Everything behind it is dark for all presets and
// ranges, also near a pole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/physics/ray.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/beam.hpp"
#include "model/rbm/emitters.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "tests/lib/simd/vector_targets.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"

namespace yars::model::rbm {
namespace {

constexpr int kPosts = 1201;             // per degree, at a spacing of 3 arcseconds
constexpr double kDegree_m = 111'694.0;  // WGS84: length of a degree of latitude at the pole

// Cell with a wall of 1500 m on ground of 10 m. The aircraft flies at 1200 m, 18.05 NM south of the wall.
class LoneWall : public ::testing::Test {
 protected:
  static constexpr int kWallRow = 601;  // 30 arcminutes north of the cell's southern edge
  LoneWall() : view_(1, terrain::Absence::none) {
    view_.add(std::make_shared<const terrain::Cell>(
        test::cell_of({37, -122}, kPosts, kPosts, [](int row, int) { return row == kWallRow ? 1500 : 10; })));
  }
  static physics::SweepGeometry geometry(double range_nm) {
    return {{37.2, -121.5},
            geo::AltitudeMsl::metres(1200.0),
            geo::Bearing::degrees(0.0),
            geo::Angle::degrees(-2.0),
            geo::Length::nautical_miles(range_nm)};
  }
  // Position behind the wall.
  static geo::GeoPoint behind(double miles) {
    return geo::geodesic_direct({37.2, -121.5}, geo::Bearing::degrees(0.0), geo::Length::nautical_miles(18.05 + miles));
  }
  terrain::CellView view_;
};

// Expects light from 1 NM to the wall and shadow behind it, except within 0.15 NM of the wall.
void expect_dark_behind(const terrain::TerrainView& view, physics::SweepGeometry geometry, double wall_nm) {
  for (const char* preset : {"draft", "standard", "reference"})
    for (const double range_nm : {20.0, 40.0, 80.0, 160.0}) {
      radar::RadarConfiguration configuration;
      configuration.fidelity = *radar::fidelity_preset(preset);
      configuration.fidelity.sub_beams = 1;
      Beam algorithm(configuration);
      const std::size_t count = sample_count(configuration);
      std::vector<float> power(count);
      std::vector<std::uint8_t> lit(count);
      geometry.range = geo::Length::nautical_miles(range_nm);
      algorithm.measure(geometry, view, power);
      algorithm.lit(lit);
      for (std::size_t i = 0; i < count; ++i) {
        const double miles = (static_cast<double>(i) + 0.5) * range_nm / static_cast<double>(count);
        const bool before = miles > 1.0 && miles < wall_nm - 0.15;
        if (!before && miles < wall_nm + 0.15) continue;
        EXPECT_EQ(lit[i], before ? 1 : 0) << preset << ", " << range_nm << ", " << miles;
      }
    }
}

TEST_F(LoneWall, HidesTheGroundBehindItAtEveryRange) {
  expect_dark_behind(view_, geometry(160.0), 18.05);
}

// The aircraft is 24 arcminutes from the pole. Its rays pass over or near the pole to a wall along a parallel,
// 12 arcminutes beyond the pole.
TEST_F(LoneWall, HidesTheGroundBehindItBeyondThePole) {
  constexpr int kRows = 601, kColumns = 101, kRing = 480;
  constexpr double kSouth_deg = 89.0 + kRing / (kRows - 1.0);
  terrain::CellView view(1, terrain::Absence::sea);
  for (int west_deg = -180; west_deg < -120; ++west_deg)
    view.add(std::make_shared<const terrain::Cell>(
        test::cell_of({89, west_deg}, kRows, kColumns, [](int row, int) { return row == kRing ? 1500 : 10; })));
  for (const double longitude_deg : {30.0, 30.1, 29.7})
    for (const double azimuth_deg : {0.0, 0.2, 359.0}) {
      physics::SweepGeometry over = geometry(160.0);
      over.apex = {89.6, longitude_deg};
      over.azimuth = geo::Bearing::degrees(azimuth_deg);
      SCOPED_TRACE(azimuth_deg);
      const double apex_to_pole = 90.0 - over.apex.latitude_deg, wall_to_pole = 90.0 - kSouth_deg;
      const double off_pole = apex_to_pole * std::sin(over.azimuth.radians());
      const double wall_deg = apex_to_pole * std::cos(over.azimuth.radians()) +
                              std::sqrt(wall_to_pole * wall_to_pole - off_pole * off_pole);
      expect_dark_behind(view, over, wall_deg * kDegree_m / geo::kMetresPerNauticalMile);
    }
}

// The longitude along a ray that passes the pole at 2.3 km changes by up to 15 degrees from sample to sample. One
// degree of longitude is land, 40 m wide there.
TEST_F(LoneWall, HidesTheGroundBehindItBesideThePole) {
  for (const int west_deg : {100, 110, 117, 125, 140}) {
    terrain::CellView view(1, terrain::Absence::sea);
    view.add(
        std::make_shared<const terrain::Cell>(test::cell_of({89, west_deg}, 601, 101, [](int, int) { return 1500; })));
    physics::SweepGeometry past = geometry(160.0);
    past.apex = {89.6, 30.0};
    past.azimuth = geo::Bearing::degrees(3.0);
    SCOPED_TRACE(west_deg);
    const double turn_rad = (west_deg + 0.5 - 30.0) * geo::kRadiansPerDegree;
    // Distance [deg of latitude] by the law of sines in the triangle of aircraft, pole and crossing.
    const double wall_deg = 0.4 * std::sin(turn_rad) / std::sin(turn_rad + past.azimuth.radians());
    expect_dark_behind(view, past, wall_deg * kDegree_m / geo::kMetresPerNauticalMile);
  }
}

TEST_F(LoneWall, HidesAShipBehindIt) {
  for (const char* preset : {"draft", "standard", "reference"})
    for (const double range_nm : {20.0, 40.0, 80.0, 160.0}) {
      radar::RadarConfiguration configuration;
      configuration.fidelity = *radar::fidelity_preset(preset);
      configuration.fidelity.sub_beams = 1;
      const std::size_t count = sample_count(configuration);
      std::vector<float> with(count), without(count);
      Beam(configuration).measure(geometry(range_nm), view_, without);
      configuration.world.movers.push_back({"ship", behind(0.2), 0.0, 0.0, 1.0e9, 6.0});
      Beam(configuration).measure(geometry(range_nm), view_, with);
      EXPECT_EQ(with, without) << preset << ", " << range_nm << " NM";
    }
}

TEST_F(LoneWall, HidesJammersAndBeacons) {
  radar::RadarConfiguration configuration;
  radar::Jammer jammer;
  jammer.position = behind(3.0);
  configuration.world.jamming.jammers.push_back(jammer);
  radar::Beacon beacon;
  beacon.position = jammer.position;
  configuration.world.beacons.beacons.push_back(beacon);
  EXPECT_EQ(Strobes(configuration).level(geometry(40.0), view_), 0.0);
  EXPECT_TRUE(Beacons(configuration).replies(geometry(40.0), view_).empty());
  // At 2500 m they are visible over the wall.
  configuration.world.jamming.jammers[0].altitude_m = configuration.world.beacons.beacons[0].altitude_m = 2500.0;
  EXPECT_GT(Strobes(configuration).level(geometry(40.0), view_), 0.0);
  EXPECT_FALSE(Beacons(configuration).replies(geometry(40.0), view_).empty());
}

// Beyond a pole, the longitudes of neighbouring samples may differ by 360 degrees.
TEST_F(LoneWall, HasTheSameCrestsAfterATurnOfLongitude) {
  terrain::CellView view(1, terrain::Absence::sea);
  view.add(std::make_shared<const terrain::Cell>(test::rough_cell({89, 20}, 601, 101, 7)));
  physics::PositionArrays positions(100);
  std::vector<float> distance_m(100 + physics::kPairSlack, 10000.0F);
  for (std::size_t i = 0; i < 100; ++i) distance_m[i] = (static_cast<float>(i) + 0.5F) * 100.0F;
  physics::sample_positions({89.3, 20.2}, geo::Bearing::degrees(5.0), geo::Length::metres(10000.0), 5,
                            distance_m.data(), positions);
  const auto crests = [&] {
    std::vector<float> found(100 + physics::kPairSlack);
    EXPECT_TRUE(
        view.crests(positions.run(), {9000.0, 0.0, {}, std::span(distance_m).first(100)}, std::span(found).first(100)));
    return found;
  };
  const std::vector<float> without_turn = crests();
  EXPECT_GT(without_turn[50], terrain::kNoTangent);
  for (std::size_t i = 1; i < 100; i += 2) positions.cells_east[i] -= 360.0F;
  EXPECT_EQ(crests(), without_turn);
}

// With a horizon, crests() looks at long pieces of an even ray and leaves out what hides nothing. The horizon that
// results is that of all crests, each step by itself.
TEST_F(LoneWall, HidesTheSameWithAHorizonToReach) {
  constexpr std::size_t kCount = 700;
  view_.add(std::make_shared<const terrain::Cell>(test::rough_cell({37, -121}, kPosts, kPosts, 7)));
  view_.add(std::make_shared<const terrain::Cell>(test::rough_cell({38, -122}, 601, 401, 8)));
  for (const double step_m : {20.0, 75.0, 280.0})
    for (const double altitude_m : {900.0, 4500.0})
      for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 7.5) {
        physics::PositionArrays positions(kCount);
        std::vector<float> distance_m(kCount + physics::kPairSlack);
        for (std::size_t i = 0; i < distance_m.size(); ++i)
          distance_m[i] = static_cast<float>((static_cast<double>(std::min(i, kCount - 1)) + 0.5) * step_m);
        physics::sample_positions({37.7, -121.4}, geo::Bearing::degrees(azimuth_deg),
                                  geo::Length::metres(kCount * step_m), 5, distance_m.data(), positions);
        const auto spare = [] { return std::vector<float>(kCount + physics::kPairSlack); };
        std::vector<float> height_m = spare(), water = spare(), near_m = spare(), near_back_m = spare();
        view_.surfaces(
            positions.run(), radar::Interpolation::bilinear,
            {std::span(height_m).first(kCount),
             std::span(water).first(kCount),
             {},
             {},
             {static_cast<float>(step_m), std::span(near_m).first(kCount), std::span(near_back_m).first(kCount)}});
        const physics::EffectiveEarth earth(8.5e6);
        const auto tangent = [&](float at_m, float ground_m) {
          const bool known = ground_m == ground_m;
          return known ? static_cast<float>(
                             earth.sight(altitude_m, static_cast<double>(at_m), static_cast<double>(ground_m)).tangent)
                       : terrain::kNoTangent;
        };
        std::vector<float> horizon = spare(), all = spare(), raised = spare();
        float highest = terrain::kNoTangent;
        for (std::size_t i = 0; i < kCount; ++i)
          horizon[i] = highest = std::max(highest, tangent(distance_m[i], height_m[i]));
        const auto crests = [&](std::span<const float> reached, std::vector<float>& found) {
          ASSERT_TRUE(view_.crests(positions.run(),
                                   {altitude_m, earth.curvature(), {}, std::span(distance_m).first(kCount), reached},
                                   std::span(found).first(kCount)));
        };
        crests({}, all);
        crests(std::span(horizon).first(kCount), raised);
        float expected = terrain::kNoTangent, found = terrain::kNoTangent;
        std::size_t different = 0;
        for (std::size_t i = 0; i < kCount; ++i) {
          expected = std::max({expected, horizon[i], all[i]});
          found = std::max({found, horizon[i], raised[i], tangent(distance_m[i] - near_back_m[i], near_m[i])});
          // A crossing 0.5 m before a sample may count in only one of the two.
          if (std::abs(expected - found) > 2e-3F * static_cast<float>(altitude_m) / distance_m[i]) ++different;
        }
        EXPECT_LE(different, kCount / 100) << step_m << " m, " << altitude_m << " m, " << azimuth_deg << " degrees";
      }
}

TEST_F(LoneWall, HasTheSameCrestsOnEveryVectorTarget) {
  physics::PositionArrays positions(333);
  std::vector<float> distance_m(333 + physics::kPairSlack);
  for (std::size_t i = 0; i < distance_m.size(); ++i)
    distance_m[i] = (static_cast<float>(std::min<std::size_t>(i, 332)) + 0.5F) * 150.0F;
  for (const terrain::CellCorner corner : {terrain::CellCorner{37, -121}, {89, 20}, {89, -160}})
    view_.add(std::make_shared<const terrain::Cell>(test::rough_cell(corner, kPosts, kPosts, 7)));
  for (const geo::GeoPoint apex : {geo::GeoPoint{37.4, -121.1}, {89.8, 20.3}})
    for (const double azimuth_deg : {0.0, 33.0, 90.0, 181.0, 275.0}) {
      physics::sample_positions(apex, geo::Bearing::degrees(azimuth_deg), geo::Length::metres(50000.0), 5,
                                distance_m.data(), positions);
      const std::vector<float> low(333 + physics::kPairSlack, -0.2F);
      for (const std::span<const float> horizon : {std::span<const float>(), std::span(low).first(333)}) {
        std::vector<float> first;
        test::for_each_vector_target([&](const char* name) {
          std::vector<float> crests(333 + physics::kPairSlack);
          ASSERT_TRUE(view_.crests(positions.run(),
                                   {1500.0, 1.0 / 8.5e6, {}, std::span(distance_m).first(333), horizon},
                                   std::span(crests).first(333)));
          crests.resize(333);
          EXPECT_GT(*std::max_element(crests.begin(), crests.end()), terrain::kNoTangent) << azimuth_deg;
          if (first.empty()) first = crests;
          EXPECT_EQ(crests, first) << name << ", " << azimuth_deg;
        });
      }
    }
}

}  // namespace
}  // namespace yars::model::rbm
