// Rows of the earth: refraction, geodesics, frames, elevation files; shadow and layover on patch maps.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "lib/geo/frames.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/configuration.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/terrain/formats/dted.hpp"
#include "model/terrain/formats/hgt.hpp"
#include "tests/model/hrm/made_up_scene.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/terrain/shapes.hpp"
#include "tests/model/terrain/shared_data.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

namespace physics = model::physics;

physics::EffectiveEarth refracting_sphere(double factor = 4.0 / 3.0) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.earth_radius_factor = factor;
  configuration.fidelity.earth = radar::EarthModel::sphere;
  return physics::effective_earth(configuration, {}, {}, {});
}

double degrees(double radians) {
  return radians / geo::kRadiansPerDegree;
}

// Root of a function that falls from above 0 to below 0 between two numbers.
template <class Function>
double root_of(Function function, double low, double high) {
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (function(middle) > 0.0 ? low : high) = middle;
  }
  return low;
}

TEST(Truth, RefractionIsThatOfAToolbox) {
  constexpr double kRadius_m = 8.4774e6;  // of effearthradius, its default
  const physics::EffectiveEarth earth = refracting_sphere(kRadius_m / geo::kMeanEarthRadius_m);
  const auto row = [](const std::string& term, double outside, double tolerance, const std::string& unit,
                      const std::string& function, double ours) {
    expect_row({"Refraction", term, outside, tolerance, unit, "MathWorks Radar Toolbox, example of " + function,
                "the example's last digit"},
               ours);
  };
  const double height_m = root_of(
      [&](double height) {
        return 0.5 -
               degrees(earth.sight(10.0, earth.distance_at_slant_range(10.0, height, 300e3), height).elevation_rad);
      },
      0.0, 20e3);
  row("height 300 km away at 0.5° from 10 m, radius 8,477.4 km", 7932.5, 0.1, "m", "el2height", height_m);
  const double distance_m =
      root_of([&](double distance) { return degrees(earth.sight(10.0, distance, 1e3).elevation_rad) - 2.0; }, 1e3, 1e5);
  row("range to 1 km height at 2°, radius 8,477.4 km", 27125.0, 0.5, "m", "height2range",
      earth.sight(10.0, distance_m, 1e3).slant_range_m);
  row("ground range to 1 km height at 2°, radius 8,477.4 km", 27106.0, 0.5, "m", "height2grndrange", distance_m);
  row("elevation of 8 km height 300 km away, radius 8,477.4 km", 0.5129, 5e-5, "°", "height2el",
      degrees(earth.sight(10.0, earth.distance_at_slant_range(10.0, 8e3, 300e3), 8e3).elevation_rad));
}

TEST(Truth, TheHorizonLiesWhereTheRayTouchesTheSphere) {
  const physics::EffectiveEarth earth = refracting_sphere();
  for (const auto& [name, height_ft, outside] :
       {std::tuple("5,000 ft", 5e3, 86.878), {"20,000 ft", 20e3, 173.716}, {"40,000 ft", 40e3, 245.598}}) {
    const double height_m = geo::Length::feet(height_ft).metres();
    const double distance_m =
        root_of([&](double distance) { return earth.sight(height_m, distance, 0.0).sin_grazing; }, 1e3, 1e6);
    expect_row({"Refraction", std::string("horizon from ") + name + ", 4/3 earth", outside, 0.002, "NM",
                "R arccos(R / (R + h)), R = 4/3 of 6,371,008.77 m", "closed form"},
               geo::Length::metres(distance_m).nautical_miles());
  }
}

TEST(Truth, TheSightLineToLevelGroundIsThatOfTheTriangle) {
  const physics::EffectiveEarth earth = refracting_sphere();
  struct Line {
    std::string of;
    double height_ft, distance_nm, elevation_deg;
  };
  const std::string source = "law of cosines, triangle with the centre of the 4/3 earth";
  for (const Line& line : {Line{"10,000 ft, 80 NM", 10e3, 80.0, -1.6780},
                           {"20,000 ft, 160 NM", 20e3, 160.0, -2.1773},
                           {"30,000 ft, 80 NM", 30e3, 80.0, -4.0293}})
    expect_row({"Refraction", "elevation of level ground from " + line.of + ", 4/3 earth", line.elevation_deg, 1e-4,
                "°", source, "closed form"},
               degrees(earth
                           .sight(geo::Length::feet(line.height_ft).metres(),
                                  geo::Length::nautical_miles(line.distance_nm).metres(), 0.0)
                           .elevation_rad));
  const physics::Sight sight =
      earth.sight(geo::Length::feet(20e3).metres(), geo::Length::nautical_miles(40.0).metres(), 0.0);
  expect_row({"Refraction", "slant range of ground from 20,000 ft, 40 NM", 74356.65, 0.05, "m", source, "closed form"},
             sight.slant_range_m);
  expect_row({"Refraction", "grazing angle from 20,000 ft, 40 NM", 4.45270, 1e-4, "°", source, "closed form"},
             degrees(std::asin(sight.sin_grazing)));
}

TEST(Truth, TheEffectiveRadiusIsThatOfTheStandardGradient) {
  expect_row({"Refraction", "effective earth radius, standard atmosphere", 8477.4, 20.0, "km",
              "MathWorks Radar Toolbox, effearthradius, gradient −39e-9 1/m", "4/3 is a round number"},
             refracting_sphere().radius_m() / 1000.0);
}

TEST(Truth, GeodesicsAreThoseOfKarney) {
  const auto row = [](const std::string& term, double outside, double tolerance, const std::string& unit,
                      const std::string& table, double ours) {
    expect_row(
        {"Geodesics", term, outside, tolerance, unit, "Karney 2013, J. Geodesy 87, " + table, "the table's last digit"},
        ours);
  };
  const auto end =
      geo::GeodesicRay({40.0, 0.0}, geo::Bearing::degrees(30.0)).position_and_azimuth(geo::Length::metres(1e7));
  row("latitude 10,000 km from 40° N on 30°", 41.79331020506, 1e-10, "°", "table 2", end.point.latitude_deg);
  row("longitude 10,000 km from 40° N on 30°", 137.84490004377, 1e-10, "°", "table 2", end.point.longitude_deg);
  row("azimuth 10,000 km from 40° N on 30°", 149.09016931807, 1e-10, "°", "table 2", end.azimuth.degrees());
  const auto near = geo::geodesic_inverse({-30.12345, 0.0}, {-30.12344, 0.00005});
  row("distance (−30.12345°, 0°) to (−30.12344°, 0.00005°)", 4.944208, 1e-6, "m", "table 3", near.distance.metres());
  const auto far = geo::geodesic_inverse({-30.0, 0.0}, {29.9, 179.8});
  row("distance (−30°, 0°) to (29.9°, 179.8°)", 19989832.827610, 1e-6, "m", "tables 4 to 6", far.distance.metres());
}

TEST(Truth, GeodesicsAreThoseOfTheTestSet) {
  const std::string source = "GeodTest.dat, Karney 2010, doi:10.5281/zenodo.32156, line 1";
  const auto line = geo::geodesic_inverse({36.530042355041, 0.0}, {-48.164270779097768864, 5.762344694676510456});
  expect_row({"Geodesics", "distance (36.53°, 0°) to (−48.16°, 5.76°)", 9398502.0434687, 1e-6, "m", source,
              "accuracy of GeographicLib: 15 nm"},
             line.distance.metres());
  expect_row({"Geodesics", "azimuth (36.53°, 0°) to (−48.16°, 5.76°)", 176.125875162171, 1e-10, "°", source,
              "the set has 12 decimals"},
             line.azimuth_at_start.degrees());
}

TEST(Truth, TheEllipsoidIsWgs84) {
  const auto row = [](const std::string& term, double outside, double tolerance, const std::string& why, double ours) {
    expect_row({"Earth", term, outside, tolerance, "m", "NIMA TR8350.2, WGS84, derived geometric constants", why},
               ours);
  };
  const std::string why = "the constant's last digit";
  row("radius of curvature at a pole", 6399593.6258, 1e-4, why, geo::radius_of_curvature(90.0, {}).metres());
  row("radius of curvature along the equator", 6378137.0, 1e-4, why,
      geo::radius_of_curvature(0.0, geo::Bearing::degrees(90.0)).metres());
  row("semi-minor axis", 6356752.3142, 1e-4, why, geo::ecef_from_geodetic({90.0, 0.0}, {}).z);
  row("mean radius", 6371008.7714, 0.05, "YARS rounds it to 0.1 m", geo::kMeanEarthRadius_m);
}

TEST(Truth, FramesAreThoseOfTheGuidanceNote) {
  const geo::GeoPoint point{53.0 + 48.0 / 60.0 + 33.82 / 3600.0, 2.0 + 7.0 / 60.0 + 46.38 / 3600.0};
  const auto height = geo::HeightAboveEllipsoid::metres(73.0);
  const auto row = [](const std::string& term, double outside, const std::string& section, double ours) {
    expect_row({"Frames", term, outside, 1e-3, "m", "EPSG Guidance Note 7-2, " + section, "the example's last digit"},
               ours);
  };
  const geo::Vector3 ecef = geo::ecef_from_geodetic(point, height);
  const std::string geocentric = "geographic/geocentric conversions, example";
  row("ECEF x of 53°48′33.82″ N 2°07′46.38″ E, 73 m", 3771793.968, geocentric, ecef.x);
  row("ECEF y of 53°48′33.82″ N 2°07′46.38″ E, 73 m", 140253.342, geocentric, ecef.y);
  row("ECEF z of 53°48′33.82″ N 2°07′46.38″ E, 73 m", 5124304.349, geocentric, ecef.z);
  const geo::LocalTangentFrame frame({55.0, 5.0}, geo::HeightAboveEllipsoid::metres(200.0));
  const geo::Vector3 enu = frame.enu_from_geodetic(point, height);
  const std::string topocentric = "geocentric/topocentric conversions, example";
  row("the same point east of 55° N 5° E, 200 m", -189013.869, topocentric, enu.x);
  row("the same point north of 55° N 5° E, 200 m", -128642.040, topocentric, enu.y);
  row("the same point above 55° N 5° E, 200 m", -4220.171, topocentric, enu.z);
}

// Checksum of GDAL over the posts of a cell, from north to south.
int gdal_checksum(const model::terrain::Cell& cell) {
  constexpr std::array<int, 11> kPrimes{7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43};
  int sum = 0;
  std::size_t number = 0;
  for (int row = cell.rows() - 1; row >= 0; --row)
    for (int column = 0; column < cell.columns(); ++column)
      sum = (sum + cell.post(row, column) % kPrimes[number++ % kPrimes.size()]) & 0xffff;
  return sum;
}

TEST(Truth, DtedHasThePostsThatGdalReads) {
  YARS_NEEDS_SHARED_DATA();
  const auto reading = model::terrain::read_dted(test::shared_data() / "malformed/n43_bad_crc.dt0", {43, -80});
  ASSERT_TRUE(reading.has_value());
  expect_row({"Elevation", "GDAL's checksum of the posts of n43.dt0", 49187.0, 0.5, "",
              "GDAL autotest, dted.py, n43.dt0", "a whole number"},
             gdal_checksum(reading->cell));
}

TEST(Truth, HgtHasTheHeightOfASummit) {
  YARS_NEEDS_SHARED_DATA();
  const auto reading = model::terrain::read_hgt(test::shared_data() / "srtm/N44W072.hgt", {44, -72});
  ASSERT_TRUE(reading.has_value());
  const auto& cell = reading->cell;
  // Highest post within 200 m.
  int highest = 0;
  const int row = static_cast<int>(std::lround(0.2705 * 1200.0)),
            column = static_cast<int>(std::lround(0.69675 * 1200.0));
  for (int i = row - 2; i <= row + 2; ++i)
    for (int k = column - 2; k <= column + 2; ++k) highest = std::max(highest, static_cast<int>(cell.post(i, k)));
  expect_row({"Elevation", "Mount Washington, 44.2705° N 71.3033° W", 1916.6, 16.0, "m",
              "National Geodetic Survey, 6,288.2 ft; file N44W072.hgt", "accuracy of SRTM: 16 m"},
             highest);
}

// Pixels of the middle column of a map that a label marks, in the rows [0, end).
double marked(const std::vector<std::uint8_t>& label, int size, int end) {
  double count = 0.0;
  for (int row = 0; row < end; ++row)
    count += label[static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(size / 2)];
  return count;
}

// A box of 60 m, 60 m long, with its middle 10 km away and 4 km below the aircraft.
TEST(Truth, ABoxHasShadowAndLayoverOfTheTextbook) {
  test::Viewpoint view;
  view.distance_m = 10e3;
  view.above_m = 4000.0;
  const auto scene = std::make_shared<test::MadeUpScene>(test::kTarget, test::kGround_m);
  scene->add({0.0, 0.0, view.from_deg, 60.0, 40.0, 60.0, test::kEarthenWorks});
  const auto map = test::make_patch(test::bare_map(1000), test::order_from(view),
                                    test::ground_of(model::terrain::flat(test::kGround_m)), scene, 1,
                                    model::hrm::kMaxSectorPoints, model::hrm::LabelUse::surfaces);
  const int size = map.image().size;
  const double pixel_m = view.window_m / size;
  const std::string source = "Oliver and Quegan 1998, Understanding SAR Images";
  const std::string why = "pixels of 1.24 m";
  // The ray over the far edge of the roof meets the ground behind the box. Rows begin at the far edge of the map.
  const int behind = static_cast<int>((0.5 * view.window_m - 30.0) / pixel_m);
  expect_row({"Patch maps", "shadow h / tan ψ of 60 m, tan ψ 3,940/10,030", 152.74, 2.5, "m", source, why},
             marked(map.labels().shadow, size, behind) * pixel_m);
  expect_row({"Patch maps", "layover h tan ψ of 60 m, tan ψ 4,000/9,970", 24.07, 2.5, "m", source, why},
             marked(map.labels().layover, size, size) * pixel_m);
}

}  // namespace
}  // namespace yars::truth
