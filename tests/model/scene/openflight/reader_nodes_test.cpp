// The reader: effect of nodes on their children, levels of detail, degrees of freedom, meshes.
#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "lib/geo/frames.hpp"
#include "model/scene/openflight/model.hpp"
#include "model/scene/openflight/parser.hpp"
#include "model/scene/openflight/records.hpp"
#include "model/terrain/formats/cell_reading.hpp"
#include "tests/model/scene/openflight/every_record.hpp"
#include "tests/model/scene/openflight/read_bytes.hpp"
#include "tests/model/terrain/shared_data.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::model::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Subfaces, LieTwoCentimetresBeforeTheirFace) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  writer.face(square(0, 0, 10), kTestKind);
  writer.begin_subfaces();
  writer.face(square(2, 2, 3), {6, 0, 0});
  writer.end_subfaces();
  const Model model = scene::read(writer);
  ASSERT_EQ(model.vertices.size(), 8U);
  EXPECT_NEAR(position_of(model, 0).z, 0.0, 1e-7);
  EXPECT_NEAR(position_of(model, 4).z, 0.02, 1e-6);
}

TEST(Matrices, ApplyToThePrecedingNode) {
  // Quarter turn about the vertical, then 100 m to the east: (10, 0) becomes (100, 10).
  worldgen::OpenFlightWriter writer(std::nullopt);
  const Transform matrix = translation({100, 0, 0}) * rotation_about_up(M_PI / 2);
  writer.begin_group("turned", &matrix);
  writer.face(square(0, 0, 10), kTestKind);
  writer.end();
  const Model model = scene::read(writer);
  EXPECT_NEAR(position_of(model, 1).x, 100, 1e-4);
  EXPECT_NEAR(position_of(model, 1).y, 10, 1e-4);
}

TEST(Matrices, OfInnerNodesApplyBeforeThoseOfOuterNodes) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  const Transform outer = rotation_about_up(M_PI / 2), inner = translation({100, 0, 0});
  writer.begin_group("outer", &outer);
  writer.begin_group("inner", &inner);
  writer.face(square(0, 0, 10), kTestKind);
  writer.end();
  writer.end();
  const Model model = scene::read(writer);
  EXPECT_NEAR(position_of(model, 0).x, 0, 1e-4);
  EXPECT_NEAR(position_of(model, 0).y, 100, 1e-4);
}

TEST(Matrices, ThatMirrorKeepFacesOutward) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  worldgen::MeshBuilder mesh_builder(writer);
  const Transform mirror = scaling({-1, 2, 1});
  writer.begin_group("mirrored", &mirror);
  mesh_builder.box({5, 5, 0}, 4, 4, 4);
  writer.end();
  const Model model = scene::read(writer);
  const Vector3 middle{-5, 10, 1};
  for (const ModelTriangle& triangle : model.triangles) {
    const Vector3 outwards = position_of(model, triangle.corners[0]) - middle;
    EXPECT_GT(dot(area_of(model, triangle), outwards), 0.0);
    EXPECT_GT(dot(normal_of(model, triangle.corners[0]), outwards), 0.0);
  }
}

TEST(Matrices, OfAFaceMoveOnlyThisFace) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.polygon({0, 1, 2, 3});
  file.face();
  file.matrix(translation({0, 0, 50}));
  file.push();
  file.corners({0, 1, 2, 3});
  file.pop();
  file.polygon({0, 1, 2, 3});
  file.pop();
  const Model model = read(file);
  ASSERT_EQ(model.vertices.size(), 12U);
  int high = 0;
  for (std::uint32_t i = 0; i < 12; ++i) high += position_of(model, i).z > 49 ? 1 : 0;
  EXPECT_EQ(high, 4);
}

TEST(Matrices, WithNaNAreRefused) {
  ByteFile file;
  file.group("a");
  file.matrix(translation({std::nan(""), 0, 0}));
  EXPECT_THAT(refusal(file), HasSubstr("expected a matrix of finite numbers"));
}

TEST(Replication, ShowsTheNodeAndItsCopiesWithRepeatedTransforms) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.group("row");
  file.matrix(translation({20, 0, 0}));
  file.replicate(3);
  file.push();
  file.polygon({0, 1, 2, 3});
  file.pop();
  file.pop();
  const Model model = read(file);
  ASSERT_EQ(model.polygons, 4U);
  for (std::uint32_t copy = 0; copy < 4; ++copy) EXPECT_NEAR(position_of(model, 4 * copy).x, 20.0 * copy, 1e-4);
}

TEST(Instances, ShowTheirDefinitionAtTheirTransforms) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  writer.begin_definition(5);
  writer.begin_object("thing");
  writer.face(square(0, 0, 10), kTestKind);
  writer.end();
  writer.end();
  writer.instance(5, translation({100, 0, 0}));
  writer.instance(5, translation({200, 0, 0}));
  const Model model = scene::read(writer);
  EXPECT_EQ(model.polygons, 2U);
  EXPECT_EQ(model.counts.faces, 1U);
  EXPECT_THAT(model.objects, ElementsAre("", "thing", "thing"));
  EXPECT_NEAR(position_of(model, 4).x, 200, 1e-4);
}

TEST(Instances, ThatContainThemselvesAreRefused) {
  ByteFile file;
  file.push();
  file.instance_definition(1);
  file.push();
  file.instance(1);
  file.pop();
  file.instance(1);
  file.pop();
  EXPECT_THAT(refusal(file), HasSubstr("deep"));
}

TEST(Instances, ThatGiveTooManyTrianglesAreRefused) {
  // Each definition shows the next one ten times: 10^9 squares.
  ByteFile file;
  file.palette(kSquare);
  file.push();
  for (std::uint16_t number = 1; number <= 9; ++number) {
    file.instance_definition(number);
    file.push();
    for (int i = 0; i < 10; ++i) file.instance(static_cast<std::uint16_t>(number + 1));
    file.pop();
  }
  file.instance_definition(10);
  file.push();
  file.polygon({0, 1, 2, 3});
  file.pop();
  file.instance(1);
  file.pop();
  const auto model =
      read_openflight(file.bytes(), "test.flt", {.triangles = 10'000, .vertices = 30'000, .visits = 100'000});
  ASSERT_FALSE(model);
  EXPECT_THAT(model.error().message(), HasSubstr("expected at most"));
}

TEST(Instances, WithoutADefinitionGiveAWarning) {
  ByteFile file;
  file.push();
  file.instance(9);
  file.pop();
  EXPECT_THAT(read(file).left_out, ElementsAre(HasSubstr("definition 9")));
}

// 1000 copies of one object in each of 200 instances: 200,000 objects without a triangle.
TEST(Instances, ThatGiveTooManyObjectsAreRefused) {
  ByteFile file;
  file.push();
  file.instance_definition(1);
  file.push();
  for (int i = 0; i < 1000; ++i) file.node(openflight::kObject, "thing", 28);
  file.pop();
  for (int i = 0; i < 200; ++i) file.instance(1);
  file.pop();
  const auto model = read_openflight(file.bytes(), "test.flt", {.objects = 100'000});
  ASSERT_FALSE(model);
  EXPECT_THAT(model.error().message(), HasSubstr("expected at most 100000 objects"));
}

TEST(Warnings, WithEqualTextAppearOnceAndFurtherWarningsAreCounted) {
  ByteFile file;
  file.push();
  for (std::uint16_t number = 1; number <= 300; ++number)
    for (int i = 0; i < 3; ++i) file.instance(number);
  file.pop();
  const auto warnings = read(file).left_out;
  ASSERT_EQ(warnings.size(), kMaxWarnings + 1);
  EXPECT_THAT(warnings[0], HasSubstr("definition 1,"));
  EXPECT_THAT(warnings[1], HasSubstr("definition 2,"));
  EXPECT_EQ(warnings.back(), "further sentences like these: 600");
}

TEST(LevelsOfDetail, TheFinestIsShown) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  writer.begin_level_of_detail("far", 10'000, 1000, {});
  writer.face(square(0, 0, 10), {1, 0, 0});
  writer.end();
  writer.begin_level_of_detail("near", 1000, 0, {});
  writer.face(square(0, 0, 10), {2, 0, 0});
  writer.end();
  const Model model = scene::read(writer);
  ASSERT_EQ(model.polygons, 1U);
  EXPECT_EQ(model.kinds[model.triangles[0].kind].material, 2);
  EXPECT_EQ(model.counts.faces, 2U);
}

// Ranges of sibling levels and their centres; the numbers of those that are shown.
struct Siblings {
  std::vector<std::array<double, 3>> levels;  // switch-in and switch-out distance, x of the centre
  std::vector<std::size_t> shown;
};

TEST(LevelsOfDetail, OnlyRangesThatExcludeEachOtherAreLevelsOfOneObject) {
  const std::vector<Siblings> cases{
      {{{2000, 0, 0}, {1500, 0, 50}, {8000, 30, 100}, {5000, 20, 150}, {3000, 10, 200}, {9000, 1, 250}},
       {0, 1, 2, 3, 4, 5}},                                                      // six buildings
      {{{500, 0, 0}, {500, 0, 100}, {2000, 500, 0}, {2000, 500, 100}}, {0, 1}},  // two with two levels each
      {{{9000, 3000, 0}, {3000, 800, 0}, {800, 100, 0}}, {2}},                   // none is drawn from 0
      {{{1000, 0, 0}, {3000, 900, 0}}, {0, 1}},                                  // ranges overlap
      {{{25, 0, 0}, {8000, 30, 100}}, {0, 1}},                                   // the farther is seen from the nearer
      {{{800.0000001, 0, 0}, {4000, 800, 0.5}}, {0}},                            // rounding; centres of the geometry
      {{{0, 0, 0}, {1000, 0, 0}, {4000, 1000, 0}}, {0, 1}},                      // the first has no range
      {{{0, 800, 0}, {800, 4000, 0}}, {0}}};                                     // in and out exchanged
  for (const Siblings& siblings : cases) {
    ByteFile file;
    file.palette(kSquare);
    file.push();
    for (std::size_t i = 0; i < siblings.levels.size(); ++i) {
      const auto& [in, out, x] = siblings.levels[i];
      file.level(in, out, {x, 0, 0});
      file.push();
      file.polygon({0, 1, 2, 3}, static_cast<std::int16_t>(i + 1));
      file.pop();
    }
    file.pop();
    const Model model = read(file);
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < model.triangles.size(); i += 2)
      shown.push_back(model.kinds[model.triangles[i].kind].material - std::size_t{1});
    EXPECT_EQ(shown, siblings.shown) << "case " << (&siblings - cases.data());
  }
}

// Small objects and those that are drawn from afar only, all beside each other: 4 * 10^8 pairs.
TEST(LevelsOfDetail, OfTooManySiblingsAreRefused) {
  ByteFile file;
  file.push();
  for (int i = 0; i < 40'000; ++i) file.level(i % 2 == 0 ? 5000 : 20, i % 2 == 0 ? 30 : 0, {1000.0 * i, 0, 0});
  file.pop();
  EXPECT_THAT(refusal(file), HasSubstr("pairs of levels of detail"));
}

TEST(LevelsOfDetail, ThatASwitchHidesReplaceNone) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.node(openflight::kSwitch, "s", 32);
  file.put_u32(20, 1);
  file.put_u32(24, 1);
  file.put_u32(28, 0b10);
  file.push();
  file.level(1000, 0);
  file.square_below();
  file.level(5000, 1000);
  file.square_below();
  file.pop();
  file.pop();
  EXPECT_EQ(read(file).polygons, 1U);
}

TEST(LevelsOfDetail, TakeTheCentreOfTheLevelBeforeIfTheirFlagSaysSo) {
  for (const bool previous : {false, true}) {
    ByteFile file;
    file.palette(kSquare);
    file.push();
    file.level(100, 0, {500, 0, 0});
    file.square_below();
    file.level(5000, 100, {0, 0, 0}, previous ? openflight::level_of_detail::kCentreOfPrevious : 0);
    file.square_below();
    file.pop();
    EXPECT_EQ(read(file).polygons, previous ? 1U : 2U);
  }
}

// Extent of the square from (0, 0) to (10, 10) below a degree of freedom.
Model posed(Vector3 origin, const std::vector<std::pair<std::size_t, double>>& pose, int units = 0) {
  ByteFile file(1600, units);
  file.palette(kSquare);
  file.push();
  file.degree_of_freedom(origin, pose);
  file.square_below();
  file.pop();
  return read(file);
}

TEST(DegreesOfFreedom, HaveTheirCurrentTranslation) {
  const Model model = posed({}, {{168, 50.0}, {136, -3.0}, {104, 2.0}}, 4);
  EXPECT_NEAR(position_of(model, 0).x, 50 * 0.3048, 1e-5);
  EXPECT_NEAR(position_of(model, 0).y, -3 * 0.3048, 1e-5);
  EXPECT_NEAR(position_of(model, 0).z, 2 * 0.3048, 1e-5);
}

TEST(DegreesOfFreedom, TurnAndScaleAboutTheirOrigin) {
  // A quarter turn about the corner (10, 0) with twice the length along x: (0, 0) becomes (10, -20).
  const Model model = posed({10, 0, 0}, {{264, 90.0}, {360, 2.0}});
  EXPECT_NEAR(position_of(model, 1).x, 10, 1e-5);
  EXPECT_NEAR(position_of(model, 1).y, 0, 1e-5);
  EXPECT_NEAR(position_of(model, 0).x, 10, 1e-5);
  EXPECT_NEAR(position_of(model, 0).y, -20, 1e-5);
}

// OpenSceneGraph's order: yaw first, then roll, then pitch. (10, 0, 0) becomes (0, 10, 0) by the yaw, stays there in
// the roll about y, and becomes (0, 0, 10) by the pitch about x.
TEST(DegreesOfFreedom, TurnByYawThenRollThenPitch) {
  const Model model = posed({}, {{264, 90.0}, {232, 90.0}, {200, 90.0}});
  EXPECT_NEAR(position_of(model, 1).x, 0, 1e-5);
  EXPECT_NEAR(position_of(model, 1).y, 0, 1e-5);
  EXPECT_NEAR(position_of(model, 1).z, 10, 1e-5);
}

TEST(DegreesOfFreedom, WithoutAPoseStandAsModelled) {
  const Model model = posed({3, 4, 5}, {});
  EXPECT_EQ(position_of(model, 1).x, 10);
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.node(openflight::kDegreeOfFreedom, "short", 12);
  file.square_below();
  file.pop();
  EXPECT_EQ(position_of(read(file), 1).x, 10);
}

TEST(Switches, ShowTheChildrenInTheirMask) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  writer.begin_switch("s", 0b10);
  for (const std::uint8_t material : {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}}) {
    writer.begin_group("child");
    writer.face(square(0, 0, 10), {material, 0, 0});
    writer.end();
  }
  writer.end();
  const Model model = scene::read(writer);
  ASSERT_EQ(model.polygons, 1U);
  EXPECT_EQ(model.kinds[model.triangles[0].kind].material, 2);
}

TEST(Meshes, StripsFansQuadrilateralsAndPolygonsAreCounterClockwise) {
  const std::vector<std::pair<std::int16_t, std::vector<std::uint16_t>>> primitives{
      {1, {0, 1, 2, 3, 4, 5}}, {2, {0, 1, 3, 2}}, {3, {0, 1, 2, 3, 4, 5}}, {4, {0, 1, 3, 5, 4, 2}}};
  const std::vector<double> areas_m2{2, 1, 2, 2};
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    ByteFile file;
    file.push();
    file.mesh(7);
    file.pool({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}, {1, 2, 0}}, true);
    file.push();
    file.primitive(primitives[i].first, primitives[i].second);
    file.pop();
    file.pop();
    const Model model = read(file);
    EXPECT_NEAR(total_area_m2(model), areas_m2[i], 1e-6) << "primitive " << primitives[i].first;
    EXPECT_EQ(model.counts.corners, primitives[i].second.size());
    for (const ModelTriangle& triangle : model.triangles) EXPECT_GT(area_of(model, triangle).z, 0.0);
    EXPECT_EQ(model.kinds[0].material, 7);
    EXPECT_EQ(model.counts.vertices, 6U);
    EXPECT_EQ(model.counts.faces, 1U);
  }
}

TEST(Meshes, IndicesOutsideThePoolAreRefused) {
  ByteFile file;
  file.push();
  file.mesh(1);
  file.pool({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  file.push();
  file.primitive(4, {0, 1, 3});
  EXPECT_THAT(refusal(file), HasSubstr("expected indices below 3"));
}

TEST(Levels, MorePopsThanPushesAreRefused) {
  ByteFile file;
  file.push();
  file.pop();
  file.pop();
  EXPECT_THAT(refusal(file), HasSubstr("one pop more"));
}

TEST(Levels, TooManyAreRefused) {
  ByteFile file;
  for (std::size_t i = 0; i <= kMaxPushDepth; ++i) file.push();
  EXPECT_THAT(refusal(file), HasSubstr("levels of records"));
}

TEST(Levels, ExtensionsAreSkippedWithTheirContent) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.plain(openflight::kPushExtension);
  file.polygon({0, 1, 2, 3});
  file.plain(openflight::kPopExtension);
  file.pop();
  EXPECT_THAT(read(file).triangles, IsEmpty());
}

}  // namespace
}  // namespace yars::model::scene
