// Rows of the radar equation: targets, clutter, jammers, beacons; movers on patch maps.
#include <algorithm>
#include <cmath>
#include <string>

#include "lib/radar/configuration.hpp"
#include "model/physics/environment.hpp"
#include "model/physics/receiver.hpp"
#include "model/rbm/emitters.hpp"
#include "tests/model/hrm/patch_maker.hpp"
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

// Flat earth without gases and sensitivity time control.
radar::RadarConfiguration plain() {
  radar::RadarConfiguration configuration;
  configuration.fidelity.earth = radar::EarthModel::flat;
  configuration.world.atmosphere.gases = false;
  configuration.receiver.stc_exponent = 0.0;
  return configuration;
}

// Powers of a target, a jammer and a beacon's reply at the aircraft's height, in the middle of the beam; full scale
// = 1.
double target(double distance_m, double cross_section_m2) {
  radar::RadarConfiguration configuration = plain();
  radar::Mover mover;
  mover.position = north(distance_m);
  mover.height_m = kAltitude_m;
  mover.cross_section_m2 = cross_section_m2;
  configuration.world.movers.push_back(mover);
  physics::Movers movers(configuration);
  const physics::Receiver receiver = physics::Receivers(configuration).at(ahead().range);
  const auto echoes = movers.echoes(ahead(), receiver, physics::effective_earth(configuration, ahead()), sea());
  return echoes.size() == 1 ? echoes[0].power : 0.0;
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

}  // namespace
}  // namespace yars::truth
