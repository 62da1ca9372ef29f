#include "radar/ray_samples.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

#include "lib/radar/configuration.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/beam.hpp"

namespace yars::radar {

namespace {

using model::physics::SweepGeometry;

// The configuration with one ray per sweep, no pulse smear and a hard-edged beam, nearly 180 deg wide in elevation. A
// narrower beam would remove the power of samples outside the beam. The 1996 algorithm would also report these samples
// as not lit.
RadarConfiguration with_wide_beam(RadarConfiguration configuration) {
  constexpr double kWideBeam_deg = 179.9;
  configuration.fidelity.sub_beams = 1;
  configuration.fidelity.pulse_smear = false;
  configuration.fidelity.beam = BeamPattern::hard_edge;
  configuration.antenna.elevation_beamwidth_deg = kWideBeam_deg;
  return configuration;
}

RaySample sample_at(const RadarConfiguration& configuration, const geo::GeodesicRay& ray, double distance_m,
                    const model::terrain::TerrainView& terrain) {
  RaySample sample;
  sample.distance_m = distance_m;
  sample.ground.elevation_m = std::numeric_limits<double>::quiet_NaN();
  const bool no_ground = std::isnan(distance_m);
  sample.position = ray.position(geo::Length::metres(no_ground ? 0.0 : distance_m));
  if (!no_ground) sample.ground = terrain.surface_at(sample.position, configuration.fidelity.interpolation);
  return sample;
}

}  // namespace

std::vector<RaySample> ray_samples(const RadarConfiguration& given,
                                   std::span<const model::kernel::SweepHeader> positions,
                                   const model::terrain::TerrainView& terrain, const parallel::GoesOn& goes_on) {
  const RadarConfiguration configuration = with_wide_beam(given);
  const auto algorithm = model::rbm::make_algorithm(configuration);
  const std::size_t count = model::rbm::sample_count(configuration);
  std::vector<double> distance_m(count);
  std::vector<float> power(count);
  std::vector<std::uint8_t> lit(count);
  std::vector<RaySample> samples;
  samples.reserve(positions.size() * count);
  for (std::size_t sweep = 0; sweep < positions.size(); ++sweep) {
    parallel::check(goes_on);
    SweepGeometry geometry = model::kernel::geometry_of(positions[sweep]);
    geometry.elevation = geo::Angle();
    algorithm->measure(geometry, terrain, power);
    algorithm->lit(lit);
    const auto earth = model::physics::effective_earth(configuration.fidelity, geometry.apex, geometry.azimuth);
    model::physics::sample_distances(configuration.fidelity, earth, geometry, terrain, distance_m);
    const geo::GeodesicRay ray(geometry.apex, geometry.azimuth);
    for (std::size_t i = 0; i < count; ++i) {
      samples.push_back(sample_at(configuration, ray, distance_m[i], terrain));
      samples.back().lit = lit[i] != 0;
      samples.back().returns = power[i] > kMinScanPower;
    }
  }
  return samples;
}

}  // namespace yars::radar
