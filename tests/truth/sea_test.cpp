// Rows of the sea: NRL formula, Nathanson's measurements, wind.
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/physics/ground_return.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/physics/texture.hpp"
#include "tests/model/physics/decibels.hpp"
#include "tests/model/terrain/shared_data.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

namespace physics = model::physics;

// Sea of a polarization, frequency and state, without wind.
physics::SeaReturn sea_of(radar::Polarization polarization, double frequency_ghz, double state) {
  radar::RadarConfiguration configuration;
  configuration.receiver.frequency_ghz = frequency_ghz;
  configuration.world.sea.polarization = polarization;
  configuration.world.sea.state = state;
  configuration.world.sea.wind_factor = 0.0;
  return physics::make_sea_return(configuration);
}

double sigma0_db(const physics::SeaReturn& sea, double grazing_deg, geo::Bearing azimuth = {}) {
  return model::decibels(physics::sea_sigma0(sea, std::sin(grazing_deg * geo::kRadiansPerDegree), azimuth));
}

constexpr auto kHorizontal = radar::Polarization::horizontal, kVertical = radar::Polarization::vertical;

TEST(Truth, TheSeaReturnsAsTheNrlFormula) {
  struct Point {
    std::string of;
    radar::Polarization polarization;
    double frequency_ghz, grazing_deg, db;
  };
  for (const Point& point : {Point{"HH, 9.3 GHz, grazing 1°", kHorizontal, 9.3, 1.0, -43.83},
                             {"HH, 9.7 GHz, grazing 10°", kHorizontal, 9.7, 10.0, -37.72},
                             {"VV, 9.3 GHz, grazing 1°", kVertical, 9.3, 1.0, -41.65},
                             {"VV, 10 GHz, grazing 1°", kVertical, 10.0, 1.0, -41.19},
                             {"VV, 9.7 GHz, grazing 10°", kVertical, 9.7, 10.0, -32.51}})
    expect_row(
        {"Sea", "σ⁰ in sea state 3, " + point.of, point.db, 0.006, "dB",
         "Gregers-Hansen and Mital, NRL 2012 (DTIC ADA559494), by another program", "the value has two decimals"},
        sigma0_db(sea_of(point.polarization, point.frequency_ghz, 3.0), point.grazing_deg));
}

// Mean of |formula - measurement| over all measurements of a polarization.
double mean_error_db(const std::string& polarization) {
  std::ifstream file(test::shared_data() / "nathanson/nathanson_sea_sigma0.csv");
  double sum = 0.0, count = 0.0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    std::string name;
    char comma = 0;
    double state = 0.0, frequency_ghz = 0.0, grazing_deg = 0.0, measured_db = 0.0;
    if (!std::getline(fields, name, ',') || name != polarization) continue;
    fields >> state >> comma >> frequency_ghz >> comma >> grazing_deg >> comma >> measured_db;
    const auto sea = sea_of(polarization == "HH" ? kHorizontal : kVertical, frequency_ghz, state);
    sum += std::abs(sigma0_db(sea, grazing_deg) - measured_db);
    count += 1.0;
  }
  return sum / count;
}

TEST(Truth, TheSeaIsAsNearToNathansonsTablesAsThePaperSays) {
  YARS_NEEDS_SHARED_DATA();
  for (const auto& [polarization, outside] : {std::pair("HH", 2.64), {"VV", 2.54}})
    expect_row(
        {"Sea", std::string("mean error against Nathanson's table, ") + polarization, outside, 0.006, "dB",
         "Gregers-Hansen and Mital, NRL 2012; measurements: nathanson_sea_sigma0.csv", "the value has two decimals"},
        mean_error_db(polarization));
}

TEST(Truth, TheSeaIsBrighterUpwind) {
  for (const auto& [grazing, grazing_deg, outside] : {std::tuple("1°", 1.0, 2.8255), {"10°", 10.0, 1.5189}}) {
    physics::SeaReturn sea = sea_of(kHorizontal, 9.6, 3.0);
    const double across_db = sigma0_db(sea, grazing_deg);
    sea.wind_factor = radar::SeaConfiguration().wind_factor;
    expect_row({"Sea", std::string("upwind over crosswind at 9.6 GHz, grazing ") + grazing, outside, 0.001, "dB",
                "GIT model, Horst, Dyer and Tuley 1978, wind direction factor", "closed form"},
               sigma0_db(sea, grazing_deg, sea.wind_from) - across_db);
  }
}

TEST(Truth, TheSeaIsAsSpikyAsMeasurements) {
  struct Point {
    std::string of;
    radar::Polarization polarization;
    double grazing_deg, cell_m2, cosine, outside;
  };
  for (const Point& point :
       {Point{"HH, 1°, 1,000 m², at 45° to the wind", kHorizontal, 1.0, 1e3, std::sqrt(0.5), 0.6095},
        {"VV, 1°, 1,000 m², at 45° to the wind", kVertical, 1.0, 1e3, std::sqrt(0.5), 3.055},
        {"HH, 5°, 10,000 m², across the wind", kHorizontal, 5.0, 1e4, 0.0, 16.19},
        {"HH, 5°, 10,000 m², upwind", kHorizontal, 5.0, 1e4, 1.0, 3.489}})
    expect_row(
        {"Sea", "shape of the K distribution, " + point.of, point.outside, 0.002 * point.outside, "",
         "Ward, Tough and Watts 2006, p. 237, as quoted by the program of M. Farshchian, NRL 2010", "closed form"},
        physics::sea_shape(point.polarization, point.grazing_deg, point.cell_m2) * physics::sea_turn(point.cosine));
}

TEST(Truth, TheSeaGlintsTowardsNadir) {
  const double variance = physics::sea_slope_variance(geo::Speed::metres_per_second(5.0));
  expect_row({"Sea", "variance of the slopes in a wind of 5 m/s", 0.0286, 1e-6, "",
              "Cox and Munk 1954: 0.003 + 0.00512 W", "closed form"},
             variance);
  for (const auto& [grazing, grazing_deg, outside] : {std::tuple("90°", 90.0, 13.290), {"80°", 80.0, 8.835}})
    expect_row({"Sea", std::string("σ⁰ of facets in a wind of 5 m/s, grazing ") + grazing, outside, 0.005, "dB",
                "geometrical optics: R²/s² sec⁴θ exp(−tan²θ/s²), R² 0.61, by hand", "closed form"},
               model::decibels(physics::specular_sigma0(variance, std::sin(grazing_deg * geo::kRadiansPerDegree))));
}

TEST(Truth, WavesRunAtTheSpeedOfDeepWater) {
  expect_row({"Sea", "speed of the waves of sea state 3 (wind 6 m/s)", 6.841, 0.005, "m/s",
              "g T / 2π at the peak of the spectrum of Pierson and Moskowitz 1964, 0.877 g / U", "closed form"},
             physics::wave_speed(physics::wind_of_sea_state(3.0)).metres_per_second());
}

// Levels of the texture of the sea along a line that runs downwind, one a metre.
std::vector<double> sea_levels(double state, double life_s, double time_s, double shape = 1.0) {
  radar::RadarConfiguration configuration;
  configuration.world.sea.state = state;
  configuration.world.sea.wind_from_deg = 270.0;
  configuration.world.sea.texture = shape;
  configuration.world.sea.texture_life_s = life_s;
  physics::SurfaceReturn surface(configuration);
  surface.use_texture({10.0, 10.0, 1000.0, 0.03}, geo::Duration::seconds(time_s));
  std::vector<double> levels;
  constexpr double kEquator_m = 111120.0;
  for (int i = 0; i < 200000; ++i)
    levels.push_back(surface.at({{0.0, 30.0 + i / kEquator_m}, {}, 0.1, 1.0, radar::kWaterMaterial}).sigma0);
  return levels;
}

double equal_share(const std::vector<double>& before, const std::vector<double>& after, std::size_t shift) {
  double equal = 0.0;
  for (std::size_t i = 0; i + shift < before.size(); ++i) equal += before[i] == after[i + shift] ? 1.0 : 0.0;
  return equal / static_cast<double>(before.size() - shift);
}

TEST(Truth, TheTextureOfTheSeaRunsWithItsWaves) {
  const std::vector<double> before = sea_levels(3.0, 1e6, 0.0), after = sea_levels(3.0, 1e6, 20.0);
  std::size_t best = 0;
  for (std::size_t shift = 0; shift < 400; ++shift)
    if (equal_share(before, after, shift) > equal_share(before, after, best)) best = shift;
  expect_row({"Sea", "way of the texture downwind in 20 s, sea state 3", 20.0 * 6.841, 4.0, "m",
              "speed of the waves, as above", "a part of the texture's grid is 4 m"},
             static_cast<double>(best));
}

TEST(Truth, TheTextureOfTheSeaLastsForItsLife) {
  const std::vector<double> before = sea_levels(0.0, 16.0, 0.0);
  for (const auto& [after_s, outside] : {std::pair(4, 0.75), {8, 0.5}, {16, 0.0}})
    expect_row(
        {"Sea", "share of the texture that is left after " + std::to_string(after_s) + " s of a life of 16 s, calm",
         outside, 0.03, "", "each cell changes once in a life, at any time of it", "256 levels; 12,000 cells"},
        equal_share(before, sea_levels(0.0, 16.0, after_s), 0));
}

TEST(Truth, TheTextureOfTheSeaHasItsVarianceAtAllTimes) {
  for (const double time_s : {0.0, 4.0}) {
    double sum = 0.0, squares = 0.0;
    const std::vector<double> levels = sea_levels(3.0, 5.0, time_s, 2.0);
    for (const double level : levels) {
      sum += level;
      squares += level * level;
    }
    const auto count = static_cast<double>(levels.size());
    expect_row({"Sea", "variance / mean² of the texture of shape 2 at " + std::to_string(time_s).substr(0, 3) + " s",
                0.5, 0.04, "", "gamma distribution: 1/ν", "chance: 12,000 cells"},
               squares * count / (sum * sum) - 1.0);
  }
}

}  // namespace
}  // namespace yars::truth
