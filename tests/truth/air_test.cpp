// Rows of the air: gases, reference atmosphere, rain at 9.6 GHz.
#include <string>

#include "lib/radar/configuration.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/rain_attenuation.hpp"
#include "model/physics/reflectivity.hpp"
#include "tests/model/physics/decibels.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

namespace physics = model::physics;

struct AirPoint {
  std::string of;  // frequency, height or path
  double x, outside;
};

double at_sea_level_db_per_km(double frequency_ghz) {
  const auto found = physics::gas_attenuation(frequency_ghz, {288.15, 1013.25, 7.5});
  return found.dry + found.water;
}

TEST(Truth, GasesAttenuateAsTheRecommendationSays) {
  for (const AirPoint& point : {AirPoint{"8", 8.0, 0.011416},
                                {"9", 9.0, 0.0126844231824067},
                                {"10", 10.0, 0.0141985419481866},
                                {"11", 11.0, 0.0160185121242455},
                                {"12", 12.0, 0.018234}})
    expect_row({"Gases", "attenuation at " + point.of + " GHz, 15 °C, 1013.25 hPa dry, 7.5 g/m³", point.outside, 1e-6,
                "dB/km", "ITU-R P.676-13, Annex 1, and the ITU's validation examples", "the example has six digits"},
               at_sea_level_db_per_km(point.x));
}

TEST(Truth, GasesAttenuateAsInAnotherProgramInXBand) {
  for (const AirPoint& point : {AirPoint{"9.3", 9.3, 0.013111}, {"9.6", 9.6, 0.013560}, {"9.7", 9.7, 0.013715}})
    expect_row({"Gases", "attenuation at " + point.of + " GHz, 15 °C, 1013.25 hPa dry, 7.5 g/m³", point.outside, 1e-6,
                "dB/km", "ITU-R P.676-13, Annex 1, by another program", "the value has six decimals"},
               at_sea_level_db_per_km(point.x));
}

constexpr char kDigits[] = "the value has three or four digits";

TEST(Truth, GasesThinOutWithHeight) {
  const physics::GasProfile profile(radar::AtmosphereConfiguration(), 9.7);
  for (const AirPoint& point : {AirPoint{"1", 1.0, 0.009773},
                                {"3", 3.0, 0.005645},
                                {"5", 5.0, 0.003516},
                                {"8", 8.0, 0.001805},
                                {"12", 12.0, 0.000667}})
    expect_row({"Gases", "attenuation at 9.7 GHz, " + point.of + " km high, mean annual atmosphere", point.outside,
                0.002 * point.outside, "dB/km", "ITU-R P.676-13 in the air of P.835, by another program", kDigits},
               1000.0 * profile.db_per_m(1000.0 * point.x));
}

TEST(Truth, GasesAttenuateOnTheWayToTheGroundAndBack) {
  radar::RadarConfiguration configuration;
  configuration.receiver.frequency_ghz = 9.7;
  configuration.fidelity.earth = radar::EarthModel::sphere;
  configuration.fidelity.earth_radius_factor = 4.0 / 3.0;
  const physics::GasPath path(configuration);
  struct Path {
    std::string of;
    double height_ft, distance_nm, db;
  };
  for (const Path& ray : {Path{"10,000 ft, 10 NM", 10e3, 10.0, 0.329},
                          {"10,000 ft, 80 NM", 10e3, 80.0, 2.764},
                          {"20,000 ft, 40 NM", 20e3, 40.0, 0.959},
                          {"20,000 ft, 160 NM", 20e3, 160.0, 4.762},
                          {"30,000 ft, 80 NM", 30e3, 80.0, 1.533}}) {
    const auto altitude = geo::AltitudeMsl::feet(ray.height_ft);
    expect_row({"Gases", "two-way loss at 9.7 GHz from " + ray.of + " to ground, 4/3 earth", ray.db, 0.002 * ray.db,
                "dB", "ITU-R P.676-13 in the air of P.835, summed along the ray, by another program", kDigits},
               -model::decibels(path.two_way_transmission(physics::effective_earth(configuration, {}, altitude, {}),
                                                          altitude.metres(),
                                                          geo::Length::nautical_miles(ray.distance_nm).metres(), 0.0)));
  }
}

TEST(Truth, TheReferenceAtmosphereIsThatOfTheRecommendation) {
  const auto row = [](const std::string& of, double outside, double tolerance, const std::string& unit,
                      const std::string& why, double ours) {
    expect_row(
        {"Atmosphere", of, outside, tolerance, unit, "ITU-R P.835, mean annual global reference atmosphere", why},
        ours);
  };
  const std::string digits = "the value's last digit";
  const auto pressure_hpa = [](const physics::Air& air) { return air.dry_hpa + physics::vapour_hpa(air); };
  const physics::Air at_5_km = physics::reference_air({}, 5e3), at_12_km = physics::reference_air({}, 12e3);
  row("temperature 5 km high", 255.68, 0.006, "K", digits, at_5_km.temperature_k);
  row("pressure 5 km high", 540.48, 0.006, "hPa", digits, pressure_hpa(at_5_km));
  row("water vapour 5 km high", 0.616, 0.0005, "g/m³", "the value has three decimals", at_5_km.water_g_m3);
  row("temperature 12 km high", 216.65, 0.001, "K", "the layer has one temperature", at_12_km.temperature_k);
  row("pressure 12 km high", 194.00, 0.02, "hPa", digits, pressure_hpa(at_12_km));
}

TEST(Truth, RainAttenuatesAsTheRecommendationSays) {
  for (const AirPoint& point : {AirPoint{"10", 10.0, 0.193342}, {"50", 50.0, 1.513296}})
    expect_row({"Rain", "attenuation at 9.6 GHz, horizontal, by " + point.of + " mm/h", point.outside,
                2e-5 * point.outside, "dB/km", "ITU-R P.838-3, equations (1) to (3), by another program",
                "the source rounds k and α to five digits"},
               1000.0 * physics::rain_attenuation_db_per_m(physics::configured_rain_law(radar::RadarConfiguration()),
                                                           point.x));
}

TEST(Truth, RainReflectsAsDropsSmallAgainstTheWavelength) {
  expect_row({"Rain", "reflectivity at 9.6 GHz of 10 mm/h, dielectric factor 0.93", -56.2295, 0.001, "dB 1/m",
              "Z = 200 r^1.6, Marshall and Palmer 1948; π⁵ 0.93 Z / λ⁴, Probert-Jones 1962", "closed form"},
             model::decibels(physics::rain_reflectivity({}, 10.0, physics::wavelength_m(9.6))));
}

}  // namespace
}  // namespace yars::truth
