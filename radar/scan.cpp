#include "yars/scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/kernel/offline_scan.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "radar/limits.hpp"
#include "radar/private_data.hpp"
#include "yars/radar.hpp"

namespace yars {

namespace {

model::kernel::ScanRequest kernel_request(const ScanRequest& request) {
  model::kernel::ScanRequest scan;
  scan.pose.position = {request.latitude_deg, request.longitude_deg};
  scan.pose.altitude = geo::AltitudeMsl::feet(request.altitude_ft);
  scan.pose.platform.heading = geo::Bearing::degrees(request.heading_deg);
  scan.pose.platform.ground_track = scan.pose.platform.heading;
  scan.pose.ground_speed = geo::Speed::knots(request.speed_kt);
  scan.range = geo::Length::nautical_miles(request.range_nm);
  scan.width = geo::Angle::degrees(request.width_deg);
  scan.elevation = geo::Angle::degrees(request.elevation_deg);
  scan.gain = request.gain;
  scan.sim_time_ns = static_cast<std::int64_t>(request.time_s * 1e9);
  scan.band = static_cast<std::uint8_t>(request.band);
  scan.channel = static_cast<std::uint8_t>(request.channel);
  return scan;
}

radar::RadarConfiguration configured(const Radar& radar, const Terrain& terrain, const ScanRequest& request,
                                     const Scene* scene) {
  radar::RadarConfiguration configuration = radar.configuration();
  configuration.terrain = terrain.stores()->configuration();
  if (request.samples) configuration.fidelity.samples = *request.samples;
  if (request.seed) configuration.seed = *request.seed;
  if (scene != nullptr) configuration.world.scenes = scene->parts().scenes;
  return configuration;
}

void check_pose(const ScanRequest& request, const radar::RadarConfiguration& configuration) {
  if (request.force) return;
  if (auto problem = radar::beyond_gimbal(geo::Angle::degrees(request.elevation_deg),
                                          geo::Angle::degrees(request.width_deg), configuration.antenna))
    radar::fail(std::move(*problem));
}

void check_height(const ScanRequest& request, const model::terrain::TerrainView& terrain) {
  if (request.force) return;
  if (auto problem = radar::beneath_ground(geo::AltitudeMsl::feet(request.altitude_ft),
                                           terrain.elevation_m({request.latitude_deg, request.longitude_deg})))
    radar::fail(std::move(*problem));
}

}  // namespace

Expected<Scan> Scan::prepare(const Radar& radar, const Terrain& terrain, const ScanRequest& request, const Scene* scene,
                             const Call& call) {
  return radar::guarded([&] {
    radar::check_fields(request);
    radar::check_same_terrain(scene, terrain);
    auto work = std::make_unique<Work>();
    work->configuration = configured(radar, terrain, request, scene);
    work->request = kernel_request(request);
    work->threads = request.threads;
    if (scene != nullptr) work->scene = *scene;
    check_pose(request, work->configuration);
    const auto read = [&](radar::Theatre& theatre) {
      work->environment = theatre.prepare(work->request, work->configuration.fidelity, radar::warn_of(call));
      work->left_out = theatre.left_out();
    };
    terrain.stores()->with_theatre(work->configuration.world.scenes, model::scene::SceneUse::scatterers, call.goes_on,
                                   read);
    check_height(request, *work->environment.terrain);
    return Scan(std::move(work));
  });
}

Scan::Scan(std::unique_ptr<Work> work) : work_(std::move(work)) {}
Scan::Scan(Scan&&) noexcept = default;
Scan& Scan::operator=(Scan&&) noexcept = default;
Scan::~Scan() = default;

model::kernel::OfflineScan& Scan::Work::ready() {
  if (!scan) scan = std::make_unique<model::kernel::OfflineScan>(configuration, request, threads);
  return *scan;
}

Expected<void> Scan::run(const Call& call) {
  return radar::guarded([&] {
    work_->ready().run({*work_->environment.terrain, work_->environment.scene.get()}, call.goes_on);
    if (call.progress) call.progress("scan", 1.0);
  });
}

void Scan::measure() {
  work_->ready().measure({*work_->environment.terrain, work_->environment.scene.get()});
}

void Scan::finish() {
  if (!work_->scan) return;
  work_->rays = work_->scan->rays();
  work_->result = work_->scan->take_result();
  work_->scan.reset();
}

std::size_t Scan::sweeps() const {
  return work_->headers().size();
}
std::size_t Scan::samples() const {
  return work_->headers().empty() ? 0 : work_->power().size() / work_->headers().size();
}
std::span<const float> Scan::power() const {
  return work_->power();
}

Expected<ScanSweep> Scan::sweep(std::size_t index) const {
  if (index >= work_->sweeps().size())
    return tl::unexpected(Error{"index of a sweep",
                                "less than " + std::to_string(work_->sweeps().size()),
                                std::to_string(index),
                                "",
                                ErrorCode::argument,
                                {},
                                {}});
  const databuffer::Sweep& record = work_->sweeps()[index];
  return ScanSweep{record.azimuth_left_deg,
                   record.azimuth_right_deg,
                   model::kernel::geometry_of(work_->headers()[index]).azimuth.degrees(),
                   record.hash,
                   {&record.video[0], record.samples},
                   work_->power().subspan(index * samples(), samples())};
}

std::uint64_t Scan::hash() const {
  return model::kernel::scan_hash(work_->sweeps());
}

const std::vector<std::string>& Scan::left_out() const {
  return work_->left_out;
}

ScanFacts Scan::facts() const {
  if (work_->headers().empty()) work_->ready();
  const model::kernel::SweepHeader& header = work_->headers().front();
  ScanFacts facts;
  facts.latitude_deg = header.apex.latitude_deg;
  facts.longitude_deg = header.apex.longitude_deg;
  facts.altitude_m = header.altitude.metres();
  facts.ground_track_deg = header.ground_track.degrees();
  facts.elevation_deg = header.elevation.degrees();
  facts.range_m = header.range.metres();
  facts.slant_range_samples = work_->configuration.fidelity.slant_range;
  facts.preset = work_->configuration.fidelity.name;
  facts.rays = work_->scan ? work_->scan->rays() : work_->rays;
  facts.terrain_bytes = work_->environment.terrain->resident_bytes();
  facts.scene_bytes = work_->environment.scene ? work_->environment.scene->resident_bytes() : 0;
  return facts;
}

namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

ScanLabels empty_labels(std::size_t count) {
  ScanLabels labels;
  for (auto* flags : {&labels.shadow, &labels.layover, &labels.material}) *flags = std::vector<std::uint8_t>(count);
  labels.object.assign(count, -1);
  for (auto* numbers : {&labels.ground_range_m, &labels.slant_range_m, &labels.latitude_deg, &labels.longitude_deg})
    numbers->assign(count, kNoNumber);
  for (auto* numbers : {&labels.height_m, &labels.grazing_deg})
    numbers->assign(count, std::numeric_limits<float>::quiet_NaN());
  return labels;
}

// Fills in layover of samples of ground range. A lit sample is laid over if a nearer one is seen at a greater slant
// range, or a farther one at a lesser. `first`: of the sweep's samples.
void label_layover(ScanLabels& labels, std::size_t first, std::size_t samples) {
  const auto lit = [&](std::size_t i) { return labels.shadow[i] == 0 && !std::isnan(labels.height_m[i]); };
  double farthest_m = 0.0;
  for (std::size_t i = first; i < first + samples; ++i) {
    if (!lit(i)) continue;
    labels.layover[i] = labels.slant_range_m[i] < farthest_m ? 1 : 0;
    farthest_m = std::max(farthest_m, labels.slant_range_m[i]);
  }
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = first + samples; i-- > first;) {
    if (!lit(i)) continue;
    if (labels.slant_range_m[i] > nearest_m) labels.layover[i] = 1;
    nearest_m = std::min(nearest_m, labels.slant_range_m[i]);
  }
}

// Fills in all labels of a sweep; layover of samples of slant range only. `first`: of the sweep's samples.
void label_samples(ScanLabels& to, std::size_t first, std::span<const radar::RaySample> samples,
                   const model::physics::SweepGeometry& geometry, const model::physics::EffectiveEarth& earth,
                   const std::optional<Scene>& scene) {
  double before_m = 0.0, before_height_m = kNoNumber;
  for (std::size_t i = first; i < first + samples.size(); ++i) {
    const radar::RaySample& sample = samples[i - first];
    to.latitude_deg[i] = sample.position.latitude_deg;
    to.longitude_deg[i] = sample.position.longitude_deg;
    if (std::isnan(sample.distance_m)) continue;
    to.ground_range_m[i] = sample.distance_m;
    const double height_m = sample.ground.elevation_m;
    if (std::isnan(height_m)) continue;
    const model::physics::Sight sight = earth.sight(geometry.altitude.metres(), sample.distance_m, height_m);
    to.slant_range_m[i] = sight.slant_range_m;
    to.height_m[i] = static_cast<float>(height_m);
    to.shadow[i] = sample.lit ? 0 : 1;
    to.layover[i] = sample.laid_over ? 1 : 0;
    to.material[i] = sample.ground.material == 0 && sample.ground.water > 0.5
                         ? static_cast<std::uint8_t>(radar::kWaterMaterial)
                         : sample.ground.material;
    if (scene) to.object[i] = radar::object_at(scene->parts().groups, sample.position);
    // Grazing angle on the profile: that on the level, plus the slope from the sample before.
    const double slope_rad = std::isnan(before_height_m) || sample.distance_m <= before_m
                                 ? 0.0
                                 : std::atan2(height_m - before_height_m, sample.distance_m - before_m);
    if (sample.lit) {
      const double grazing_deg =
          (std::asin(std::clamp(sight.sin_grazing, -1.0, 1.0)) + slope_rad) / geo::kRadiansPerDegree;
      // Below the aircraft a slope that faces it may be seen from beyond its perpendicular.
      to.grazing_deg[i] = static_cast<float>(std::max(std::min(grazing_deg, 180.0 - grazing_deg), 0.0));
    }
    before_m = sample.distance_m;
    before_height_m = height_m;
  }
}

}  // namespace

Expected<const ScanLabels*> Scan::labels(const Call& call) {
  return radar::guarded([&]() -> const ScanLabels* {
    if (work_->labels) return &*work_->labels;
    if (work_->headers().empty()) work_->ready();
    const std::vector<radar::RaySample> samples = work_->ray_samples(call.goes_on);
    ScanLabels labels = empty_labels(samples.size());
    const auto headers = work_->headers();
    const std::size_t width = samples.size() / headers.size();
    for (std::size_t sweep = 0; sweep < headers.size(); ++sweep) {
      const auto geometry = model::kernel::geometry_of(headers[sweep]);
      const auto earth = model::physics::effective_earth(work_->configuration, geometry);
      label_samples(labels, sweep * width, std::span(samples).subspan(sweep * width, width), geometry, earth,
                    work_->scene);
      if (!work_->configuration.fidelity.slant_range) label_layover(labels, sweep * width, width);
    }
    return &work_->labels.emplace(std::move(labels));
  });
}

}  // namespace yars
