#include "tools/trade/trade_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "lib/error/error.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/map_image.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/receiver.hpp"
#include "model/physics/reflectivity.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/beam.hpp"
#include "tools/trade/trade_table.hpp"

namespace yars::tools::trade {

namespace {
constexpr std::uint8_t kMarkMaterial = 1;
constexpr double kMarkGamma_db = 40.0;  // far above the return of water
constexpr double kNothing_db = -150.0;  // gamma of all other land, which must return no power
constexpr double kEdgeFraction = 0.03;  // side of a mark / side of the window; smaller marks have inexact centroids
}  // namespace

MarkScene::MarkScene(const model::hrm::PatchOrder& order) {
  kinds_.push_back({kMarkMaterial, 0, 0});
  const model::hrm::PatchGeometry geometry(order, radar::RadarConfiguration(), 0.0);
  for (int row = 0; row < kMarksPerEdge; ++row)
    for (int column = 0; column < kMarksPerEdge; ++column)
      add(geometry.position_of({((column + 0.5) / kMarksPerEdge - 0.5) * geometry.window_m(),
                                (0.5 - (row + 0.5) / kMarksPerEdge) * geometry.window_m()}),
          kEdgeFraction * geometry.window_m());
}

void MarkScene::add(geo::GeoPoint centre, double edge_m) {
  model::scene::Tile tile;
  tile.origin = centre;
  const auto half = static_cast<float>(0.5 * edge_m);
  tile.bounds = {-half, half, -half, half, 0.0F, 0.0F};
  tile.east_m = {-half, half, half, -half};
  tile.north_m = {-half, -half, half, half};
  tile.up_m.assign(4, 0.0F);
  tile.first_with_normal = 4;
  tile.corner = {{{0, 0}, {1, 2}, {2, 3}}};
  tile.on_ground = 2;
  tile.kind.assign(2, 0);
  tile.object.assign(2, static_cast<std::uint32_t>(objects_.size()));
  objects_.push_back({"mark", centre, 0.0, 0.0, edge_m, edge_m, 0.0, 0});
  tiles_.push_back(std::move(tile));
}

void MarkScene::tiles_near(geo::GeoPoint /*position*/, double /*radius_m*/,
                           std::vector<const model::scene::Tile*>& found) const {
  found.clear();
  for (const model::scene::Tile& tile : tiles_) found.push_back(&tile);
}

radar::RadarConfiguration marks_alone(radar::RadarConfiguration configuration) {
  configuration.fidelity.map_detail = false;
  configuration.fidelity.map_response = false;
  configuration.receiver.land_gamma_db = kNothing_db;
  for (radar::Material& material : configuration.world.land.materials)
    material.gamma_db = material.code == kMarkMaterial ? kMarkGamma_db : kNothing_db;
  configuration.world.movers.clear();
  return configuration;
}

namespace {

namespace hrm = model::hrm;
using radar::RadarConfiguration;

// Sums of power of the ruler and of what is compared with it.
struct Brightness {
  double ruler = 0.0, found = 0.0;
  void add(double ruler_power, double found_power) {
    ruler += ruler_power;
    found += found_power;
  }
  // [dB] NaN: none
  double over_the_ruler(bool is_radar) const {
    return is_radar && ruler > 0.0 ? 10.0 * std::log10(found / ruler) : std::numeric_limits<double>::quiet_NaN();
  }
};

constexpr double kDarkFraction = 0.05;    // fraction of level ground's power; pixels with less power are dark
constexpr double kMinPower = 1e-8;        // lower limit of powers, avoids log10(0); unit as MapImage::power
constexpr double kVisibleFraction = 0.2;  // fraction of the brightest mark's power; a mark with less is hidden

// Apparent position of each mark: centroid of the power in the mark's part of the window (one of 3 x 3 equal parts).
// nullopt: the mark is hidden.
std::vector<std::optional<hrm::MapPoint>> marks_of(const hrm::MapImage& image, double window_m) {
  const double pixel_m = window_m / image.size;
  struct Sum {
    double power = 0.0, right_m = 0.0, up_m = 0.0;
  };
  std::vector<Sum> sums(static_cast<std::size_t>(kMarksPerEdge) * kMarksPerEdge);
  for (int row = 0; row < image.size; ++row) {
    for (int column = 0; column < image.size; ++column) {
      const auto power = std::max(0.0, static_cast<double>(image.power[image.at(column, row)]));
      const int mark = row * kMarksPerEdge / image.size * kMarksPerEdge + column * kMarksPerEdge / image.size;
      Sum& sum = sums[static_cast<std::size_t>(mark)];
      sum.power += power;
      sum.right_m += power * ((column + 0.5) * pixel_m - 0.5 * window_m);
      sum.up_m += power * (0.5 * window_m - (row + 0.5) * pixel_m);
    }
  }
  const double brightest =
      std::max_element(sums.begin(), sums.end(), [](const Sum& a, const Sum& b) { return a.power < b.power; })->power;
  std::vector<std::optional<hrm::MapPoint>> marks(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (sums[i].power > kVisibleFraction * brightest)
      marks[i] = hrm::MapPoint{sums[i].right_m / sums[i].power, sums[i].up_m / sums[i].power};
  return marks;
}

}  // namespace

double time_map(hrm::PatchFormation& patch_formation, const hrm::PatchOrder& order,
                const hrm::PatchEnvironment& environment, Clock clock, const parallel::GoesOn& goes_on) {
  const double begin_ms = clock();
  patch_formation.begin(order);
  patch_formation.set_environment(environment);
  for (; patch_formation.state() != hrm::PatchState::done; patch_formation.advance()) parallel::check(goes_on);
  return clock() - begin_ms;
}

MapObservation observe_map(const RadarConfiguration& configuration, const hrm::PatchOrder& order,
                           const hrm::PatchEnvironment& environment, Clock clock, const parallel::GoesOn& goes_on) {
  RadarConfiguration noiseless = configuration;
  noiseless.fidelity = without_noise(noiseless.fidelity);
  hrm::PatchFormation patch_formation(noiseless, {});
  MapObservation observation;
  observation.took_ms = time_map(patch_formation, order, environment, clock, goes_on);
  observation.size = patch_formation.image().size;
  observation.power.assign(patch_formation.image().power.begin(), patch_formation.image().power.end());
  observation.video = patch_formation.picture();
  observation.power_is_radar = configuration.fidelity.algorithm != radar::Algorithm::report_1996;
  observation.noise =
      hrm::noise_gamma(configuration.high_resolution, geo::Length::metres(patch_formation.geometry().slant_range_m()),
                       geo::Length::metres(patch_formation.geometry().window_m()));
  const double level = observation.power_is_radar ? model::physics::make_land_return(noiseless).gamma[0]
                                                  : patch_formation.geometry().sin_grazing();
  for (const float power : observation.power)
    observation.dark.push_back(static_cast<double>(power) < kDarkFraction * level ? 1 : 0);

  RadarConfiguration marked = marks_alone(noiseless);
  // The brightness of 1996 does not depend on materials, so marks are invisible. The algorithm `standard` uses the same
  // map plane and puts the marks at the same positions.
  if (!observation.power_is_radar) marked.fidelity.algorithm = radar::Algorithm::standard;
  hrm::PatchFormation marks(marked, {});
  time_map(marks, order, {environment.window, environment.path, std::make_shared<MarkScene>(order)}, clock, goes_on);
  observation.marks = marks_of(marks.image(), marks.geometry().window_m());
  return observation;
}

MapErrors errors_against(const MapObservation& ruler, const MapObservation& found) {
  RootMeanSquare decibels, grays;
  Brightness brightness;
  std::size_t mismatches = 0;
  const auto size = static_cast<std::size_t>(ruler.size), found_size = static_cast<std::size_t>(found.size);
  for (std::size_t row = 0; row < size; ++row) {
    const std::size_t there_row = (2 * row + 1) * found_size / (2 * size);
    for (std::size_t column = 0; column < size; ++column) {
      const std::size_t there_column = (2 * column + 1) * found_size / (2 * size);
      const std::size_t here = row * size + column;
      const std::size_t there = there_row * found_size + there_column;
      grays.add(static_cast<double>(ruler.video[here]) - static_cast<double>(found.video[there]));
      if (ruler.dark[here] != found.dark[there]) ++mismatches;
      const auto exact = static_cast<double>(ruler.power[here]);
      if (exact >= 0.0) brightness.add(exact, static_cast<double>(found.power[there]));
      const bool both = ruler.dark[here] == 0 && found.dark[there] == 0 && found.power_is_radar && exact > ruler.noise;
      if (both) decibels.add(10.0 * std::log10(std::max(static_cast<double>(found.power[there]), kMinPower) / exact));
    }
  }
  double farthest_m = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t mark = 0; mark < ruler.marks.size(); ++mark) {
    if (!ruler.marks[mark] || !found.marks[mark]) continue;
    const double away_m = std::hypot(found.marks[mark]->right_m - ruler.marks[mark]->right_m,
                                     found.marks[mark]->up_m - ruler.marks[mark]->up_m);
    farthest_m = std::isnan(farthest_m) ? away_m : std::max(farthest_m, away_m);
  }
  return {farthest_m, 100.0 * static_cast<double>(mismatches) / static_cast<double>(ruler.power.size()),
          decibels.value(), grays.value(), brightness.over_the_ruler(found.power_is_radar)};
}

namespace {

using model::kernel::OfflineScan;
using model::kernel::ScanRequest;
using model::physics::SweepGeometry;
using radar::kMinScanPower;
using radar::RadarConfiguration;
using radar::ray_samples;
using radar::RaySample;

double position_error_m(const RadarConfiguration& configuration, const OfflineScan& scan) {
  // The algorithm `reference` solves the geodesic for each sample, so its positions are exact.
  if (configuration.fidelity.algorithm == radar::Algorithm::reference) return 0.0;
  constexpr std::size_t kStep = 4;  // checks every 4th sample of every 4th sweep: the error varies slowly
  model::physics::PositionArrays positions(model::rbm::sample_count(configuration));
  double worst_m = 0.0;
  for (std::size_t sweep = 0; sweep < scan.headers().size(); sweep += kStep) {
    const SweepGeometry geometry = model::kernel::geometry_of(scan.headers()[sweep]);
    std::vector<double> exact_m(positions.count);
    model::physics::sample_distances(geometry.range, exact_m);
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
  observation.position_m = position_error_m(configuration, scan);
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
  Brightness brightness;
  std::size_t ground = 0, mismatches = 0;
  for (std::size_t sweep = 0; sweep < exact.sweeps; ++sweep) {
    for (std::size_t i = 0; i < exact.samples; ++i) {
      const std::size_t here = sweep * exact.samples + i;
      // Index of the sample that contains the middle of the ruler's sample.
      const std::size_t there = sweep * found.samples + (2 * i + 1) * found.samples / (2 * exact.samples);
      grays.add(static_cast<double>(exact.video[here]) - static_cast<double>(found.video[there]));
      brightness.add(static_cast<double>(exact.power[here]), static_cast<double>(found.power[there]));
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
  return {found.position_m, 100.0 * fraction, decibels.value(), grays.value(),
          brightness.over_the_ruler(found.power_is_radar)};
}

}  // namespace yars::tools::trade
