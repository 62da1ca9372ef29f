// Terrain at a reduced level of detail: peaks cast its shadow, equally by the algorithms `reference` and `standard`.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/rbm/standard.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tests/model/physics/ground.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "tests/model/terrain/sampling/rough_cell.hpp"

namespace yars::model::rbm {
namespace {

constexpr geo::GeoPoint kApex{37.5, -121.5};

// Mountain ranges with single posts as peaks, and an area of voids.
terrain::Cell mountains() {
  return test::cell_of({37, -122}, 121, 121, [](int row, int column) {
    if (row > 70 && row < 80 && column > 70 && column < 84) return int{terrain::kVoidPost};
    const double ranges = 500.0 + 300.0 * std::sin(row * 0.31) * std::cos(column * 0.23);
    return static_cast<int>(ranges) + (row * 7 + column * 13) % 29 * 10;
  });
}

physics::SweepGeometry geometry_from(double azimuth_deg) {
  return {kApex, geo::AltitudeMsl::metres(1500.0), geo::Bearing::degrees(azimuth_deg), geo::Angle::degrees(-3.0),
          geo::Length::nautical_miles(20.0)};
}

std::vector<std::uint8_t> lit_by(Algorithm& algorithm, const physics::SweepGeometry& geometry,
                                 const terrain::TerrainView& view, std::size_t count) {
  std::vector<float> power(count);
  std::vector<std::uint8_t> lit(count);
  algorithm.measure(geometry, view, power);
  algorithm.lit(lit);
  for (const float value : power) EXPECT_TRUE(std::isfinite(value) && value >= 0.0F);
  return lit;
}

class ReducedTerrain : public ::testing::Test {
 protected:
  terrain::TerrainViewPointer view(double spacing_m) const {
    EXPECT_TRUE(terrain::write_dted(folder_.path(), mountains(), 0));
    auto store = terrain::DirectoryTerrainStore::open(folder_.path(), {});
    return (*store)->prepare({kApex, 40000.0, terrain::detail_for(spacing_m)});
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(ReducedTerrain, TheReferenceAndTheStandardHaveTheSameShadows) {
  const auto reduced = view(4100.0);  // every fourth post
  ASSERT_TRUE(reduced->has_peaks());
  radar::RadarConfiguration configuration;
  configuration.fidelity.samples = 480;
  Reference reference(configuration);
  Standard standard(configuration);
  const std::size_t count = sample_count(configuration);
  double mismatches = 0.0, dark = 0.0, total = 0.0;
  for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 5.0) {
    const auto exact = lit_by(reference, geometry_from(azimuth_deg), *reduced, count);
    const auto fast = lit_by(standard, geometry_from(azimuth_deg), *reduced, count);
    for (std::size_t i = 0; i < count; ++i) {
      mismatches += exact[i] != fast[i] ? 1.0 : 0.0;
      dark += exact[i] == 0 ? 1.0 : 0.0;
      total += 1.0;
    }
  }
  EXPECT_LE(mismatches / total, 0.005);
  EXPECT_GT(dark / total, 0.1);
  EXPECT_LT(dark / total, 0.9);
}

TEST_F(ReducedTerrain, ThePeakOfAPositionIsNeverBelowItsGround) {
  const auto reduced = view(4100.0);
  const auto finest_view = view(0.0);
  for (int i = 0; i < 300; ++i) {
    const geo::GeoPoint position{37.05 + 0.0029 * i, -121.05 - 0.003 * i};
    const terrain::Surface surface = reduced->surface_at(position);
    if (std::isnan(surface.elevation_m)) continue;
    EXPECT_GE(surface.peak_m, surface.elevation_m - 1.0);
    const terrain::Surface finest = finest_view->surface_at(position);
    if (std::isnan(finest.elevation_m)) continue;
    EXPECT_GE(surface.peak_m, finest.elevation_m - 1e-9) << "a shadow is never lost";
    EXPECT_EQ(finest.peak_m, finest.elevation_m);
  }
}

}  // namespace
}  // namespace yars::model::rbm
