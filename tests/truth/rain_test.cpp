// Rows of rain: attenuation at the frequency and polarization of the radar.
#include <string>

#include "lib/geo/quantity.hpp"
#include "lib/radar/configuration.hpp"
#include "model/physics/rain_attenuation.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

namespace physics = model::physics;

TEST(Truth, RainAttenuatesAsTheExamplesOfTheRecommendation) {
  struct Example {
    double elevation_deg, frequency_ghz, rate_mmh, tilt_deg, db_per_km;
    const char* inputs;
  };
  for (const Example& example :
       {Example{31.07699124, 14.25, 26.48052, 0.0, 1.58130839, "26.48 mm/h at 14.25 GHz, elevation 31.08°, horizontal"},
        {52.67898486, 14.25, 78.2994993, 0.0, 5.11503463, "78.30 mm/h at 14.25 GHz, elevation 52.68°, horizontal"},
        {48.24117054, 14.25, 63.62668149, 90.0, 3.72901264, "63.63 mm/h at 14.25 GHz, elevation 48.24°, vertical"},
        {22.27833468, 29.0, 50.639304, 0.0, 9.42430244, "50.64 mm/h at 29 GHz, elevation 22.28°, horizontal"},
        {20.14335809, 29.0, 42.91007183, 90.0, 6.83364556, "42.91 mm/h at 29 GHz, elevation 20.14°, vertical"}}) {
    const physics::RainLaw law = physics::rain_law(example.frequency_ghz, example.tilt_deg * geo::kRadiansPerDegree,
                                                   example.elevation_deg * geo::kRadiansPerDegree);
    expect_row({"Rain", std::string("attenuation by ") + example.inputs, example.db_per_km, 1e-7, "dB/km",
                "ITU-R P.838-3, the ITU's validation examples (itu/ITURP838-3_rain_specific_attenuation.csv)",
                "the example has eight decimals, its inputs too"},
               1000.0 * physics::rain_attenuation_db_per_m(law, example.rate_mmh));
  }
}

TEST(Truth, RainAttenuatesByTheFrequencyAndPolarizationOfTheRadar) {
  struct Example {
    double frequency_ghz;
    radar::Polarization polarization;
    double factor, factor_digit, exponent, exponent_digit;
    const char* inputs;
  };
  constexpr auto kHorizontal = radar::Polarization::horizontal, kVertical = radar::Polarization::vertical;
  for (const Example& example : {Example{9.7, kHorizontal, 0.010664, 1e-6, 1.27287, 1e-5, "9.7 GHz, horizontal"},
                                 {9.7, kVertical, 0.009761, 1e-6, 1.23556, 1e-5, "9.7 GHz, vertical"},
                                 {16.0, kHorizontal, 0.05282, 1e-5, 1.1086, 1e-4, "16 GHz, horizontal"}}) {
    radar::RadarConfiguration configuration;
    configuration.receiver.frequency_ghz = example.frequency_ghz;
    configuration.world.sea.polarization = example.polarization;
    const physics::RainLaw law = physics::configured_rain_law(configuration);
    const std::string source = "ITU-R P.838-3, equations 2 and 3, by an independent program";
    expect_row({"Rain", std::string("k at ") + example.inputs, example.factor, 0.6 * example.factor_digit, "dB/km",
                source, "the last digit"},
               law.factor);
    expect_row({"Rain", std::string("α at ") + example.inputs, example.exponent, 0.6 * example.exponent_digit, "",
                source, "the last digit"},
               law.exponent);
  }
}

}  // namespace
}  // namespace yars::truth
