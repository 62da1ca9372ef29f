// The reader, record by record.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "model/scene/generator_yard.hpp"
#include "model/scene/openflight_parser.hpp"
#include "model/scene/record_stream.hpp"
#include "model/scene/triangulation.hpp"
#include "model/terrain/cell_reading.hpp"
#include "tests/scene/every_record.hpp"
#include "tests/terrain/shared_data.hpp"

namespace yars::model::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Model read(ByteFile& file) {
  auto model = read_openflight(file.bytes(), "test.flt");
  EXPECT_TRUE(model) << (model ? "" : model.error().message());
  return model ? std::move(*model) : Model{};
}

std::string refusal(ByteFile& file) {
  const auto model = read_openflight(file.bytes(), "test.flt");
  EXPECT_FALSE(model);
  return model ? "" : model.error().message();
}

// A square of 10 m about which files of bytes are built.
const std::vector<Vector3> kSquare{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};

TEST(Records, FieldsPastTheEndAreAbsent) {
  RecordBuilder builder;
  builder.begin(5, 10);
  builder.put<std::int16_t>(8, -7);
  const auto record = record_at(builder.bytes(), 0);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->number<std::int16_t>(8), -7);
  EXPECT_FALSE(record->number<std::int32_t>(8));
  EXPECT_FALSE(record->number<std::uint8_t>(std::numeric_limits<std::size_t>::max()));
  EXPECT_EQ(record->number_or<double>(4, 2.5), 2.5);
}

TEST(Records, OneThatRunsPastTheFileIsRefused) {
  ByteFile file;
  file.group("a");
  file.bytes().resize(file.bytes().size() - 1);
  EXPECT_THAT(refusal(file), HasSubstr("truncated"));
}

TEST(Records, ALengthBelowFourIsRefused) {
  ByteFile file;
  file.group("a");
  file.bytes()[openflight::header::kBytes + 3] = std::byte{3};
  EXPECT_THAT(refusal(file), HasSubstr("a length of 3"));
}

TEST(Header, HasRevisionUnitAndOrigin) {
  OpenFlightWriter writer(geo::GeoPoint{37.5, -122.3});
  const Model model = scene::read(writer);
  EXPECT_EQ(model.header.revision, 1600);
  EXPECT_EQ(model.header.metres_per_unit, 1.0);
  ASSERT_TRUE(model.header.origin);
  EXPECT_EQ(model.header.origin->latitude_deg, 37.5);
  EXPECT_EQ(model.header.origin->longitude_deg, -122.3);
}

TEST(Header, RevisionsOutsideFourteenToSixteenAndAHalfAreRefused) {
  for (const std::int32_t revision : {1300, 1651, -5, 0}) {
    ByteFile file(revision);
    EXPECT_THAT(refusal(file), HasSubstr("expected OpenFlight revision 1400 to 1650"));
  }
  for (const std::int32_t revision : {1400, 142, 14, 1541, 1650}) {
    ByteFile file(revision);
    EXPECT_TRUE(read_openflight(file.bytes(), "test.flt"));
  }
}

TEST(Header, UnitsBecomeMetres) {
  const std::vector<std::pair<int, double>> units{{0, 1.0}, {1, 1000.0}, {4, 0.3048}, {5, 0.0254}, {8, 1852.0}};
  for (const auto& [code, metres] : units) {
    ByteFile file(1600, code);
    file.palette(kSquare);
    file.push();
    file.group("moved");
    file.matrix(Affine::translation({1, 0, 0}));
    file.push();
    file.polygon({0, 1, 2, 3});
    file.pop();
    file.pop();
    const Model model = read(file);
    ASSERT_EQ(model.vertices.size(), 4U);
    EXPECT_NEAR(place_of(model, 0).x, metres, 1e-3 * metres);
    EXPECT_NEAR(place_of(model, 1).x, 11 * metres, 1e-3 * metres);
  }
  ByteFile furlongs(1600, 7);
  EXPECT_THAT(refusal(furlongs), HasSubstr("expected units"));
}

TEST(Faces, KeepMaterialFeatureAndColor) {
  OpenFlightWriter writer(std::nullopt);
  writer.begin_object("o");
  writer.face(square(0, 0, 10), {9, 1234, 0x804020});
  writer.end();
  const Model model = scene::read(writer);
  ASSERT_EQ(model.kinds.size(), 1U);
  EXPECT_EQ(model.kinds[0].material, 9);
  EXPECT_EQ(model.kinds[0].feature_id, 1234);
  EXPECT_EQ(model.kinds[0].color_rgb, 0x804020U);
  EXPECT_EQ(model.counts.materials, 1U);
  EXPECT_THAT(model.objects, ElementsAre("", "o"));
}

TEST(Faces, OfOldShortRecordsHaveNoMaterial) {
  ByteFile file(1400);
  file.palette(kSquare);
  file.push();
  file.face(32, 0);
  file.push();
  file.corners({0, 1, 2, 3});
  file.pop();
  file.pop();
  const Model model = read(file);
  ASSERT_EQ(model.triangles.size(), 2U);
  EXPECT_EQ(model.kinds[0].material, 0);
}

TEST(Faces, WithACodeBeyondThirtyOneCountAsWithoutOne) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.polygon({0, 1, 2, 3}, 99);
  file.pop();
  const Model model = read(file);
  EXPECT_EQ(model.kinds[0].material, 0);
  EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("code beyond 31: 1")));
}

TEST(Faces, HiddenOnesLinesAndLightsAreLeftOut) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  for (const int draw_type : {2, 3, 8, 9, 10}) {
    file.face(80, static_cast<std::uint8_t>(draw_type));
    file.push();
    file.corners({0, 1, 2, 3});
    file.pop();
  }
  file.face(80, 0, 0, openflight::face::kHidden);
  file.push();
  file.corners({0, 1, 2, 3});
  file.pop();
  file.pop();
  const Model model = read(file);
  EXPECT_EQ(model.triangles.size(), 0U);
  EXPECT_EQ(model.counts.faces, 6U);
  EXPECT_EQ(model.counts.hidden_faces, 1U);
}

TEST(Faces, OfTwoSidesAreThereTwiceWithOppositeNormals) {
  OpenFlightWriter writer(std::nullopt);
  writer.face(square(0, 0, 10), kTestKind, true);
  const Model model = scene::read(writer);
  ASSERT_EQ(model.triangles.size(), 4U);
  EXPECT_EQ(model.polygons, 1U);
  int up = 0;
  for (const ModelTriangle& triangle : model.triangles) {
    const Vector3 area = area_of(model, triangle);
    up += area.z > 0 ? 1 : -1;
    EXPECT_GT(dot(area, normal_of(model, triangle.corners[0])), 0.0);
  }
  EXPECT_EQ(up, 0);
}

TEST(Faces, WithoutNormalsGetTheirFacets) {
  ByteFile file;
  file.palette({{0, 0, 0}, {0, 10, 0}, {0, 10, 10}});
  file.push();
  file.polygon({0, 1, 2});
  file.pop();
  const Model model = read(file);
  EXPECT_NEAR(normal_of(model, 0).x, 1.0, 1e-6);
}

TEST(Faces, WithNormalsOfTheOtherSideGetTheirFacets) {
  OpenFlightWriter writer(std::nullopt);
  auto corners = square(0, 0, 10);
  for (WriterVertex& corner : corners) corner.normal = {0, 0, -1};
  writer.face(corners, kTestKind);
  EXPECT_NEAR(normal_of(scene::read(writer), 0).z, 1.0, 1e-6);
}

TEST(Faces, WithCornersThatAreNoNumbersAreLeftOut) {
  ByteFile file;
  file.palette({{0, 0, 0}, {10, 0, 0}, {std::nan(""), 10, 0}});
  file.push();
  file.polygon({0, 1, 2});
  file.pop();
  const Model model = read(file);
  EXPECT_THAT(model.triangles, IsEmpty());
  EXPECT_THAT(model.warnings, ElementsAre(HasSubstr("no numbers")));
}

TEST(Faces, CornersOutsideThePaletteAreRefused) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.polygon({0, 1, 7});
  EXPECT_THAT(refusal(file), HasSubstr("expected corners that are vertices of the palette"));
}

TEST(Polygons, ConcaveOnesKeepTheirAreaAndSense) {
  // An L of 75 m2, whose fan from the first corner would leave it.
  ByteFile file;
  file.palette({{5, 5, 0}, {5, 10, 0}, {0, 10, 0}, {0, 0, 0}, {10, 0, 0}, {10, 5, 0}});
  file.push();
  file.polygon({0, 1, 2, 3, 4, 5});
  file.pop();
  const Model model = read(file);
  EXPECT_EQ(model.triangles.size(), 4U);
  EXPECT_NEAR(total_area_m2(model), 75, 1e-4);
  for (const ModelTriangle& triangle : model.triangles) EXPECT_GT(area_of(model, triangle).z, 0.0);
}

TEST(Polygons, StarsOfAnySizeAndSlopeKeepTheirArea) {
  Chance chance(7);
  for (int trial = 0; trial < 200; ++trial) {
    const int points = 5 + chance.below(40);
    const Affine tilt{{chance.between(-1, 1), chance.between(-1, 1), chance.between(-1, 1)},
                      {chance.between(-1, 1), chance.between(-1, 1), chance.between(-1, 1)}};
    std::vector<Vector3> star;
    double flat_m2 = 0.0;
    for (int i = 0; i < points; ++i) {
      const double angle = 2 * M_PI * i / points, radius = chance.between(1, 10);
      star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    for (std::size_t i = 0; i < star.size(); ++i) flat_m2 += cross(star[i], star[(i + 1) % star.size()]).z / 2;
    for (Vector3& corner : star) corner = tilt.apply(corner);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangulate(star, triangles);
    double area_m2 = 0.0;
    for (const auto& t : triangles) area_m2 += length(cross(star[t[1]] - star[t[0]], star[t[2]] - star[t[0]])) / 2;
    EXPECT_NEAR(area_m2, flat_m2 * length(cross(tilt.x, tilt.y)), 1e-9 * (1 + area_m2)) << "trial " << trial;
  }
}

TEST(Polygons, WithoutAreaGiveNoTriangle) {
  ByteFile file;
  file.palette({{0, 0, 0}, {5, 0, 0}, {10, 0, 0}});
  file.push();
  file.polygon({0, 1, 2});
  file.pop();
  EXPECT_THAT(read(file).triangles, IsEmpty());
}

TEST(Subfaces, LieJustBeforeTheirFace) {
  OpenFlightWriter writer(std::nullopt);
  writer.face(square(0, 0, 10), kTestKind);
  writer.begin_subfaces();
  writer.face(square(2, 2, 3), {6, 0, 0});
  writer.end_subfaces();
  const Model model = scene::read(writer);
  ASSERT_EQ(model.vertices.size(), 8U);
  EXPECT_NEAR(place_of(model, 0).z, 0.0, 1e-7);
  EXPECT_NEAR(place_of(model, 4).z, 0.02, 1e-6);
}

TEST(Matrices, ApplyToTheNodeBeforeThem) {
  // Quarter turn about up, then 100 east: (10, 0) goes to (100, 10).
  OpenFlightWriter writer(std::nullopt);
  const Affine matrix = Affine::turn_about_up(M_PI / 2) * Affine::translation({100, 0, 0});
  writer.begin_group("turned", &matrix);
  writer.face(square(0, 0, 10), kTestKind);
  writer.end();
  const Model model = scene::read(writer);
  EXPECT_NEAR(place_of(model, 1).x, 100, 1e-4);
  EXPECT_NEAR(place_of(model, 1).y, 10, 1e-4);
}

TEST(Matrices, OfInnerNodesComeBeforeThoseOfOuterOnes) {
  OpenFlightWriter writer(std::nullopt);
  const Affine outer = Affine::turn_about_up(M_PI / 2), inner = Affine::translation({100, 0, 0});
  writer.begin_group("outer", &outer);
  writer.begin_group("inner", &inner);
  writer.face(square(0, 0, 10), kTestKind);
  writer.end();
  writer.end();
  const Model model = scene::read(writer);
  EXPECT_NEAR(place_of(model, 0).x, 0, 1e-4);
  EXPECT_NEAR(place_of(model, 0).y, 100, 1e-4);
}

TEST(Matrices, ThatMirrorKeepOutsideOutside) {
  OpenFlightWriter writer(std::nullopt);
  Sketch sketch(writer);
  const Affine mirror = Affine::scale({-1, 2, 1});
  writer.begin_group("mirrored", &mirror);
  sketch.box({5, 5, 0}, 4, 4, 4);
  writer.end();
  const Model model = scene::read(writer);
  const Vector3 middle{-5, 10, 1};
  for (const ModelTriangle& triangle : model.triangles) {
    const Vector3 outwards = place_of(model, triangle.corners[0]) - middle;
    EXPECT_GT(dot(area_of(model, triangle), outwards), 0.0);
    EXPECT_GT(dot(normal_of(model, triangle.corners[0]), outwards), 0.0);
  }
}

TEST(Matrices, OfAFaceMoveThatFaceAlone) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.polygon({0, 1, 2, 3});
  file.face();
  file.matrix(Affine::translation({0, 0, 50}));
  file.push();
  file.corners({0, 1, 2, 3});
  file.pop();
  file.polygon({0, 1, 2, 3});
  file.pop();
  const Model model = read(file);
  ASSERT_EQ(model.vertices.size(), 12U);
  int high = 0;
  for (std::uint32_t i = 0; i < 12; ++i) high += place_of(model, i).z > 49 ? 1 : 0;
  EXPECT_EQ(high, 4);
}

TEST(Matrices, OfNumbersThatAreNoneAreRefused) {
  ByteFile file;
  file.group("a");
  file.matrix(Affine::translation({std::nan(""), 0, 0}));
  EXPECT_THAT(refusal(file), HasSubstr("expected a matrix of finite numbers"));
}

TEST(Replication, ShowsTheNodeAndSoManyMoreEachFartherOn) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.group("row");
  file.matrix(Affine::translation({20, 0, 0}));
  file.replicate(3);
  file.push();
  file.polygon({0, 1, 2, 3});
  file.pop();
  file.pop();
  const Model model = read(file);
  ASSERT_EQ(model.polygons, 4U);
  for (std::uint32_t copy = 0; copy < 4; ++copy) EXPECT_NEAR(place_of(model, 4 * copy).x, 20.0 * copy, 1e-4);
}

TEST(Instances, ShowTheirDefinitionWhereTheyAre) {
  OpenFlightWriter writer(std::nullopt);
  writer.begin_definition(5);
  writer.begin_object("thing");
  writer.face(square(0, 0, 10), kTestKind);
  writer.end();
  writer.end();
  writer.instance(5, Affine::translation({100, 0, 0}));
  writer.instance(5, Affine::translation({200, 0, 0}));
  const Model model = scene::read(writer);
  EXPECT_EQ(model.polygons, 2U);
  EXPECT_EQ(model.counts.faces, 1U);
  EXPECT_THAT(model.objects, ElementsAre("", "thing", "thing"));
  EXPECT_NEAR(place_of(model, 4).x, 200, 1e-4);
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

TEST(Instances, ThatMultiplyWithoutBoundAreRefused) {
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

TEST(Instances, OfNoDefinitionAreAWarning) {
  ByteFile file;
  file.push();
  file.instance(9);
  file.pop();
  EXPECT_THAT(read(file).warnings, ElementsAre(HasSubstr("definition 9")));
}

TEST(LevelsOfDetail, TheFinestIsShown) {
  OpenFlightWriter writer(std::nullopt);
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

TEST(Switches, ShowWhatTheirMaskHas) {
  OpenFlightWriter writer(std::nullopt);
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

TEST(Meshes, StripsFansQuadrilateralsAndPolygonsTurnTheSameWay) {
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
  for (std::size_t i = 0; i <= kDeepestPush; ++i) file.push();
  EXPECT_THAT(refusal(file), HasSubstr("levels of records"));
}

TEST(Levels, ExtensionsAreSkippedWithAllThatIsInThem) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.plain(openflight::kPushExtension);
  file.polygon({0, 1, 2, 3});
  file.plain(openflight::kPopExtension);
  file.pop();
  EXPECT_THAT(read(file).triangles, IsEmpty());
}

TEST(ExternalFiles, AreReadBesideTheirFileInItsUnitsAndMoved) {
  const Folder folder;
  ByteFile child(1600, 4);  // feet
  child.palette(kSquare);
  child.push();
  child.polygon({0, 1, 2, 3}, 9);
  child.pop();
  folder.write("parts/child.flt", child.bytes());
  OpenFlightWriter parent(std::nullopt);
  parent.external("parts\\child.flt", Affine::translation({100, 0, 0}));
  parent.external("parts/child.flt<all>", Affine::translation({200, 0, 0}));
  const auto model = read_openflight(folder.write("parent.flt", parent.take()));
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_EQ(model->polygons, 2U);
  EXPECT_EQ(model->files.size(), 1U);
  EXPECT_EQ(model->counts.external_references, 2U);
  EXPECT_NEAR(place_of(*model, 1).x, 103.048, 1e-4);
  EXPECT_NEAR(place_of(*model, 4).x, 200, 1e-4);
}

TEST(ExternalFiles, ThatLeadBackAreLeftOut) {
  const Folder folder;
  OpenFlightWriter a(std::nullopt), b(std::nullopt);
  a.face(square(0, 0, 1), kTestKind);
  a.external("b.flt", {});
  b.face(square(0, 0, 1), kTestKind);
  b.external("a.flt", {});
  const auto first = folder.write("a.flt", a.take());
  folder.write("b.flt", b.take());
  const auto model = read_openflight(first);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->polygons, 2U);
  EXPECT_THAT(model->warnings, ElementsAre(HasSubstr("leads back to itself")));
}

TEST(ExternalFiles, OutsideTheFolderAndMissingOnesAreLeftOut) {
  const Folder folder;
  OpenFlightWriter inner(std::nullopt), outer(std::nullopt);
  outer.face(square(0, 0, 1), kTestKind);
  folder.write("outer.flt", outer.take());
  inner.external("../outer.flt", {});
  inner.external("nowhere.flt", {});
  const auto model = read_openflight(folder.write("sub/inner.flt", inner.take()));
  ASSERT_TRUE(model);
  EXPECT_THAT(model->triangles, IsEmpty());
  EXPECT_THAT(model->warnings, ElementsAre(HasSubstr("outside the folder"), HasSubstr("is not there")));
}

TEST(EveryRecord, IsReadTogether) {
  const auto model = read_openflight(every_record(), "every.flt");
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_GT(model->triangles.size(), 30U);
}

TEST(Tank, HasItsPolygonsAndVertices) {
  YARS_NEEDS_SHARED_DATA();
  const auto model = read_openflight(test::shared_data() / "flt/tank.FLT");
  ASSERT_TRUE(model) << model.error().message();
  EXPECT_EQ(model->counts.faces, 957U);
  EXPECT_EQ(model->counts.vertices, 3101U);
  EXPECT_EQ(model->counts.materials, 1U);
  EXPECT_EQ(model->counts.objects, 1U);
}

}  // namespace
}  // namespace yars::model::scene
