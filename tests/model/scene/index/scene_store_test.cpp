// SceneStore and SceneView: position and placement of scenes on the ground, the files that a store reads, the tiles
// that a view finds.
#include "model/scene/index/scene_store.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "lib/geo/frames.hpp"
#include "lib/radar/world.hpp"
#include "model/scene/index/scene_index.hpp"
#include "tests/model/scene/support.hpp"
#include "tests/model/terrain/shapes.hpp"
#include "worldgen/scene/scene_builder.hpp"

namespace yars::model::scene {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr geo::GeoPoint kOrigin{37.5, -122.3};

std::unique_ptr<terrain::TerrainStore> ground(terrain::AnalyticTerrain::Height height) {
  return std::make_unique<terrain::FixedTerrainStore>(
      std::make_shared<const terrain::AnalyticTerrain>(std::move(height)));
}

std::unique_ptr<SceneStore> store_of(const std::vector<radar::Scene>& scenes, terrain::AnalyticTerrain::Height height,
                                     SceneStoreOptions options = {}) {
  auto store = SceneStore::open(scenes, ground(std::move(height)), options);
  EXPECT_TRUE(store) << (store ? "" : store.error().message());
  return std::move(*store);
}

radar::Scene scene_of(const std::filesystem::path& file) {
  return {.file = file.string()};
}

// The box of box_and_road() alone.
std::vector<std::byte> box(std::optional<geo::GeoPoint> origin) {
  worldgen::OpenFlightWriter writer(origin);
  worldgen::MeshBuilder mesh_builder(writer);
  writer.begin_object("box");
  mesh_builder.box({300, 400, 0}, 20, 10, 8);
  writer.end();
  return writer.take();
}

// A box of 20 x 10 x 8 m whose middle is 300 m east and 400 m north of the origin, and a flat road of 200 m.
std::vector<std::byte> box_and_road(std::optional<geo::GeoPoint> origin) {
  worldgen::OpenFlightWriter writer(origin);
  worldgen::MeshBuilder mesh_builder(writer);
  writer.begin_object("box");
  mesh_builder.kind = {1, 0, 0xFF0000};
  mesh_builder.box({300, 400, 0}, 20, 10, 8);
  writer.end();
  writer.begin_object("road");
  mesh_builder.kind = {9, 0, 0x00FF00};
  mesh_builder.polygon({{-100, -2, 0.1}, {100, -2, 0.1}, {100, 2, 0.1}, {-100, 2, 0.1}});
  writer.end();
  return writer.take();
}

geo::GeoPoint offset(geo::GeoPoint from, double azimuth_deg, double distance_m) {
  return geo::geodesic_direct(from, geo::Bearing::degrees(azimuth_deg), geo::Length::metres(distance_m));
}

double distance_m(geo::GeoPoint a, geo::GeoPoint b) {
  return geo::geodesic_inverse(a, b).distance.metres();
}

// Calls look(object, position, altitude [m MSL]) for each corner of a view's triangles.
template <class Look>
void each_corner(const SceneView& view, const Look& look) {
  std::vector<const Tile*> tiles;
  view.tiles_near(kOrigin, 50'000, tiles);
  for (const Tile* tile : tiles)
    for (std::size_t triangle = 0; triangle < tile->triangles(); ++triangle)
      for (const std::size_t i : tile->corners(triangle)) {
        const double east = static_cast<double>(tile->east_m[i]), north = static_cast<double>(tile->north_m[i]);
        const geo::GeoPoint at = offset(tile->origin, std::atan2(east, north) * 180.0 / M_PI, std::hypot(east, north));
        look(view.objects()[tile->object[triangle]], at, tile->zero_msl_m + static_cast<double>(tile->up_m[i]));
      }
}

// Objects whose centres lie within the radius: indices into view.objects().
std::vector<std::uint32_t> objects_near(const SceneView& view, geo::GeoPoint position, double radius_m) {
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < view.objects().size(); ++i)
    if (distance_m(view.objects()[i].middle, position) <= radius_m) found.push_back(static_cast<std::uint32_t>(i));
  return found;
}

TEST(SceneStore, PlacesAnObjectAtItsLatitudeAndLongitude) {
  const Folder folder;
  const auto store = store_of({scene_of(folder.write("a.flt", box_and_road(kOrigin)))}, terrain::flat(100));
  const SceneViewPointer view = store->prepare({kOrigin, 1000, 0});
  const geo::GeoPoint middle = offset(kOrigin, std::atan2(300, 400) * 180.0 / M_PI, 500);
  const auto found = objects_near(*view, middle, 5);
  ASSERT_EQ(found.size(), 1U);
  const SceneObject& object = view->objects()[found[0]];
  EXPECT_EQ(object.name, "box");
  EXPECT_LT(distance_m(object.middle, middle), 0.01);
  EXPECT_NEAR(object.base_msl_m, 100, 1e-9);
  EXPECT_NEAR(object.height_m, 8, 1e-5);
  EXPECT_NEAR(object.length_m, 20, 1e-4);
  EXPECT_NEAR(object.width_m, 10, 1e-4);
  EXPECT_NEAR(object.heading_deg, 90, 0.01);
  EXPECT_EQ(view->kinds()[object.kind].material, 1);
}

// Ends of a road on a slope differ by many metres from the height of its middle. Still all its triangles lie on the
// ground, and none of the box.
TEST(SceneStore, ARoadOnASlopeLiesOnTheGround) {
  const Folder folder;
  const terrain::TerrainAxis east{kOrigin, geo::Bearing::degrees(90)};
  const auto store = store_of({scene_of(folder.write("a.flt", box_and_road(kOrigin)))}, terrain::plane(east, 500, 0.1));
  const SceneViewPointer view = store->prepare({kOrigin, 1000, 0});
  std::vector<const Tile*> tiles;
  view->tiles_near(kOrigin, 5000, tiles);
  std::size_t lying = 0;
  for (const Tile* tile : tiles)
    for (std::size_t t = 0; t < tile->triangles(); ++t) {
      EXPECT_EQ(t < tile->on_ground, view->objects()[tile->object[t]].name == "road");
      lying += t < tile->on_ground ? 1 : 0;
    }
  EXPECT_GT(lying, 8U);
}

// The road is at 0.1 m MSL. It lies on the ground if the terrain is within about a metre, and not if it is 10 m lower.
TEST(SceneStore, ALevelFaceAtAnAltitudeLiesOnGroundAtNearlyThisAltitude) {
  const Folder folder;
  radar::Scene scene = scene_of(folder.write("a.flt", box_and_road(kOrigin)));
  scene.heights = radar::SceneHeights::sea_level;
  for (const double ground_m : {1.0, -1.0, -10.0}) {
    const auto store = store_of({scene}, terrain::flat(ground_m));
    const SceneViewPointer view = store->prepare({kOrigin, 1000, 0});
    std::vector<const Tile*> tiles;
    view->tiles_near(kOrigin, 50, tiles);
    ASSERT_FALSE(tiles.empty());
    for (const Tile* tile : tiles) EXPECT_EQ(tile->on_ground, ground_m < -2.0 ? 0 : tile->triangles()) << ground_m;
  }
}

// A triangle 400,000 km long and 1 cm wide. In pieces of 30 m it would give 13 million, which its area does not show.
TEST(SceneStore, ASliverOf400000KilometresGivesABoundedNumberOfPieces) {
  const Folder folder;
  worldgen::OpenFlightWriter writer(kOrigin);
  worldgen::MeshBuilder mesh_builder(writer);
  writer.begin_object("road");
  mesh_builder.kind = {9, 0, 0x00FF00};
  mesh_builder.polygon({{0, 0, 0.1}, {4e8, 0, 0.1}, {4e8, 0.01, 0.1}});
  writer.end();
  const auto store = store_of({scene_of(folder.write("a.flt", writer.take()))}, terrain::flat(0));
  const SceneViewPointer view = store->prepare({kOrigin, 1000, 0});
  EXPECT_LT(view->resident_bytes(), 400'000'000U);
}

TEST(SceneStore, TurnsASceneClockwiseByItsHeading) {
  const Folder folder;
  radar::Scene scene = scene_of(folder.write("a.flt", box_and_road(std::nullopt)));
  scene.position = kOrigin;
  scene.heading_deg = 90;
  const auto store = store_of({scene}, terrain::flat(0));
  const SceneViewPointer view = store->prepare({kOrigin, 1000, 0});
  // 300 east and 400 north become 400 east and 300 south.
  const auto found = objects_near(*view, offset(kOrigin, std::atan2(400, -300) * 180.0 / M_PI, 500), 1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(view->objects()[found[0]].heading_deg, 0, 0.01);
}

TEST(SceneStore, PlacesAnObjectLevelOnTheGroundUnderItsMiddle) {
  const Folder folder;
  // The ground rises by 1 m in 10 m towards the east.
  const terrain::TerrainAxis east{kOrigin, geo::Bearing::degrees(90)};
  const auto store = store_of({scene_of(folder.write("a.flt", box_and_road(kOrigin)))}, terrain::plane(east, 500, 0.1));
  const SceneViewPointer view = store->prepare({kOrigin, 1000, 0});
  double lowest = 1e9, highest = -1e9;
  each_corner(*view, [&](const SceneObject& object, geo::GeoPoint, double altitude) {
    if (object.name != "box") return;
    lowest = std::min(lowest, altitude);
    highest = std::max(highest, altitude);
  });
  EXPECT_NEAR(lowest, 530, 0.01);
  EXPECT_NEAR(highest, 538, 0.01);
}

TEST(SceneStore, LaysARoadOnTheGroundAlongItsLength) {
  const Folder folder;
  const auto hills = terrain::sine_hills({kOrigin, geo::Bearing::degrees(90)}, 5, 200);
  const auto store = store_of({scene_of(folder.write("a.flt", box_and_road(kOrigin)))}, hills);
  const SceneViewPointer view = store->prepare({kOrigin, 1000, 0});
  std::size_t vertices = 0;
  each_corner(*view, [&](const SceneObject& object, geo::GeoPoint at, double altitude) {
    if (object.name != "road") return;
    ++vertices;
    EXPECT_NEAR(altitude, hills(at) + 0.1, 0.01);
  });
  EXPECT_GT(vertices, 40U);
}

TEST(SceneStore, KeepsHeightsAboveMeanSeaLevel) {
  const Folder folder;
  radar::Scene scene = scene_of(folder.write("a.flt", box_and_road(kOrigin)));
  scene.heights = radar::SceneHeights::sea_level;
  const auto store = store_of({scene}, terrain::flat(700));
  const SceneViewPointer view = store->prepare({kOrigin, 1000, 0});
  each_corner(*view, [&](const SceneObject&, geo::GeoPoint, double altitude) { EXPECT_LT(altitude, 8.001); });
}

TEST(SceneStore, PlacesAnAnchoredSceneAtTheGroundElevationOfItsPosition) {
  const Folder folder;
  radar::Scene scene = scene_of(folder.write("a.flt", box_and_road(kOrigin)));
  scene.heights = radar::SceneHeights::anchor;
  const terrain::TerrainAxis east{kOrigin, geo::Bearing::degrees(90)};
  const auto store = store_of({scene}, terrain::plane(east, 500, 0.1));
  const SceneViewPointer view = store->prepare({kOrigin, 1000, 0});
  for (const SceneObject& object : view->objects()) EXPECT_NEAR(object.base_msl_m, 500, 1e-6);
}

TEST(SceneStore, PrefersThePositionInTheFileNameToTheHeader) {
  const Folder folder;
  std::vector<std::string> problems;
  const auto index = index_scenes({scene_of(folder.write("N35_44_51W121_30_2.flt", box_and_road(kOrigin)))}, problems);
  ASSERT_TRUE(index) << index.error().message();
  EXPECT_NEAR((*index)[0].placement.position.latitude_deg, 35.0 + 44.0 / 60 + 51.0 / 3600, 1e-12);
  EXPECT_NEAR((*index)[0].placement.position.longitude_deg, -(121.0 + 30.0 / 60 + 2.0 / 3600), 1e-12);
}

TEST(SceneStore, RefusesASceneWithoutAPosition) {
  const Folder folder;
  const auto store =
      SceneStore::open({scene_of(folder.write("a.flt", box_and_road(std::nullopt)))}, ground(terrain::flat(0)));
  ASSERT_FALSE(store);
  EXPECT_THAT(store.error().message(), HasSubstr("expected a scene with a position"));
}

TEST(SceneStore, ReadsOnlyScenesThatOverlapTheRegion) {
  const Folder folder;
  std::vector<std::byte> far = box_and_road(offset(kOrigin, 0, 100'000));
  far.resize(far.size() - 3);  // truncated, so that reading fails
  folder.write("far.flt", far);
  folder.write("near.flt", box_and_road(kOrigin));
  const auto store = store_of({scene_of(folder.path())}, terrain::flat(0));
  const SceneViewPointer view = store->prepare({kOrigin, 10'000, 0});
  EXPECT_THAT(store->take_problems(), IsEmpty());
  EXPECT_EQ(store->prepare({kOrigin, 9'000, 0}), view);
  const SceneViewPointer after_failure = store->prepare({kOrigin, 120'000, 0});
  EXPECT_THAT(store->take_problems(), testing::ElementsAre(HasSubstr("truncated")));
  EXPECT_EQ(after_failure, view);
}

// What is left out of the scenes of all regions stays known, unlike problems, which are told once.
TEST(SceneStore, KnowsWhatItsViewsLack) {
  const Folder folder;
  worldgen::OpenFlightWriter writer(kOrigin);
  writer.external("gone.flt", {});
  std::vector<std::byte> bytes = writer.take();
  bytes.resize(bytes.size() + 5);  // a warning, which is no loss
  folder.write("a.flt", bytes);
  folder.write("no_position.flt", box_and_road(std::nullopt));
  std::vector<std::byte> cut = box_and_road(kOrigin);
  cut.resize(cut.size() - 3);
  folder.write("cut.flt", cut);
  const auto store = store_of({scene_of(folder.path())}, terrain::flat(0));
  EXPECT_THAT(store->left_out(), testing::ElementsAre(HasSubstr("scene with a position")));
  for (int time = 0; time < 2; ++time) {
    store->prepare({kOrigin, 1000, 0});
    EXPECT_THAT(store->left_out(),
                testing::UnorderedElementsAre(HasSubstr("scene with a position"), HasSubstr("gone.flt is not there"),
                                              HasSubstr("truncated")));
    EXPECT_EQ(store->take_problems().size(), time == 0 ? 4U : 0U);
  }
  store->prepare({offset(kOrigin, 90, 300'000), 1000, 0});
  EXPECT_EQ(store->left_out().size(), 3U);
}

// check_files() has the sentences that reading the scenes will have, in one call a file, and can be stopped.
TEST(SceneStore, ChecksItsFilesBeforeARegionNeedsThem) {
  const Folder folder;
  worldgen::OpenFlightWriter writer(kOrigin);
  writer.external("gone.flt", {});
  std::vector<std::byte> bytes = writer.take();
  bytes.resize(bytes.size() + 5);
  folder.write("a.flt", bytes);
  folder.write("b.flt", box_and_road(kOrigin));
  std::vector<std::byte> cut = box_and_road(kOrigin);
  cut.resize(cut.size() - 3);
  folder.write("cut.flt", cut);
  const auto store = store_of({scene_of(folder.path())}, terrain::flat(0));
  std::vector<std::string> checked;
  int files = 0;
  store->check_files([&](const std::vector<std::string>& problems) {
    ++files;
    checked.insert(checked.end(), problems.begin(), problems.end());
    return true;
  });
  EXPECT_EQ(files, 3);
  EXPECT_TRUE(store->take_problems().empty()) << "nothing is loaded";
  store->prepare({kOrigin, 1000, 0});
  EXPECT_THAT(checked, testing::UnorderedElementsAreArray(store->take_problems()));
  EXPECT_EQ(checked.size(), 3U);
  files = 0;
  store->check_files([&](const std::vector<std::string>&) { return ++files < 2; });
  EXPECT_EQ(files, 2);
}

// A file that is too large for the check is counted, and is read when a region needs it.
TEST(SceneStore, AFileTooLargeForTheCheckIsCounted) {
  const Folder folder;
  folder.write("a.flt", box_and_road(kOrigin));
  std::filesystem::resize_file(folder.path() / "a.flt", kMaxCheckedFileBytes + 1);
  const auto store = store_of({scene_of(folder.path())}, terrain::flat(0));
  std::vector<std::string> checked;
  store->check_files([&](const std::vector<std::string>& problems) {
    checked.insert(checked.end(), problems.begin(), problems.end());
    return true;
  });
  EXPECT_THAT(checked, testing::ElementsAre(HasSubstr("1 scene file too large to be checked")));
}

// A store of a.flt at kOrigin and b.flt at `other`, in which only one scene stays resident.
auto store_of_two(const Folder& folder, geo::GeoPoint other) {
  return store_of(
      {scene_of(folder.write("a.flt", box_and_road(kOrigin))), scene_of(folder.write("b.flt", box_and_road(other)))},
      terrain::flat(0), {.resident_limit_bytes = 1});
}

TEST(SceneStore, DropsTheLeastRecentlyUsedSceneBeyondItsLimit) {
  const Folder folder;
  const geo::GeoPoint other = offset(kOrigin, 90, 200'000);
  const auto store = store_of_two(folder, other);
  std::vector<const Tile*> tiles;
  const SceneViewPointer first = store->prepare({kOrigin, 1000, 0});
  first->tiles_near(kOrigin, 1000, tiles);
  EXPECT_FALSE(tiles.empty());
  const SceneViewPointer second = store->prepare({other, 1000, 0});
  EXPECT_GT(second->generation(), first->generation());
  second->tiles_near(kOrigin, 1000, tiles);
  EXPECT_TRUE(tiles.empty());
  second->tiles_near(other, 1000, tiles);
  EXPECT_FALSE(tiles.empty());
  // Loaded again, the objects have the same indices.
  const SceneViewPointer third = store->prepare({kOrigin, 1000, 0});
  EXPECT_EQ(objects_near(*first, kOrigin, 1000), objects_near(*third, kOrigin, 1000));
}

TEST(SceneStore, AChangedFileWithFewerObjectsTakesNoNewIndices) {
  const Folder folder;
  const geo::GeoPoint other = offset(kOrigin, 90, 200'000);
  const auto store = store_of_two(folder, other);
  std::size_t first_count = 0;
  for (int load = 0; load < 6; ++load) {
    folder.write("a.flt", load % 2 == 0 ? box_and_road(kOrigin) : box(kOrigin));
    const SceneViewPointer view = store->prepare({kOrigin, 1000, 0});
    EXPECT_EQ(objects_near(*view, kOrigin, 1000).size(), load % 2 == 0 ? 3U : 2U) << "load " << load;
    store->prepare({other, 1000, 0});
    if (load == 0) first_count = view->objects().size();
    // The first view has no object of the other scene.
    const std::size_t expected = load == 0 ? first_count : first_count + 3;
    EXPECT_EQ(view->objects().size(), expected) << "load " << load;
  }
}

TEST(SceneStore, GivesEqualViewsForEqualFiles) {
  const Folder folder;
  const auto file = folder.write("a.flt", worldgen::generate_scene({.triangles = 8000, .origin = kOrigin}).file);
  std::vector<std::vector<float>> ups;
  for (int run = 0; run < 2; ++run) {
    const auto store = store_of({scene_of(file)}, terrain::built_in_hills());
    const SceneViewPointer view = store->prepare({kOrigin, 1000, 0});
    std::vector<const Tile*> tiles;
    view->tiles_near(kOrigin, 10'000, tiles);
    std::vector<float> all;
    for (const Tile* tile : tiles) {
      all.insert(all.end(), tile->up_m.begin(), tile->up_m.end());
      all.insert(all.end(), tile->east_m.begin(), tile->east_m.end());
    }
    ups.push_back(std::move(all));
  }
  EXPECT_EQ(ups[0], ups[1]);
  EXPECT_GT(ups[0].size(), 10'000U);
}

TEST(SceneView, FindsExactlyTheTilesWhoseBoundsAreWithinTheRadius) {
  const Folder folder;
  const auto file = folder.write("a.flt", worldgen::generate_scene({.triangles = 30'000, .origin = kOrigin}).file);
  const auto store = store_of({scene_of(file)}, terrain::flat(0));
  const SceneViewPointer view = store->prepare({kOrigin, 1000, 0});
  std::vector<const Tile*> all, found;
  view->tiles_near(kOrigin, 100'000, all);
  ASSERT_GT(all.size(), 20U);
  for (const double azimuth_deg : {0.0, 70.0, 200.0})
    for (const double away_m : {0.0, 800.0, 3000.0})
      for (const double radius_m : {1.0, 300.0, 2500.0}) {
        const geo::GeoPoint position = offset(kOrigin, azimuth_deg, away_m);
        view->tiles_near(position, radius_m, found);
        std::vector<const Tile*> expected;
        for (const Tile* tile : all) {
          const auto to_position = geo::geodesic_inverse(tile->origin, position);
          const double east = to_position.distance.metres() * std::sin(to_position.azimuth_at_start.radians());
          const double north = to_position.distance.metres() * std::cos(to_position.azimuth_at_start.radians());
          const Bounds& b = tile->bounds;
          const double de =
              std::max({0.0, static_cast<double>(b.east_min_m) - east, east - static_cast<double>(b.east_max_m)});
          const double dn =
              std::max({0.0, static_cast<double>(b.north_min_m) - north, north - static_cast<double>(b.north_max_m)});
          if (std::hypot(de, dn) <= radius_m) expected.push_back(tile);
        }
        EXPECT_EQ(found, expected);
      }
}

TEST(SceneView, TrianglesAreCounterClockwiseAndWithinTheirBounds) {
  const Folder folder;
  const auto file = folder.write("a.flt", worldgen::generate_scene({.triangles = 30'000, .origin = kOrigin}).file);
  const auto store = store_of({scene_of(file)}, terrain::flat(250));
  const SceneViewPointer view = store->prepare({kOrigin, 1000, 0});
  std::vector<const Tile*> tiles;
  view->tiles_near(kOrigin, 100'000, tiles);
  std::size_t wrong = 0;
  for (const Tile* tile : tiles) {
    for (std::size_t triangle = 0; triangle < tile->triangles(); ++triangle) {
      const auto t = tile->corners(triangle);
      const auto at = [&](std::uint32_t i) {
        return Vector3{static_cast<double>(tile->east_m[i]), static_cast<double>(tile->north_m[i]),
                       static_cast<double>(tile->up_m[i])};
      };
      const Vector3 area = cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
      const bool flat = t[0] < tile->first_with_normal;
      for (const std::size_t i : t) {
        EXPECT_EQ(i < tile->first_with_normal, flat);
        if (!flat) {
          const std::size_t n = i - tile->first_with_normal;
          const Vector3 normal{static_cast<double>(tile->normal_east[n]), static_cast<double>(tile->normal_north[n]),
                               static_cast<double>(tile->normal_up[n])};
          EXPECT_NEAR(length(normal), 1.0, 1e-4);
          wrong += dot(area, normal) <= 0.0 ? 1 : 0;
        }
        EXPECT_LE(tile->east_m[i], tile->bounds.east_max_m);
        EXPECT_GE(tile->up_m[i], tile->bounds.up_min_m);
      }
    }
    for (const auto& corner : tile->corner) EXPECT_EQ(corner.size(), tile->triangles());
    EXPECT_EQ(tile->object.size(), tile->triangles());
  }
  EXPECT_EQ(wrong, 0U);
}

TEST(SceneSource, ReadsFilePositionAndHeading) {
  const auto scene = parse_scene("some/airfield.flt@37.5,-122.25,45");
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->file, "some/airfield.flt");
  EXPECT_EQ(scene->position.latitude_deg, 37.5);
  EXPECT_EQ(scene->position.longitude_deg, -122.25);
  EXPECT_EQ(scene->heading_deg, 45);
  EXPECT_TRUE(std::isnan(parse_scene("airfield.flt")->position.latitude_deg));
  const Folder folder;
  const std::string named = folder.write("a@37.5,-122.flt", {}).string();
  EXPECT_EQ(parse_scene(named)->file, named);
  EXPECT_EQ(parse_scene(named + "@1,2")->file, named);
  EXPECT_EQ(parse_scene(named + "@1,2")->position.latitude_deg, 1);
  EXPECT_FALSE(parse_scene("airfield.flt@north"));
  EXPECT_FALSE(parse_scene("airfield.flt@95,0"));
  EXPECT_FALSE(parse_scene("@1,2"));
}

}  // namespace
}  // namespace yars::model::scene
