// Interpolation between columns of the polar grid. If posts are many columns apart, a map samples the ground only on
// every third or fifth column. The tests check the change of the map, and cases in which every column is sampled.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/polar_ground_simd.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "tests/lib/simd/vector_targets.hpp"
#include "tests/model/hrm/patch_maker.hpp"

namespace yars::test {
namespace {

namespace terrain = model::terrain;

// Hills with 120 m amplitude, and roughness with 6 m amplitude between neighbouring posts.
std::shared_ptr<const terrain::Cell> mountains(int posts) {
  std::vector<std::int16_t> heights;
  for (int row = 0; row < posts; ++row)
    for (int column = 0; column < posts; ++column)
      heights.push_back(static_cast<std::int16_t>(300.0 + 120.0 * std::sin(0.11 * row) * std::cos(0.13 * column) +
                                                  6.0 * std::sin(2.1 * row + 1.7 * column)));
  return std::make_shared<const terrain::Cell>(terrain::CellCorner{37, -123}, posts, posts, heights);
}

// Passes on another view, but reports another spacing of its posts, and, if wanted, that it may have materials.
class Reported final : public terrain::TerrainView {
 public:
  Reported(terrain::TerrainViewPointer of, double spacing_m, bool materials)
      : of_(std::move(of)), spacing_m_(spacing_m), materials_(materials) {}
  std::uint64_t generation() const override { return of_->generation(); }
  std::uint64_t resident_bytes() const override { return of_->resident_bytes(); }
  terrain::Surface surface_at(geo::GeoPoint position, Interpolation interpolation) const override {
    return of_->surface_at(position, interpolation);
  }
  std::size_t surfaces(const terrain::PositionRun& positions, Interpolation interpolation,
                       const terrain::SurfaceRun& found) const override {
    return of_->surfaces(positions, interpolation, found);
  }
  double post_spacing_m() const override { return spacing_m_; }
  bool has_materials() const override { return materials_; }
  std::vector<std::shared_ptr<const terrain::Cell>> cells_within(const terrain::GeoBox& box) const override {
    return of_->cells_within(box);
  }
  bool crests(const terrain::PositionRun& positions, const terrain::RaySight& sight,
              std::span<float> tangent) const override {
    return of_->crests(positions, sight, tangent);
  }

 private:
  terrain::TerrainViewPointer of_;
  double spacing_m_;
  bool materials_;
};

terrain::TerrainViewPointer view_of(int posts) {
  auto view = std::make_shared<terrain::CellView>(1, terrain::Absence::none);
  view->add(mountains(posts));
  return view;
}

hrm::PatchOrder order_over_mountains() {
  Viewpoint view;
  view.above_m = 4000.0;
  return order_from(view);
}

TEST(PostSpacing, IsThatOfTheClosestPosts) {
  // Posts 3 arcseconds apart: 92.7 m to the north, less to the east, least at the northern edge, 38 degrees.
  EXPECT_NEAR(view_of(1201)->post_spacing_m(), geo::kMetresPerDegree / 1200.0 * std::cos(38.0 * geo::kRadiansPerDegree),
              0.1);
  terrain::CellView both(1, terrain::Absence::none);
  EXPECT_EQ(both.post_spacing_m(), 0.0);
  both.add(mountains(1201));
  both.add(
      std::make_shared<const terrain::Cell>(terrain::CellCorner{89, 0}, 121, 2, std::vector<std::int16_t>(242, 1)));
  EXPECT_NEAR(both.post_spacing_m(), 0.0, 1e-9) << "a cell at a pole";
}

TEST(ColumnsBetween, LieOnAStraightLineOnEveryVectorTarget) {
  constexpr std::size_t kRows = 37, kPitch = 48;
  for (const std::size_t step : {3U, 5U}) {
    for_each_vector_target([&](const char* name) {
      std::vector<float> columns(16 * kPitch + 16, -1.0F);
      for (std::size_t lane = 0; lane < 16; lane += step)
        for (std::size_t row = 0; row < kRows; ++row)
          columns[lane * kPitch + row] = static_cast<float>(3 * lane + 100 * row);
      hrm::simd::interpolate_columns(kRows, step, columns.data(), kPitch);
      for (std::size_t lane = 0; lane < 16; ++lane)
        for (std::size_t row = 0; row < kRows; ++row)
          EXPECT_NEAR(columns[lane * kPitch + row], static_cast<float>(3 * lane + 100 * row), 1e-3F)
              << name << ' ' << lane << ' ' << row;
    });
  }
}

// Map with the columns of the configuration, or with every column sampled.
hrm::PatchFormation map_of_mountains(const radar::RadarConfiguration& configuration, int posts, bool every_column,
                                     bool materials = false) {
  // Columns of a pixel's width are sampled at most a quarter of the posts' spacing apart, every third or fifth one.
  // Crests between rows would be computed for rows farther apart than a tenth of the spacing.
  constexpr double kPixelsPerPost = 11.0;
  const hrm::PatchOrder order = order_over_mountains();
  const double pixel_m = order.window.metres() / configuration.fidelity.map_size;
  const auto ground = view_of(posts);
  double spacing_m = ground->post_spacing_m();
  if (every_column) spacing_m = std::min(spacing_m, kPixelsPerPost * pixel_m);
  hrm::PatchFormation formation(configuration, {});
  formation.begin(order);
  formation.set_environment({std::make_shared<Reported>(ground, spacing_m, materials), ground, nullptr});
  while (formation.state() != hrm::PatchState::done) formation.advance();
  return formation;
}

class ColumnsBetweenWith : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Materials, ColumnsBetweenWith, testing::Bool());

TEST_P(ColumnsBetweenWith, ChangeAMapOfMountainsByLessThanHalfADecibel) {
  const radar::RadarConfiguration configuration = bare_map(1024);
  const auto interpolated = map_of_mountains(configuration, 1201, false, GetParam());
  const auto sampled = map_of_mountains(configuration, 1201, true, GetParam());
  const auto& interpolated_power = interpolated.image().power;
  const auto& sampled_power = sampled.image().power;
  ASSERT_EQ(interpolated_power.size(), sampled_power.size());
  double squares = 0.0, interpolated_sum = 0.0, sampled_sum = 0.0;
  std::size_t lit = 0, differ = 0;
  const auto dark = static_cast<float>(0.05 * gamma_of(configuration, 0));
  for (std::size_t i = 0; i < interpolated_power.size(); ++i) {
    interpolated_sum += static_cast<double>(interpolated_power[i]);
    sampled_sum += static_cast<double>(sampled_power[i]);
    if ((interpolated_power[i] < dark) != (sampled_power[i] < dark)) ++differ;
    if (interpolated_power[i] < dark || sampled_power[i] < dark) continue;
    squares += std::pow(10.0 * std::log10(static_cast<double>(interpolated_power[i] / sampled_power[i])), 2.0);
    ++lit;
  }
  const double rms_db = std::sqrt(squares / static_cast<double>(lit));
  std::printf("every fifth column: %.3f dB RMS, power %+.5f, shadow %.5f\n", rms_db,
              interpolated_sum / sampled_sum - 1.0,
              static_cast<double>(differ) / static_cast<double>(interpolated_power.size()));
  EXPECT_GT(rms_db, 0.0) << "some columns are interpolated";
  EXPECT_LT(rms_db, 0.5);
  EXPECT_NEAR(interpolated_sum / sampled_sum, 1.0, 0.002);
  EXPECT_LT(static_cast<double>(differ), 0.002 * static_cast<double>(interpolated_power.size()));
}

TEST(ColumnsBetween, AreSampledForClosePostsNearestInterpolationAndGroundDetail) {
  const auto equal_maps = [](const radar::RadarConfiguration& configuration, int posts) {
    return map_of_mountains(configuration, posts, false).image().power ==
           map_of_mountains(configuration, posts, true).image().power;
  };
  radar::RadarConfiguration configuration = bare_map(240);
  EXPECT_TRUE(equal_maps(configuration, 3601)) << "pixels of 5 m, posts of 24 m";
  configuration = bare_map(512);
  configuration.fidelity.interpolation = radar::Interpolation::nearest;
  EXPECT_TRUE(equal_maps(configuration, 1201));
  configuration.fidelity.interpolation = radar::Interpolation::bilinear;
  EXPECT_FALSE(equal_maps(configuration, 1201));
  // Samples are at most one texel of the ground detail apart, which is less than three columns.
  configuration.fidelity.map_detail = true;
  configuration.fidelity.map_size = 480;
  EXPECT_TRUE(equal_maps(configuration, 1201));
}

// Fields of two materials, 40 m wide, turned against the columns.
constexpr std::uint8_t kFirstMaterial = 2, kSecondMaterial = 5;
std::uint8_t field_at(geo::GeoPoint position) {
  const double field = geo::kMetresPerDegree / 40.0 * (position.latitude_deg + 0.3 * position.longitude_deg);
  return std::fmod(std::floor(field), 2.0) == 0.0 ? kFirstMaterial : kSecondMaterial;
}

TEST(ColumnsBetween, HaveTheMaterialsOfTheirOwnPositions) {
  radar::RadarConfiguration configuration = bare_map(512);
  const auto level = [](geo::GeoPoint) { return kGround_m; };
  const auto fields = std::make_shared<terrain::AnalyticTerrain>(level, 1, field_at);
  const auto map = make_patch(configuration, order_from({}), std::make_shared<Reported>(fields, 92.7, true));
  const double border = std::sqrt(gamma_of(configuration, kFirstMaterial) * gamma_of(configuration, kSecondMaterial));
  const bool first_is_brighter = gamma_of(configuration, kFirstMaterial) > gamma_of(configuration, kSecondMaterial);
  std::size_t wrong = 0;
  const double pixel_m = map.geometry().window_m() / map.image().size;
  for (int row = 0; row < map.image().size; ++row)
    for (int column = 0; column < map.image().size; ++column) {
      const double half = 0.5 * map.image().size - 0.5;
      const geo::GeoPoint position = map.geometry().position_of({(column - half) * pixel_m, (half - row) * pixel_m});
      const bool bright = static_cast<double>(map.image().power[map.image().at(column, row)]) > border;
      if (bright != ((field_at(position) == kFirstMaterial) == first_is_brighter)) ++wrong;
    }
  // Pixels of 1.2 m at borders of fields of 40 m: one pixel in 33 lies on a border, and half of these are wrong.
  EXPECT_LT(static_cast<double>(wrong), 0.02 * 1024.0 * 1024.0);
}

}  // namespace
}  // namespace yars::test
