// Bent rays: the tracer against Snell's law and finer steps; the two lifts of a sweep against the tracer.
#include "lib/geo/refraction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "tests/model/physics/visible_rays.hpp"

namespace yars::model::rbm {
namespace {

constexpr double kMeanRadius_m = geo::kMeanEarthRadius_m;

TEST(TracedRay, KeepsTheInvariantOfSnell) {
  const geo::RefractivityProfile air = geo::kMeanRefractivity;
  const auto invariant_m = [&](double height_m, double elevation_rad) {
    return air.index(height_m) * (kMeanRadius_m + height_m) * std::cos(elevation_rad);
  };
  for (const test::VisibleRay& ray : test::visible_rays(kMeanRadius_m)) {
    const double begins_m = invariant_m(ray.altitude_m, ray.traced.elevation_rad);
    const double ends_m = invariant_m(ray.height_m, ray.traced.end.elevation_rad);
    EXPECT_NEAR(ends_m / begins_m, 1.0, 1e-10) << ray.altitude_m << " m, " << ray.distance_m << " m";
    EXPECT_NEAR(ray.traced.end.height_m, ray.height_m, 1e-3);
  }
}

TEST(TracedRay, IsStraightWithoutAir) {
  for (const double altitude_m : {150.0, 9144.0})
    for (const double distance_m : {500.0, 40e3, 150e3}) {
      const auto ray = geo::trace_ray({0.0, 1e-4}, kMeanRadius_m, altitude_m, distance_m, 100.0);
      const auto sight = physics::EffectiveEarth(kMeanRadius_m).sight(altitude_m, distance_m, 100.0);
      EXPECT_NEAR(ray.elevation_rad, sight.elevation_rad, 1e-9);
      EXPECT_NEAR(ray.end.length_m, sight.slant_range_m, 1e-4);
    }
}

// Half the step changes no elevation by 0.001 mrad: 100 steps over half the way, and again from there.
TEST(TracedRay, DoesNotDependOnItsSteps) {
  const geo::RefractivityProfile air = geo::kMeanRefractivity;
  for (const test::VisibleRay& ray : test::visible_rays(kMeanRadius_m)) {
    const geo::RayEnd half =
        launch_ray(air, kMeanRadius_m, ray.altitude_m, ray.traced.elevation_rad, 0.5 * ray.distance_m);
    const geo::RayEnd end = launch_ray(air, kMeanRadius_m, half.height_m, half.elevation_rad, 0.5 * ray.distance_m);
    EXPECT_LT(std::abs(end.height_m - ray.height_m) / ray.traced.end.length_m, 1e-7)
        << ray.altitude_m << " m, " << ray.distance_m << " m, " << ray.height_m << " m";
  }
}

struct Errors {
  double elevation_mrad = 0.0, grazing_mrad = 0.0, range = 0.0;
};

Errors worst_errors(radar::Algorithm algorithm, geo::GeoPoint apex, geo::Bearing azimuth) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.algorithm = algorithm;
  const physics::GeometryParameters parameters(configuration);
  Errors worst;
  for (const double altitude_ft : test::kObservers_ft) {
    const auto altitude = geo::AltitudeMsl::feet(altitude_ft);
    const physics::EffectiveEarth earth = physics::effective_earth(parameters, apex, altitude, azimuth);
    Errors here;
    for (const test::VisibleRay& ray : test::visible_rays(earth.radius_m(), altitude.metres())) {
      const physics::Sight sight = earth.sight(ray.altitude_m, ray.distance_m, ray.height_m);
      const auto raise = [](double& to, double error) { to = std::max(to, std::abs(error)); };
      raise(here.elevation_mrad, 1e3 * (sight.elevation_rad - ray.traced.elevation_rad));
      raise(here.elevation_mrad,
            1e3 * (std::atan(earth.tangent(ray.altitude_m, ray.distance_m, ray.height_m)) - ray.traced.elevation_rad));
      const double grazing_rad = std::asin(std::clamp(sight.sin_grazing, -1.0, 1.0));
      if (ray.distance_m > 2000.0) raise(here.grazing_mrad, 1e3 * (grazing_rad + ray.traced.end.elevation_rad));
      raise(here.range, sight.slant_range_m / ray.traced.end.optical_m - 1.0);
    }
    std::printf("%6.0f ft: elevation %.4f, grazing angle %.4f mrad, slant range %.2e\n", altitude_ft,
                here.elevation_mrad, here.grazing_mrad, here.range);
    worst = {std::max(worst.elevation_mrad, here.elevation_mrad), std::max(worst.grazing_mrad, here.grazing_mrad),
             std::max(worst.range, here.range)};
  }
  return worst;
}

TEST(Refraction, OfTheFastPathIsThatOfTracedRays) {
  for (const double latitude_deg : {0.0, 45.0, 90.0}) {
    const Errors worst = worst_errors(radar::Algorithm::standard, {latitude_deg, 0.0}, {});
    EXPECT_LT(worst.elevation_mrad, 0.05) << latitude_deg;
    EXPECT_LT(worst.grazing_mrad, 0.12) << latitude_deg;
    EXPECT_LT(worst.range, 4e-4) << latitude_deg;
  }
}

TEST(Refraction, OfTheReferenceIsThatOfTracedRays) {
  for (const double latitude_deg : {0.0, 45.0, 90.0}) {
    const Errors worst = worst_errors(radar::Algorithm::reference, {latitude_deg, 0.0}, {});
    EXPECT_LT(worst.elevation_mrad, 0.005) << latitude_deg;
    EXPECT_LT(worst.grazing_mrad, 0.005) << latitude_deg;
  }
}

// The sum over the traced ray is made of launched parts of it.
TEST(Refraction, BendsThePathThroughTheGases) {
  const radar::RadarConfiguration configuration;
  const physics::GasPath path(configuration);
  const physics::GasProfile profile(configuration.world.atmosphere, configuration.receiver.frequency_ghz);
  for (const double altitude_ft : {5e3, 20e3, 40e3}) {
    const auto altitude = geo::AltitudeMsl::feet(altitude_ft);
    const physics::EffectiveEarth earth = physics::effective_earth(configuration, {}, altitude, {});
    for (const double distance_m : {20e3, 75e3, 148e3, 290e3}) {
      const auto ray = geo::trace_ray(geo::kMeanRefractivity, earth.radius_m(), altitude.metres(), distance_m, 0.0);
      if (ray.end.elevation_rad > 0.0) continue;
      constexpr int kParts = 400;
      double expected_db = 0.0;
      geo::RayEnd at{altitude.metres(), ray.elevation_rad, 0.0, 0.0};
      for (int part = 0; part < kParts; ++part) {
        const geo::RayEnd next =
            launch_ray(geo::kMeanRefractivity, earth.radius_m(), at.height_m, at.elevation_rad, distance_m / kParts);
        expected_db += next.length_m * profile.db_per_m(0.5 * (at.height_m + next.height_m));
        at = next;
      }
      EXPECT_NEAR(path.one_way_db(earth, altitude.metres(), distance_m, 0.0), expected_db, 0.002 + 0.003 * expected_db)
          << altitude_ft << " ft, " << distance_m << " m";
    }
  }
}

TEST(Refraction, HasATangentThatFallsBeyondTheHorizon) {
  const radar::RadarConfiguration configuration;
  for (const double altitude_m : {0.0, 100.0, 3000.0, 12e3, 100e3}) {
    const physics::EffectiveEarth earth =
        physics::effective_earth(configuration, {}, geo::AltitudeMsl::metres(altitude_m), {});
    double before = 1.0;
    bool falls = false;
    for (double distance_m = 1000.0; distance_m < 1.85e6; distance_m += 2000.0) {
      const double tangent = earth.tangent(altitude_m, distance_m, 0.0);
      EXPECT_TRUE(!falls || tangent < before) << altitude_m << " m, " << distance_m << " m";
      falls = falls || (distance_m > 1000.0 && tangent < before);
      before = tangent;
    }
    EXPECT_TRUE(falls) << altitude_m;
  }
}

}  // namespace
}  // namespace yars::model::rbm
