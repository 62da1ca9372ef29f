// Sweep geometries, configurations and terrain for the tests of the radar model.
#pragma once

#include <memory>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/radar/configuration.hpp"
#include "model/rbm/reference.hpp"
#include "tests/model/terrain/shapes.hpp"

namespace yars::test {

inline constexpr geo::GeoPoint kMidLatitude{37.0, -122.0};

// Configuration of the algorithm `reference` on a flat earth, without noise, smears and gases. The beam is 180 degrees
// wide in elevation.
inline radar::RadarConfiguration bare_configuration(int samples) {
  radar::RadarConfiguration configuration;
  configuration.fidelity.algorithm = radar::Algorithm::reference;
  configuration.fidelity.samples = samples;
  configuration.fidelity.earth = radar::EarthModel::flat;
  configuration.fidelity.noise = false;
  configuration.fidelity.sub_beams = 1;
  configuration.fidelity.pulse_smear = false;
  configuration.fidelity.beam = radar::BeamPattern::hard_edge;
  configuration.antenna.elevation_beamwidth_deg = 180.0;
  configuration.world.atmosphere.gases = false;
  return configuration;
}

inline model::physics::SweepGeometry geometry_north(double altitude_m, double range_m,
                                                    geo::GeoPoint apex = kMidLatitude) {
  return {apex, geo::AltitudeMsl::metres(altitude_m), geo::Bearing::degrees(0.0), geo::Angle(),
          geo::Length::metres(range_m)};
}

inline model::terrain::TerrainAxis axis_north(geo::GeoPoint origin = kMidLatitude) {
  return {origin, geo::Bearing::degrees(0.0)};
}

// Samples of one sweep by the algorithm `reference`.
inline std::vector<model::rbm::Reference::Sample> seen_by_reference(const radar::RadarConfiguration& configuration,
                                                                    const model::physics::SweepGeometry& geometry,
                                                                    const model::terrain::TerrainView& terrain) {
  model::rbm::Reference reference(configuration);
  std::vector<float> power(static_cast<std::size_t>(configuration.fidelity.samples));
  reference.measure(geometry, terrain, power);
  return {reference.samples().begin(), reference.samples().end()};
}

}  // namespace yars::test
