// The reader against OpenSceneGraph (Debian's osgconv): counts of all available files, poses, and files that osgconv
// wrote (tests/model/scene/openflight/osgconv, from files made for this project). OpenSceneGraph gives each face its
// own vertices, so its vertices are the reader's corners. It makes a material for each pair of material and colour. It
// drops definitions that are not shown.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "lib/memory/byte_order.hpp"
#include "lib/radar/world.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/scene/openflight/parser.hpp"
#include "model/scene/openflight/reader.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "tests/model/scene/openflight/every_record.hpp"
#include "tests/model/terrain/shapes.hpp"
#include "tests/model/terrain/shared_data.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::model::scene {
namespace {

namespace fs = std::filesystem;

const fs::path kWrittenByOsgconv = fs::path(YARS_SOURCE_DIR) / "tests/model/scene/openflight/osgconv";

struct Counts {
  std::size_t faces = 0, corners = 0, materials = 0;
  bool operator==(const Counts&) const = default;
  friend std::ostream& operator<<(std::ostream& out, const Counts& c) {
    return out << c.faces << " faces, " << c.corners << " corners, " << c.materials << " materials";
  }
};

bool has_osgconv() {
  return std::system("command -v osgconv > /dev/null 2>&1") == 0;
}

// Polygons and their corners in one osg::DrawArrays. Each face has one, and each primitive of a mesh.
Counts counts_of(const std::string& mode, std::size_t vertices) {
  if (mode == "TRIANGLE_STRIP" || mode == "TRIANGLE_FAN") return {vertices - 2, 3 * (vertices - 2), 0};
  if (mode == "QUAD_STRIP") return {vertices / 2 - 1, 4 * (vertices / 2 - 1), 0};
  return {1, vertices, 0};
}

// Counts of a scene that osgconv wrote as text.
Counts counts_of_osgt(const fs::path& file) {
  Counts counts;
  std::set<std::string> materials;
  std::ifstream in(file);
  std::string word, mode, number;
  for (bool in_primitive = false; in >> word;) {
    if (word == "osg::DrawArrays") in_primitive = true;
    if (word == "Mode" && in_primitive) in >> mode;
    if (word == "Count" && in_primitive) {
      in >> number;
      const Counts found = counts_of(mode, std::stoul(number));
      counts.corners += found.corners;
      counts.faces += found.faces;
      in_primitive = false;
    }
    if (word == "osg::Material") {
      in >> word >> word >> number;  // { UniqueID n
      materials.insert(number);
    }
  }
  counts.materials = materials.size();
  return counts;
}

// Collects the nodes that are reachable from node `number`.
void visit(const NodeTree& tree, std::uint32_t number, std::set<std::uint32_t>& seen) {
  if (!seen.insert(number).second) return;
  const Node& node = tree.nodes[number];
  if (node.kind == NodeKind::instance) {
    const auto definition = tree.definitions.find(node.instance);
    if (definition != tree.definitions.end()) visit(tree, definition->second, seen);
  }
  for (std::uint32_t child = node.first_child; child != kNone; child = tree.nodes[child].next_sibling)
    visit(tree, child, seen);
}

// Counts of the nodes that are reachable from the root. Each definition counts once.
Counts counts_of_tree(const NodeTree& tree) {
  Counts counts;
  std::set<std::uint32_t> seen;
  visit(tree, 0, seen);
  std::set<std::pair<int, std::uint32_t>> materials;
  for (const std::uint32_t number : seen)
    for (std::uint32_t face = tree.nodes[number].first_face; face != kNone; face = tree.faces[face].next) {
      const TreeFace& found = tree.faces[face];
      ++counts.faces;
      counts.corners += found.count;
      materials.insert({tree.kinds[found.kind].material, tree.kinds[found.kind].color_rgb});
    }
  counts.materials = materials.size();
  return counts;
}

// Converts an OpenFlight file by osgconv.
void convert(const fs::path& file, const fs::path& to) {
  const std::string command = "OSG_OPTIMIZER=OFF timeout 100 osgconv -O 'preserveFace preserveObject' '" +
                              file.string() + "' '" + to.string() + "' > /dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
}

void expect_equal_counts(const std::vector<std::byte>& bytes, const std::string& name) {
  SCOPED_TRACE(name);
  const Folder folder;
  const auto file = folder.write(name + ".flt", bytes);
  const auto tree = parse_openflight(bytes, name);
  ASSERT_TRUE(tree) << tree.error().message();
  const auto text = folder.path() / (name + ".osgt");
  convert(file, text);
  Counts ours = counts_of_tree(*tree);
  const Counts theirs = counts_of_osgt(text);
  if (theirs.materials == 0) ours.materials = 0;  // OpenSceneGraph gives unlit faces no material
  EXPECT_EQ(ours, theirs);
}

// Corners of all triangles, or `v` lines of an .obj file, in millimetres.
using Positions = std::set<std::array<long, 3>>;
Positions positions_of(const Model& model) {
  Positions found;
  for (const ModelVertex& vertex : model.vertices) {
    const Vector3 at = vector_of(vertex.position_m) + model.base;
    found.insert({std::lround(1000 * at.x), std::lround(1000 * at.y), std::lround(1000 * at.z)});
  }
  return found;
}
Positions positions_of_obj(const fs::path& file) {
  Positions found;
  std::ifstream in(file);
  for (std::string word; in >> word; std::getline(in, word)) {
    double x = 0, y = 0, z = 0;
    if (word == "v" && in >> x >> y >> z)
      found.insert({std::lround(1000 * x), std::lround(1000 * y), std::lround(1000 * z)});
  }
  return found;
}

TEST(OpenSceneGraph, HasEqualCountsForTheTank) {
  YARS_NEEDS_SHARED_DATA();
  if (!has_osgconv()) GTEST_SKIP() << "needs osgconv (Debian: openscenegraph), which is absent here";
  const auto bytes = terrain::read_file(test::shared_data() / "flt/tank.FLT", 1 << 20);
  ASSERT_TRUE(bytes);
  expect_equal_counts(*bytes, "tank");
}

TEST(OpenSceneGraph, HasEqualCountsForGeneratedScenes) {
  if (!has_osgconv()) GTEST_SKIP() << "needs osgconv (Debian: openscenegraph), which is absent here";
  int number = 0;
  for (const worldgen::GeneratedKind kind : {worldgen::GeneratedKind::airfield, worldgen::GeneratedKind::harbour,
                                             worldgen::GeneratedKind::bridge, worldgen::GeneratedKind::town})
    expect_equal_counts(
        worldgen::generate_scene({.kind = kind, .triangles = 25'000, .seed = 5, .origin = {36, -115}}).file,
        "made" + std::to_string(number++));
}

TEST(OpenSceneGraph, HasEqualCountsForModelsOfOthers) {
  YARS_NEEDS_SHARED_DATA();
  if (!has_osgconv()) GTEST_SKIP() << "needs osgconv (Debian: openscenegraph), which is absent here";
  std::size_t models = 0;
  for (const char* folder : {"cdb/sandiego/GTModel", "acceptance"})
    for (const auto& entry : fs::recursive_directory_iterator(test::shared_data() / folder)) {
      // OpenSceneGraph knows no nodes of external files, and reads nothing of the nested master.
      if (entry.path().extension() != ".flt" || entry.path().filename() == "node.flt" ||
          entry.path().string().find("/nested/") != std::string::npos)
        continue;
      const auto bytes = terrain::read_file(entry.path(), 1 << 24);
      ASSERT_TRUE(bytes);
      expect_equal_counts(*bytes, entry.path().stem().string());
      ++models;
    }
  EXPECT_GT(models, 10U);
}

TEST(OpenSceneGraph, HasEqualPosesOfDegreesOfFreedom) {
  if (!has_osgconv()) GTEST_SKIP() << "needs osgconv (Debian: openscenegraph), which is absent here";
  auto bytes = terrain::read_file(kWrittenByOsgconv / "dof.flt", 1 << 20);
  ASSERT_TRUE(bytes);
  std::size_t at = 0;
  while (record_at(*bytes, at)->opcode() != openflight::kDegreeOfFreedom) at += record_at(*bytes, at)->size();
  // Local axes that are turned, then translation, pitch, roll, yaw and scale along them.
  const std::vector<std::pair<std::size_t, double>> pose{
      {16, 3.0},  {24, -2.0},  {32, 1.0},  {40, 4.0},   {48, 1.0},   {56, 2.0},   {64, 1.0},  {72, 5.0},  {80, 2.5},
      {168, 7.0}, {136, -3.0}, {104, 4.0}, {200, 20.0}, {232, 35.0}, {264, 50.0}, {360, 1.2}, {328, 0.7}, {296, 1.5}};
  for (const auto& [offset, value] : pose)
    std::ranges::copy(memory::bytes_of(value, std::endian::big),
                      bytes->begin() + static_cast<std::ptrdiff_t>(at + offset));
  const Folder folder;
  const auto flt = folder.write("pose.flt", *bytes);
  convert(flt, folder.path() / "pose.obj");
  const auto model = read_openflight(flt);
  ASSERT_TRUE(model) << model.error().message();
  const Positions expected = positions_of_obj(folder.path() / "pose.obj");
  EXPECT_EQ(expected.size(), 8U);
  EXPECT_EQ(positions_of(*model), expected);
}

// Files that osgconv wrote, in revisions 15.8 and 16.1, with external references.
Model written_by_osgconv(const std::string& name) {
  const fs::path file = kWrittenByOsgconv / name;
  EXPECT_TRUE(read_openflight_header(file));
  const auto model = read_openflight(file);
  EXPECT_TRUE(model) << model.error().message();
  if (!model) return {};
  EXPECT_TRUE(model->left_out.empty()) << model->left_out.front();
  return *model;
}

TEST(FilesOfOsgconv, AreRead) {
  EXPECT_EQ(written_by_osgconv("levels.flt").polygons, 30U) << "six buildings of five walls";
  const Positions moved = positions_of(written_by_osgconv("dof.flt"));
  ASSERT_EQ(moved.size(), 8U);
  EXPECT_EQ((*moved.begin())[0], 45'000);
  EXPECT_EQ((*moved.rbegin())[0], 55'000);
  const Model nested = written_by_osgconv("master/master.flt");
  EXPECT_EQ(nested.polygons, 3U);
  EXPECT_EQ(nested.files.size(), 2U);
}

// Files on which earlier readers failed, by the store that radar-model, scan and patch use. Triangles; 0: compared with
// OpenSceneGraph above.
TEST(FilesOfOthers, AreReadByTheStoreAsByTheReader) {
  YARS_NEEDS_SHARED_DATA();
  const fs::path folder = test::shared_data() / "acceptance";
  const std::vector<std::pair<std::string, std::size_t>> files{{"header328.flt", 10},
                                                               {"r1660.flt", 10},
                                                               {"dof.flt", 10},
                                                               {"zeros_to_2048.flt", 10},
                                                               {"lodtown.flt", 60},
                                                               {"lib.flt", 20},
                                                               {"node.flt", 10},
                                                               {"nested/master/master.flt", 6},
                                                               {"cdb_harbor_club_header328.flt", 0},
                                                               {"cdb_trailing_byte.flt", 0}};
  constexpr geo::GeoPoint kPlace{37.5, -122.3};
  for (const auto& [name, triangles] : files) {
    SCOPED_TRACE(name);
    const auto model = read_openflight(folder / name);
    ASSERT_TRUE(model) << model.error().message();
    EXPECT_TRUE(triangles == 0 || model->triangles.size() == triangles) << model->triangles.size();
    EXPECT_TRUE(model->left_out.empty());
    radar::Scene scene;
    scene.file = (folder / name).string();
    scene.position = kPlace;
    auto store = SceneStore::open({scene}, std::make_unique<terrain::FixedTerrainStore>(
                                               std::make_shared<terrain::AnalyticTerrain>(terrain::flat(0))));
    ASSERT_TRUE(store) << store.error().message();
    const auto view = (*store)->prepare({kPlace, 1000, 0});
    EXPECT_EQ((*store)->wanted().unreadable, 0U);
    EXPECT_TRUE((*store)->left_out().empty());
    std::vector<const Tile*> tiles;
    view->tiles_near(kPlace, 10'000, tiles);
    std::size_t shown = 0;
    for (const Tile* tile : tiles) shown += tile->triangles();
    EXPECT_GE(shown, model->triangles.size()) << "those on the ground may be cut";
  }
}

}  // namespace
}  // namespace yars::model::scene
