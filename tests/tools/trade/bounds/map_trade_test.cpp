// `yars trade maps`: error measures of patch maps against the ruler, the effect of knobs, and refused input.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/radar/configuration.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/scene/openflight/reader.hpp"
#include "tests/model/terrain/shapes.hpp"
#include "tools/trade/scenes.hpp"
#include "tools/trade/trade_errors.hpp"
#include "tools/trade/trade_table.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::tools::trade {
namespace {

namespace hrm = model::hrm;

constexpr int kSize = 48;  // [pixels] edge of the maps; small, because the reference is slow
constexpr geo::GeoPoint kTarget{37.5, -121.5};

// Clock that always shows 0.
double no_clock() {
  return 0.0;
}

radar::Fidelity preset(std::string_view name) {
  radar::Fidelity fidelity = *radar::fidelity_preset(name);
  fidelity.map_size = kSize;
  return fidelity;
}

model::terrain::TerrainViewPointer hills() {
  return std::make_shared<model::terrain::AnalyticTerrain>(model::terrain::built_in_hills());
}

// A generated airfield, placed on the ground at the target.
model::scene::SceneViewPointer airfield(const model::terrain::TerrainView& ground) {
  using namespace model::scene;
  const worldgen::GeneratedScene made = worldgen::generate_scene({worldgen::GeneratedKind::airfield, 5000, 1, kTarget});
  const auto model = read_openflight(made.file, "airfield");
  if (!model) return nullptr;
  KindTable kinds;
  const auto placed = std::make_shared<PlacedScene>(place_model(*model, {kTarget}, ground, 0, kinds));
  return std::make_shared<PlacedView>(1, std::vector<std::shared_ptr<const PlacedScene>>{placed}, kinds.kinds(),
                                      std::vector<SceneObject>(placed->objects));
}

class MapTrade : public ::testing::Test {
 protected:
  MapObservation observe(const radar::Fidelity& fidelity, const MapView& view, bool scene = false) const {
    radar::RadarConfiguration configuration;
    configuration.fidelity = fidelity;
    return observe_map(configuration, order_of(view), {ground_, ground_, scene ? airfield(*ground_) : nullptr},
                       no_clock);
  }
  model::terrain::TerrainViewPointer ground_ = hills();
};

TEST_F(MapTrade, TheReferenceAgainstItselfHasNoError) {
  const MapView view = view_of_target(kTarget, 10.0, 200.0, 15000.0, 0.67);
  const MapObservation exact = observe(preset("reference"), view, true);
  const MapErrors errors = errors_against(exact, observe(preset("reference"), view, true));
  EXPECT_EQ(errors.position_m, 0.0);
  EXPECT_EQ(errors.shadow_percent, 0.0);
  EXPECT_EQ(errors.power_db, 0.0);
  EXPECT_EQ(errors.gray_levels, 0.0);
}

// Near; far and far north; and across the antimeridian. The apparent position of a mark is known to half a pixel.
TEST_F(MapTrade, StandardPutsMarksWithinHalfAPixelOfTheReference) {
  for (const MapView& view :
       {view_of_target(kTarget, 10.0, 200.0, 15000.0, 0.67), view_of_target({78.2, 16.0}, 80.0, 120.0, 30000.0, 20.0),
        view_of_target({-16.5, 179.99}, 20.0, 100.0, 15000.0, 10.0)}) {
    SCOPED_TRACE(map_view_name(view));
    const MapObservation exact = observe(preset("reference"), view);
    const MapErrors errors = errors_against(exact, observe(preset("standard"), view));
    EXPECT_LT(errors.position_m, 0.5 * view.window_nm * geo::kMetresPerNauticalMile / kSize);
    EXPECT_LT(errors.shadow_percent, 8.0);  // the pixels are coarse: many lie on the edge of a shadow
    EXPECT_LT(errors.power_db, 3.0);
  }
}

// A plane that slopes across the line of sight. Expected error without layover: height above the map's plane times the
// tangent of the grazing angle.
TEST_F(MapTrade, WithoutLayoverMarksAreOffByHeightTimesTheTangentOfGrazing) {
  ground_ = std::make_shared<model::terrain::AnalyticTerrain>(
      model::terrain::plane({kTarget, geo::Bearing::degrees(110.0)}, 2000.0, 0.4));
  const MapView view = view_of_target(kTarget, 20.0, 200.0, 30000.0, 4.7);
  const MapObservation exact = observe(preset("reference"), view);
  radar::Fidelity flat = preset("standard");
  const double with_m = errors_against(exact, observe(flat, view)).position_m;
  flat.map_layover = false;
  const MapErrors without = errors_against(exact, observe(flat, view));
  const hrm::PatchGeometry geometry(order_of(view), radar::RadarConfiguration(), ground_->elevation_m(kTarget));
  double farthest_m = 0.0;
  const MarkScene marks(order_of(view));
  for (const model::scene::SceneObject& mark : marks.objects())
    farthest_m = std::max(farthest_m, std::abs(ground_->elevation_m(mark.middle) - geometry.plane_msl_m()));
  const double sine = geometry.sin_grazing();
  const double wanted_m = farthest_m * sine / std::sqrt(1.0 - sine * sine);
  // The apparent position of a mark is known to half a pixel.
  const double half_m = 0.5 * geometry.window_m() / kSize;
  ASSERT_GT(wanted_m, 2.0 * half_m);
  EXPECT_LT(with_m, half_m);
  EXPECT_NEAR(without.position_m, wanted_m, half_m);
}

TEST_F(MapTrade, ErrorsIncreaseFromStandardToDraftTo1996) {
  const MapView view = view_of_target(kTarget, 10.0, 200.0, 15000.0, 0.67);
  const MapObservation exact = observe(preset("reference"), view, true);
  const MapErrors standard = errors_against(exact, observe(preset("standard"), view, true));
  const MapErrors draft = errors_against(exact, observe(preset("draft"), view, true));
  EXPECT_GT(draft.power_db, standard.power_db);
  EXPECT_GT(draft.gray_levels, standard.gray_levels);
  const MapErrors report = errors_against(exact, observe(preset("1996"), view, true));
  EXPECT_TRUE(std::isnan(report.power_db));
  EXPECT_GT(report.gray_levels, draft.gray_levels);
  EXPECT_GT(standard.power_db, 0.0);
}

// A map of 1 x 1 pixel against a ruler of 2 x 2 pixels. Expected values are computed by hand.
TEST(MapErrorMeasures, AreCountedOnTheRulersPixels) {
  MapObservation ruler;
  ruler.size = 2;
  ruler.power = {1.0F, 1.0F, 0.0F, 1.0F};
  ruler.dark = {0, 0, 1, 0};
  ruler.video = {10, 20, 30, 40};
  ruler.marks = {hrm::MapPoint{0.0, 0.0}, std::nullopt, hrm::MapPoint{5.0, 5.0}};
  MapObservation found;
  found.size = 1;
  found.power = {0.1F};
  found.dark = {0};
  found.video = {20};
  found.marks = {hrm::MapPoint{3.0, 4.0}, hrm::MapPoint{90.0, 0.0}, std::nullopt};
  const MapErrors errors = errors_against(ruler, found);
  EXPECT_DOUBLE_EQ(errors.position_m, 5.0);
  EXPECT_DOUBLE_EQ(errors.shadow_percent, 25.0);
  EXPECT_NEAR(errors.power_db, 10.0, 1e-6);
  EXPECT_DOUBLE_EQ(errors.gray_levels, std::sqrt((100.0 + 0.0 + 100.0 + 400.0) / 4.0));
}

TEST(MapKnobs, AreOnlyThoseOfMaps) {
  const radar::Fidelity base = *radar::fidelity_preset("standard");
  EXPECT_EQ((*knob_candidates("mapOversampling=2", base, Subject::map))[0].fidelity.map_oversampling, 2);
  EXPECT_EQ((*knob_candidates("mapSize=1024", base, Subject::map))[0].fidelity.map_size, 1024);
  EXPECT_FALSE((*knob_candidates("mapLayover=false", base, Subject::map))[0].fidelity.map_layover);
  for (const char* sweep : {"samples=240", "mapSize=15", "mapSize=4097", "mapOversampling=5", "mapDetail=1", ""}) {
    const auto refused = knob_candidates(sweep, base, Subject::map);
    ASSERT_FALSE(refused) << sweep;
    EXPECT_TRUE(refused.error().bad_usage());
  }
}

TEST(MapViewOf, TakesSixNumbersWithinTheirLimits) {
  const auto view = map_view_of("37.6,-122.5,15000,37.8,-122.3,3.3");
  ASSERT_TRUE(view);
  EXPECT_EQ(row_of(*view).numbers, (std::vector<double>{37.6, -122.5, 15000.0, 37.8, -122.3, 3.3}));
  for (const char* text :
       {"", "37.6,-122.5,15000,37.8,-122.3", "37.6,-122.5,15000,37.8,-122.3,3.3,1", "91,-122.5,15000,37.8,-122.3,3.3",
        "37.6,-122.5,15000,37.8,-122.3,40", "37.6,-122.5,15000,37.8,-122.3,nan"}) {
    const auto refused = map_view_of(text);
    ASSERT_FALSE(refused) << text;
    EXPECT_TRUE(refused.error().bad_usage());
  }
}

}  // namespace
}  // namespace yars::tools::trade
