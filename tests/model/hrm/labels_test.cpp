// Labels of a patch map: over a box they end where geometry says, over hills they are those of a plain search.
// Source: docs/spec/physics.md#layover.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/model/hrm/made_up_scene.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::test {
namespace {

hrm::PatchFormation labelled(const radar::RadarConfiguration& configuration, const hrm::PatchOrder& order,
                             const model::terrain::TerrainViewPointer& ground,
                             const model::scene::SceneViewPointer& scene = nullptr) {
  return make_patch(configuration, order, ground, scene, 1, hrm::kMaxSectorPoints, hrm::LabelUse::heights);
}

class LabelledBox : public testing::TestWithParam<double> {};

// A box of 25 m, 60 m long and 40 m wide, lit along its length.
TEST_P(LabelledBox, HasShadowLayoverAndObjectWhereGeometrySays) {
  const radar::RadarConfiguration configuration = bare_map();
  Viewpoint view;
  view.from_deg = GetParam();
  view.distance_m = 10000.0;
  view.above_m = 4000.0;
  const auto scene = std::make_shared<MadeUpScene>(kTarget, kGround_m);
  scene->add({150.0, -150.0, 0.0, 10.0, 10.0, 5.0, kStone});  // another object, so that the index is not the only one
  const Box box{0.0, 0.0, view.from_deg, 60.0, 40.0, 25.0, kEarthenWorks};
  const auto number = static_cast<std::int32_t>(scene->add(box));
  const auto process = labelled(configuration, order_from(view), ground_of(model::terrain::flat(kGround_m)), scene);
  const hrm::PixelLabels& labels = process.labels();
  const int size = process.image().size;
  const double pixel_m = process.geometry().window_m() / size;
  const double near_m = view.distance_m - 0.5 * box.length_m, far_m = view.distance_m + 0.5 * box.length_m;
  const double roof_begin_m = hrm::laid_over_m(near_m, box.height_m, view.above_m);
  const double roof_end_m = hrm::laid_over_m(far_m, box.height_m, view.above_m);
  const double shadow_end_m = far_m * view.above_m / (view.above_m - box.height_m);
  const auto gamma = static_cast<float>(gamma_of(configuration, 0));
  int checked = 0;
  for (int row = 0; row < size; ++row) {
    const double at_m = view.distance_m + 0.5 * process.geometry().window_m() - (row + 0.5) * pixel_m;
    const auto nears = [&](double edge_m) { return std::abs(at_m - edge_m) < 1.5 * pixel_m; };
    if (nears(roof_begin_m) || nears(roof_end_m) || nears(near_m) || nears(shadow_end_m)) continue;
    const std::size_t pixel = process.image().at(size / 2, row);
    const bool on_roof = at_m > roof_begin_m && at_m < roof_end_m;
    const bool on_foot = at_m > roof_begin_m && at_m < near_m;  // wall, roof and the ground before the wall
    const bool dark = at_m > roof_end_m && at_m < shadow_end_m && at_m > near_m;
    EXPECT_EQ(labels.shadow[pixel], dark ? 1 : 0) << at_m;
    EXPECT_EQ(labels.layover[pixel], on_foot ? 1 : 0) << at_m;
    EXPECT_EQ(labels.object[pixel], on_roof || on_foot ? number : -1) << at_m;
    EXPECT_EQ(labels.material[pixel], on_roof || on_foot ? kEarthenWorks : 0) << at_m;
    EXPECT_EQ(process.image().power[pixel] < 0.01F * gamma, dark) << at_m;
    if (dark) {
      EXPECT_TRUE(std::isnan(labels.height_m[pixel]) && std::isnan(labels.sin_grazing[pixel])) << at_m;
    } else if (!on_roof && !on_foot) {
      EXPECT_NEAR(labels.height_m[pixel], kGround_m, 0.01) << at_m;
      EXPECT_NEAR(labels.sin_grazing[pixel], view.above_m / std::hypot(at_m, view.above_m), 0.003) << at_m;
    } else if (!on_foot) {
      EXPECT_NEAR(labels.height_m[pixel], kGround_m + box.height_m, 0.01) << at_m;
      EXPECT_NEAR(labels.sin_grazing[pixel], view.above_m / std::hypot(at_m, view.above_m), 0.003) << at_m;
    }
    ++checked;
  }
  EXPECT_GT(checked, size - 40);
}

INSTANTIATE_TEST_SUITE_P(FromSeveralSides, LabelledBox, testing::Values(0.0, 90.0, 180.0, 237.0));

// A plain search over the ground along one pixel column's line of sight, in steps of a twentieth of a pixel.
struct Profile {
  std::vector<double> distance_m, height_m, seen_at_m;
  std::vector<bool> lit;
};

Profile search(const hrm::PatchFormation& process, const hrm::PatchOrder& order,
               const model::terrain::TerrainView& ground, double turn_rad) {
  const hrm::PatchGeometry& geometry = process.geometry();
  const double step_m = geometry.window_m() / process.image().size / 20.0;
  Profile profile;
  double horizon = -1e9;
  for (double distance_m = step_m; distance_m < geometry.distance_m() + 1.5 * geometry.window_m();
       distance_m += step_m) {
    const geo::GeoPoint position = geo::geodesic_direct(order.apex, geometry.up() + geo::Angle::radians(turn_rad),
                                                        geo::Length::metres(distance_m));
    const double height_m = ground.elevation_m(position) - geometry.plane_msl_m();
    const double tangent = (height_m - geometry.above_plane_m(distance_m)) / geometry.sight_distance_m(distance_m);
    profile.distance_m.push_back(distance_m);
    profile.height_m.push_back(height_m);
    profile.lit.push_back(tangent > horizon);
    profile.seen_at_m.push_back(hrm::laid_over_m(distance_m, height_m, geometry.above_level_m(distance_m)));
    horizon = std::max(horizon, tangent);
  }
  return profile;
}

// Number of lit pieces of the profile that appear at a distance.
int layers_at(const Profile& profile, double at_m) {
  int layers = 0;
  for (std::size_t i = 1; i < profile.lit.size(); ++i) {
    if (!profile.lit[i]) continue;
    const auto [low, high] = std::minmax(profile.seen_at_m[i - 1], profile.seen_at_m[i]);
    layers += low <= at_m && at_m < high ? 1 : 0;
  }
  return layers;
}

TEST(LabelsOverHills, AreThoseOfAPlainSearch) {
  const radar::RadarConfiguration configuration = bare_map(240);
  Viewpoint view;
  view.distance_m = 9000.0;
  view.above_m = 8000.0;
  const hrm::PatchOrder order = order_from(view);
  const auto hills = model::terrain::sine_hills({order.centre, geo::Bearing::degrees(20.0)}, 140.0, 260.0);
  const auto ground = ground_of([&](geo::GeoPoint position) { return 200.0 + hills(position); });
  const auto process = labelled(configuration, order, ground);
  const hrm::PixelLabels& labels = process.labels();
  const int size = process.image().size;
  const double pixel_m = process.geometry().window_m() / size;
  int differ = 0, checked = 0, dark = 0, folded = 0;
  for (int line = -5; line <= 5; line += 2) {
    const double tangent = 0.1 * line * process.geometry().window_m() / view.distance_m;
    const Profile profile = search(process, order, *ground, std::atan(tangent));
    for (int row = 0; row < size; ++row) {
      const double ahead_m = view.distance_m + 0.5 * process.geometry().window_m() - (row + 0.5) * pixel_m;
      const auto column = static_cast<int>(tangent * ahead_m / pixel_m + 0.5 * size);
      if (column < 0 || column >= size) continue;
      const double at_m = std::hypot(tangent * ahead_m, ahead_m);
      const int layers = layers_at(profile, at_m);
      // Pixels near an edge may belong to either side.
      if (layers != layers_at(profile, at_m - pixel_m) || layers != layers_at(profile, at_m + pixel_m)) continue;
      const std::size_t pixel = process.image().at(column, row);
      const bool is_same = (labels.shadow[pixel] != 0) == (layers == 0) && (labels.layover[pixel] != 0) == (layers > 1);
      differ += is_same ? 0 : 1;
      dark += layers == 0 ? 1 : 0;
      folded += layers > 1 ? 1 : 0;
      ++checked;
    }
  }
  EXPECT_GT(checked, 750);
  EXPECT_GT(dark, 25);
  EXPECT_GT(folded, 50);
  EXPECT_LE(differ, checked / 200) << "of " << checked;
}

TEST(LabelsOfWater, AreThoseOfGroundAtSeaLevelAndTheBlindZoneHasNone) {
  radar::RadarConfiguration configuration = bare_map(64);
  configuration.fidelity.map_smooth_ground = false;
  Viewpoint view;
  hrm::PatchOrder order = order_from(view);
  const auto sea = labelled(configuration, order, ground_of(model::terrain::flat(0.0)));
  for (const std::uint8_t material : sea.labels().material) ASSERT_EQ(material, radar::kWaterMaterial);
  order.ground_track = geo::geodesic_inverse(order.apex, order.centre).azimuth_at_start;
  const auto blind = labelled(configuration, order, ground_of(model::terrain::flat(kGround_m)));
  for (std::size_t i = 0; i < blind.image().power.size(); ++i) {
    ASSERT_LT(blind.image().power[i], 0.0F);
    ASSERT_EQ(blind.labels().object[i], -1);
    ASSERT_EQ(blind.labels().shadow[i], 0);
    ASSERT_TRUE(std::isnan(blind.labels().height_m[i]));
  }
}

TEST(PatchResult, IsTakenWithoutACopyAndTheNextMapIsWhole) {
  const radar::RadarConfiguration configuration = bare_map(64);
  const hrm::PatchOrder order = order_from({});
  const auto ground = ground_of(model::terrain::flat(kGround_m));
  hrm::PatchFormation process = labelled(configuration, order, ground);
  const float* const power = process.image().power.data();
  const hrm::PatchFormation::Result first = process.take_result();
  EXPECT_EQ(first.image.power.data(), power);
  process.begin(order);
  process.set_environment({ground, ground, nullptr});
  while (process.state() != hrm::PatchState::done) process.advance();
  const hrm::PatchFormation::Result second = process.take_result();
  EXPECT_EQ(second.image.power, first.image.power);
  EXPECT_EQ(second.picture, first.picture);
  EXPECT_EQ(second.labels.object, first.labels.object);
}

}  // namespace
}  // namespace yars::test
