// Rows of refraction in the exponential atmosphere: rays, horizons, shadows; the fast path against traced rays.
#include "lib/geo/refraction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "lib/radar/configuration.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "tests/model/physics/visible_rays.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

namespace physics = model::physics;

const std::string kSource = "another program: Snell's law, N = 313 exp(−0.1439 h/km), sphere";

double elevation_deg(double radians) {
  return radians / geo::kRadiansPerDegree;
}
double feet_m(double height_ft) {
  return geo::Length::feet(height_ft).metres();
}
double miles_m(double distance_nm) {
  return geo::Length::nautical_miles(distance_nm).metres();
}

physics::EffectiveEarth earth_from(radar::Algorithm algorithm, double height_ft, double factor = radar::kNotGiven) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.algorithm = algorithm;
  configuration.fidelity.earth = radar::EarthModel::sphere;
  configuration.fidelity.earth_radius_factor = factor;
  return physics::effective_earth(configuration, {}, geo::AltitudeMsl::feet(height_ft), {});
}

TEST(Truth, RaysToLevelGroundHaveTheElevationsOfTheExponentialAtmosphere) {
  struct Line {
    std::string of;
    double height_ft, distance_nm, elevation_deg;
  };
  for (const Line& line : {Line{"10,000 ft, 80 NM", 10e3, 80.0, -1.6962},
                           {"20,000 ft, 80 NM", 20e3, 80.0, -2.9083},
                           {"20,000 ft, 160 NM", 20e3, 160.0, -2.2602},
                           {"30,000 ft, 80 NM", 30e3, 80.0, -4.1083},
                           {"30,000 ft, 160 NM", 30e3, 160.0, -2.9044}})
    for (const auto& [name, algorithm, tolerance, why] :
         {std::tuple("reference", radar::Algorithm::reference, 3e-4, "table of traced rays: 0.005 mrad"),
          {"standard", radar::Algorithm::standard, 0.003, "polynomials: 0.05 mrad"}})
      expect_row({"Refraction", std::string("elevation of level ground from ") + line.of + ", exponential air, " + name,
                  line.elevation_deg, tolerance, "°", kSource, why},
                 elevation_deg(earth_from(algorithm, line.height_ft)
                                   .sight(feet_m(line.height_ft), miles_m(line.distance_nm), 0.0)
                                   .elevation_rad));
}

// The ground farthest away has the greatest tangent.
double horizon_m(const physics::EffectiveEarth& earth, double altitude_m) {
  double low = 1e3, high = 8e5;
  for (int i = 0; i < 200; ++i) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    (earth.tangent(altitude_m, a, 0.0) < earth.tangent(altitude_m, b, 0.0) ? low : high) =
        earth.tangent(altitude_m, a, 0.0) < earth.tangent(altitude_m, b, 0.0) ? a : b;
  }
  return low;
}

TEST(Truth, HorizonsAreThoseOfTheExponentialAtmosphere) {
  struct Horizon {
    std::string from;
    double height_ft, distance_nm;
  };
  for (const Horizon& horizon : {Horizon{"5,000 ft", 5e3, 88.4},
                                 {"10,000 ft", 10e3, 124.4},
                                 {"20,000 ft", 20e3, 174.0},
                                 {"30,000 ft", 30e3, 211.2},
                                 {"40,000 ft", 40e3, 242.0}})
    expect_row({"Horizons", "horizon from " + horizon.from, horizon.distance_nm, 0.15, "NM", kSource,
                "the table of traced rays ends at 450 km; the value has one decimal"},
               geo::Length::metres(
                   horizon_m(earth_from(radar::Algorithm::reference, horizon.height_ft), feet_m(horizon.height_ft)))
                   .nautical_miles());
}

// Length of the shadow of an edge of 10 m on level ground.
double shadow_m(const physics::EffectiveEarth& earth, double altitude_m, double edge_m) {
  const double tangent = earth.tangent(altitude_m, edge_m, 10.0);
  double low = edge_m, high = edge_m + 20e3;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (earth.tangent(altitude_m, middle, 0.0) < tangent ? low : high) = middle;
  }
  return low - edge_m;
}

TEST(Truth, ShadowsAreLongerThanOnTheEffectiveEarth) {
  for (const auto& [nm, outside] : {std::pair(40.0, 1.003), {80.0, 1.011}, {120.0, 1.027}, {160.0, 1.058}})
    for (const auto& [name, algorithm, tolerance, why] :
         {std::tuple("reference", radar::Algorithm::reference, 0.001, "the value has three decimals"),
          {"standard", radar::Algorithm::standard, 0.012, "polynomials: 1 % of a shadow at 160 NM"}})
      expect_row({"Refraction",
                  std::string(name) + ", shadow of a low edge from 30,000 ft, " + std::to_string(static_cast<int>(nm)) +
                      " NM, over that on the 4/3 earth",
                  outside, tolerance, "", kSource, why},
                 shadow_m(earth_from(algorithm, 30e3), feet_m(30e3), miles_m(nm)) /
                     shadow_m(earth_from(algorithm, 30e3, 4.0 / 3.0), feet_m(30e3), miles_m(nm)));
}

TEST(Truth, RaysEndHigherThanOnTheEffectiveEarth) {
  for (const auto& [nm, outside] : {std::pair(80.0, 208.0), {120.0, 452.0}, {160.0, 761.0}}) {
    // The ray that meets level ground on the 4/3 earth.
    const double elevation_rad =
        earth_from(radar::Algorithm::reference, 30e3, 4.0 / 3.0).sight(feet_m(30e3), miles_m(nm), 0.0).elevation_rad;
    expect_row(
        {"Ends of rays",
         "height of the end of the 4/3 earth's ray to the ground, from 30,000 ft, " +
             std::to_string(static_cast<int>(nm)) + " NM",
         outside, 1.0, "m", kSource, "the value has no decimal"},
        launch_ray(geo::kMeanRefractivity, geo::kMeanEarthRadius_m, feet_m(30e3), elevation_rad, miles_m(nm)).height_m);
  }
}

// The factor k whose effective earth has the elevation of the traced ray to level ground.
double factor_of(double height_ft, double distance_m) {
  const double elevation_rad =
      earth_from(radar::Algorithm::reference, height_ft).sight(feet_m(height_ft), distance_m, 0.0).elevation_rad;
  double low = 1.0, high = 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const auto sight =
        earth_from(radar::Algorithm::reference, height_ft, middle).sight(feet_m(height_ft), distance_m, 0.0);
    (sight.elevation_rad < elevation_rad ? low : high) = middle;
  }
  return low;
}

TEST(Truth, TheEffectiveEarthOfARayToTheGroundShrinksWithAltitude) {
  for (const auto& [name, height_ft, distance_nm, outside] : {std::tuple("5,000 ft, 80 NM", 5e3, 80.0, 1.34),
                                                              {"10,000 ft, 120 NM", 10e3, 120.0, 1.30},
                                                              {"20,000 ft, 160 NM", 20e3, 160.0, 1.23},
                                                              {"30,000 ft, 160 NM", 30e3, 160.0, 1.16},
                                                              {"40,000 ft, 160 NM", 40e3, 160.0, 1.13}})
    expect_row({"Effective earths", std::string("factor k of the ray to the ground from ") + name, outside, 0.015, "",
                kSource, "the source fits one k to many distances"},
               factor_of(height_ft, miles_m(distance_nm)));
}

// From 10 m at 2°: MathWorks' refraction by the CRPL exponential reference atmosphere.
TEST(Truth, ARayOfTheCrplAtmosphereIsThatOfAToolbox) {
  double low = 1e3, high = 1e5;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (launch_ray(geo::kMeanRefractivity, geo::kMeanEarthRadius_m, 10.0, 2.0 * geo::kRadiansPerDegree, middle).height_m <
             1000.0
         ? low
         : high) = middle;
  }
  const geo::RayEnd end =
      launch_ray(geo::kMeanRefractivity, geo::kMeanEarthRadius_m, 10.0, 2.0 * geo::kRadiansPerDegree, low);
  const auto row = [](const std::string& term, double outside, double tolerance, const std::string& unit,
                      const std::string& function, double ours) {
    expect_row({"Refraction of the CRPL atmosphere", term, outside, tolerance, unit,
                "MathWorks Radar Toolbox, example of " + function, "the example's last digit"},
               ours);
  };
  const physics::Sight straight = physics::EffectiveEarth(geo::kMeanEarthRadius_m).sight(10.0, low, 1000.0);
  row("ground range to 1 km height at 2° from 10 m", 27143.0, 0.6, "m", "height2grndrange, CRPL", low);
  row("slant range to 1 km height at 2° from 10 m", 27163.0, 0.6, "m", "height2range, CRPL", straight.slant_range_m);
  row("propagated range to 1 km height at 2° from 10 m", 27171.0, 0.6, "m", "height2range, CRPL", end.optical_m);
  row("true elevation of 1 km height seen at 2° from 10 m", 1.9666, 5e-5, "°", "height2el, CRPL",
      elevation_deg(straight.elevation_rad));
}

TEST(Truth, TheFastPathHasTheElevationsOfTracedRays) {
  for (const auto& [name, algorithm, limit_mrad] :
       {std::tuple("standard", radar::Algorithm::standard, 0.05), {"reference", radar::Algorithm::reference, 0.005}}) {
    double worst_mrad = 0.0;
    for (const double height_ft : test::kObservers_ft) {
      const physics::EffectiveEarth earth = earth_from(algorithm, height_ft);
      for (const test::VisibleRay& ray : test::visible_rays(earth.radius_m(), feet_m(height_ft)))
        worst_mrad = std::max(worst_mrad,
                              1e3 * std::abs(earth.sight(ray.altitude_m, ray.distance_m, ray.height_m).elevation_rad -
                                             ray.traced.elevation_rad));
    }
    expect_row({"Refraction against traced rays",
                std::string(name) +
                    ", worst elevation, 500 to 50,000 ft, to 200 NM, ground to 4 km, less that of the traced ray",
                0.0, limit_mrad, "mrad", "Snell's law on the sphere, integrated (lib/geo/refraction.hpp)",
                "the bound of the fast path"},
               worst_mrad);
  }
}

}  // namespace
}  // namespace yars::truth
