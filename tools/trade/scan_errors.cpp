#include "tools/trade/scan_errors.hpp"

#include <algorithm>
#include <cmath>

#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/configuration.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/beam.hpp"
#include "tools/trade/candidate.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::tools::trade {

namespace {

using model::kernel::OfflineScan;
using model::kernel::ScanRequest;
using model::physics::SweepGeometry;
using radar::kMinScanPower;
using radar::RadarConfiguration;
using radar::ray_samples;
using radar::RaySample;

double position_error_m(const RadarConfiguration& configuration, const OfflineScan& scan,
                        const model::terrain::TerrainView& terrain) {
  // The algorithm `reference` solves the geodesic for each sample, so its positions are exact.
  if (configuration.fidelity.algorithm == radar::Algorithm::reference) return 0.0;
  constexpr std::size_t kStep = 4;  // checks every 4th sample of every 4th sweep: the error varies slowly
  model::physics::PositionArrays positions(model::rbm::sample_count(configuration));
  double worst_m = 0.0;
  for (std::size_t sweep = 0; sweep < scan.headers().size(); sweep += kStep) {
    const SweepGeometry geometry = model::kernel::geometry_of(scan.headers()[sweep]);
    std::vector<double> exact_m(positions.count);
    const auto earth = model::physics::effective_earth(configuration.fidelity, geometry.apex, geometry.azimuth);
    model::physics::sample_distances(configuration.fidelity, earth, geometry, terrain, exact_m);
    // Samples without ground at their slant range get ground range 0.
    std::replace_if(exact_m.begin(), exact_m.end(), [](double value) { return std::isnan(value); }, 0.0);
    std::vector<float> distance_m(exact_m.begin(), exact_m.end());
    distance_m.resize(distance_m.size() + model::terrain::kRunSlack, 0.0F);
    model::physics::sample_positions(geometry.apex, geometry.azimuth, geometry.range,
                                     configuration.fidelity.geodesic_knots, distance_m.data(), positions);
    const geo::GeodesicRay ray(geometry.apex, geometry.azimuth);
    for (std::size_t i = 0; i < positions.count; i += kStep) {
      geo::GeoPoint found = model::terrain::position_of(positions.run(), i);
      found.longitude_deg = geo::wrapped_degrees(found.longitude_deg);
      const geo::GeoPoint exact = ray.position(geo::Length::metres(static_cast<double>(distance_m[i])));
      worst_m = std::max(worst_m, geo::geodesic_inverse(exact, found).distance.metres());
    }
  }
  return worst_m;
}

template <class Predicate>
std::vector<std::uint8_t> flags_of(std::span<const RaySample> samples, Predicate predicate) {
  std::vector<std::uint8_t> flags(samples.size());
  std::transform(samples.begin(), samples.end(), flags.begin(),
                 [&](const RaySample& sample) { return predicate(sample) ? std::uint8_t{1} : std::uint8_t{0}; });
  return flags;
}

ScanObservation observe_scan(const RadarConfiguration& configuration, const model::terrain::TerrainView& terrain,
                             OfflineScan& scan, std::span<const RaySample> ray, const parallel::GoesOn& goes_on) {
  scan.run(terrain, goes_on);
  ScanObservation observation;
  observation.sweeps = scan.headers().size();
  observation.samples = model::rbm::sample_count(configuration);
  observation.power.assign(scan.power().begin(), scan.power().end());
  for (const databuffer::Sweep& sweep : scan.sweeps())
    observation.video.insert(observation.video.end(), &sweep.video[0], &sweep.video[0] + sweep.samples);
  observation.seen = flags_of(ray, [](const RaySample& sample) { return sample.lit; });
  observation.returns = flags_of(ray, [](const RaySample& sample) { return sample.returns; });
  observation.position_m = position_error_m(configuration, scan, terrain);
  observation.power_is_radar = configuration.fidelity.algorithm != radar::Algorithm::report_1996;
  return observation;
}

}  // namespace

ScanObservation observe(const RadarConfiguration& configuration, const ScanRequest& request,
                        const model::terrain::TerrainView& terrain, const parallel::GoesOn& goes_on) {
  RadarConfiguration noiseless = configuration;
  noiseless.fidelity = without_noise(noiseless.fidelity);
  OfflineScan scan(noiseless, request, 1);
  return observe_scan(noiseless, terrain, scan, ray_samples(noiseless, scan.headers(), terrain, goes_on), goes_on);
}

Ruler make_ruler(const RadarConfiguration& configuration, const ScanRequest& request,
                 const model::terrain::TerrainView& terrain, const parallel::GoesOn& goes_on) {
  RadarConfiguration noiseless = configuration;
  noiseless.fidelity = without_noise(noiseless.fidelity);
  OfflineScan scan(noiseless, request, 1);
  const std::vector<RaySample> ray = ray_samples(noiseless, scan.headers(), terrain, goes_on);
  Ruler ruler;
  ruler.observation = observe_scan(noiseless, terrain, scan, ray, goes_on);
  ruler.ground = flags_of(ray, [](const RaySample& sample) { return !std::isnan(sample.ground.elevation_m); });
  ruler.noise = model::physics::Receivers(noiseless).at(request.range).noise;
  return ruler;
}

Errors errors_against(const Ruler& ruler, const ScanObservation& found) {
  const ScanObservation& exact = ruler.observation;
  YARS_REQUIRE(exact.sweeps, ==, found.sweeps);
  RootMeanSquare decibels, grays;
  std::size_t ground = 0, mismatches = 0;
  for (std::size_t sweep = 0; sweep < exact.sweeps; ++sweep) {
    for (std::size_t i = 0; i < exact.samples; ++i) {
      const std::size_t here = sweep * exact.samples + i;
      // Index of the sample that contains the middle of the ruler's sample.
      const std::size_t there = sweep * found.samples + (2 * i + 1) * found.samples / (2 * exact.samples);
      grays.add(static_cast<double>(exact.video[here]) - static_cast<double>(found.video[there]));
      if (ruler.ground[here] == 0) continue;
      ++ground;
      if (exact.seen[here] != found.seen[there]) ++mismatches;
      const bool both = exact.returns[here] != 0 && found.returns[there] != 0;
      if (!both || !found.power_is_radar || static_cast<double>(exact.power[here]) <= ruler.noise) continue;
      const double ratio =
          static_cast<double>(std::max(found.power[there], kMinScanPower)) / static_cast<double>(exact.power[here]);
      decibels.add(10.0 * std::log10(ratio));
    }
  }
  const double fraction = ground > 0 ? static_cast<double>(mismatches) / static_cast<double>(ground) : 0.0;
  return {found.position_m, 100.0 * fraction, decibels.value(), grays.value()};
}

}  // namespace yars::tools::trade
