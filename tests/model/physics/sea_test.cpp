// Return of the sea: NRL model, wind, sea state, and the table of the vector code.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/physics/clutter_simd.hpp"
#include "model/physics/reflectivity.hpp"
#include "tests/model/physics/decibels.hpp"

namespace yars::model::physics {
namespace {

constexpr SeaCoefficients kHorizontal{-73.0, 20.781, 7.351, 25.65, 0.0054};
constexpr SeaCoefficients kVertical{-50.796, 25.93, 0.7093, 21.588, 0.00211};

TEST(Sea, GivesTheNrlModelsCheckValue) {
  // Source: docs/spec/physics.md#sea.
  EXPECT_NEAR(std::pow(10.0, 0.1 * nrl_sigma0_db(kHorizontal, 10.0, 30.0, 2.0)), 2.1555e-4, 5e-9);
}

TEST(Sea, ReturnsMoreInARougherSeaAndAtASteeperAngle) {
  for (const SeaCoefficients& c : {kHorizontal, kVertical}) {
    double before_db = -1e9;
    for (double state = 0.0; state <= 6.0; state += 0.5) {
      const double here_db = nrl_sigma0_db(c, 2.0, 9.6, state);
      EXPECT_GT(here_db, before_db) << state;
      before_db = here_db;
    }
    before_db = -1e9;
    for (double grazing_deg = 0.1; grazing_deg <= 60.0; grazing_deg *= 1.3) {
      const double here_db = nrl_sigma0_db(c, grazing_deg, 9.6, 2.0);
      EXPECT_GT(here_db, before_db) << grazing_deg;
      before_db = here_db;
    }
  }
}

TEST(Sea, OfNathansonsModelRisesWithGrazingAngleAndStateThroughoutXBand) {
  radar::RadarConfiguration configuration;
  configuration.world.sea.model = radar::SeaModel::nathanson;
  configuration.world.sea.wind_factor = 0.0;
  const auto db_at = [&](double state, double grazing_deg) {
    configuration.world.sea.state = state;
    return decibels(sea_sigma0(make_sea_return(configuration), std::sin(grazing_deg * geo::kRadiansPerDegree), {}));
  };
  for (const auto polarization : {radar::Polarization::horizontal, radar::Polarization::vertical}) {
    configuration.world.sea.polarization = polarization;
    for (const double frequency_ghz : {8.0, 9.6, 12.0}) {
      configuration.receiver.frequency_ghz = frequency_ghz;
      for (double state = 0.0; state <= 6.0; state += 0.25) {
        for (double grazing_deg = 0.1; grazing_deg < 59.0; grazing_deg *= 1.05) {
          const double here_db = db_at(state, grazing_deg);
          ASSERT_GT(db_at(state, grazing_deg * 1.01), here_db) << state << ", " << grazing_deg;
          if (state == 6.0) continue;
          ASSERT_GT(db_at(state + 0.25, grazing_deg), here_db) << state << ", " << grazing_deg;
        }
      }
    }
  }
}

TEST(Sea, IsThreeDecibelsBrighterUpwindAndThreeDarkerDownwindAtXBand) {
  radar::RadarConfiguration configuration;
  configuration.world.sea.wind_from_deg = 350.0;
  const SeaReturn sea = make_sea_return(configuration);
  const double sine = std::sin(1.0 * geo::kRadiansPerDegree);
  const auto towards_db = [&](double azimuth_deg) {
    return decibels(sea_sigma0(sea, sine, geo::Bearing::degrees(azimuth_deg)));
  };
  // 2.97 dB at zero grazing, times 1 - 2.8 psi; psi: grazing angle [rad].
  EXPECT_NEAR(towards_db(350.0) - towards_db(80.0), 2.83, 0.02);
  EXPECT_NEAR(towards_db(170.0) - towards_db(80.0), -2.83, 0.02);
  EXPECT_NEAR(towards_db(80.0), nrl_sigma0_db(kHorizontal, 1.0, 9.6, 2.0), 1e-9);
  EXPECT_EQ(upwind_db(0.2, 0.03, 0.5), 0.0);
}

TEST(Sea, HasTheStateOfTheBeaufortForceOfTheWind) {
  struct Row {
    double wind_kt, state;
  };
  for (const Row row : {Row{0, 0}, Row{2, 1}, Row{5, 2}, Row{10, 2}, Row{11, 3}, Row{16, 3}, Row{21, 4}, Row{22, 5},
                        Row{28, 6}, Row{60, 6}}) {
    EXPECT_EQ(sea_state_of_wind(geo::Speed::knots(row.wind_kt)), row.state) << row.wind_kt;
  }
}

TEST(Sea, HasAConfiguredStateForAnyWind) {
  radar::RadarConfiguration configuration;
  EXPECT_EQ(make_sea_return(configuration).state, 2.0);  // 10 kt
  configuration.world.sea.state = 4.5;
  EXPECT_EQ(make_sea_return(configuration).state, 4.5);
}

TEST(Sea, ReturnsNothingAtNegativeGrazingAnglesAndAConstantAbove60DegreesWithoutFacets) {
  radar::RadarConfiguration configuration;
  configuration.world.sea.specular = false;
  const SeaReturn sea = make_sea_return(configuration);
  EXPECT_EQ(sea_sigma0(sea, 0.0, {}), 0.0);
  EXPECT_EQ(sea_sigma0(sea, -0.1, {}), 0.0);
  EXPECT_NEAR(sea_sigma0(sea, 1.0, {}) / sea_sigma0(sea, std::sin(60.0 * geo::kRadiansPerDegree), {}), 1.0, 1e-9);
}

TEST(Sea, ReturnsMoreTowardsNadirByItsFacets) {
  const SeaReturn sea = make_sea_return(radar::RadarConfiguration());
  double last = 0.0;
  for (double grazing_deg = 60.0; grazing_deg <= 90.0; grazing_deg += 0.5) {
    const double sigma0 = sea_sigma0(sea, std::sin(grazing_deg * geo::kRadiansPerDegree), {});
    EXPECT_GE(sigma0, last) << grazing_deg;
    last = sigma0;
  }
  EXPECT_GT(decibels(last), 10.0);
}

TEST(SeaTable, IsWithin0Point05DecibelsOfTheModelsBelow15DegreesOfGrazing) {
  for (const int kind : {0, 1, 2, 3}) {
    radar::RadarConfiguration configuration;
    configuration.world.sea.polarization = radar::Polarization(kind % 2);
    configuration.world.sea.model = radar::SeaModel(kind / 2);
    configuration.world.sea.specular = false;
    const SeaReturn sea = make_sea_return(configuration);
    const SeaTable table = make_sea_table(sea);
    constexpr std::size_t kPaddedCount = SeaTable::kPieces + 1 + terrain::kRunSlack;
    std::vector<float> sigma0(kPaddedCount), sine(2 * terrain::kRunSlack, 0.0F), found(sine.size());
    const std::vector<float> water(sine.size(), 1.0F);
    std::vector<float> land(sine.size());
    const physics::simd::MaterialTables tables;
    physics::simd::GroundInputs ground;
    ground.tables = &tables;
    ground.water = water.data();
    ground.sea = &table;
    ground.sigma0 = sigma0.data();
    for (const double azimuth_deg : {0.0, 133.0, 270.0}) {
      const geo::Bearing azimuth = geo::Bearing::degrees(azimuth_deg);
      ground.upwind = static_cast<float>(std::cos((azimuth - sea.wind_from).radians()));
      const auto at = [&](float sine_of_grazing) {
        sine[0] = sine_of_grazing;
        physics::simd::reflect(1, ground, sine.data(), land.data(), found.data());
        return static_cast<double>(found[0]);
      };
      for (double grazing_deg = 0.02; grazing_deg < 90.0; grazing_deg *= 1.01) {
        const double exact = std::sin(grazing_deg * geo::kRadiansPerDegree);
        const double least_db = sea.correction.p[0] == 0.0 ? 0.02 : 0.05;
        const double bound_db = grazing_deg < 15.0 ? least_db : grazing_deg < 55.0 ? 0.2 : 0.4;
        ASSERT_NEAR(decibels(at(static_cast<float>(exact))), decibels(sea_sigma0(sea, exact, azimuth)), bound_db)
            << grazing_deg;
      }
      EXPECT_EQ(at(0.0F), 0.0);
      EXPECT_EQ(at(-0.5F), 0.0);
      EXPECT_GT(at(1.0F), 0.0);
    }
  }
}

}  // namespace
}  // namespace yars::model::physics
