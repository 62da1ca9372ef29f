// Where posts are many columns apart, a map reads the ground only on each third or fifth column. Tests the effect, and
// the cases where this is not done.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/geo/earth.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/polar_ground_simd.hpp"
#include "model/terrain/sampling/cell_view.hpp"
#include "tests/lib/simd/vector_targets.hpp"
#include "tests/model/hrm/patch_maker.hpp"

namespace yars::test {
namespace {

namespace terrain = model::terrain;

// Hills and steps of the ground between neighbouring posts, as mountains have them.
std::shared_ptr<const terrain::Cell> mountains(int posts) {
  std::vector<std::int16_t> heights;
  for (int row = 0; row < posts; ++row)
    for (int column = 0; column < posts; ++column)
      heights.push_back(static_cast<std::int16_t>(300.0 + 120.0 * std::sin(0.11 * row) * std::cos(0.13 * column) +
                                                  6.0 * std::sin(2.1 * row + 1.7 * column)));
  return std::make_shared<const terrain::Cell>(terrain::CellCorner{37, -123}, posts, posts, heights);
}

// The same ground, which may have materials: every column is read.
class Covered final : public terrain::TerrainView {
 public:
  explicit Covered(terrain::TerrainViewPointer of) : of_(std::move(of)) {}
  std::uint64_t generation() const override { return of_->generation(); }
  std::uint64_t resident_bytes() const override { return of_->resident_bytes(); }
  terrain::Surface surface_at(geo::GeoPoint position, Interpolation interpolation) const override {
    return of_->surface_at(position, interpolation);
  }
  std::size_t surfaces(const terrain::PositionRun& positions, Interpolation interpolation,
                       const terrain::SurfaceRun& found) const override {
    return of_->surfaces(positions, interpolation, found);
  }
  double post_spacing_m() const override { return of_->post_spacing_m(); }
  bool has_materials() const override { return true; }
  std::vector<std::shared_ptr<const terrain::Cell>> cells_within(const terrain::GeoBox& box) const override {
    return of_->cells_within(box);
  }
  bool crests(const terrain::PositionRun& positions, const terrain::RaySight& sight,
              std::span<float> tangent) const override {
    return of_->crests(positions, sight, tangent);
  }

 private:
  terrain::TerrainViewPointer of_;
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
  // 3": 92.7 m to the north, closer to the east; the cell reaches to 38 degrees.
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

TEST(ColumnsBetween, ChangeAMapOfMountainsByLessThanHalfADecibel) {
  const auto known = view_of(1201);
  const auto covered = std::make_shared<Covered>(known);
  const radar::RadarConfiguration configuration = bare_map(1024);
  const auto quick = make_patch(configuration, order_over_mountains(), known);
  const auto whole = make_patch(configuration, order_over_mountains(), covered);
  const auto& one = quick.image().power;
  const auto& two = whole.image().power;
  ASSERT_EQ(one.size(), two.size());
  double squares = 0.0, sum_one = 0.0, sum_two = 0.0;
  std::size_t lit = 0, differ = 0;
  const auto dark = static_cast<float>(0.05 * gamma_of(configuration, 0));
  for (std::size_t i = 0; i < one.size(); ++i) {
    sum_one += static_cast<double>(one[i]);
    sum_two += static_cast<double>(two[i]);
    if ((one[i] < dark) != (two[i] < dark)) ++differ;
    if (one[i] < dark || two[i] < dark) continue;
    squares += std::pow(10.0 * std::log10(static_cast<double>(one[i] / two[i])), 2.0);
    ++lit;
  }
  const double rms_db = std::sqrt(squares / static_cast<double>(lit));
  std::printf("every fifth column: %.3f dB RMS, power %+.5f, shadow %.5f\n", rms_db, sum_one / sum_two - 1.0,
              static_cast<double>(differ) / static_cast<double>(one.size()));
  EXPECT_GT(rms_db, 0.0) << "columns were left out";
  EXPECT_LT(rms_db, 0.5);
  EXPECT_NEAR(sum_one / sum_two, 1.0, 0.002);
  EXPECT_LT(static_cast<double>(differ), 0.002 * static_cast<double>(one.size()));
}

TEST(ColumnsBetween, AreReadWherePostsAreCloseOrTheNearestDecides) {
  const auto same = [](const radar::RadarConfiguration& configuration, int posts) {
    const auto known = view_of(posts);
    return make_patch(configuration, order_over_mountains(), known).image().power ==
           make_patch(configuration, order_over_mountains(), std::make_shared<Covered>(known)).image().power;
  };
  radar::RadarConfiguration configuration = bare_map(240);
  EXPECT_TRUE(same(configuration, 3601)) << "pixels of 5 m, posts of 24 m";
  configuration = bare_map(1024);
  configuration.fidelity.interpolation = radar::Interpolation::nearest;
  EXPECT_TRUE(same(configuration, 1201));
  configuration.fidelity.interpolation = radar::Interpolation::bilinear;
  EXPECT_FALSE(same(configuration, 1201));
  // The made-up detail is finer than five columns, not than three of these.
  configuration.fidelity.map_detail = true;
  configuration.fidelity.map_size = 480;
  EXPECT_TRUE(same(configuration, 1201));
}

}  // namespace
}  // namespace yars::test
