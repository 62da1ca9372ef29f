// Rows of the antenna's beam and of the weighting of patch maps.
#include <cmath>
#include <string>

#include "lib/radar/configuration.hpp"
#include "model/hrm/point_response.hpp"
#include "model/physics/receiver.hpp"
#include "model/rbm/emitters.hpp"
#include "tests/model/physics/decibels.hpp"
#include "tests/model/physics/ground.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

namespace physics = model::physics;

constexpr double kBeamwidth_rad = 2.5 * geo::kRadiansPerDegree;
constexpr auto kGaussian = radar::BeamPattern::gaussian;

TEST(Truth, TheBeamIsThreeDecibelsDownAtHalfABeamwidth) {
  const std::string source = "Gaussian beam, exp(−4 ln 2 (δ/θ)²) one-way", why = "YARS rounds 8 ln 2 to 5.545";
  for (const auto& [of, beamwidths, outside] :
       {std::tuple("half a beamwidth", 0.5, -6.0206), {"a beamwidth", 1.0, -24.0824}}) {
    expect_row({"Beam", std::string("two-way gain ") + of + " off in elevation", outside, 0.002, "dB", source, why},
               model::decibels(physics::two_way_gain(kGaussian, kBeamwidth_rad, 0.0, beamwidths * kBeamwidth_rad)));
    expect_row({"Beam", std::string("two-way gain ") + of + " off in azimuth", outside, 0.002, "dB", source, why},
               model::decibels(physics::azimuth_gain(kBeamwidth_rad, -beamwidths * kBeamwidth_rad)));
  }
}

TEST(Truth, TheTwoWayBeamHasThreeQuartersOfABeamwidth) {
  expect_row({"Beam", "integral of the two-way gain over elevation, in beamwidths", 0.752692, 1e-4, "",
              "√(π / (8 ln 2)), Probert-Jones 1962", "YARS rounds 8 ln 2 to 5.545"},
             physics::beam_integral(kGaussian, kBeamwidth_rad, 0.0, -0.3, 0.3) / kBeamwidth_rad);
}

// Power of a jammer off the beam's centre, relative to that in the centre.
double jammer_db(double off_deg) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.beam = kGaussian;
  radar::Jammer jammer;
  jammer.position = geo::geodesic_direct(test::kMidLatitude, {}, geo::Length::metres(50e3));
  jammer.altitude_m = 3000.0;
  configuration.world.jamming.jammers.push_back(jammer);
  const model::terrain::AnalyticTerrain sea(model::terrain::flat(0.0));
  const auto level = [&](double azimuth_deg) {
    physics::SweepGeometry geometry = test::geometry_north(3000.0, 74080.0);
    geometry.azimuth = geo::Bearing::degrees(azimuth_deg);
    return model::rbm::Strobes(configuration).level(geometry, sea);
  };
  return model::decibels(level(off_deg) / level(0.0));
}

TEST(Truth, AJammerIsThreeDecibelsDownAtHalfABeamwidth) {
  expect_row({"Beam", "one-way gain towards a jammer half a beamwidth off", -3.0103, 0.002, "dB",
              "definition of the 3 dB beamwidth, IEEE Std 145", "YARS rounds 8 ln 2 to 5.545"},
             jammer_db(1.25));
}

TEST(Truth, PatchMapsHaveTaylorsWeighting) {
  const model::hrm::Response response(radar::HighResolutionConfiguration().sidelobe_db, 1.0);
  const std::string source = "SciPy 1.10, scipy.signal.windows.taylor(4096, nbar=5, sll=35)";
  const auto db = [&](double cells) { return model::decibels(response.power(cells)); };
  for (const auto& [cells, at, outside] :
       {std::tuple("half a cell", 0.5, -3.0103), {"3/4 of a cell", 0.75, -7.1405}, {"a cell", 1.0, -13.937}})
    expect_row({"Weighting", std::string("impulse response ") + cells + " from a point", outside, 0.01, "dB", source,
                "SciPy samples the window"},
               db(at));
  double null = 1.2;
  while (response.power(null + 1e-4) < response.power(null)) null += 1e-4;
  expect_row({"Weighting", "first null of the impulse response, in cells", 1.40597, 2e-4, "",
              "σ √(A² + 1/4), Taylor 1955; width by SciPy 1.10", "found in steps of 1e-4"},
             null);
  double peak = null;
  while (response.power(peak + 1e-4) > response.power(peak)) peak += 1e-4;
  expect_row(
      {"Weighting", "first sidelobe of the impulse response", -35.22, 0.05, "dB", source, "SciPy samples the window"},
      db(peak));
}

TEST(Truth, TheBroadeningIsThatOfTaylorsWeighting) {
  expect_row({"Weighting", "half-power width of the response times the bandwidth", 1.1875, 0.015, "",
              "SciPy 1.10, scipy.signal.windows.taylor(4096, nbar=5, sll=35)", "YARS rounds it to 1.2"},
             radar::HighResolutionConfiguration().broadening);
}

}  // namespace
}  // namespace yars::truth
