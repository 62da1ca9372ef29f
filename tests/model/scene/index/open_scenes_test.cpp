// open_scenes(): scenes of a configuration, and scenes that lie in the folder of the terrain.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "lib/radar/world.hpp"
#include "model/scene/index/scene_store.hpp"
#include "tests/model/scene/support.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::model::scene {
namespace {

constexpr geo::GeoPoint kScenesOrigin{37.5, -122.3};

// A scene of one object of this name at kScenesOrigin.
std::vector<std::byte> box(const std::string& name) {
  worldgen::OpenFlightWriter writer(kScenesOrigin);
  worldgen::MeshBuilder mesh_builder(writer);
  writer.begin_object(name);
  mesh_builder.box({0, 0, 0}, 20, 10, 8);
  writer.end();
  return writer.take();
}

bool has_object(SceneStore& store, const std::string& name) {
  const SceneViewPointer view = store.prepare({kScenesOrigin, 1000, 0});
  return std::ranges::any_of(view->objects(), [&](const SceneObject& object) { return object.name == name; });
}

class OpenScenes : public ::testing::Test {
 protected:
  OpenScenes() {
    folder_.write("terrain/N37W123.hgt", std::vector<std::byte>(std::size_t{1201} * 1201 * 2));
    terrain_.directory = (folder_.path() / "terrain").string();
  }
  std::unique_ptr<SceneStore> opened(const std::vector<radar::Scene>& configured = {}) {
    auto store = open_scenes(configured, terrain_);
    EXPECT_TRUE(store) << store.error().message();
    return store ? std::move(*store) : nullptr;
  }

  Folder folder_;
  radar::TerrainConfiguration terrain_;
};

TEST_F(OpenScenes, WithoutAnySceneThereIsNoStore) {
  EXPECT_EQ(opened(), nullptr);
  std::filesystem::create_directories(folder_.path() / "terrain/scenes");
  EXPECT_EQ(opened(), nullptr) << "an empty folder is no error";
  terrain_.directory.clear();
  EXPECT_EQ(opened(), nullptr) << "the built-in hills";
}

TEST_F(OpenScenes, ScenesStandOnHeightsWithoutTheCultureOfTheTerrain) {
  folder_.write("terrain/N37W123.smc.png", std::vector<std::byte>(10));
  folder_.write("terrain/scenes/a.flt", box("shed"));
  const auto store = opened();
  ASSERT_NE(store, nullptr);
  EXPECT_TRUE(has_object(*store, "shed"));
  EXPECT_TRUE(store->take_problems().empty());
}

TEST_F(OpenScenes, FilesInTheTerrainsFolderBelongToTheTerrain) {
  folder_.write("terrain/scenes/a.flt", box("shed"));
  const auto store = opened();
  ASSERT_NE(store, nullptr);
  EXPECT_TRUE(has_object(*store, "shed"));
}

TEST_F(OpenScenes, TheyStandBesideThoseOfTheConfiguration) {
  folder_.write("terrain/scenes/a.flt", box("shed"));
  const auto store = opened({{.file = folder_.write("b.flt", box("barn")).string()}});
  ASSERT_NE(store, nullptr);
  EXPECT_TRUE(has_object(*store, "shed"));
  EXPECT_TRUE(has_object(*store, "barn"));
}

TEST_F(OpenScenes, AnUnusableFileInTheTerrainsFolderIsAProblemNotAnError) {
  folder_.write("terrain/scenes/a.flt", box("shed"));
  folder_.write("terrain/scenes/b.flt", std::vector<std::byte>(10));
  const auto store = opened();
  ASSERT_NE(store, nullptr);
  EXPECT_TRUE(has_object(*store, "shed"));
  EXPECT_FALSE(store->take_problems().empty());
}

}  // namespace
}  // namespace yars::model::scene
