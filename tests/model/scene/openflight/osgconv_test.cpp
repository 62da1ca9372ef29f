// The reader's counts against those of OpenSceneGraph (Debian's osgconv), on all available files. OpenSceneGraph gives
// each face its own vertices, so its vertices are the reader's corners. It makes a material for each pair of material
// and colour. It drops definitions that are not shown.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <utility>

#include "model/scene/openflight/parser.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "tests/model/scene/openflight/every_record.hpp"
#include "tests/model/terrain/shared_data.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::model::scene {
namespace {

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

// Counts of a scene that osgconv wrote as text. Each face has one osg::DrawArrays with its number of corners.
Counts counts_of_osgt(const std::filesystem::path& file) {
  Counts counts;
  std::set<std::string> materials;
  std::ifstream in(file);
  std::string word, number;
  for (bool in_primitive = false; in >> word;) {
    if (word == "osg::DrawArrays") in_primitive = true;
    if (word == "Count" && in_primitive) {
      in >> number;
      counts.corners += std::stoul(number);
      ++counts.faces;
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

void expect_equal_counts(const std::vector<std::byte>& bytes, const std::string& name) {
  SCOPED_TRACE(name);
  const Folder folder;
  const auto file = folder.write(name + ".flt", bytes);
  const auto tree = parse_openflight(bytes, name);
  ASSERT_TRUE(tree) << tree.error().message();
  const auto text = folder.path() / (name + ".osgt");
  const std::string command = "OSG_OPTIMIZER=OFF timeout 100 osgconv -O 'preserveFace preserveObject' '" +
                              file.string() + "' '" + text.string() + "' > /dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(counts_of_tree(*tree), counts_of_osgt(text));
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

}  // namespace
}  // namespace yars::model::scene
