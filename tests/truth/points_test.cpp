// Rows of the radar equation: targets, clutter, jammers, beacons; movers on patch maps.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "lib/radar/cross_section.hpp"
#include "model/physics/environment.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/target_echo.hpp"
#include "model/rbm/beam.hpp"
#include "model/rbm/emitters.hpp"
#include "tests/model/hrm/patch_maker.hpp"
#include "tests/model/made_up_objects.hpp"
#include "tests/model/physics/decibels.hpp"
#include "tests/model/physics/ground.hpp"
#include "tests/truth/ledger.hpp"

namespace yars::truth {
namespace {

namespace physics = model::physics;

constexpr double kAltitude_m = 3000.0, kRange_m = 80e3;

geo::GeoPoint north(double distance_m) {
  return geo::geodesic_direct(test::kMidLatitude, {}, geo::Length::metres(distance_m));
}

const physics::SweepGeometry& ahead() {
  static const physics::SweepGeometry geometry = test::geometry_north(kAltitude_m, kRange_m);
  return geometry;
}

const model::terrain::AnalyticTerrain& sea() {
  static const model::terrain::AnalyticTerrain terrain(model::terrain::flat(0.0));
  return terrain;
}

// Flat earth without gases, sensitivity time control and noise.
radar::RadarConfiguration plain() {
  radar::RadarConfiguration configuration;
  configuration.fidelity.earth = radar::EarthModel::flat;
  configuration.world.atmosphere.gases = false;
  configuration.receiver.stc_exponent = 0.0;
  configuration.fidelity.noise = false;
  return configuration;
}

// Powers of a mover in successive scans; full scale = 1.
std::vector<double> echoes_of(const radar::Mover& mover, radar::RadarConfiguration configuration, std::uint32_t scans) {
  configuration.world.movers.push_back(mover);
  physics::Movers movers(configuration);
  const physics::Receiver receiver = physics::Receivers(configuration).at(ahead().range);
  const auto earth = physics::effective_earth(configuration, ahead());
  physics::Environment environment(sea());
  std::vector<double> powers;
  for (environment.scan = 1; environment.scan <= scans; ++environment.scan)
    for (const physics::Echo& echo : movers.echoes(ahead(), receiver, earth, environment)) powers.push_back(echo.power);
  return powers;
}
double echo_of(const radar::Mover& mover) {
  const auto powers = echoes_of(mover, plain(), 1);
  return powers.empty() ? 0.0 : powers[0];
}

// Powers of a target, a jammer and a beacon's reply at the aircraft's height, in the middle of the beam; full scale
// = 1.
double target(double distance_m, double cross_section_m2) {
  return echo_of({.position = north(distance_m), .cross_section_m2 = cross_section_m2, .height_m = kAltitude_m});
}

double jammer(double distance_m, double power_w) {
  radar::RadarConfiguration configuration = plain();
  radar::Jammer jammer;
  jammer.position = north(distance_m);
  jammer.altitude_m = kAltitude_m;
  jammer.power_w = power_w;
  configuration.world.jamming.jammers.push_back(jammer);
  return model::rbm::Strobes(configuration).level(ahead(), sea());
}

model::rbm::Reply beacon(double distance_m, double power_w, double delay_us) {
  radar::RadarConfiguration configuration = plain();
  radar::Beacon beacon;
  beacon.position = north(distance_m);
  beacon.altitude_m = kAltitude_m;
  beacon.power_w = power_w;
  beacon.delay_us = delay_us;
  configuration.world.beacons.beacons.push_back(beacon);
  model::rbm::Beacons beacons(configuration);
  const auto replies = beacons.replies(ahead(), sea());
  return replies.empty() ? model::rbm::Reply() : replies[0];
}

constexpr char kRadarEquation[] = "radar equation, P ∝ σ / R⁴, Skolnik, Introduction to Radar Systems";

TEST(Truth, ATargetLosesTwelveDecibelsAtTwiceTheRange) {
  expect_row(
      {"Radar equation", "target at 60 km over target at 30 km", -12.0412, 0.001, "dB", kRadarEquation, "closed form"},
      model::decibels(target(60e3, 10.0) / target(30e3, 10.0)));
  expect_row(
      {"Radar equation", "target of 1,000 m² over target of 1 m²", 30.0, 0.001, "dB", kRadarEquation, "closed form"},
      model::decibels(target(40e3, 1000.0) / target(40e3, 1.0)));
}

TEST(Truth, PulseLimitedClutterLosesNineDecibelsAtTwiceTheRange) {
  const physics::Receiver receiver = physics::Receivers(plain()).at(ahead().range);
  const double sine = std::sin(2.0 * geo::kRadiansPerDegree);
  const auto power = [&](double range_m) {
    return physics::returned_power(range_m * physics::illuminated_length_m(receiver, range_m, sine), 1.0, range_m);
  };
  expect_row({"Radar equation", "clutter of equal σ⁰ at 40 km over 20 km, pulse-limited", -9.0309, 0.001, "dB",
              "surface clutter equation, P ∝ σ⁰ / R³, Skolnik, Introduction to Radar Systems", "closed form"},
             model::decibels(power(40e3) / power(20e3)));
}

TEST(Truth, AJammerAndItsTargetHaveTheRatioOfTheHandbook) {
  const std::string source = "4π R² ERP_j / (ERP_r σ), jamming-to-signal ratio, NAWCWPNS TP 8347";
  expect_row({"Emitters", "jammer of 10 W over target of 10 m², 50 km", 32.9715, 0.002, "dB", source, "closed form"},
             model::decibels(jammer(50e3, 10.0) / target(50e3, 10.0)));
  expect_row({"Emitters", "jammer of 10 W over target of 100 m², 20 km", 15.0127, 0.002, "dB", source, "closed form"},
             model::decibels(jammer(20e3, 10.0) / target(20e3, 100.0)));
  expect_row({"Emitters", "jammer at 60 km over jammer at 30 km", -6.0206, 0.001, "dB", source, "closed form"},
             model::decibels(jammer(60e3, 10.0) / jammer(30e3, 10.0)));
}

TEST(Truth, ABeaconRepliesByTheOneWayEquation) {
  const std::string source = "4π R² ERP_b / (ERP_r σ), one-way radar equation, NAWCWPNS TP 8347";
  expect_row({"Emitters", "beacon of 100 W over target of 10 m², 50 km", 42.9715, 0.002, "dB", source, "closed form"},
             model::decibels(beacon(50e3, 100.0, 2.0).power / target(50e3, 10.0)));
  expect_row({"Emitters", "beacon at 60 km over beacon at 30 km", -6.0206, 0.001, "dB", source, "closed form"},
             model::decibels(beacon(60e3, 100.0, 2.0).power / beacon(30e3, 100.0, 2.0).power));
}

TEST(Truth, ABeaconsDelayOfARadarMileIsAMile) {
  expect_row({"Emitters", "range added to a reply by 12.36 µs of delay", 1.0, 0.001, "NM",
              "radar mile of 12.36 µs, Skolnik, Introduction to Radar Systems", "the delay has four digits"},
             geo::Length::metres(beacon(30e3, 100.0, 12.36).slant_range_m - 30e3).nautical_miles());
}

// ---- Fluctuation, ships, corner reflectors
TEST(Truth, AFluctuatingTargetHasSwerlingsQuantiles) {
  constexpr std::uint32_t kScans = 100'000;
  const double steady = target(30e3, 10.0);
  radar::RadarConfiguration noisy = plain();
  noisy.fidelity.noise = true;
  struct Case {
    radar::TargetEcho echo;
    std::string name, law;
    std::vector<double> quantiles_db;
  };
  const std::string source = ", Swerling 1954, RAND RM-1217";
  for (const Case& one : {Case{radar::TargetEcho::swerling1, "Swerling 1", "exponential", {-9.7732, -1.5917, 3.6222}},
                          {radar::TargetEcho::swerling3,
                           "Swerling 3",
                           "chi-square of 4 degrees of freedom",
                           {-5.7527, -0.7615, 2.8889}}}) {
    auto powers = echoes_of(
        {.position = north(30e3), .cross_section_m2 = 10.0, .height_m = kAltitude_m, .echo = one.echo}, noisy, kScans);
    ASSERT_EQ(powers.size(), kScans);
    std::ranges::sort(powers);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string quantile = std::vector<std::string>{"0.1", "0.5", "0.9"}[i];
      const double share = std::vector<double>{0.1, 0.5, 0.9}[i];
      expect_row({"Targets", one.name + ", quantile " + quantile + " over mean", one.quantiles_db[i], 0.15, "dB",
                  one.law + source, "chance: 100,000 scans"},
                 model::decibels(powers[static_cast<std::size_t>(share * kScans)] / steady));
    }
    double sum = 0.0;
    for (const double power : powers) sum += power;
    expect_row({"Targets", one.name + ", mean over the steady target", 1.0, 0.02, "", one.law + source,
                "chance: 100,000 scans"},
               sum / kScans / steady);
  }
}

// The sample of a steady target on land in the middle of a sweep.
struct Shown {
  std::size_t at;
  double steady, total;  // power
  double variation;      // variance / mean^2 of 4,000 videos, one look
};

Shown shown_target(double cross_section_m2) {
  constexpr double kRange_db = 120.0;  // black to white
  radar::RadarConfiguration configuration = plain();
  configuration.fidelity.noise = true;
  configuration.fidelity.samples = 480;
  configuration.receiver.looks = 1;
  configuration.receiver.noise_floor_db = -200.0;
  configuration.receiver.dynamic_range_db = kRange_db;
  configuration.world.land.texture = 0.0;
  configuration.world.movers.push_back({.position = north(30e3),
                                        .cross_section_m2 = cross_section_m2,
                                        .height_m = 2.0,
                                        .echo = radar::TargetEcho::steady});
  model::rbm::Beam beam(configuration);
  const model::terrain::AnalyticTerrain land(model::terrain::flat(1.0));
  std::vector<float> power(480);
  beam.measure(ahead(), land, power);
  const auto steady = beam.steady();
  if (steady.empty()) return {};
  const physics::SteadyPower target = *std::ranges::max_element(steady, {}, &physics::SteadyPower::power);
  physics::PowerWindow window{power, power, power};
  window.steady = {steady, steady, steady};
  std::vector<std::uint8_t> video(power.size());
  constexpr std::uint32_t kVideos = 4000;
  double sum = 0.0, squares = 0.0;
  for (std::uint32_t sweep = 0; sweep < kVideos; ++sweep) {
    beam.form_video(window, ahead().range, physics::kFullGain, {1, 1, sweep}, video);
    const double shown = physics::ratio(kRange_db * (video[target.at] / 255.0 - 1.0));
    sum += shown;
    squares += shown * shown;
  }
  return {target.at, static_cast<double>(target.power), static_cast<double>(power[target.at]),
          squares * kVideos / (sum * sum) - 1.0};
}

// Land fluctuates from look to look, the target does not.
TEST(Truth, ATargetOnLandFluctuatesByItsShareOfThePower) {
  const Shown one = shown_target(1.0);
  ASSERT_GT(one.steady, 0.0);
  const double land = one.total - one.steady;
  for (const double share : {0.5, 0.95}) {
    const Shown found = shown_target(share / (1.0 - share) * land / one.steady);
    expect_row({"Targets",
                "variance/mean² of a sample with a steady target of " +
                    std::to_string(static_cast<int>(100.0 * share)) + " % of its power, one look",
                1.0 - share * share, 0.05, "", "a constant in Gaussian noise: Rice 1945", "chance: 4,000 sweeps"},
               found.variation);
  }
}

TEST(Truth, AShipHasTheCrossSectionOfItsDisplacement) {
  for (const auto& [name, displacement_t, outside] :
       {std::tuple("1 kt", 1e3, 37.0939), {"10 kt", 1e4, 52.0939}, {"100 kt", 1e5, 67.0939}})
    expect_row({"Targets", std::string("ship of ") + name + " at 9.7 GHz", outside, 0.001, "dBsm",
                "52 √f[MHz] D[kt]^1.5 m², Skolnik 1974, IEEE Trans. AES-10", "closed form"},
               model::decibels(radar::ship_cross_section_m2(displacement_t, 9.7)));
}

// Full width at half power [deg] of a reflector's gain in a plane through its axis.
double half_power_width_deg(const physics::PointTarget& target, bool level) {
  double inside = 0.0, outside = 1.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (inside + outside);
    const physics::Aspect aspect = level ? physics::Aspect{middle, 0.0} : physics::Aspect{0.0, middle};
    (physics::reflector_gain(target, 9.7, aspect) > 0.5 ? inside : outside) = middle;
  }
  return 2.0 * inside / geo::kRadiansPerDegree;
}

TEST(Truth, ACornerReflectorHasAnAspect) {
  using radar::TargetEcho;
  const std::string trihedral = "4π a⁴ / 3λ², Doerry, Reflectors for SAR performance testing, Sandia";
  const std::string dihedral = "8π a² b² / λ², Knott, Shaeffer and Tuley, Radar Cross Section";
  const double triple_m2 = radar::reflector_cross_section_m2(TargetEcho::trihedral, 0.5, 9.7);
  const double double_m2 = radar::reflector_cross_section_m2(TargetEcho::dihedral, 0.5, 9.7);
  expect_row(
      {"Targets", "trihedral of 0.5 m at 9.7 GHz, on its axis", 24.3787, 0.001, "dBsm", trihedral, "closed form"},
      model::decibels(triple_m2));
  expect_row({"Targets", "dihedral of 0.5 m at 9.7 GHz, on its axis", 32.1602, 0.001, "dBsm", dihedral, "closed form"},
             model::decibels(double_m2));
  const auto level_of = [&](TargetEcho echo, double cross_section_m2, int facing_deg, int tilt_deg) {
    return model::decibels(echo_of({.position = north(30e3),
                                    .cross_section_m2 = cross_section_m2,
                                    .height_m = kAltitude_m,
                                    .echo = echo,
                                    .facing_deg = facing_deg,
                                    .tilt_deg = tilt_deg}) /
                           target(30e3, cross_section_m2));
  };
  expect_row({"Targets", "trihedral, 20° beside its axis over the axis", -3.2136, 0.001, "dB",
              "(3 cos α − 2 / cos α)², " + trihedral, "closed form"},
             level_of(TargetEcho::trihedral, triple_m2, 160, 0));
  expect_row({"Targets", "dihedral, 15° below its axis over the axis", -3.0103, 0.001, "dB",
              "(cos ε − sin ε)², " + dihedral, "closed form"},
             level_of(TargetEcho::dihedral, double_m2, 180, 15));
  expect_row({"Targets", "half-power width of a trihedral beside its axis", 38.9424, 0.001, "°",
              "2 asin 1/3 of (3 cos α − 2 / cos α)², " + trihedral, "closed form"},
             half_power_width_deg({triple_m2, TargetEcho::trihedral}, true));
  expect_row({"Targets", "half-power width of a dihedral of 0.5 m along its seam, 9.7 GHz", 1.5688, 0.001, "°",
              "sinc² of 2a / λ sin α, " + dihedral, "closed form"},
             half_power_width_deg({double_m2, TargetEcho::dihedral}, true));
  EXPECT_EQ(level_of(TargetEcho::trihedral, triple_m2, 120, 0), model::decibels(0.0)) << "outside the octant";
}

// Distance to the right of its true position at which a mover that recedes at 5 m/s appears on a patch map.
double displacement_m(double squint_deg) {
  test::Viewpoint view;
  view.distance_m = 20.0 * geo::kMetresPerNauticalMile;
  view.window_m = 3.3 * geo::kMetresPerNauticalMile;
  model::hrm::PatchOrder order = test::order_from(view);
  order.ground_track = order.ground_track + geo::Angle::degrees(90.0 - squint_deg);
  radar::RadarConfiguration configuration = test::bare_map(480);
  configuration.receiver.land_gamma_db = -120.0;
  const model::hrm::PatchGeometry geometry(order, configuration, test::kGround_m);
  configuration.world.movers.push_back({"mover", order.centre, 5.0, geometry.up().degrees(), 1000.0, 0.0});
  const auto map = test::make_patch(configuration, order, test::ground_of(model::terrain::flat(test::kGround_m)));
  double sum = 0.0, columns = 0.0;
  for (std::size_t i = 0; i < map.image().power.size(); ++i) {
    const auto power = static_cast<double>(map.image().power[i]);
    sum += power;
    columns += power * (static_cast<double>(i % 480) + 0.5);
  }
  return (columns / sum / 480.0 - 0.5) * view.window_m;
}

TEST(Truth, AMoverIsDisplacedOnAMap) {
  for (const auto& [name, squint_deg, outside] : {std::tuple("90°", 90.0, 750.0), {"40°", 40.0, 1166.8}})
    expect_row({"Movers", std::string("displacement on map, 5 m/s, 20 NM, 480 kt, squint ") + name, outside,
                0.01 * outside, "m", "R v / (V sin φ), Raney 1971", "the mover goes on during the formation"},
               displacement_m(squint_deg));
}

// Echo of a steady target 10 m above a calm sea, with the lobes over that without.
double lobe_db(double distance_m) {
  const auto echo = [&](bool lobes) {
    radar::RadarConfiguration configuration = plain();
    configuration.fidelity.sea_lobes = lobes;
    configuration.world.sea.wind_speed_mps = 0.0;
    const radar::Mover target{.position = north(distance_m), .height_m = 10.0, .echo = radar::TargetEcho::steady};
    return echoes_of(target, configuration, 1).at(0);
  };
  return 10.0 * std::log10(echo(true) / echo(false));
}

// |1 + rho exp(-j phase)| with the exact difference of both ways over a flat sea, and Fresnel's rho.
double field_of_two_rays(double distance_m, double height_m) {
  const double wavelength_m = 299792458.0 / 9.6e9;
  const double sum_m = kAltitude_m + height_m, difference_m = kAltitude_m - height_m;
  const double ways_m = std::hypot(distance_m, sum_m) - std::hypot(distance_m, difference_m);
  const double sine = sum_m / std::hypot(distance_m, sum_m), cosine2 = 1.0 - sine * sine;
  const std::complex<double> root = std::sqrt(std::complex<double>(65.0 - cosine2, -37.0));
  const std::complex<double> horizontal = (sine - root) / (sine + root);
  return std::abs(1.0 + horizontal * std::polar(1.0, -2.0 * std::numbers::pi * ways_m / wavelength_m));
}

// Echo of a wall that stands in the sea, with lobes over without.
double wall_lobe_db(double distance_m, double height_m) {
  const auto scene =
      test::scene_of({{.east_side_m = 20.0, .north_side_m = 1.0, .height_m = height_m}}, north(distance_m));
  const auto echo = [&](bool lobes) {
    radar::RadarConfiguration configuration = plain();
    configuration.fidelity.sea_lobes = lobes;
    configuration.receiver.noise_floor_db = -200.0;
    configuration.world.sea.wind_speed_mps = 0.0;
    model::rbm::Beam beam(configuration);
    std::vector<float> with(configuration.fidelity.samples), without(with.size());
    beam.measure(ahead(), {sea(), scene.get()}, with);
    beam.measure(ahead(), {sea(), nullptr}, without);
    double sum = 0.0;
    for (std::size_t i = 0; i < with.size(); ++i) sum += static_cast<double>(with[i]) - static_cast<double>(without[i]);
    return sum;
  };
  return model::decibels(echo(true) / echo(false));
}

TEST(Points, AWallInACalmSeaHasTheMeanOfItsLobes) {
  constexpr double kHeight_m = 5.0;
  for (const double distance_m : {18e3, 55e3}) {
    constexpr int kSteps = 1000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i)
      sum += std::pow(field_of_two_rays(distance_m, kHeight_m * (i + 0.5) / kSteps), 4.0) / kSteps;
    expect_row({"Targets",
                "lobes of a wall 5 m high in a calm sea, " + std::to_string(static_cast<int>(distance_m / 1e3)) +
                    " km, aircraft at 3,000 m",
                model::decibels(sum), 1.0, "dB", "mean of two rays over the height: Skolnik 2001, 8.2; Fresnel",
                "the reflected ray is taken at the wall's place"},
               wall_lobe_db(distance_m, kHeight_m));
  }
}

TEST(Points, OverACalmSeaHaveTheLobesOfTwoRays) {
  constexpr double height_m = 10.0;
  for (const double distance_m : {18e3, 31e3, 55e3}) {
    const double field = field_of_two_rays(distance_m, height_m);
    expect_row({"Targets",
                "lobe of a target 10 m above a calm sea, " + std::to_string(static_cast<int>(distance_m / 1e3)) +
                    " km, aircraft at 3,000 m",
                40.0 * std::log10(field), 1.0, "dB", "two rays over a plane: Skolnik 2001, 8.2; Fresnel",
                "the reflected ray is taken at the target's place"},
               lobe_db(distance_m));
  }
}

}  // namespace
}  // namespace yars::truth
