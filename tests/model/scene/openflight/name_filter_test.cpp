// NameFilter: omission of objects of a scene by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <vector>

#include "lib/radar/world.hpp"
#include "model/scene/index/scene_index.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/scene/openflight/node_tree.hpp"
#include "model/scene/openflight/reader.hpp"
#include "model/terrain/sampling/analytic_terrain.hpp"
#include "tests/model/terrain/formats/dted_builder.hpp"
#include "worldgen/scene/openflight_writer.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::model::scene {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(NameFilter, StarsAndQuestionMarksAreWildcardsAndCaseIsIgnored) {
  struct Row {
    const char *names, *name;
    bool out;
  };
  const Row rows[] = {{"env_box", "env_box", true},
                      {"ENV_box", "env_BOX", true},
                      {"env*", "env_box", true},
                      {"*box", "env_box", true},
                      {"e?v*x", "env_box", true},
                      {"env", "env_box", false},
                      {"a, env_box ,b", "env_box", true},
                      {"*", "anything", true},
                      {"**a*a*b", "aaaaaaaaac", false},
                      {"", "env_box", false},
                      {"?", "", false},
                      {"env_boxx", "env_box", false}};
  for (const Row& row : rows) EXPECT_EQ(NameFilter(row.names).leaves_out(row.name), row.out) << row.names;
}

TEST(NameFilter, AnUnmatchedNameIsAnErrorThatListsSimilarNames) {
  NameFilter filter("hull,enviroment");
  for (const char* name : {"hull", "mast", "environment", "funnel", "deck", "bridge", "environment_box", "boat"})
    filter.leaves_out(name);
  EXPECT_THAT(filter.unmatched_names(), ElementsAre("enviroment"));
  const std::string message = filter.unmatched_error("ship.flt")->message();
  EXPECT_THAT(message, HasSubstr("ship.flt: expected a part to leave out with the name 'enviroment', found none"));
  EXPECT_THAT(message, HasSubstr("8 names exist; the most similar are 'environment', 'environment_box'"));
  EXPECT_FALSE(NameFilter("").unmatched_error("ship.flt"));
}

constexpr geo::GeoPoint kFilteredOrigin{37.5, -122.5};

void write_bytes(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// Ship with a hull 20 m high inside an environment box of 2 km, as in some ship models.
std::filesystem::path boxed_ship(const std::filesystem::path& folder) {
  worldgen::OpenFlightWriter writer(kFilteredOrigin);
  worldgen::MeshBuilder mesh_builder(writer);
  writer.begin_object("hull");
  mesh_builder.box({0, 0, 0}, 20, 100, 20);
  writer.end();
  writer.begin_object("environment");
  mesh_builder.box({0, 0, 0}, 2000, 2000, 500);
  writer.end();
  const std::filesystem::path file = folder / "ship.flt";
  write_bytes(file, writer.take());
  return file;
}

TEST(NameFilter, AnOmittedObjectIsMissingWithItsChildren) {
  const test::TemporaryFolder folder;
  const auto file = boxed_ship(folder.path());
  const auto complete = read_openflight(file);
  ASSERT_TRUE(complete);
  EXPECT_THAT(complete->objects, ElementsAre("", "hull", "environment"));
  NameFilter filter("env*");
  const auto filtered = read_openflight(file, &filter);
  ASSERT_TRUE(filtered);
  EXPECT_THAT(filtered->objects, ElementsAre("", "hull"));
  EXPECT_EQ(2 * filtered->triangles.size(), complete->triangles.size());
  EXPECT_FALSE(filter.unmatched_error("ship.flt"));
}

TEST(NameFilter, AStoreOmitsTheNamesOfItsSceneAndRefusesAnUnmatchedName) {
  const test::TemporaryFolder folder;
  radar::Scene scene;
  scene.file = boxed_ship(folder.path());
  const auto open = [&scene] {
    return SceneStore::open({scene},
                            std::make_unique<terrain::FixedTerrainStore>(
                                std::make_shared<terrain::AnalyticTerrain>([](geo::GeoPoint) { return 10.0; })));
  };
  const auto triangles = [&](SceneStore& store) {
    const auto view = store.prepare({kFilteredOrigin, 3000.0, 0});
    std::vector<const Tile*> tiles;
    view->tiles_near(kFilteredOrigin, 3000.0, tiles);
    std::size_t sum = 0;
    for (const Tile* tile : tiles) sum += tile->triangles();
    return sum;
  };
  auto complete = open();
  ASSERT_TRUE(complete);
  scene.without = "environment";
  auto filtered = open();
  ASSERT_TRUE(filtered);
  EXPECT_GT(triangles(**complete), triangles(**filtered));
  EXPECT_GT(triangles(**filtered), 0U);
  scene.without = "environmint";
  const auto refused = open();
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("'environment'"));
}

TEST(NameFilter, EachOfSeveralScenesOmitsTheNamesThatItHas) {
  const test::TemporaryFolder folder;
  const std::string ship = boxed_ship(folder.path());
  std::filesystem::create_directory(folder.path() / "other");
  const std::string other = folder.path() / "other" / "pier.flt";
  worldgen::OpenFlightWriter writer(kFilteredOrigin);
  worldgen::MeshBuilder mesh_builder(writer);
  writer.begin_object("pier");
  mesh_builder.box({0, 0, 0}, 10, 50, 2);
  writer.end();
  write_bytes(other, writer.take());
  std::vector<radar::Scene> scenes;
  ASSERT_TRUE(add_scenes(scenes, {ship, other}, {"environment", "p*"}));
  EXPECT_EQ(scenes[0].without, "environment");
  EXPECT_EQ(scenes[1].without, "p*");
  const auto refused = add_scenes(scenes, {}, {"tower"});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("3 names exist"));
  EXPECT_FALSE(add_scenes(scenes, {}, {" , "})) << "no name";
  std::vector<radar::Scene> none;
  EXPECT_FALSE(add_scenes(none, {}, {""})) << "no scene";
}

}  // namespace
}  // namespace yars::model::scene
