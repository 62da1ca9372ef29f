#include "tools/trade/ray_samples.hpp"

#include <cmath>
#include <limits>

#include "lib/geo/geodesic.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/earth.hpp"

namespace yars::tools::trade {

namespace {

using model::rbm::Look;
using radar::RadarConfiguration;

constexpr float kNothing = 1e-8F;  // of full scale: far below the noise, and what float still tells from zero

// One ray, no smear, and a beam without edge about the horizon: what is outside a beam has no power and, by the 1996
// report, is not lit.
RadarConfiguration bare(RadarConfiguration configuration) {
  constexpr double kWholeViewDeg = 179.9;
  configuration.fidelity.sub_beams = 1;
  configuration.fidelity.pulse_smear = false;
  configuration.fidelity.beam = radar::BeamPattern::hard_edge;
  configuration.antenna.elevation_beamwidth_deg = kWholeViewDeg;
  return configuration;
}

RaySample sample_at(const RadarConfiguration& configuration, const geo::GeodesicRay& ray, double distance_m,
                    const model::terrain::TerrainView& terrain) {
  RaySample sample;
  sample.distance_m = distance_m;
  sample.ground.elevation_m = std::numeric_limits<double>::quiet_NaN();
  const bool hole = std::isnan(distance_m);
  sample.place = ray.position(geo::Length::metres(hole ? 0.0 : distance_m));
  if (!hole) sample.ground = terrain.surface_at(sample.place, configuration.fidelity.interpolation);
  return sample;
}

}  // namespace

std::vector<RaySample> ray_samples(const RadarConfiguration& given, std::span<const model::kernel::SweepPlace> places,
                                   const model::terrain::TerrainView& terrain) {
  const RadarConfiguration configuration = bare(given);
  const auto algorithm = model::rbm::make_algorithm(configuration);
  const std::size_t count = model::rbm::sample_count(configuration);
  std::vector<double> distance_m(count);
  std::vector<float> power(count);
  std::vector<std::uint8_t> lit(count);
  std::vector<RaySample> samples;
  samples.reserve(places.size() * count);
  for (const model::kernel::SweepPlace& place : places) {
    Look look = model::kernel::look_of(place);
    look.elevation = geo::Angle();
    algorithm->measure(look, terrain, power);
    algorithm->lit(lit);
    const auto earth = model::rbm::effective_earth(configuration.fidelity, look.apex, look.azimuth);
    model::rbm::sample_distances(configuration.fidelity, earth, look, terrain, distance_m);
    const geo::GeodesicRay ray(look.apex, look.azimuth);
    for (std::size_t i = 0; i < count; ++i) {
      samples.push_back(sample_at(configuration, ray, distance_m[i], terrain));
      samples.back().lit = lit[i] != 0;
      samples.back().returns = power[i] > kNothing;
    }
  }
  return samples;
}

}  // namespace yars::tools::trade
