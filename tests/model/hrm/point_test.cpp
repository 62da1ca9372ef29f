// Point targets on a patch map: a corner reflector (a mover at rest) and movers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/radar/configuration.hpp"
#include "lib/radar/mission.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::test {
namespace {

radar::RadarConfiguration with_mover(int size, const radar::Mover& mover) {
  radar::RadarConfiguration configuration = bare_map(size);
  configuration.receiver.land_gamma_db = -120.0;
  configuration.fidelity.map_response = true;
  configuration.world.movers.push_back(mover);
  return configuration;
}

struct Pixel {
  int column, row;
};

Pixel brightest(const hrm::MapImage& image) {
  const auto at = static_cast<int>(std::max_element(image.power.begin(), image.power.end()) - image.power.begin());
  return {at % image.size, at / image.size};
}

hrm::MapPoint point_of(const hrm::PatchFormation& process, double column, double row) {
  const double pixel_m = process.geometry().window_m() / process.image().size;
  const double edge_m = 0.5 * process.geometry().window_m();
  return {(column + 0.5) * pixel_m - edge_m, edge_m - (row + 0.5) * pixel_m};
}

// Width [pixels] of the response along a row, at half of its peak power.
double half_power_width(const hrm::MapImage& image, Pixel peak) {
  const auto power = [&](int column) { return static_cast<double>(image.power[image.at(column, peak.row)]); };
  double width = 0.0;
  for (const int step : {-1, 1}) {
    int column = peak.column;
    while (power(column + step) > 0.5 * power(peak.column)) column += step;
    const double fraction = (power(column) - 0.5 * power(peak.column)) / (power(column) - power(column + step));
    width += std::abs(column - peak.column) + fraction;
  }
  return width;
}

TEST(CornerReflector, StandsAtItsPositionAsWideAsACellWithTaylorsSidelobes) {
  constexpr int kSize = 1024;
  const hrm::MapPoint wanted{123.4, -77.7};
  for (const double from_deg : {0.0, 130.0, 250.0}) {
    Viewpoint view;
    view.from_deg = from_deg;
    const hrm::PatchOrder order = order_from(view);
    const hrm::PatchGeometry geometry(order, bare_map(), kGround_m);
    const auto process = make_patch(with_mover(kSize, {"corner", geometry.position_of(wanted), 0.0, 0.0, 1000.0, 0.0}),
                                    order, ground_of(model::terrain::flat(kGround_m)));
    const hrm::MapImage& image = process.image();
    const Pixel peak = brightest(image);
    const hrm::MapPoint found = point_of(process, peak.column, peak.row);
    const double pixel_m = view.window_m / kSize;
    EXPECT_NEAR(found.right_m, wanted.right_m, pixel_m);
    EXPECT_NEAR(found.up_m, wanted.up_m, pixel_m);
    const double cell = static_cast<double>(kSize) / radar::kMapCells;
    EXPECT_NEAR(half_power_width(image, peak), cell, 0.08 * cell);
    double sidelobe = 0.0;
    for (int column = peak.column + static_cast<int>(std::ceil(1.9 * cell)); column < image.size; ++column)
      sidelobe = std::max(sidelobe, static_cast<double>(image.power[image.at(column, peak.row)]));
    const double level_db =
        10.0 * std::log10(sidelobe / static_cast<double>(image.power[image.at(peak.column, peak.row)]));
    EXPECT_NEAR(level_db, -35.0, 1.5);
    EXPECT_NEAR(cross_section_m2(process), 1000.0, 1.0);
  }
}

TEST(CornerReflector, BehindAHillIsNotSeen) {
  const hrm::PatchOrder order = order_from({});
  const hrm::PatchGeometry geometry(order, bare_map(), kGround_m);
  const model::terrain::TerrainAxis axis{order.apex, geometry.up()};
  const auto hill = model::terrain::ridge(axis, geometry.distance_m() - 200.0, 150.0, 60.0);
  const auto ground = ground_of([&](geo::GeoPoint position) { return kGround_m + hill(position); });
  const radar::Mover behind{"behind", geometry.position_of({0.0, -20.0}), 0.0, 0.0, 1000.0, 1.0};
  const radar::Mover beyond{"beyond", geometry.position_of({0.0, 400.0}), 0.0, 0.0, 1000.0, 1.0};
  EXPECT_LT(cross_section_m2(make_patch(with_mover(240, behind), order, ground)), 1.0);
  EXPECT_GT(cross_section_m2(make_patch(with_mover(240, beyond), order, ground)), 990.0);
}

// Centre of the map's power.
hrm::MapPoint middle_of(const hrm::PatchFormation& process) {
  const hrm::MapImage& image = process.image();
  double sum = 0.0;
  double right_m = 0.0;
  double up_m = 0.0;
  for (int row = 0; row < image.size; ++row) {
    for (int column = 0; column < image.size; ++column) {
      const auto power = static_cast<double>(image.power[image.at(column, row)]);
      const hrm::MapPoint point = point_of(process, column, row);
      sum += power;
      right_m += power * point.right_m;
      up_m += power * point.up_m;
    }
  }
  return {right_m / sum, up_m / sum};
}

TEST(Mover, IsDisplacedByRangeTimesItsRadialSpeedOverTheAircraftsCrossRangeSpeed) {
  Viewpoint view;
  view.distance_m = 20.0 * geo::kMetresPerNauticalMile;
  view.window_m = 3.3 * geo::kMetresPerNauticalMile;
  const double speed_mps = geo::Speed::knots(480.0).metres_per_second();
  for (const double squint_deg : {90.0, 40.0, -90.0, -140.0}) {
    for (const double receding_mps : {5.0, -3.0}) {
      hrm::PatchOrder order = order_from(view);
      order.ground_track = order.ground_track + geo::Angle::degrees(90.0 - squint_deg);
      const hrm::PatchGeometry geometry(order, bare_map(), kGround_m);
      radar::Mover mover{"mover", order.centre, std::abs(receding_mps), geometry.up().degrees(), 1000.0, 0.0};
      if (receding_mps < 0.0) mover.heading_deg += 180.0;
      const auto process = make_patch(with_mover(480, mover), order, ground_of(model::terrain::flat(kGround_m)));
      const hrm::MapPoint found = middle_of(process);
      // A receding mover has a lower Doppler frequency and appears aft. In a look to the right of the track, aft is
      // right.
      const double shift_m =
          view.distance_m * receding_mps / (speed_mps * std::sin(squint_deg * geo::kRadiansPerDegree));
      EXPECT_NEAR(found.right_m, shift_m, 0.02 * std::abs(shift_m)) << squint_deg << ' ' << receding_mps;
      // It appears at its position in the middle of the formation time.
      EXPECT_NEAR(found.up_m, 0.5 * receding_mps * process.formation().seconds(), 12.0);
    }
  }
}

TEST(Mover, ThatMovesAcrossTheLineOfSightIsSmearedAndNotDisplaced) {
  const hrm::PatchOrder order = order_from({});
  const hrm::PatchGeometry geometry(order, bare_map(), kGround_m);
  const radar::Mover mover{"mover", order.centre, 20.0, geometry.up().degrees() + 90.0, 1000.0, 0.0};
  const auto process = make_patch(with_mover(480, mover), order, ground_of(model::terrain::flat(kGround_m)));
  const double path_m = 20.0 * process.formation().seconds();
  const hrm::MapPoint found = middle_of(process);
  EXPECT_NEAR(found.right_m, 0.5 * path_m, 3.0);
  EXPECT_NEAR(found.up_m, 0.0, 3.0);
  const hrm::MapImage& image = process.image();
  const float most = *std::max_element(image.power.begin(), image.power.end());
  int bright = 0;
  for (int column = 0; column < image.size; ++column) {
    float top = 0.0F;
    for (int row = 0; row < image.size; ++row) top = std::max(top, image.power[image.at(column, row)]);
    if (top > 0.5F * most) ++bright;
  }
  const double pixel_m = geometry.window_m() / image.size;
  EXPECT_NEAR(bright * pixel_m, 2.0 * path_m, 2.0 * pixel_m);
}

TEST(PatchPoints, FluctuateFromMapToMapWithNoise) {
  radar::RadarConfiguration configuration = with_mover(240, {.position = kTarget});
  const auto ground = ground_of(model::terrain::flat(kGround_m));
  hrm::PatchOrder order = order_from({});
  const auto seen_m2 = [&](std::uint32_t map) {
    order.map = map;
    return cross_section_m2(make_patch(configuration, order, ground));
  };
  EXPECT_EQ(seen_m2(1), seen_m2(2));
  configuration.fidelity.noise = true;
  EXPECT_NE(seen_m2(1), seen_m2(2));
  EXPECT_EQ(seen_m2(1), seen_m2(1));
}

// The aircraft is south of the target.
TEST(PatchPoints, OfAReflectorHaveAnAspect) {
  const auto ground = ground_of(model::terrain::flat(kGround_m));
  const auto seen_m2 = [&](int facing_deg) {
    const radar::Mover mover{.position = kTarget, .echo = radar::TargetEcho::trihedral, .facing_deg = facing_deg};
    return cross_section_m2(make_patch(with_mover(240, mover), order_from({}), ground));
  };
  EXPECT_GT(seen_m2(180), 700.0);
  EXPECT_NEAR(seen_m2(160) / seen_m2(180), 0.5, 0.06);
  EXPECT_LT(seen_m2(90), 1.0);
}

// A world that was changed at run time comes with the environment, in place of the configuration's movers.
TEST(PatchPoints, OfAChangedWorldReplaceTheConfiguredOnes) {
  const auto picture_of = [](const radar::RadarConfiguration& configuration,
                             std::optional<std::vector<model::physics::MovingPoint>> movers) {
    hrm::PatchFormation process(configuration, executor_of(1));
    const auto ground = ground_of(model::terrain::flat(kGround_m));
    process.begin(order_from({}));
    hrm::PatchEnvironment environment{ground, ground, nullptr};
    environment.movers = std::move(movers);
    process.set_environment(environment);
    while (process.state() != hrm::PatchState::done) process.advance();
    return process.picture();
  };
  const radar::RadarConfiguration without = bare_map();
  radar::RadarConfiguration with = without;
  with.world.movers.push_back({.name = "truck", .position = kTarget, .cross_section_m2 = 1e6});
  const auto shown = picture_of(with, std::nullopt), empty = picture_of(without, std::nullopt);
  EXPECT_NE(shown, empty);
  EXPECT_EQ(picture_of(without, model::physics::moving_points(with.world)), shown);
  EXPECT_EQ(picture_of(with, std::vector<model::physics::MovingPoint>{}), empty);
}

}  // namespace
}  // namespace yars::test
