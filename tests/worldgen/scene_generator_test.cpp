// Generator of OpenFlight scenes: repeatability, number of triangles, materials, objects and file size.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "model/scene/openflight/records.hpp"
#include "tests/model/scene/support.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::model::scene {
namespace {

constexpr geo::GeoPoint kOrigin{36.2, -115.0};
constexpr std::array<worldgen::GeneratedKind, 4> kKinds{worldgen::GeneratedKind::airfield,
                                                        worldgen::GeneratedKind::harbour,
                                                        worldgen::GeneratedKind::bridge, worldgen::GeneratedKind::town};

// Generates a scene and reads its file.
Model model_of(const worldgen::SceneRequest& order) {
  auto model = read_openflight(worldgen::generate_scene(order).file, "made.flt");
  EXPECT_TRUE(model) << (model ? "" : model.error().message());
  return model ? std::move(*model) : Model{};
}

TEST(Generator, MakesTheSameFileForTheSameRequest) {
  for (const worldgen::GeneratedKind kind : kKinds) {
    const worldgen::SceneRequest order{.kind = kind, .triangles = 15'000, .seed = 3, .origin = kOrigin};
    EXPECT_EQ(worldgen::generate_scene(order).file, worldgen::generate_scene(order).file);
    worldgen::SceneRequest other = order;
    other.seed = 4;
    EXPECT_NE(worldgen::generate_scene(order).file, worldgen::generate_scene(other).file);
  }
}

// The last bits of GeographicLib's positions differ between its versions; the file does not.
TEST(Generator, RoundsTheCornersToABillionthOfADegree) {
  const auto file = worldgen::generate_scene({.triangles = 15'000, .seed = 2, .origin = {37.8, -122.6}}).file;
  for (const std::size_t at : {openflight::header::kSouthLatitude, openflight::header::kWestLongitude,
                               openflight::header::kNorthLatitude, openflight::header::kEastLongitude}) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < 8; ++i) bits = bits << 8U | std::to_integer<std::uint64_t>(file[at + i]);
    const auto degrees = std::bit_cast<double>(bits);
    EXPECT_GT(std::abs(degrees), 30.0) << at;
    EXPECT_EQ(degrees, std::round(degrees * 1e9) / 1e9) << at;
  }
}

TEST(Generator, MakesTheRequestedNumberOfTrianglesWithin10Percent) {
  for (const worldgen::GeneratedKind kind : kKinds) {
    const worldgen::SceneRequest order{.kind = kind, .triangles = 60'000, .seed = 1, .origin = kOrigin};
    const worldgen::GeneratedScene made = worldgen::generate_scene(order);
    const auto model = read_openflight(made.file, "made.flt");
    ASSERT_TRUE(model);
    EXPECT_NEAR(static_cast<double>(made.triangles), 60'000, 6'000);
    EXPECT_NEAR(static_cast<double>(model->triangles.size()), static_cast<double>(made.triangles), 20);
  }
}

// MeshBuilder::map rotates the scene about its origin. Instances of a shared object rotate like faces written directly.
TEST(SceneBuilder, RotatesInstancesLikeOtherFaces) {
  const worldgen::SceneRequest request{.origin = kOrigin};
  const worldgen::GenerationProgress no_progress;
  worldgen::SceneBuilder builder(request, no_progress);
  const auto box_at = [](double x_m) { return [x_m](worldgen::MeshBuilder& mesh) { mesh.box({x_m, 0, 0}, 2, 2, 2); }; };
  const std::uint64_t triangles = builder.define_object(1, "instance", box_at(0));
  builder.mesh.map = rotation_about_up(M_PI / 2);
  builder.add_instance(1, triangles, worldgen::pose(100, 0, 0));
  builder.object("drawn", worldgen::surface::kMetal, box_at(200));
  const auto model = read_openflight(builder.out.take(), "made.flt");
  ASSERT_TRUE(model) << model.error().message();
  double min_y_m = 1e9, max_y_m = 0;
  for (std::uint32_t i = 0; i < model->vertices.size(); ++i) {
    EXPECT_NEAR(position_of(*model, i).x, 0.0, 1.01);
    min_y_m = std::min(min_y_m, position_of(*model, i).y);
    max_y_m = std::max(max_y_m, position_of(*model, i).y);
  }
  EXPECT_NEAR(min_y_m, 99.0, 0.01);
  EXPECT_NEAR(max_y_m, 201.0, 0.01);
}

TEST(Generator, GivesEveryFaceAMaterialAndStaysWithinTheExtentOfItsHeader) {
  for (const worldgen::GeneratedKind kind : kKinds) {
    const Model model = model_of({.kind = kind, .triangles = 30'000, .seed = 2, .origin = kOrigin});
    EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
    for (const SurfaceKind& surface : model.kinds) EXPECT_NE(surface.material, 0);
    ASSERT_TRUE(model.header.south_west && model.header.north_east && model.header.origin);
    const double reach_m = geo::geodesic_inverse(*model.header.origin, *model.header.north_east).distance.metres();
    for (std::uint32_t i = 0; i < model.vertices.size(); ++i)
      EXPECT_LT(std::hypot(position_of(model, i).x, position_of(model, i).y), reach_m);
  }
}

TEST(Generator, MakesAnAirfieldOfHangarsRunwayTanksAircraftFencesAndRevetments) {
  const Model model = model_of({.triangles = 20'000, .seed = 1, .origin = kOrigin});
  std::map<std::string, int> names;
  for (const std::string& name : model.objects) ++names[name];
  for (const char* name : {"runway", "taxiway", "apron", "hangar1", "tower", "tank1", "fighter", "transport", "truck",
                           "tanker", "fence", "embankment", "revetment"})
    EXPECT_GT(names[name], 0) << name;
  EXPECT_EQ(names["fighter_far"], 0);
}

// Farthest corner of an object from the origin, as a true bearing [deg].
double bearing_of_farthest(const Model& model, const std::string& name) {
  Vector3 farthest;
  for (const ModelTriangle& triangle : model.triangles)
    for (const std::uint32_t corner : triangle.corners)
      if (model.objects[triangle.object] == name && length(position_of(model, corner)) > length(farthest))
        farthest = position_of(model, corner);
  return std::atan2(farthest.x, farthest.y) * 180.0 / M_PI;
}

std::vector<Vector3> corners_of(const Model& model, const std::string& name) {
  std::vector<Vector3> corners;
  for (const ModelTriangle& triangle : model.triangles)
    if (model.objects[triangle.object] == name)
      for (const std::uint32_t corner : triangle.corners) corners.push_back(position_of(model, corner));
  return corners;
}

Vector3 turned_clockwise(Vector3 position, double angle_deg) {
  const double sine = std::sin(angle_deg * M_PI / 180.0), cosine = std::cos(angle_deg * M_PI / 180.0);
  return {cosine * position.x + sine * position.y, cosine * position.y - sine * position.x, position.z};
}

TEST(Generator, TurnsEachKindToTheRequestedHeading) {
  // Half the runway's width of 45 m at its end, 1250 m away, is 1 degree.
  const Model airfield = model_of({.origin = kOrigin, .heading_deg = 20.0});
  EXPECT_NEAR(std::fmod(bearing_of_farthest(airfield, "runway") + 360.0, 180.0), 110.0, 1.1);
  constexpr double kTurn_deg = 30.0;
  for (const auto& [kind, name] :
       {std::pair{worldgen::GeneratedKind::harbour, "quay"}, std::pair{worldgen::GeneratedKind::bridge, "bridge"}}) {
    const auto straight = corners_of(model_of({.kind = kind, .origin = kOrigin}), name);
    const auto turned = corners_of(model_of({.kind = kind, .origin = kOrigin, .heading_deg = kTurn_deg}), name);
    ASSERT_EQ(turned.size(), straight.size()) << name;
    ASSERT_FALSE(straight.empty()) << name;
    for (std::size_t i = 0; i < straight.size(); ++i)
      EXPECT_LT(length(turned[i] - turned_clockwise(straight[i], kTurn_deg)), 0.1) << name << " corner " << i;
  }
  const worldgen::SceneRequest town{.kind = worldgen::GeneratedKind::town, .origin = kOrigin, .heading_deg = 0.0};
  worldgen::SceneRequest east = town;
  east.heading_deg = 90.0;
  EXPECT_NE(worldgen::generate_scene(town).file, worldgen::generate_scene(east).file);
}

TEST(Generator, MakesATownOfAMillionTrianglesInLessThan16Mebibytes) {
  const worldgen::GeneratedScene made = worldgen::generate_scene(
      {.kind = worldgen::GeneratedKind::town, .triangles = 1'000'000, .seed = 1, .origin = kOrigin});
  EXPECT_LT(made.file.size(), 16U << 20U);
  EXPECT_GE(made.triangles, 1'000'000U);
}

}  // namespace
}  // namespace yars::model::scene
