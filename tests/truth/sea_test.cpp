// Rows of the sea: NRL formula, Nathanson's measurements, wind.
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "lib/radar/configuration.hpp"
#include "model/physics/reflectivity.hpp"
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

}  // namespace
}  // namespace yars::truth
