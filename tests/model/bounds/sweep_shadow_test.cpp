// Shadow of terrain on sweeps, against brute force. Brute force samples the bilinear ground in steps of a tenth of the
// post spacing and at each line of posts, along the exact geodesic on the exact effective earth. A sample is dark if
// any nearer ground has an equal or greater tangent of elevation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "lib/values/presets.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/beam.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/bounds/lines_of_posts.hpp"
#include "tests/model/bounds/made_up_coast.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"
#include "tests/model/terrain/shared_data.hpp"

namespace yars::model::rbm {
namespace {

constexpr int kPosts = 1201;                                             // per degree, at a spacing of 3 arcseconds
constexpr double kNoTangent = -std::numeric_limits<double>::infinity();  // without ground

struct Scan {
  geo::GeoPoint apex;
  double altitude_ft = 15000.0;
  double first_deg = 0.0, last_deg = 0.0, step_deg = 1.0;  // true bearings of the compared sweeps
};

physics::SweepGeometry geometry_along(const Scan& scan, double azimuth_deg, double range_nm) {
  return {scan.apex, geo::AltitudeMsl::feet(scan.altitude_ft), geo::Bearing::degrees(azimuth_deg),
          geo::Angle::degrees(-3.0), geo::Length::nautical_miles(range_nm)};
}

// By sample. `known`: false over a void.
struct Truth {
  std::vector<bool> lit, known;
};

// `posts_m`: post spacing of `finest`.
Truth brute_force(const physics::SweepGeometry& geometry, const terrain::TerrainView& finest, double posts_m,
                  std::size_t samples) {
  radar::RadarConfiguration exact;
  exact.fidelity = *radar::fidelity_preset("reference");  // traced rays
  const physics::EffectiveEarth earth = physics::effective_earth(exact, geometry);
  const geo::GeodesicRay ray(geometry.apex, geometry.azimuth);
  const double spacing_m = geometry.range.metres() / static_cast<double>(samples);
  const auto steps = static_cast<int>(std::ceil(spacing_m / (0.1 * posts_m)));
  const auto tangent = [&](double distance_m) {
    const double height_m = finest.elevation_m(ray.position(geo::Length::metres(distance_m)));
    return std::isnan(height_m) ? kNoTangent : earth.sight(geometry.altitude.metres(), distance_m, height_m).tangent;
  };
  Truth truth;
  double horizon = kNoTangent;
  for (std::size_t i = 0; i < samples; ++i) {
    const double centre_m = (static_cast<double>(i) + 0.5) * spacing_m;
    for (int step = 1; step <= steps; ++step) {
      const double distance_m = centre_m - spacing_m * (1.0 - static_cast<double>(step) / steps);
      if (!(distance_m > 0.0)) continue;
      for (const double line_m :
           test::lines_of_posts_m(finest, ray, std::max(0.0, distance_m - spacing_m / steps), distance_m))
        if (line_m < distance_m || step < steps) horizon = std::max(horizon, tangent(line_m));
      if (step < steps) horizon = std::max(horizon, tangent(distance_m));
    }
    const double own_tangent = tangent(centre_m);
    truth.known.push_back(own_tangent > kNoTangent);
    truth.lit.push_back(own_tangent > horizon);
    horizon = std::max(horizon, own_tangent);
  }
  return truth;
}

struct Counts {
  double wrong = 0.0, dark = 0.0, samples = 0.0;
};

// Terrain at its finest detail, with its post spacing [m], and the terrain that a preset receives.
struct Ground {
  std::shared_ptr<const terrain::TerrainView> finest, served;
  double posts_m;
};

Counts compare(std::string_view preset, const Scan& scan, double range_nm, const Ground& ground) {
  radar::RadarConfiguration configuration;
  configuration.fidelity = *radar::fidelity_preset(preset);
  configuration.fidelity.sub_beams = 1;  // only the middle ray of the beam
  Beam algorithm(configuration);
  const std::size_t count = sample_count(configuration);
  std::vector<float> power(count);
  std::vector<std::uint8_t> lit(count);
  Counts counts;
  for (double azimuth_deg = scan.first_deg; azimuth_deg <= scan.last_deg; azimuth_deg += scan.step_deg) {
    const physics::SweepGeometry geometry = geometry_along(scan, azimuth_deg, range_nm);
    const Truth truth = brute_force(geometry, *ground.finest, ground.posts_m, count);
    algorithm.measure(geometry, *ground.served, power);
    algorithm.lit(lit);
    for (std::size_t i = 0; i < count; ++i) {
      if (!truth.known[i]) continue;
      counts.samples += 1.0;
      counts.dark += truth.lit[i] ? 0.0 : 1.0;
      counts.wrong += truth.lit[i] == (lit[i] != 0) ? 0.0 : 1.0;
    }
  }
  return counts;
}

// Returns the fraction of dark samples, or 0 if no ground is known.
double expect_within(const values::ComparablePreset& preset, const std::string& name, const Scan& scan, double range_nm,
                     const Ground& ground) {
  const Counts counts = compare(preset.name, scan, range_nm, ground);
  if (counts.samples == 0.0) return 0.0;
  const double wrong = counts.wrong / counts.samples;
  const double dark = counts.dark / counts.samples;
  EXPECT_LE(wrong, preset.max_wrong_shadow) << name << ", " << preset.name << ", " << range_nm << " NM";
  std::printf("%s, %s, %g NM: %.0f samples, %.1f %% dark, %.3f %% differ\n", name.c_str(), preset.name.data(), range_nm,
              counts.samples, 100.0 * dark, 100.0 * wrong);
  return dark;
}

constexpr double kRanges_nm[] = {4.7, 10.0, 20.0, 40.0, 80.0, 160.0};

// Compares all presets and ranges. Each preset receives the terrain detail that it requests. Returns the largest
// fraction of dark samples.
double expect_within_bounds(const std::string& name, const Scan& scan, const std::filesystem::path& folder,
                            std::span<const double> ranges_nm = kRanges_nm) {
  auto store = terrain::open_terrain({folder.string(), true});
  EXPECT_TRUE(store) << store.error().message();
  if (!store) return 0.0;
  double most_dark = 0.0;
  for (const double range_nm : ranges_nm)
    for (const auto& preset : values::kComparablePresets) {
      const geo::Length range = geo::Length::nautical_miles(range_nm);
      const auto finest = (*store)->prepare({scan.apex, range.metres(), 0});
      const int detail = kernel::scan_detail(*radar::fidelity_preset(preset.name), range);
      const auto served = (*store)->prepare({scan.apex, range.metres(), detail});
      const Ground ground{finest, served, finest->post_spacing_m()};
      most_dark = std::max(most_dark, expect_within(preset, name, scan, range_nm, ground));
    }
  return most_dark;
}

// Mountain ranges some kilometres apart, with ridges and gullies as small as one post spacing, and an area of voids.
terrain::Cell mountains() {
  return test::cell_of({38, -115}, kPosts, kPosts, [](int row, int column) {
    if (row > 700 && row < 715 && column > 600 && column < 640) return int{terrain::kVoidPost};
    const double x = column + 11.0 * std::sin(row * 0.041), y = row + 9.0 * std::sin(column * 0.053);
    const double height_m = 2000.0 + 450.0 * std::sin(x * 0.043) * std::cos(y * 0.031) +
                            170.0 * std::sin(x * 0.171 + y * 0.094) + 60.0 * std::abs(std::sin(x * 0.31 - y * 0.43)) +
                            14.0 * std::sin(x * 1.1) * std::sin(y * 0.9);
    return static_cast<int>(height_m);
  });
}

// The cells beside the mountains are absent, which means sea.
TEST(ShadowBound, HoldsOverMountains) {
  test::TemporaryFolder folder;
  ASSERT_TRUE(terrain::write_dted(folder.path(), mountains(), 1));
  constexpr double kSome_nm[] = {10.0, 20.0, 80.0};  // the coast has the others
  const Scan scan{{38.3, -114.9}, 15000.0, 20.0, 80.0, 10.0};
  EXPECT_GT(expect_within_bounds("mountains", scan, folder.path(), kSome_nm), 0.3);
}

TEST(ShadowBound, HoldsOverTheMadeUpCoast) {
  constexpr double kSome_nm[] = {4.7, 40.0, 160.0};
  const Scan scan{{37.1, -122.95}, 4000.0, 10.0, 80.0, 10.0};
  EXPECT_GT(expect_within_bounds("made-up coast", scan, test::made_up_coast(), kSome_nm), 0.02);
}

// Mountains like mountains(), with posts of 1 arcsecond and gullies and crags of that size.
TEST(ShadowBound, HoldsOverMountainsOfFinePosts) {
  constexpr int kFinePosts = 3601;
  const terrain::Cell fine = test::cell_of({38, -115}, kFinePosts, kFinePosts, [](int row, int column) {
    const double x = column + 33.0 * std::sin(row * 0.0137), y = row + 27.0 * std::sin(column * 0.0177);
    return static_cast<int>(2000.0 + 450.0 * std::sin(x * 0.0143) * std::cos(y * 0.0103) +
                            170.0 * std::sin(x * 0.057 + y * 0.031) + 60.0 * std::abs(std::sin(x * 0.103 - y * 0.143)) +
                            22.0 * std::sin(x * 0.33) * std::sin(y * 0.27) + 6.0 * std::sin(x * 0.97 + y * 0.71));
  });
  test::TemporaryFolder folder;
  ASSERT_TRUE(terrain::write_dted(folder.path(), fine, 2));
  constexpr double kFar_nm[] = {40.0, 80.0, 160.0};
  const Scan scan{{38.3, -114.9}, 15000.0, 20.0, 80.0, 20.0};
  EXPECT_GT(expect_within_bounds("fine mountains", scan, folder.path(), kFar_nm), 0.3);
}

// Mountains about a pole. Heights are a function of plane coordinates about the pole, so that all cells agree there.
// Rows are 10 arcseconds apart and columns 60 arcseconds, the DTED ratio beyond 80 degrees of latitude.
constexpr int kPolarRows = 361, kPolarColumns = 61;
constexpr double kPolarDegree_m = 111'694.0;  // WGS84: length of a degree of latitude at the pole

terrain::Cell polar_mountains(terrain::CellCorner corner) {
  return test::cell_of(corner, kPolarRows, kPolarColumns, [&](int row, int column) {
    const double r = kPolarDegree_m * (90.0 - std::abs(corner.south_deg + row / (kPolarRows - 1.0)));
    const double east_rad = (corner.west_deg + column / (kPolarColumns - 1.0)) * geo::kRadiansPerDegree;
    const double x = r * std::sin(east_rad) + 900.0, y = r * std::cos(east_rad);
    return static_cast<int>(1700.0 + 600.0 * std::sin(x / 3500.0) * std::cos(y / 4800.0) +
                            240.0 * std::sin(x / 900.0 + y / 1650.0) +
                            90.0 * std::abs(std::sin(x / 700.0 - y / 520.0)));
  });
}

std::shared_ptr<const terrain::CellView> polar_cap(std::initializer_list<int> souths_deg) {
  auto view = std::make_shared<terrain::CellView>(1, terrain::Absence::sea);
  for (const int south_deg : souths_deg)
    for (int west_deg = -180; west_deg < 180; ++west_deg)
      view->add(std::make_shared<const terrain::Cell>(polar_mountains({south_deg, west_deg})));
  return view;
}

void expect_polar_bounds(const std::shared_ptr<const terrain::CellView>& cap, const Scan& scan,
                         std::initializer_list<double> ranges_nm) {
  // Post spacing of brute force: the spacing of columns 30 arcminutes from the pole. Nearer the pole it is smaller.
  const Ground ground{cap, cap, kPolarDegree_m / (kPolarColumns - 1) * 0.5 * geo::kRadiansPerDegree};
  for (const double range_nm : ranges_nm)
    for (const auto& preset : values::kComparablePresets) {
      const std::string name = "from " + std::to_string(scan.apex.latitude_deg);
      EXPECT_GT(expect_within(preset, name, scan, range_nm, ground), 0.02);
    }
}

// From beside the pole: past it, over it and along parallels. From the pole itself. Some rays cross the antimeridian.
TEST(ShadowBound, HoldsNearTheNorthPole) {
  const auto cap = polar_cap({88, 89});
  expect_polar_bounds(cap, {{88.5, 20.5}, 12000.0, 351.0, 369.0, 4.5}, {10.0, 40.0, 160.0});
  expect_polar_bounds(cap, {{89.5, -179.9}, 12000.0, 240.0, 480.0, 40.0}, {10.0, 160.0});
  expect_polar_bounds(cap, {{89.999, 100.0}, 12000.0, 0.0, 350.0, 70.0}, {10.0, 80.0});
  expect_polar_bounds(cap, {{90.0, 0.0}, 12000.0, 0.0, 350.0, 70.0}, {10.0, 80.0});
}

TEST(ShadowBound, HoldsNearTheSouthPole) {
  const auto cap = polar_cap({-90});
  expect_polar_bounds(cap, {{-89.5, 179.9}, 12000.0, 60.0, 300.0, 80.0}, {40.0});
  expect_polar_bounds(cap, {{-90.0, 0.0}, 12000.0, 0.0, 350.0, 115.0}, {40.0});
}

TEST(ShadowBound, HoldsOverRealMountains) {
  YARS_NEEDS_SHARED_DATA();
  const Scan scan{{38.2, -114.9}, 15000.0, 0.0, 90.0, 3.0};
  EXPECT_GT(expect_within_bounds("Nevada", scan, test::shared_data() / "srtm"), 0.3);
}

TEST(ShadowBound, HoldsOverRealHills) {
  YARS_NEEDS_SHARED_DATA();
  const Scan scan{{0.25, 6.9}, 8000.0, 230.0, 310.0, 3.0};
  EXPECT_GT(expect_within_bounds("jungle hills", scan, test::shared_data() / "dted"), 0.1);
}

TEST(ShadowBound, HoldsOverARealCoast) {
  YARS_NEEDS_SHARED_DATA();
  const Scan scan{{36.3, -122.3}, 6000.0, 20.0, 110.0, 3.0};
  EXPECT_GT(expect_within_bounds("Big Sur", scan, test::shared_data() / "srtm"), 0.1);
}

}  // namespace
}  // namespace yars::model::rbm
