// The reader: records, header, faces, polygons.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

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

TEST(Records, FieldsBeyondTheEndOfARecordAreAbsent) {
  worldgen::RecordBuilder builder;
  builder.begin(5, 10);
  builder.put<std::int16_t>(8, -7);
  const auto record = record_at(builder.bytes(), 0);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->number<std::int16_t>(8), -7);
  EXPECT_FALSE(record->number<std::int32_t>(8));
  EXPECT_FALSE(record->number<std::uint8_t>(std::numeric_limits<std::size_t>::max()));
  EXPECT_EQ(record->number_or<double>(4, 2.5), 2.5);
}

TEST(Records, ARecordBeyondTheEndOfTheFileIsRefused) {
  ByteFile file;
  file.group("a");
  file.bytes().resize(file.bytes().size() - 1);
  EXPECT_THAT(refusal(file), HasSubstr("truncated"));
}

TEST(Records, ALengthBelowFourIsRefused) {
  ByteFile file;
  file.group("a");
  file.bytes()[openflight::header::kBytes + 3] = std::byte{3};
  EXPECT_THAT(refusal(file), HasSubstr("one with a stated length of 3 bytes"));
}

// The bytes after the level below the header, if they are no record.
std::vector<std::byte> followed_by(std::size_t count, std::byte value) {
  ByteFile file;
  file.palette(kSquare);
  file.square_below();
  file.bytes().insert(file.bytes().end(), count, value);
  return file.bytes();
}

TEST(Records, BytesAfterTheLastRecordAreAWarning) {
  for (const std::size_t count : {1, 3, 4, 7, 2048})
    for (const std::byte value : {std::byte{0}, std::byte{0xA5}, std::byte{0xFF}}) {
      const auto model = read_openflight(followed_by(count, value), "test.flt");
      ASSERT_TRUE(model) << model.error().message();
      EXPECT_EQ(model->polygons, 1U);
      EXPECT_THAT(model->warnings, ElementsAre(HasSubstr("after the last record")));
      EXPECT_THAT(model->warnings[0], HasSubstr("last record: " + std::to_string(count)));
      EXPECT_THAT(model->left_out, IsEmpty());
    }
}

TEST(Records, AFileCutAnywhereBeforeItsLastRecordIsRefusedOrSaysWhatIsMissing) {
  const std::vector<std::byte> whole = followed_by(0, {});
  for (std::size_t bytes = 1; bytes < whole.size(); ++bytes) {
    const auto model = read_openflight(std::span(whole).first(bytes), "test.flt");
    const bool has_nodes = bytes > openflight::header::kBytes + 8 + 4 * 40;
    EXPECT_FALSE(model && has_nodes && model->left_out.empty()) << bytes;
  }
}

// A file whose nodes lie beside its header, with no level around them.
TEST(Records, PaddingAfterNodesBesideTheHeaderIsAWarningAndAPieceOfARecordIsRefused) {
  const auto file = [] {
    ByteFile made;
    made.palette(kSquare);
    made.group("a");
    made.square_below();
    return made;
  };
  ByteFile padded = file();
  padded.bytes().resize(padded.bytes().size() + 500);
  EXPECT_THAT(read(padded).warnings, ElementsAre(HasSubstr("bytes after the last record: 500")));
  ByteFile cut = file();
  cut.group("b");
  cut.bytes().resize(cut.bytes().size() - 1);
  EXPECT_THAT(refusal(cut), HasSubstr("truncated"));
}

TEST(Header, HasRevisionUnitAndOrigin) {
  worldgen::OpenFlightWriter writer(geo::GeoPoint{37.5, -122.3});
  const Model model = scene::read(writer);
  EXPECT_EQ(model.header.revision, 1600);
  EXPECT_EQ(model.header.metres_per_unit, 1.0);
  ASSERT_TRUE(model.header.origin);
  EXPECT_EQ(model.header.origin->latitude_deg, 37.5);
  EXPECT_EQ(model.header.origin->longitude_deg, -122.3);
}

TEST(Header, RevisionsOutside1400To1670AreRefused) {
  for (const std::int32_t revision : {1300, 1671, -5, 0}) {
    ByteFile file(revision);
    EXPECT_THAT(refusal(file), HasSubstr("expected OpenFlight revision 1400 to 1670"));
  }
  for (const std::int32_t revision : {1400, 142, 14, 1541, 1650, 1660, 1670}) {
    ByteFile file(revision);
    EXPECT_TRUE(read_openflight(file.bytes(), "test.flt"));
  }
}

// Revisions and programs write headers of other lengths; a CDB asks for 328 bytes.
TEST(Header, OfAnyLengthIsReadAloneAsWithTheWholeFile) {
  const Folder folder;
  for (const std::size_t bytes : {240, 304, 308, 324, 328, 400, 65'532}) {
    ByteFile file(1600, 4, bytes);
    file.palette(kSquare);
    file.square_below();
    const auto path = folder.write(std::to_string(bytes) + ".flt", file.bytes());
    const auto header = read_openflight_header(path);
    const auto model = read_openflight(path);
    ASSERT_TRUE(header) << header.error().message();
    ASSERT_TRUE(model) << model.error().message();
    EXPECT_EQ(header->metres_per_unit, 0.3048);
    EXPECT_EQ(model->polygons, 1U);
  }
}

TEST(Header, UnitsBecomeMetres) {
  const std::vector<std::pair<int, double>> units{{0, 1.0}, {1, 1000.0}, {4, 0.3048}, {5, 0.0254}, {8, 1852.0}};
  for (const auto& [code, metres] : units) {
    ByteFile file(1600, code);
    file.palette(kSquare);
    file.push();
    file.group("moved");
    file.matrix(translation({1, 0, 0}));
    file.push();
    file.polygon({0, 1, 2, 3});
    file.pop();
    file.pop();
    const Model model = read(file);
    ASSERT_EQ(model.vertices.size(), 4U);
    EXPECT_NEAR(position_of(model, 0).x, metres, 1e-3 * metres);
    EXPECT_NEAR(position_of(model, 1).x, 11 * metres, 1e-3 * metres);
  }
  ByteFile undefined_unit(1600, 7);
  EXPECT_THAT(refusal(undefined_unit), HasSubstr("expected units"));
}

TEST(Faces, KeepMaterialFeatureAndColor) {
  worldgen::OpenFlightWriter writer(std::nullopt);
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

TEST(Faces, OfShortRecordsInOldRevisionsHaveNoMaterial) {
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

TEST(Faces, WithAMaterialCodeAbove31HaveNoMaterial) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.polygon({0, 1, 2, 3}, 99);
  file.pop();
  const Model model = read(file);
  EXPECT_EQ(model.kinds[0].material, 0);
  EXPECT_THAT(model.left_out, ElementsAre(HasSubstr("code beyond 31: 1")));
}

TEST(Faces, ThatAreHiddenOrLinesOrLightsAreLeftOut) {
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

TEST(Faces, WithTwoSidesAppearTwiceWithOppositeNormals) {
  worldgen::OpenFlightWriter writer(std::nullopt);
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

TEST(Faces, WithoutNormalsGetTheNormalsOfTheirFacets) {
  ByteFile file;
  file.palette({{0, 0, 0}, {0, 10, 0}, {0, 10, 10}});
  file.push();
  file.polygon({0, 1, 2});
  file.pop();
  const Model model = read(file);
  EXPECT_NEAR(normal_of(model, 0).x, 1.0, 1e-6);
}

TEST(Faces, WithNormalsOfTheOtherSideGetTheNormalsOfTheirFacets) {
  worldgen::OpenFlightWriter writer(std::nullopt);
  auto corners = square(0, 0, 10);
  for (worldgen::WriterVertex& corner : corners) corner.normal = {0, 0, -1};
  writer.face(corners, kTestKind);
  EXPECT_NEAR(normal_of(scene::read(writer), 0).z, 1.0, 1e-6);
}

TEST(Faces, WithNaNInTheirCornersAreLeftOut) {
  ByteFile file;
  file.palette({{0, 0, 0}, {10, 0, 0}, {std::nan(""), 10, 0}});
  file.push();
  file.polygon({0, 1, 2});
  file.pop();
  const Model model = read(file);
  EXPECT_THAT(model.triangles, IsEmpty());
  EXPECT_THAT(model.left_out, ElementsAre(HasSubstr("not numbers")));
}

TEST(Faces, CornersOutsideThePaletteAreRefused) {
  ByteFile file;
  file.palette(kSquare);
  file.push();
  file.polygon({0, 1, 7});
  EXPECT_THAT(refusal(file), HasSubstr("expected corners that are vertices of the palette"));
}

TEST(Polygons, ThatAreConcaveKeepTheirAreaAndOrientation) {
  // An L of 75 m2 with a reflex corner at (5, 5).
  ByteFile file;
  file.palette({{5, 10, 0}, {0, 10, 0}, {0, 0, 0}, {10, 0, 0}, {10, 5, 0}, {5, 5, 0}});
  file.push();
  file.polygon({0, 1, 2, 3, 4, 5});
  file.pop();
  const Model model = read(file);
  EXPECT_EQ(model.triangles.size(), 4U);
  EXPECT_NEAR(total_area_m2(model), 75, 1e-4);
  for (const ModelTriangle& triangle : model.triangles) EXPECT_GT(area_of(model, triangle).z, 0.0);
}

TEST(Polygons, ThatAreStarsKeepTheirAreaAtAnySlope) {
  random::CounterRng rng(7);
  for (int trial = 0; trial < 200; ++trial) {
    const int points = 5 + rng.below(40);
    const auto axis = [&] { return glm::dvec4(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1), 0); };
    const glm::dvec4 east = axis(), north = axis();
    const Transform tilt(east, north, glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, 0, 1));
    std::vector<Vector3> star;
    double flat_m2 = 0.0;
    for (int i = 0; i < points; ++i) {
      const double angle = 2 * M_PI * i / points, radius = rng.uniform(1, 10);
      star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    for (std::size_t i = 0; i < star.size(); ++i) flat_m2 += cross(star[i], star[(i + 1) % star.size()]).z / 2;
    for (Vector3& corner : star) corner = transformed_point(tilt, corner);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangulate(star, triangles);
    double area_m2 = 0.0;
    for (const auto& t : triangles) area_m2 += length(cross(star[t[1]] - star[t[0]], star[t[2]] - star[t[0]])) / 2;
    EXPECT_NEAR(area_m2, flat_m2 * glm::length(glm::cross(Vector3(tilt[0]), Vector3(tilt[1]))), 1e-9 * (1 + area_m2))
        << "trial " << trial;
  }
}

// All corners of a pentagram turn in one direction, by 720 degrees in total.
TEST(Polygons, ThatCrossThemselvesGiveTrianglesOfOneOrientation) {
  for (const bool clockwise : {false, true}) {
    std::vector<Vector3> pentagram;
    for (int i = 0; i < 5; ++i) {
      const double angle = (clockwise ? -1 : 1) * 4 * M_PI * i / 5;
      pentagram.push_back({std::cos(angle), std::sin(angle), 0});
    }
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangulate(pentagram, triangles);
    EXPECT_EQ(triangles.size(), 2u);
    for (const auto& t : triangles) {
      const double turn =
          cross(pentagram[t[1]] - pentagram[t[0]], pentagram[t[2]] - pentagram[t[0]]).z * (clockwise ? -1 : 1);
      EXPECT_GT(turn, 0.0);
    }
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

TEST(Files, ThatAreMissingAreNamedInTheError) {
  const auto model = read_openflight(std::filesystem::path("/nowhere/a.flt"));
  ASSERT_FALSE(model);
  EXPECT_THAT(model.error().message(), HasSubstr("/nowhere/a.flt: expected an OpenFlight file, found none"));
}

TEST(EveryRecord, IsReadFromOneFile) {
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
