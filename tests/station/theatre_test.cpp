// The instructor's map: tiles, and what is drawn on them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "databuffer/messages/key_map.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/configuration.hpp"
#include "station/instructor_map.hpp"

namespace yars::station {
namespace {

TEST(MapTile, APathNamesASquareInDegrees) {
  const auto tile = tile_of_path("/map/3/127/58.png");
  ASSERT_TRUE(tile);
  const auto frame = frame_of(*tile);
  EXPECT_EQ(frame.south_deg, 37.0);
  EXPECT_EQ(frame.north_deg, 38.0);
  EXPECT_EQ(frame.west_deg, -122.0);
  EXPECT_EQ(frame.east_deg, -121.0);
  EXPECT_EQ(frame.width, kTilePixels);
  EXPECT_TRUE(tile_of_path("/map/0/22/44.png")) << "the last of level 0";
}

TEST(MapTile, OtherPathsNameNone) {
  for (const char* path :
       {"", "/map", "/map/", "/map/3/127.png", "/map/3/127/58", "/map/3/127/58.jpg", "/map/3/127/58.png?x",
        "/map/-1/0/0.png", "/map/13/0/0.png", "/map/0/23/0.png", "/map/0/0/45.png", "/map/3/-1/0.png",
        "/map/3/1e3/0.png", "/map/99999999999/0/0.png", "/map/3/127/58.png/"})
    EXPECT_FALSE(tile_of_path(path)) << path;
}

// The corners of a map that lies east of the aircraft: up on the picture is east.
TEST(TheatreJson, CornersOfAPatchMapLieAroundItsCentre) {
  databuffer::PatchMap map{};
  map.id = 7;
  map.apex_latitude_deg = 37.0;
  map.apex_longitude_deg = -122.0;
  map.up_deg = 90.0;
  map.distance_m = 20000.0;
  map.window_nm = 1.0;
  const auto corners = patch_json(map)["corners"];
  ASSERT_EQ(corners.size(), 4U);
  const geo::GeoPoint apex{37.0, -122.0};
  const auto centre = geo::GeodesicRay(apex, geo::Bearing::degrees(90.0)).position(geo::Length::metres(20000.0));
  for (const auto& corner : corners) {
    const geo::GeoPoint point{corner[0].get<double>(), corner[1].get<double>()};
    EXPECT_NEAR(geo::geodesic_inverse(centre, point).distance.metres(), 926.0 * 1.41421356, 1.0);
  }
  EXPECT_GT(corners[0][1], corners[3][1]) << "the far corners are farther east";
  EXPECT_GT(corners[0][0], corners[1][0]) << "left is north";
}

TEST(TheatreJson, WithoutAFreshAircraftThereIsNeitherAircraftNorScan) {
  databuffer::ModelStatus model{};
  model.flags = databuffer::kModelStale;
  EXPECT_TRUE(aircraft_json(model).is_null());
  EXPECT_TRUE(scan_json(model).is_null());
  EXPECT_TRUE(forming_json(model).is_null());
  model.flags = 0;
  model.ownship.velocity_east_mps = 100.0;
  EXPECT_NEAR(aircraft_json(model)["speed_kt"].get<double>(), 194.38, 0.01);
  EXPECT_NEAR(aircraft_json(model)["track_deg"].get<double>(), 90.0, 1e-9);
}

TEST(TheatreJson, TheKeysAreThoseOfTheHelpOverTheDisplay) {
  const auto keys = theatre_json(radar::RadarConfiguration(), {}, {})["keys"];
  ASSERT_EQ(keys.size(), databuffer::key_help().size());
  EXPECT_EQ(keys[0]["keys"], databuffer::key_help()[0].keys);
  EXPECT_EQ(keys[0]["does"], databuffer::key_help()[0].does);
}

}  // namespace
}  // namespace yars::station
