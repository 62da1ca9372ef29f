// Ground without objects on a patch map: level, behind a ridge, with voids, in the blind zone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/radar/configuration.hpp"
#include "lib/radar/mission.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::test {
namespace {

namespace terrain = model::terrain;

TEST(LevelGround, ReturnsItsGammaTimesTheSineOfItsGrazingAngle) {
  for (const int oversampling : {1, 2}) {
    for (const double window_nm : {0.67, 4.7}) {
      radar::RadarConfiguration configuration = bare_map(240);
      configuration.fidelity.earth = radar::EarthModel::ellipsoid;
      configuration.fidelity.map_oversampling = oversampling;
      Viewpoint view;
      view.window_m = window_nm * geo::kMetresPerNauticalMile;
      const auto process = make_patch(configuration, order_from(view), ground_of(terrain::flat(kGround_m)));
      const hrm::MapImage& image = process.image();
      const hrm::PatchGeometry& geometry = process.geometry();
      for (int row = 3; row < image.size; row += 18) {
        for (int column = 1; column < image.size; column += 14) {
          const double pixel_m = view.window_m / image.size;
          const double ahead_m = geometry.distance_m() + 0.5 * view.window_m - (row + 0.5) * pixel_m;
          const double right_m = (column + 0.5) * pixel_m - 0.5 * view.window_m;
          const double sine = geometry.earth().sight(view.above_m, std::hypot(ahead_m, right_m), 0.0).sin_grazing;
          const double expected = gamma_of(configuration, 0) * sine / geometry.sin_grazing();
          EXPECT_NEAR(static_cast<double>(image.power[image.at(column, row)]), expected, 0.01 * expected)
              << row << ' ' << column;
        }
      }
    }
  }
}

// Rows of the middle column that return less than half of level ground.
int dark_rows(const hrm::MapImage& image, double gamma) {
  int dark = 0;
  for (int row = 0; row < image.size; ++row)
    if (!(static_cast<double>(image.power[image.at(image.size / 2, row)]) > 0.5 * gamma)) ++dark;
  return dark;
}

TEST(Ridge, ShadowsTheWindowUpToTheEndOfItsShadow) {
  const radar::RadarConfiguration configuration = bare_map(240);
  Viewpoint view;
  view.window_m = 4000.0;
  const hrm::PatchOrder order = order_from(view);
  const hrm::PatchGeometry geometry(order, configuration, kGround_m);
  // Round hill of 600 m at 16 km. The line of sight from 3000 m over its crest meets the ground near 20 km, the centre.
  const auto hill = [](double distance_m) {
    const double off = (distance_m - 16000.0) / 1500.0;
    return std::abs(off) < 1.0 ? 600.0 * (1.0 - off * off) : 0.0;
  };
  const auto process = make_patch(configuration, order, ground_of([&](geo::GeoPoint position) {
                                    const hrm::MapPoint point = geometry.point_of(position);
                                    return kGround_m + hill(std::hypot(point.right_m, point.up_m + view.distance_m));
                                  }));
  double horizon = -1.0;
  for (double distance_m = 14000.0; distance_m < 18000.0; distance_m += 1.0)
    horizon = std::max(horizon, (hill(distance_m) - view.above_m) / distance_m);
  const double dark_m = view.above_m / -horizon - (view.distance_m - 0.5 * view.window_m);
  const double pixel_m = view.window_m / configuration.fidelity.map_size;
  EXPECT_NEAR(dark_rows(process.image(), gamma_of(configuration, 0)) * pixel_m, dark_m, pixel_m);
  const auto open = make_patch(configuration, order, ground_of(terrain::flat(kGround_m)));
  EXPECT_EQ(dark_rows(open.image(), gamma_of(configuration, 0)), 0);
}

TEST(Void, IsDarkAndHidesNothing) {
  const radar::RadarConfiguration configuration = bare_map(240);
  const hrm::PatchOrder order = order_from({});
  const hrm::PatchGeometry geometry(order, configuration, kGround_m);
  const auto with_void = [&](geo::GeoPoint position) {
    const hrm::MapPoint point = geometry.point_of(position);
    return std::hypot(point.right_m, point.up_m - 200.0) < 100.0 ? std::numeric_limits<double>::quiet_NaN() : kGround_m;
  };
  const auto process = make_patch(configuration, order, ground_of(with_void));
  const hrm::MapImage& image = process.image();
  const auto at = [&](double right_m, double up_m) {
    const double pixel_m = geometry.window_m() / image.size;
    return image.power[image.at(static_cast<int>(0.5 * image.size + right_m / pixel_m),
                                static_cast<int>(0.5 * image.size - up_m / pixel_m))];
  };
  EXPECT_EQ(at(0.0, 200.0), 0.0F);
  EXPECT_NEAR(at(0.0, 310.0), gamma_of(configuration, 0), 0.02 * gamma_of(configuration, 0));
  EXPECT_NEAR(at(0.0, 80.0), gamma_of(configuration, 0), 0.02 * gamma_of(configuration, 0));
}

// Voids at the near edge, then a valley 300 m below the map's centre.
TEST(Void, AtTheNearEdgeHidesNoLowGroundBehindIt) {
  const radar::RadarConfiguration configuration = bare_map(240);
  const hrm::PatchOrder order = order_from({});
  const hrm::PatchGeometry geometry(order, configuration, kGround_m);
  const auto valley = [&](geo::GeoPoint position) {
    const double up_m = geometry.point_of(position).up_m;
    if (up_m < -560.0) return std::numeric_limits<double>::quiet_NaN();
    return up_m < -100.0 ? kGround_m - 300.0 : kGround_m;
  };
  const auto process = make_patch(configuration, order, ground_of(valley));
  const double pixel_m = geometry.window_m() / process.image().size;
  // Ground 300 m below the map plane appears 300 m x 3000 / 20000 = 45 m farther out.
  const int row = static_cast<int>((0.5 * geometry.window_m() + 520.0 - 45.0) / pixel_m);
  for (const int column : {40, 120, 200})
    EXPECT_GT(process.image().power[process.image().at(column, row)], 0.5 * gamma_of(configuration, 0)) << column;
}

TEST(Void, EverywhereGivesABlackMap) {
  const auto nothing = ground_of(terrain::flat(std::numeric_limits<double>::quiet_NaN()));
  const auto process = make_patch(bare_map(64), order_from({}), nothing);
  for (const float power : process.image().power) EXPECT_EQ(power, 0.0F);
}

TEST(BlindZone, IsBlankOnBothSidesOfTheGroundTrackAndNowhereElse) {
  radar::RadarConfiguration configuration = bare_map(240);
  configuration.fidelity.noise = true;
  Viewpoint view;
  view.window_m = 8000.0;
  hrm::PatchOrder order = order_from(view);
  // The edge of the zone runs through the middle of the window.
  const double edge_deg = configuration.high_resolution.blind_zone_deg;
  order.ground_track = order.ground_track + geo::Angle::degrees(90.0 - edge_deg);
  const auto process = make_patch(configuration, order, ground_of(terrain::flat(kGround_m)));
  const hrm::MapImage& image = process.image();
  for (int row = 0; row < image.size; row += 7) {
    for (int column = 0; column < image.size; ++column) {
      if (std::abs(column - image.size / 2) < 2) continue;
      const std::size_t at = image.at(column, row);
      // The ground track and the blind zone are to the left of the middle.
      if (column < image.size / 2) {
        EXPECT_EQ(process.picture()[at], 0) << row << ' ' << column;
      } else {
        EXPECT_GT(image.power[at], 0.0F) << row << ' ' << column;
      }
    }
  }
}

// Compares every pixel of the map with radar::in_blind_zone() at the pixel's angle. Returns the number of blind pixels.
int expect_zone_by_angle(const hrm::PatchGeometry& geometry, geo::Angle squint, double half_width_deg, int size) {
  const hrm::BlindZone zone(geometry, geometry.up() - squint, half_width_deg, size);
  const double pixel_m = geometry.window_m() / size;
  const double edge_m = 0.5 * geometry.window_m();
  hrm::MapImage image(size);
  std::fill(image.power.begin(), image.power.end(), 1.0F);
  // Two calls, as from two threads.
  const bool first = zone.blank(0, size / 3, image);
  const bool second = zone.blank(size / 3, size, image);
  int blind = 0;
  int wrong = 0;
  for (int row = 0; row < size; ++row) {
    const double ahead_m = geometry.distance_m() + edge_m - (row + 0.5) * pixel_m;
    for (int column = 0; column < size; ++column) {
      const geo::Angle off_centre = geo::Angle::radians(std::atan2((column + 0.5) * pixel_m - edge_m, ahead_m));
      const bool expected = radar::in_blind_zone(geometry.squint(geometry.up() - squint) + off_centre, half_width_deg);
      if (expected) ++blind;
      if (image.power[image.at(column, row)] != (expected ? -1.0F : 1.0F)) ++wrong;
    }
  }
  EXPECT_EQ(wrong, 0) << "squint " << squint.degrees() << " deg, half width " << half_width_deg << " deg, distance "
                      << geometry.distance_m() << " m, " << size << " pixels";
  EXPECT_EQ(first || second, blind > 0);
  EXPECT_TRUE(zone.may_reach_map() || blind == 0);
  return blind;
}

hrm::PatchGeometry geometry_at(double distance_m, double window_m) {
  Viewpoint view;
  view.distance_m = distance_m;
  view.window_m = window_m;
  return {order_from(view), bare_map(64), kGround_m};
}

TEST(BlindZone, HasThePixelsThatLieInItByAngle) {
  constexpr double kWindow_m = 8000.0;
  // The aircraft in the middle of the window, elsewhere in it, on its edge, before it and far from it. From 45 degrees
  // on the two sectors together are half a turn and more.
  for (const double distance_m : {0.0, 1.0, 2500.0, 4000.0, 5700.0, 20000.0, 200000.0}) {
    const hrm::PatchGeometry geometry = geometry_at(distance_m, kWindow_m);
    int mixed = 0;
    for (const int size : {16, 33}) {
      for (const double half_width_deg : {0.0, 0.5, 8.0, 30.0, 45.0, 60.0, 90.0}) {
        for (double squint_deg = -180.0; squint_deg < 180.0; squint_deg += 7.5) {
          for (const double off_deg : {0.0, -half_width_deg, half_width_deg, 1.3}) {
            const geo::Angle squint = geo::Angle::degrees(squint_deg + off_deg);
            const int blind = expect_zone_by_angle(geometry, squint, half_width_deg, size);
            if (blind > 0 && blind < size * size) ++mixed;
          }
        }
      }
    }
    EXPECT_GT(mixed, 30) << distance_m;
  }
}

// Aircraft at the centre of a window of whole metres: the pixels' coordinates are exact, and whole diagonals, rows and
// columns of pixels lie on an edge.
TEST(BlindZone, DecidesPixelsOnAnEdgeByAngle) {
  for (const int size : {64, 65}) {
    const hrm::PatchGeometry geometry = geometry_at(0.0, size);
    for (double squint_deg = -180.0; squint_deg <= 180.0; squint_deg += 45.0)
      for (const double half_width_deg : {0.0, 45.0, 90.0})
        expect_zone_by_angle(geometry, geo::Angle::degrees(squint_deg), half_width_deg, size);
  }
}

TEST(BlindZone, DoesNotReachMapsFarFromTheGroundTrack) {
  const hrm::PatchGeometry geometry = geometry_at(20000.0, 8000.0);
  const auto reaches = [&](double squint_deg) {
    return hrm::BlindZone(geometry, geometry.up() - geo::Angle::degrees(squint_deg), 8.0, 64).may_reach_map();
  };
  // The map subtends 14.0 degrees either side of its centre.
  for (const double squint_deg : {-178.0, -158.5, -21.5, 0.0, 21.5, 158.5})
    EXPECT_TRUE(reaches(squint_deg)) << squint_deg;
  for (const double squint_deg : {-157.5, -90.0, -22.5, 22.5, 90.0, 157.5})
    EXPECT_FALSE(reaches(squint_deg)) << squint_deg;
}

TEST(BlindZone, IsTheSameWithAnyNumberOfThreads) {
  radar::RadarConfiguration configuration = bare_map(240);
  configuration.fidelity.map_response = true;
  hrm::PatchOrder order = order_from({});
  order.ground_track = order.ground_track + geo::Angle::degrees(90.0 - configuration.high_resolution.blind_zone_deg);
  const auto ground = ground_of(terrain::flat(kGround_m));
  const auto one = make_patch(configuration, order, ground);
  const auto four = make_patch(configuration, order, ground, nullptr, 4);
  EXPECT_TRUE(one.image().blind);
  EXPECT_TRUE(four.image().blind);
  EXPECT_EQ(one.image().power, four.image().power);
  EXPECT_EQ(one.picture(), four.picture());
}

}  // namespace
}  // namespace yars::test
