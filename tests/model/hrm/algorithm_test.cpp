// Every algorithm of patch maps: a map does not depend on earlier or abandoned maps of the same PatchFormation.
#include "model/hrm/algorithm.hpp"

#include <gtest/gtest.h>

#include "lib/radar/configuration.hpp"
#include "tests/model/hrm/made_up_scene.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::test {
namespace {

class EveryAlgorithm : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Presets, EveryAlgorithm, ::testing::Values("standard", "draft", "reference", "1996"));

TEST_P(EveryAlgorithm, FormsAMapIndependentOfEarlierAndAbandonedMaps) {
  radar::RadarConfiguration configuration;
  configuration.fidelity = *radar::fidelity_preset(GetParam());
  configuration.fidelity.map_size = configuration.fidelity.algorithm == radar::Algorithm::reference ? 32 : 64;
  const auto scene = std::make_shared<MadeUpScene>(kTarget, kGround_m);
  scene->add({});
  const auto ground = ground_of(model::terrain::flat(kGround_m));
  const hrm::PatchOrder order = order_from({});
  Viewpoint wide;
  wide.window_m *= 3.0;

  hrm::PatchFormation formation(configuration, {});
  formation.begin(order_from(wide));
  formation.set_environment({ground, ground, scene});
  while (formation.state() != hrm::PatchState::done) formation.advance();
  formation.begin(order);
  formation.set_environment({ground, ground, scene});
  for (int stage = 0; stage < 2; ++stage) formation.advance();  // then abandoned, after the scene is drawn
  for (const bool with_scene : {true, false}) {
    const model::scene::SceneViewPointer given = with_scene ? scene : nullptr;
    formation.begin(order);
    formation.set_environment({ground, ground, given});
    while (formation.state() != hrm::PatchState::done) formation.advance();
    const auto fresh = make_patch(configuration, order, ground, given);
    EXPECT_EQ(formation.image().power, fresh.image().power) << with_scene;
    EXPECT_EQ(formation.picture(), fresh.picture()) << with_scene;
  }
}

}  // namespace
}  // namespace yars::test
