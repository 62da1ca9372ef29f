// Rows of the sea: both models against Nathanson's table of X band.
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"
#include "model/physics/reflectivity.hpp"
#include "tests/model/terrain/shared_data.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

namespace physics = model::physics;

constexpr double kXBand_ghz = 9.3;
const std::string kTable = "Nathanson, Radar Design Principles, in DTIC ADA559494";
const std::string kFile = kTable + " (nathanson/nathanson_sea_sigma0.csv)";

struct Point {
  bool horizontal = true;
  double state = 0.0, frequency_ghz = 0.0, grazing_deg = 0.0, sigma0_db = 0.0;
};

std::vector<Point> table() {
  std::ifstream file(test::shared_data() / "nathanson/nathanson_sea_sigma0.csv");
  std::vector<Point> points;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#") || line.starts_with("pol")) continue;
    Point point{.horizontal = line.starts_with("HH")};
    std::istringstream numbers(line.substr(3));
    char comma = 0;
    numbers >> point.state >> comma >> point.frequency_ghz >> comma >> point.grazing_deg >> comma >> point.sigma0_db;
    points.push_back(point);
  }
  return points;
}

double sigma0_db(radar::SeaModel model, const Point& point) {
  radar::RadarConfiguration configuration;
  configuration.receiver.frequency_ghz = point.frequency_ghz;
  configuration.world.sea.model = model;
  configuration.world.sea.state = point.state;
  configuration.world.sea.wind_factor = 0.0;
  configuration.world.sea.polarization =
      point.horizontal ? radar::Polarization::horizontal : radar::Polarization::vertical;
  return 10.0 * std::log10(physics::sea_sigma0(physics::make_sea_return(configuration),
                                               std::sin(point.grazing_deg * geo::kRadiansPerDegree), {}));
}

double mean_error_db(radar::SeaModel model, const std::vector<Point>& points) {
  double sum = 0.0;
  for (const Point& point : points) sum += std::abs(sigma0_db(model, point) - point.sigma0_db);
  return sum / static_cast<double>(points.size());
}

TEST(Truth, SeaReturnsAsNathansonsTable) {
  YARS_NEEDS_SHARED_DATA();
  const std::vector<Point> whole = table();
  for (const bool horizontal : {true, false}) {
    const std::string polarization = horizontal ? "horizontal" : "vertical";
    std::vector<Point> points = whole;
    std::erase_if(points, [&](const Point& point) { return point.horizontal != horizontal; });
    std::erase_if(points, [](const Point& point) { return point.frequency_ghz != kXBand_ghz; });
    ASSERT_EQ(points.size(), horizontal ? 47U : 46U);
    expect_row({"Sea", "mean error of NRL's model (the default) at 9.3 GHz, " + polarization, 0.0,
                horizontal ? 2.95 : 2.15, "dB", kFile, "NRL fitted one formula to all frequencies of the table"},
               mean_error_db(radar::SeaModel::nrl, points));
    expect_row({"Sea", "mean error of the model nathanson at 9.3 GHz, " + polarization, 0.0, 1.1, "dB", kFile,
                "whole decibels, and ten coefficients that rise with angle and state"},
               mean_error_db(radar::SeaModel::nathanson, points));
  }
}

TEST(Truth, SeaReturnsAsPointsOfNathansonsTable) {
  for (const Point& point : {Point{true, 3, kXBand_ghz, 0.3, -46.0},
                             {true, 3, kXBand_ghz, 30.0, -34.0},
                             {true, 5, kXBand_ghz, 3.0, -33.0},
                             {false, 3, kXBand_ghz, 10.0, -32.0},
                             {false, 1, kXBand_ghz, 0.1, -65.0}}) {
    std::ostringstream term;
    term << "σ⁰ of the model nathanson at 9.3 GHz, sea state " << point.state << ", grazing " << point.grazing_deg
         << "°, " << (point.horizontal ? "horizontal" : "vertical");
    expect_row({"Sea", term.str(), point.sigma0_db, 2.0, "dB", kTable, "twice the mean error of the fit"},
               sigma0_db(radar::SeaModel::nathanson, point));
  }
}

}  // namespace
}  // namespace yars::truth
