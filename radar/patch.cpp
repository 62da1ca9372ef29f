#include "yars/patch.hpp"

#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <thread>
#include <utility>

#include "lib/radar/mission.hpp"
#include "lib/text/plain_text.hpp"
#include "model/physics/environment.hpp"
#include "radar/limits.hpp"
#include "radar/private_data.hpp"
#include "yars/radar.hpp"

namespace yars {

namespace hrm = model::hrm;

namespace {

hrm::PatchOrder order_of(const PatchRequest& request, const radar::RadarConfiguration& configuration) {
  hrm::PatchOrder order;
  order.apex = {request.latitude_deg, request.longitude_deg};
  order.altitude = geo::AltitudeMsl::feet(request.altitude_ft);
  order.ground_track = geo::Bearing::degrees(request.heading_deg);
  order.ground_speed = geo::Speed::knots(request.speed_kt);
  order.centre = {request.target_latitude_deg, request.target_longitude_deg};
  order.window = geo::Length::nautical_miles(request.window_nm.value_or(configuration.window_limits.power_up_nm));
  order.looks = request.looks.value_or(static_cast<int>(configuration.high_resolution.looks.front()));
  order.sim_time = geo::Duration::seconds(request.time_s);
  order.map = static_cast<std::uint32_t>(request.map);
  return order;
}

radar::RadarConfiguration configured(const Radar& radar, const Terrain& terrain, const PatchRequest& request) {
  radar::RadarConfiguration configuration = radar.configuration();
  configuration.terrain = terrain.stores()->configuration();
  if (request.seed) configuration.seed = *request.seed;
  if (request.size) configuration.fidelity.map_size = *request.size;
  if (const int most = hrm::max_map_size(configuration.fidelity.algorithm); configuration.fidelity.map_size > most)
    radar::fail({"size", "at most " + std::to_string(most) + " with the algorithm reference",
                 std::to_string(configuration.fidelity.map_size), "give a smaller `size`, or the preset fine",
                 ErrorCode::range, 16.0, static_cast<double>(most)});
  return configuration;
}

// Minimum target distance as a fraction of the window's side; PatchRequest::force does not override this minimum. Below
// 0.5 the map would extend behind the aircraft. hrm::PatchOrder requires more than 0.71, half the window's diagonal.
constexpr double kMinDistanceFraction = 0.75;

// Checks the radar's limits, unless `force`; and, always, that the map does not extend behind the aircraft.
void check_order(const hrm::PatchOrder& order, const radar::RadarConfiguration& configuration, bool force) {
  if (!force)
    if (auto problem = radar::beyond_limits(order, configuration)) radar::fail(std::move(*problem));
  const double distance_nm = geo::geodesic_inverse(order.apex, order.centre).distance.nautical_miles();
  if (distance_nm < kMinDistanceFraction * order.window.nautical_miles())
    radar::fail(
        {"target_latitude_deg, target_longitude_deg",
         "a target at a distance of at least " + text::text_of_number(kMinDistanceFraction) + " of the window's side",
         std::to_string(distance_nm) + " NM", "", ErrorCode::argument});
}

// Checks that the aircraft is above the ground, and that the antenna can look down at the target.
void check_heights(const hrm::PatchOrder& order, const hrm::PatchEnvironment& environment,
                   const radar::RadarConfiguration& configuration) {
  if (auto problem = radar::beneath_ground(order.altitude, environment.path->elevation_m(order.apex)))
    radar::fail(std::move(*problem));
  if (auto problem = radar::beyond_limits(order, configuration, environment.window->elevation_m(order.centre)))
    radar::fail(std::move(*problem));
}

// A mover has the defaults of the world's record.
static_assert(Mover{}.cross_section_m2 == values::WorldMover::cross_section.initial);
static_assert(Mover{}.height_m == values::WorldMover::height.initial * values::WorldMover::height.factor);

constexpr std::uint64_t kSubjectNumbers = 1ULL << 33U;  // PointTarget::number is beyond those of configured movers

model::physics::MovingPoint moving_point(const Mover& mover, const hrm::PatchOrder& order, std::uint64_t number) {
  return model::physics::moving_point({{mover.latitude_deg, mover.longitude_deg},
                                       geo::Bearing::degrees(mover.heading_deg),
                                       geo::Speed::knots(mover.speed_kt).metres_per_second(),
                                       order.sim_time},
                                      {.cross_section_m2 = mover.cross_section_m2, .number = number}, mover.height_m);
}

std::size_t threads_of(const PatchRequest& request) {
  constexpr int kMost = 256;
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  return static_cast<std::size_t>(request.threads.value_or(std::clamp(processors, 1, kMost)));
}

hrm::LabelUse label_use(LabelUse use) {
  return static_cast<hrm::LabelUse>(use);
}
static_assert(static_cast<int>(LabelUse::heights) == static_cast<int>(hrm::LabelUse::heights));

}  // namespace

Patch::Work::Work(const radar::RadarConfiguration& given, std::size_t count, LabelUse labels)
    : configuration(given), threads(count), label_use(labels) {}

Patch::Work::Formation::Formation(const radar::RadarConfiguration& configuration, std::size_t threads, LabelUse labels)
    : workers(threads),
      map(configuration, {threads, [this](const std::function<void(std::size_t)>& job) { workers.run(job); }},
          hrm::kMaxSectorPoints, yars::label_use(labels)) {}

Patch::Work::Formation& Patch::Work::ready() {
  if (!formation) formation = std::make_unique<Formation>(configuration, threads, label_use);
  return *formation;
}

void Patch::Work::prepare(const Terrain& terrain, const PatchRequest& request, const PatchSubject& subject,
                          const Call& call) {
  radar::check_fields(request);
  radar::check_same_terrain(subject.scene, terrain);
  const hrm::PatchOrder wanted = order_of(request, configuration);
  check_order(wanted, configuration, request.force);
  const std::vector<radar::Scene>& scenes =
      subject.scene != nullptr ? subject.scene->parts().scenes : configuration.world.scenes;
  const hrm::PatchNeed need = ready().map.begin(wanted);
  terrain.stores()->with_theatre(scenes, model::scene::SceneUse::triangles, call.goes_on, [&](radar::Theatre& theatre) {
    environment = theatre.prepare(need, radar::warn_of(call));
    left_out = theatre.left_out();
  });
  if (!request.force) check_heights(wanted, environment, configuration);
  order = wanted;
  for (const Mover& mover : subject.movers)
    environment.traffic.push_back(moving_point(mover, order, kSubjectNumbers + environment.traffic.size()));
}

std::span<const std::string_view> Patch::steps() {
  return hrm::kPatchStages;
}

Expected<Patch> Patch::prepare(const Radar& radar, const Terrain& terrain, const PatchRequest& request,
                               const PatchSubject& subject, const Call& call) {
  return radar::guarded([&] {
    radar::check_fields(request);
    auto work = std::make_unique<Work>(configured(radar, terrain, request), threads_of(request), subject.labels);
    work->prepare(terrain, request, subject, call);
    return Patch(std::move(work));
  });
}

Expected<void> Patch::prepare_next(const Terrain& terrain, const PatchRequest& request, const PatchSubject& subject,
                                   const Call& call) {
  return radar::guarded([&] { work_->prepare(terrain, request, subject, call); });
}

Patch::Patch(std::unique_ptr<Work> work) : work_(std::move(work)) {}
Patch::Patch(Patch&&) noexcept = default;
Patch& Patch::operator=(Patch&&) noexcept = default;
Patch::~Patch() = default;

Expected<void> Patch::run(const Call& call) {
  return radar::guarded([&] {
    hrm::PatchFormation& map = work_->ready().map;
    map.begin(work_->order);
    map.set_environment(work_->environment);
    while (map.state() != hrm::PatchState::done) {
      parallel::check(call.goes_on);
      const auto stage = static_cast<std::size_t>(map.stages_done());
      map.advance();
      if (call.progress)
        call.progress(hrm::kPatchStages[stage], static_cast<double>(stage + 1) / hrm::kPatchStages.size());
    }
    work_->geometry = map.geometry();
    work_->formation_s = map.formation().seconds();
    work_->triangles = map.triangles();
  });
}

void Patch::finish() {
  if (!work_->formation) return;
  work_->result = work_->formation->map.take_result();
  work_->formation.reset();
}

int Patch::size() const {
  return work_->configuration.fidelity.map_size;
}
std::span<const std::uint8_t> Patch::video() const {
  return work_->picture();
}
std::span<const float> Patch::power() const {
  return work_->image().power;
}
PatchLabels Patch::labels() const {
  const hrm::PixelLabels& labels = work_->labels();
  return {labels.shadow, labels.layover, labels.object, labels.material, labels.height_m, labels.sin_grazing};
}
std::uint64_t Patch::hash() const {
  return XXH3_64bits(work_->picture().data(), work_->picture().size());
}
const std::vector<std::string>& Patch::left_out() const {
  return work_->left_out;
}

namespace {

// Affine transform from pixel to the map's plane with north up, in GDAL's order. The plane has the same origin as that
// of the map, so the transform rotates by the bearing of the map's centre.
std::array<double, 6> plane_from_pixel(const hrm::PatchGeometry& geometry, int size) {
  const double pixel_m = geometry.window_m() / size;
  const double sine = std::sin(geometry.up().radians());
  const double cosine = std::cos(geometry.up().radians());
  const double left_m = -0.5 * geometry.window_m();
  const double top_m = geometry.distance_m() + 0.5 * geometry.window_m();
  return {left_m * cosine + top_m * sine,  pixel_m * cosine, -pixel_m * sine,
          -left_m * sine + top_m * cosine, -pixel_m * sine,  -pixel_m * cosine};
}

}  // namespace

PatchFacts Patch::facts() const {
  const hrm::PatchOrder& order = work_->order;
  PatchFacts facts;
  facts.latitude_deg = order.apex.latitude_deg;
  facts.longitude_deg = order.apex.longitude_deg;
  facts.altitude_m = order.altitude.metres();
  facts.ground_track_deg = order.ground_track.degrees();
  facts.target_latitude_deg = order.centre.latitude_deg;
  facts.target_longitude_deg = order.centre.longitude_deg;
  facts.window_m = order.window.metres();
  facts.resolution_m = radar::map_resolution(order.window).metres();
  facts.looks = order.looks;
  facts.preset = work_->configuration.fidelity.name;
  facts.threads = work_->threads;
  facts.terrain_bytes = work_->environment.window->resident_bytes() + work_->environment.path->resident_bytes();
  facts.formation_s = work_->formation_s;
  facts.triangles = work_->triangles;
  if (!work_->geometry) return facts;
  const hrm::PatchGeometry& geometry = *work_->geometry;
  facts.target_height_m = geometry.plane_msl_m();
  facts.up_deg = geometry.up().degrees();
  facts.ground_range_m = geometry.distance_m();
  facts.slant_range_m = geometry.slant_range_m();
  facts.grazing_deg = std::asin(geometry.sin_grazing()) / geo::kRadiansPerDegree;
  facts.plane_from_pixel = plane_from_pixel(geometry, size());
  return facts;
}

PatchPositions Patch::positions() const {
  PatchPositions positions;
  if (!work_->geometry) return positions;
  const hrm::PatchGeometry& geometry = *work_->geometry;
  const double above_m = geometry.altitude_m() - geometry.plane_msl_m();
  const double pixel_m = geometry.window_m() / size(), half_m = 0.5 * geometry.window_m();
  for (int row = 0; row < size(); ++row)
    for (int column = 0; column < size(); ++column) {
      const hrm::MapPoint point{(column + 0.5) * pixel_m - half_m, half_m - (row + 0.5) * pixel_m};
      const geo::GeoPoint position = geometry.position_of(point);
      positions.latitude_deg.push_back(position.latitude_deg);
      positions.longitude_deg.push_back(position.longitude_deg);
      positions.ground_range_m.push_back(std::hypot(point.right_m, point.up_m + geometry.distance_m()));
      positions.slant_range_m.push_back(
          geometry.earth().sight(above_m, positions.ground_range_m.back(), 0.0).slant_range_m);
    }
  return positions;
}

}  // namespace yars
