// Rows of the air: gases, rain.
#include <string>

#include "lib/radar/configuration.hpp"
#include "model/physics/atmosphere.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

namespace physics = model::physics;

TEST(Truth, GasesAttenuateAsTheRecommendationSays) {
  struct Example {
    double frequency_ghz, db_per_km;
  };
  for (const Example& example : {Example{8.0, 0.011416},
                                 {9.0, 0.0126844231824067},
                                 {10.0, 0.0141985419481866},
                                 {11.0, 0.0160185121242455},
                                 {12.0, 0.018234}}) {
    const auto found = physics::gas_attenuation(example.frequency_ghz, {288.15, 1013.25, 7.5});
    const std::string frequency = std::to_string(static_cast<int>(example.frequency_ghz));
    expect_row(
        {"Gases", "attenuation at " + frequency + " GHz, 15 °C, 1013.25 hPa dry, 7.5 g/m³", example.db_per_km, 1e-6,
         "dB/km", "ITU-R P.676-13, Annex 1, and the ITU's validation examples", "the example has six digits"},
        found.dry + found.water);
  }
}

}  // namespace
}  // namespace yars::truth
