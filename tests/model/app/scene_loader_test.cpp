// SceneLoader: with a thread, a request returns at once and the scenes load in the background. A synchronous loader
// returns when the scenes are loaded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "lib/radar/world.hpp"
#include "model/app/background_shell.hpp"
#include "tests/model/made_up_objects.hpp"

namespace yars::model {
namespace {

constexpr geo::GeoPoint kScenePosition{37.2, -121.8};

class SceneLoading : public testing::Test {
 protected:
  SceneLoading() {
    std::filesystem::create_directories(folder_);
    const auto bytes = test::flt_of({test::Building{}}, kScenePosition);
    std::ofstream(folder_ / "a.flt", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  ~SceneLoading() override { std::filesystem::remove_all(folder_); }

  std::unique_ptr<scene::SceneStore> store() const {
    scene::SceneStoreOptions options;
    options.use = scene::SceneUse::scatterers;
    auto ground = std::make_shared<const terrain::AnalyticTerrain>(terrain::flat(0.0));
    return std::move(*scene::SceneStore::open({{.file = (folder_ / "a.flt").string()}},
                                              std::make_unique<terrain::FixedTerrainStore>(std::move(ground)),
                                              options));
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("yars_scene_loader_" + std::to_string(::getpid()));
};

TEST_F(SceneLoading, ASynchronousLoaderReturnsAllScenesAtOnce) {
  SceneLoader loader(store(), true);
  const SceneLoader::LoadedScenes loaded = loader.request({kScenePosition, 20'000.0, 0});
  EXPECT_TRUE(loaded.complete);
  ASSERT_TRUE(loaded.view);
  EXPECT_EQ(loaded.view->scatterers().size(), 1U);
}

TEST_F(SceneLoading, ALoaderWithAThreadReturnsAllScenesLater) {
  SceneLoader loader(store(), false);
  const terrain::TerrainRegion region{kScenePosition, 20'000.0, 0};
  SceneLoader::LoadedScenes loaded = loader.request(region);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!loaded.complete && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::yield();
    loaded = loader.request(region);
  }
  ASSERT_TRUE(loaded.complete);
  EXPECT_EQ(loaded.view->scatterers().size(), 1U);
}

TEST_F(SceneLoading, AStandbyLoadsTheScenesOfTheScanWithoutThoseOfTheMargin) {
  SceneLoader loader(store(), true);
  // The file does not say how far the scene reaches.
  const auto distance = geo::Length::metres(20'000.0 + scene::kUnknownReach_m + 0.5 * kLoadMargin_m);
  const geo::GeoPoint beside = geo::geodesic_direct(kScenePosition, geo::Bearing::degrees(20.0), distance);
  const terrain::TerrainRegion region{beside, 20'000.0, 0};
  const SceneLoader::LoadedScenes ahead = loader.request(region, kStandbyMargin_m);
  EXPECT_TRUE(ahead.complete);
  ASSERT_TRUE(ahead.view);
  EXPECT_TRUE(ahead.view->scatterers().empty());
  const SceneLoader::LoadedScenes with_margin = loader.request(region);
  EXPECT_TRUE(with_margin.complete);
  EXPECT_EQ(with_margin.view->scatterers().size(), 1U);
}

TEST_F(SceneLoading, ASynchronousLoaderReturnsAllScenesAlongAFlight) {
  SceneLoader loader(store(), true);
  for (int minute = 0; minute < 30; ++minute) {
    const geo::GeoPoint position =
        geo::geodesic_direct(kScenePosition, geo::Bearing::degrees(20.0), geo::Length::metres(15'000.0 * minute));
    EXPECT_TRUE(loader.request({position, 40'000.0, 0}).complete) << minute;
  }
}

// What is left out of a scene is said at the start, though no region needs the scene, and once.
TEST_F(SceneLoading, WhatASceneLacksIsKnownBeforeARegionNeedsIt) {
  worldgen::OpenFlightWriter writer(kScenePosition);
  writer.external("gone.flt", {});
  const auto bytes = writer.take();
  std::ofstream(folder_ / "a.flt", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  for (const bool synchronous : {true, false}) {
    SceneLoader loader(store(), synchronous);
    std::vector<std::string> problems = loader.take_problems();
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (problems.empty() && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::yield();
      problems = loader.take_problems();
    }
    EXPECT_THAT(problems, testing::ElementsAre(testing::HasSubstr("gone.flt is not there"))) << synchronous;
    const terrain::TerrainRegion region{kScenePosition, 20'000.0, 0};
    while (!loader.request(region).complete && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    EXPECT_TRUE(loader.take_problems().empty()) << "said once";
  }
}

TEST(SceneLoader, WithoutAStoreIsCompleteAndHasNoView) {
  SceneLoader loader(nullptr, false);
  const SceneLoader::LoadedScenes loaded = loader.request({kScenePosition, 20'000.0, 0});
  EXPECT_TRUE(loaded.complete);
  EXPECT_FALSE(loaded.view);
}

}  // namespace
}  // namespace yars::model
