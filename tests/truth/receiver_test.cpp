// Rows of antenna and receiver: evenness of flat land with the mapping beam, noise by range scale, width of the clutter
// cell, sensitivity time control of noise.
#include "model/physics/receiver.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/rbm/beam.hpp"
#include "tests/model/physics/decibels.hpp"
#include "tests/model/terrain/shapes.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

namespace physics = model::physics;
using model::decibels;

// Power of a sweep over flat land of constant gamma from 15,000 ft, by sample.
std::vector<float> flat_land(const radar::RadarConfiguration& configuration, double range_nm) {
  radar::RadarConfiguration quiet = configuration;
  quiet.fidelity.noise = false;
  quiet.fidelity.sub_beams = 1;
  quiet.world.atmosphere.gases = false;
  const model::terrain::AnalyticTerrain land(model::terrain::flat(1.0));
  model::rbm::Beam beam(quiet);
  std::vector<float> power(static_cast<std::size_t>(quiet.fidelity.samples));
  beam.measure({{37.0, -115.0},
                geo::AltitudeMsl::feet(15000.0),
                geo::Bearing::degrees(30.0),
                geo::Angle::degrees(-3.0),
                geo::Length::nautical_miles(range_nm)},
               land, power);
  return power;
}

// Difference of the brightest and the darkest sample between two ranges.
double spread_db(const std::vector<float>& power, double range_nm, double from_nm, double to_nm) {
  const auto at = [&](double nm) {
    return power.begin() + static_cast<std::ptrdiff_t>(nm / range_nm * static_cast<double>(power.size()));
  };
  const auto [least, most] = std::minmax_element(at(from_nm), at(to_nm));
  return decibels(static_cast<double>(*most) / static_cast<double>(*least));
}

TEST(Receiver, FlatLandIsEvenInRangeWithTheMappingBeam) {
  for (const char* preset : {"reference", "standard"}) {
    radar::RadarConfiguration configuration;
    configuration.fidelity = *radar::fidelity_preset(preset);
    expect_row({"Receiver", std::string("spread of flat land, 15,000 ft, 4 to 39 NM, ") + preset, 0.0, 3.0, "dB",
                "two-way csc⁴: power does not depend on range, Skolnik, Introduction to Radar Systems",
                "± 1.5 dB; curvature, and sine against tangent near the aircraft"},
               spread_db(flat_land(configuration, 40.0), 40.0, 4.0, 39.0));
  }
}

TEST(Receiver, AMappingBeamsGainIsTheFourthPowerOfTheCosecant) {
  const double radians = 0.017453292519943295;
  const double gain =
      physics::two_way_gain(radar::BeamPattern::mapping, 2.5 * radians, -3.0 * radians, -12.0 * radians);
  expect_row({"Receiver", "two-way gain 12° below the horizon, centre at 3°",
              40.0 * std::log10(std::sin(3.0 * radians) / std::sin(12.0 * radians)), 0.001, "dB",
              "one-way csc², Skolnik, Introduction to Radar Systems", "closed form"},
             decibels(gain));
}

// The cross section that equals noise at the far end of a range scale.
TEST(Receiver, NoiseByRangeScaleFollowsRangeAndPulse) {
  const radar::RadarConfiguration configuration;
  const physics::Receivers receivers(configuration);
  const auto equal_m2 = [&](double range_nm) {
    const geo::Length range = geo::Length::nautical_miles(range_nm);
    const physics::Receiver receiver = receivers.at(range);
    return receiver.noise * physics::time_control(receiver, range.metres()) /
           physics::received(receiver, physics::returned_power(1.0, 1.0, range.metres()), range.metres());
  };
  struct Scale {
    double range_nm, pulse_us;
  };
  for (const Scale& scale : {Scale{4.7, 0.26}, {10.0, 0.5}, {80.0, 4.0}, {160.0, 6.0}}) {
    const double outside = 40.0 * std::log10(scale.range_nm / 40.0) - 10.0 * std::log10(scale.pulse_us / 2.0);
    const std::string name = scale.range_nm < 5.0 ? "4.7" : std::to_string(static_cast<int>(scale.range_nm));
    expect_row({"Receiver", "cross section equal to noise, " + name + " NM over 40 NM", outside, 0.1, "dB",
                "radar equation: σ ∝ R⁴ / τ", "closed form; beam-limited areas do not enter"},
               decibels(equal_m2(scale.range_nm) / equal_m2(40.0)));
  }
}

TEST(Receiver, TheClutterCellIsTheIntegralOfTheBeam) {
  const physics::Receiver receiver =
      physics::Receivers(radar::RadarConfiguration{}).at(geo::Length::nautical_miles(40.0));
  expect_row({"Receiver", "width of the clutter cell in beamwidths", 0.75268, 0.0005, "",
              "∫ exp(−8 ln 2 x²) dx = √(π / (8 ln 2)), Probert-Jones 1962", "YARS rounds 8 ln 2 to 5.545"},
             receiver.azimuth_cell_rad / receiver.azimuth_beamwidth_rad);
}

// Brightness of noise alone at half and at all of the range, with a time control of exponent 3.
TEST(Receiver, TimeControlActsOnNoise) {
  for (const char* preset : {"reference", "standard"}) {
    radar::RadarConfiguration configuration;
    configuration.fidelity = *radar::fidelity_preset(preset);
    configuration.fidelity.noise = false;
    configuration.receiver.stc_exponent = 3.0;
    configuration.receiver.noise_floor_db = -20.0;
    const auto count = static_cast<std::size_t>(configuration.fidelity.samples);
    model::rbm::Beam beam(configuration);
    const std::vector<float> nothing(count, 0.0F);
    std::vector<std::uint8_t> video(count);
    beam.form_video({nothing, nothing, nothing}, geo::Length::nautical_miles(40.0), physics::kFullGain, {}, video);
    const double db = (video[count - 1] - video[count / 2]) * configuration.receiver.dynamic_range_db / 255.0;
    expect_row({"Receiver", std::string("noise at 40 NM over noise at 20 NM, (R/R₀)³, ") + preset, 9.03, 0.2, "dB",
                "a gain acts on all that is received", "8 bits"},
               db);
  }
}

}  // namespace
}  // namespace yars::truth
