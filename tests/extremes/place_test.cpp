// Sweeps from positions where coordinates are singular: poles, antimeridian, the crossing of the equator and the prime
// meridian. The positions of islands come from formulas for arcs of the ellipsoid, not from the geodesics under test.
#include <gtest/gtest.h>

#include <cmath>

#include "model/terrain/store/directory_store.hpp"
#include "tests/extremes/islands.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"

namespace yars::model {
namespace {

using test::expect_lit_between;
using test::geometry_from;
using test::island_at;
using test::seen;

constexpr int kSamples = 400;
constexpr double kPlaceRange_m = 80000.0;
constexpr double kAltitude_m = 3000.0;
constexpr double kRadius_m = 3000.0;                 // of an island
constexpr double kEquator_m = 6378137.0;             // [m] semi-major axis a of WGS84
constexpr double kFlattening = 1.0 / 298.257223563;  // f of WGS84
constexpr std::uint16_t kVoidPost = 0xFFFF;          // DTED void

// Arc of a meridian between two latitudes: the integral of its radius of curvature, a (1 - e2) / (1 - e2 sin2)^1.5.
// e2 is f (2 - f), sin2 the squared sine of the latitude.
double meridian_m(double from_deg, double to_deg) {
  constexpr double kE2 = kFlattening * (2.0 - kFlattening);
  constexpr int kSteps = 1000;
  const double step_deg = (to_deg - from_deg) / kSteps;
  double sum_m = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    const double sine = std::sin((from_deg + (step + 0.5) * step_deg) * geo::kRadiansPerDegree);
    sum_m += kEquator_m * (1.0 - kE2) / std::pow(1.0 - kE2 * sine * sine, 1.5) * step_deg * geo::kRadiansPerDegree;
  }
  return std::abs(sum_m);
}

// Arc of the equator.
double equator_m(double degrees) {
  return kEquator_m * std::abs(degrees) * geo::kRadiansPerDegree;
}

// Expects the island at its distance in a sweep along `azimuth_deg`, and no power in a sweep in the opposite direction.
void expect_island(geo::GeoPoint apex, double azimuth_deg, geo::GeoPoint island, double distance_m) {
  const terrain::AnalyticTerrain terrain = island_at(island, kRadius_m);
  test::for_each_algorithm(kSamples, [&](const radar::RadarConfiguration& configuration) {
    expect_lit_between(seen(configuration, geometry_from(apex, azimuth_deg, kAltitude_m, kPlaceRange_m), terrain),
                       kPlaceRange_m, distance_m - kRadius_m, distance_m + kRadius_m);
    EXPECT_TRUE(test::is_dark(
        seen(configuration, geometry_from(apex, azimuth_deg + 180.0, kAltitude_m, kPlaceRange_m), terrain)));
  });
}

TEST(ExtremePositions, AtTheNorthPoleASweepAlongAMeridianSeesAnIslandOnIt) {
  // Every azimuth leads south. Azimuth 180 is along the meridian of the apex's longitude; greater azimuths lead west of
  // it.
  for (const double longitude_deg : {0.0, 45.0, 135.0, 180.0, -179.5, -90.0}) {
    SCOPED_TRACE(longitude_deg);
    expect_island({90.0, 0.0}, 180.0 - longitude_deg, {89.6, longitude_deg}, meridian_m(89.6, 90.0));
  }
}

TEST(ExtremePositions, AtTheSouthPoleASweepAlongAMeridianSeesAnIslandOnIt) {
  for (const double longitude_deg : {0.0, 45.0, 135.0, 180.0, -179.5, -90.0}) {
    SCOPED_TRACE(longitude_deg);
    expect_island({-90.0, 0.0}, longitude_deg, {-89.6, longitude_deg}, meridian_m(-89.6, -90.0));
  }
}

TEST(ExtremePositions, ASweepOverAPoleSeesTheIslandOnTheOppositeMeridian) {
  expect_island({89.9, 30.0}, 0.0, {89.6, -150.0}, meridian_m(89.9, 90.0) + meridian_m(89.6, 90.0));
  expect_island({-89.9, -170.0}, 180.0, {-89.6, 10.0}, meridian_m(-89.9, -90.0) + meridian_m(-89.6, -90.0));
}

TEST(ExtremePositions, OnTheEquatorASweepOverTheAntimeridianSeesTheIslandBeyond) {
  // The equator is a geodesic of radius a.
  expect_island({0.0, 179.9}, 90.0, {0.0, -179.7}, equator_m(0.4));
  expect_island({0.0, -179.9}, 270.0, {0.0, 179.7}, equator_m(0.4));
  expect_island({0.0, 180.0}, 90.0, {0.0, -179.6}, equator_m(0.4));
  expect_island({0.0, -180.0}, 270.0, {0.0, 179.6}, equator_m(0.4));
}

TEST(ExtremePositions, Longitudes180AndMinus180GiveTheSamePower) {
  const terrain::AnalyticTerrain island = island_at({-17.2, -179.9}, 10000.0);
  test::for_each_algorithm(kSamples, [&](const radar::RadarConfiguration& configuration) {
    const auto east = seen(configuration, geometry_from({-17.0, 180.0}, 155.0, kAltitude_m, kPlaceRange_m), island);
    const auto west = seen(configuration, geometry_from({-17.0, -180.0}, 155.0, kAltitude_m, kPlaceRange_m), island);
    EXPECT_FALSE(test::is_dark(east));
    for (std::size_t i = 0; i < east.size(); ++i) EXPECT_FLOAT_EQ(east[i], west[i]) << i;
  });
}

TEST(ExtremePositions, AtTheCrossingOfEquatorAndPrimeMeridianEachOfFourDirectionsSeesItsIsland) {
  expect_island({0.0, 0.0}, 0.0, {0.3, 0.0}, meridian_m(0.0, 0.3));
  expect_island({0.0, 0.0}, 90.0, {0.0, 0.3}, equator_m(0.3));
  expect_island({0.0, 0.0}, 180.0, {-0.3, 0.0}, meridian_m(0.0, 0.3));
  expect_island({0.0, 0.0}, 270.0, {0.0, -0.3}, equator_m(0.3));
}

TEST(ExtremePositions, AtTheCrossingOfEquatorAndPrimeMeridianEachOfFourQuadrantsSeesItsIsland) {
  // Within 0.2 degrees the ellipsoid is flat to 1 in 100,000, so that the distance is the hypotenuse of the two arcs.
  const double north_m = meridian_m(0.0, 0.2);
  const double east_m = equator_m(0.2);
  const double corner_deg = std::atan2(east_m, north_m) / geo::kRadiansPerDegree;
  for (const int north : {-1, 1}) {
    for (const int east : {-1, 1}) {
      const double azimuth_deg = (north > 0 ? 0.0 : 180.0) + (north * east > 0 ? corner_deg : -corner_deg);
      expect_island({0.0, 0.0}, azimuth_deg, {0.2 * north, 0.2 * east}, std::hypot(north_m, east_m));
    }
  }
}

// Writes a DTED cell with all posts at kIslandHeight_m (`land`) or all void.
void write_cell(const test::TemporaryFolder& folder, int south_deg, int west_deg, bool land) {
  char name[32];
  std::snprintf(name, sizeof name, "%c%03d/%c%02d.dt0", west_deg < 0 ? 'w' : 'e', std::abs(west_deg),
                south_deg < 0 ? 's' : 'n', std::abs(south_deg));
  const auto post = land ? static_cast<std::uint16_t>(test::kIslandHeight_m) : kVoidPost;
  folder.write(name, test::level_dted(south_deg, west_deg, post).bytes());
}

std::unique_ptr<terrain::DirectoryTerrainStore> store_over(const test::TemporaryFolder& folder) {
  auto store = terrain::DirectoryTerrainStore::open(folder.path(), {.missing_cell_is_sea = false});
  EXPECT_TRUE(store.has_value()) << store.error().message();
  return std::move(store.value());
}

TEST(ExtremePositions, AnEastwardSweepGoesFromAVoidCellToALandCellAtTheAntimeridian) {
  const test::TemporaryFolder folder;
  write_cell(folder, 0, 179, false);
  write_cell(folder, 0, -180, true);
  const geo::GeoPoint apex{0.5, 179.7};
  const auto view = store_over(folder)->prepare({apex, kPlaceRange_m});
  test::for_each_algorithm(kSamples, [&](const radar::RadarConfiguration& configuration) {
    // At 0.5 degrees of latitude the parallel is shorter than the equator by 1 in 26,000. The geodesic is within metres
    // of the parallel.
    expect_lit_between(seen(configuration, geometry_from(apex, 90.0, kAltitude_m, kPlaceRange_m), *view), kPlaceRange_m,
                       equator_m(0.3) * std::cos(0.5 * geo::kRadiansPerDegree), 2.0 * kPlaceRange_m);
  });
}

TEST(ExtremePositions, AtThePolesASweepSeesOnlyTheCellOfItsMeridian) {
  for (const int south_deg : {89, -90}) {
    SCOPED_TRACE(south_deg);
    const test::TemporaryFolder folder;
    for (int west_deg = -180; west_deg < 180; ++west_deg) write_cell(folder, south_deg, west_deg, west_deg == -180);
    const geo::GeoPoint pole{south_deg > 0 ? 90.0 : -90.0, 0.0};
    const auto view = store_over(folder)->prepare({pole, kPlaceRange_m});
    test::for_each_algorithm(kSamples, [&](const radar::RadarConfiguration& configuration) {
      for (const double longitude_deg : {-179.5, 179.5, -178.5, 0.5}) {
        const double azimuth_deg = south_deg > 0 ? 180.0 - longitude_deg : longitude_deg;
        const auto power = seen(configuration, geometry_from(pole, azimuth_deg, kAltitude_m, kPlaceRange_m), *view);
        // The first samples are not checked: they see the post of the pole itself, which every cell has.
        const bool lit = power[200] > 0.0F && power[399] > 0.0F;
        EXPECT_EQ(lit, longitude_deg == -179.5) << longitude_deg;
      }
    });
  }
}

}  // namespace
}  // namespace yars::model
