// Correlation with the visual scene: one object of an OpenFlight file has one latitude and longitude in the real beam
// map, in the HRM PPI, in a patch map and in the file. The tests convert pictures to positions by published data only:
// a sweep's apex, edges and range, a map's geometry.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_formation.hpp"
#include "model/scene/index/scene_store.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/kernel/cockpit.hpp"
#include "tests/model/made_up_objects.hpp"

namespace yars::model {
namespace {

constexpr double kDistance_m = 15'000.0;
constexpr double kOnePlaceAltitude_m = 1500.0;
constexpr double kRange_nm = 10.0;

struct Setting {
  const char* name;
  geo::GeoPoint origin;  // origin of the file
  double from_deg;       // true bearing from the tower to the aircraft
};

class OneObject : public testing::TestWithParam<Setting> {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    // The tower stands 400 m east and 300 m south of the file's origin.
    const auto bytes = test::flt_of({{400.0, -300.0, 12.0, 12.0, 40.0, 1}}, GetParam().origin);
    std::ofstream(folder_ / "tower.flt", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    tower_ = geo::geodesic_direct(GetParam().origin,
                                  geo::Bearing::degrees(90.0 + std::atan2(300.0, 400.0) / geo::kRadiansPerDegree),
                                  geo::Length::metres(500.0));
    apex_ = geo::geodesic_direct(tower_, geo::Bearing::degrees(GetParam().from_deg), geo::Length::metres(kDistance_m));
    configuration_.fidelity.noise = false;
    configuration_.fidelity.azimuth_smear = true;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  terrain::TerrainViewPointer ground() const { return test::ground_of(terrain::flat(test::kGround_m)); }

  scene::SceneViewPointer scene_for(scene::SceneUse use) const {
    scene::SceneStoreOptions options;
    options.use = use;
    auto store = scene::SceneStore::open({{.file = (folder_ / "tower.flt").string()}},
                                         std::make_unique<terrain::FixedTerrainStore>(ground()), options);
    return (*store)->prepare({tower_, 100'000.0, 0});
  }

  // Sweeps of one live scan, by number. The tower is 25 degrees to the right of the ground track.
  std::map<std::uint32_t, databuffer::Sweep> scan(radar::Mode mode, scene::SceneViewPointer scenes) const {
    test::Cockpit cockpit(configuration_, terrain::flat(test::kGround_m));
    cockpit.scenes = std::move(scenes);
    const geo::Bearing to_tower = geo::geodesic_inverse(apex_, tower_).azimuth_at_start;
    const geo::Bearing track = to_tower - geo::Angle::degrees(25.0);
    cockpit.tick.ownship.latitude_deg = apex_.latitude_deg;
    cockpit.tick.ownship.longitude_deg = apex_.longitude_deg;
    cockpit.tick.ownship.altitude_msl_m = kOnePlaceAltitude_m;
    cockpit.tick.ownship.heading_deg = track.degrees();
    cockpit.tick.ownship.velocity_north_mps = 240.0 * std::cos(track.radians());
    cockpit.tick.ownship.velocity_east_mps = 240.0 * std::sin(track.radians());
    cockpit.tick.command.mode = static_cast<std::uint8_t>(mode);
    cockpit.tick.command.range_nm = kRange_nm;
    cockpit.tick.command.gain = 2;
    cockpit.tick.command.cursor_latitude_deg = tower_.latitude_deg;
    cockpit.tick.command.cursor_longitude_deg = tower_.longitude_deg;
    cockpit.tick.command.flags |= databuffer::kCursorValid;
    std::map<std::uint32_t, databuffer::Sweep> sweeps;
    for (int tick = 0; tick < 5000; ++tick) {
      const databuffer::Sweep* sweep = cockpit.step();
      if (sweep == nullptr) continue;
      sweeps[sweep->number] = *sweep;
      if (test::is_scan_end(*sweep)) break;
    }
    return sweeps;
  }

  struct Found {
    geo::GeoPoint position;
    double spacing_m = 0.0, wedge_m = 0.0;  // size of a cell at the tower, in range and in azimuth
  };
  // Centre of the brightness that the tower adds to the video of a scan.
  Found brightest(radar::Mode mode) const {
    const auto with_tower = scan(mode, scene_for(scene::SceneUse::scatterers));
    const auto without = scan(mode, nullptr);
    double weight = 0.0, azimuth = 0.0, distance = 0.0;
    Found found;
    const geo::Bearing zero = geo::geodesic_inverse(apex_, tower_).azimuth_at_start;
    for (const auto& [number, sweep] : with_tower) {
      const geo::Bearing left = geo::Bearing::degrees(sweep.azimuth_left_deg);
      const geo::Angle width = geo::Bearing::degrees(sweep.azimuth_right_deg) - left;
      for (std::uint32_t i = 0; i < sweep.samples; ++i) {
        const double added = sweep.video[i] - without.at(number).video[i];
        if (!(added > 0.0)) continue;
        weight += added;
        azimuth += added * (left + 0.5 * width - zero).degrees();
        distance += added * (i + 0.5) * sweep.range_m / sweep.samples;
        found.spacing_m = sweep.range_m / sweep.samples;
        found.wedge_m = width.radians() * kDistance_m;
      }
    }
    EXPECT_GT(weight, 50.0);
    found.position = geo::geodesic_direct(apex_, zero + geo::Angle::degrees(azimuth / weight),
                                          geo::Length::metres(distance / weight));
    return found;
  }

  void expect_at_the_tower(const Found& found) const {
    const geo::GeodesicInverse truth = geo::geodesic_inverse(apex_, tower_);
    const geo::GeodesicInverse seen = geo::geodesic_inverse(apex_, found.position);
    EXPECT_NEAR(seen.distance.metres(), truth.distance.metres(), found.spacing_m);
    EXPECT_NEAR((seen.azimuth_at_start - truth.azimuth_at_start).radians() * kDistance_m, 0.0, found.wedge_m);
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("yars_one_place_" + std::to_string(::getpid()));
  geo::GeoPoint tower_, apex_;
  radar::RadarConfiguration configuration_;
};

TEST_P(OneObject, StandsAtItsPositionInTheFile) {
  const auto view = scene_for(scene::SceneUse::triangles);
  const auto& objects = view->objects();
  const auto tower = std::find_if(objects.begin(), objects.end(), [](const auto& one) { return one.height_m > 30.0; });
  ASSERT_NE(tower, objects.end());
  EXPECT_LT(geo::geodesic_inverse(tower->middle, tower_).distance.metres(), 0.05);
}

TEST_P(OneObject, StandsWithinACellOfItsPositionInTheRealBeamMap) {
  expect_at_the_tower(brightest(radar::Mode::rbm));
}

TEST_P(OneObject, StandsWithinACellOfItsPositionInTheSharpenedScan) {
  const Found found = brightest(radar::Mode::hrm);
  EXPECT_LT(found.wedge_m, 60.0) << "azimuth cell of a sharpened scan";
  expect_at_the_tower(found);
}

TEST_P(OneObject, StandsWithinAPixelOfItsPositionInAPatchMap) {
  radar::RadarConfiguration configuration = test::bare_map();
  configuration.fidelity.earth = radar::EarthModel::ellipsoid;
  hrm::PatchOrder order;
  order.centre = GetParam().origin;
  order.apex = apex_;
  order.altitude = geo::AltitudeMsl::metres(kOnePlaceAltitude_m);
  order.ground_speed = geo::Speed::knots(480.0);
  order.ground_track = geo::geodesic_inverse(apex_, order.centre).azimuth_at_start - geo::Angle::degrees(60.0);
  order.window = geo::Length::nautical_miles(4.7);
  order.looks = 1;
  order.map = 1;
  const auto process = test::make_patch(configuration, order, ground(), scene_for(scene::SceneUse::triangles));
  const hrm::MapImage& image = process.image();
  const double pixel_m = process.geometry().window_m() / image.size;
  const double half_m = 0.5 * process.geometry().window_m();
  const float maximum = *std::max_element(image.power.begin(), image.power.end());
  double weight = 0.0, right = 0.0, up = 0.0;
  for (int row = 0; row < image.size; ++row)
    for (int column = 0; column < image.size; ++column) {
      const auto power = static_cast<double>(image.power[image.at(column, row)]);
      if (power < 0.1 * static_cast<double>(maximum)) continue;
      weight += power;
      right += power * ((column + 0.5) * pixel_m - half_m);
      up += power * (half_m - (row + 0.5) * pixel_m);
    }
  const geo::GeoPoint seen = process.geometry().position_of({right / weight, up / weight});
  // The brightest part is the middle of the wall that faces the radar: 6 m nearer, and laid over by 20 m times the
  // tangent of the grazing angle.
  const double nearer_m = 6.0 + 20.0 * (kOnePlaceAltitude_m - test::kGround_m) / kDistance_m;
  const geo::GeodesicInverse truth = geo::geodesic_inverse(apex_, tower_), found = geo::geodesic_inverse(apex_, seen);
  EXPECT_NEAR(found.distance.metres(), truth.distance.metres() - nearer_m, pixel_m);
  EXPECT_NEAR((found.azimuth_at_start - truth.azimuth_at_start).radians() * kDistance_m, 0.0, pixel_m);
}

INSTANTIATE_TEST_SUITE_P(Places, OneObject,
                         testing::Values(Setting{"MidLatitude", {37.8, -122.3}, 200.0},
                                         Setting{"Antimeridian", {10.0, 179.9995}, 265.0},
                                         Setting{"BeforeTheAntimeridian", {-25.0, 179.95}, 80.0},
                                         Setting{"SeventyNorth", {70.0, 25.0}, 130.0}),
                         [](const auto& setting) { return std::string(setting.param.name); });

}  // namespace
}  // namespace yars::model
