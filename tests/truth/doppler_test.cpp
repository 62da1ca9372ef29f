// Rows of the Doppler modes and of the resolution of patch maps.
#include <string>

#include "lib/radar/configuration.hpp"
#include "lib/radar/velocity_beams.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

const geo::Speed kSpeed = geo::Speed::knots(480.0);

TEST(Truth, DopplerSharpensTheBeamByTheDwell) {
  const radar::SyntheticArray array{radar::RadarConfiguration()};
  for (const auto& [name, squint_deg, outside] :
       {std::tuple("5°", 5.0, 0.0831374), {"20°", 20.0, 0.0211856}, {"90°", 90.0, 0.00724590}})
    expect_row({"Doppler", std::string("sharpened beam, 9.6 GHz, 480 kt, 0.5 s, squint ") + name, outside, 1e-6, "°",
                "λ / (2 V T sin φ), Stimson 1998, Doppler beam sharpening", "closed form"},
               radar::dbs_beamwidth(geo::Angle::degrees(squint_deg), kSpeed, array).degrees());
}

TEST(Truth, AMapTakesTheTimeOfItsSyntheticArray) {
  const radar::SyntheticArray array{radar::RadarConfiguration()};
  const geo::Length range = geo::Length::nautical_miles(20.0), window = geo::Length::nautical_miles(0.67);
  for (const auto& [name, squint_deg, outside] :
       {std::tuple("8°", 8.0, 7.8120), {"30°", 30.0, 2.1744}, {"90°", 90.0, 1.0872}})
    expect_row({"Doppler", std::string("formation of 8.5 ft, 20 NM, 480 kt, squint ") + name, outside, 1e-3, "s",
                "k λ R / (2 V ρ sin φ), Carrara, Goodman and Majewski 1995, 2.3", "closed form"},
               radar::formation_time({range, window, geo::Angle::degrees(squint_deg), kSpeed, 1}, array).seconds());
}

TEST(Truth, AWindowHasTheCellsOfTheReport) {
  for (const auto& [name, window_nm, outside] :
       {std::tuple("0.67 NM", 0.67, 8.5), {"3.3 NM", 3.3, 41.8}, {"10 NM", 10.0, 127.0}})
    expect_row({"Doppler", std::string("cell of a patch map of ") + name, outside, outside < 100.0 ? 0.05 : 0.5, "ft",
                "report of 1996, table 1", "the report's last digit"},
               radar::map_resolution(geo::Length::nautical_miles(window_nm)).feet());
}

TEST(Truth, AVelocityBeamMeasuresTheSpeedAlongIt) {
  const geo::Vector3 line = radar::line_of_sight(geo::Bearing::degrees(30.0), geo::Angle::degrees(-15.0));
  expect_row({"Doppler", "speed towards ground 30° right, 15° down, at 100 m/s", 83.6516, 1e-4, "m/s",
              "V cos A cos E, Stimson 1998, Doppler navigation", "closed form"},
             dot(line, geo::Vector3(100.0, 0.0, 0.0)));
}

}  // namespace
}  // namespace yars::truth
