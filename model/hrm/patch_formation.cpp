#include "model/hrm/patch_formation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>

#include "lib/error/error.hpp"
#include "lib/radar/fidelity.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/sensor.hpp"
#include "model/hrm/algorithm.hpp"
#include "model/hrm/reference.hpp"
#include "model/hrm/report_1996.hpp"
#include "model/hrm/standard.hpp"

namespace yars::model::hrm {

namespace {
std::unique_ptr<Algorithm> make_algorithm(const physics::RadarParameters& parameters) {
  switch (parameters.fidelity.algorithm) {
    case radar::Algorithm::reference:
      return std::make_unique<Reference>(parameters);
    case radar::Algorithm::report_1996:
      return std::make_unique<Report1996>(parameters);
    case radar::Algorithm::standard:
      break;
  }
  return std::make_unique<Standard>(parameters);
}
}  // namespace

int max_map_size(radar::Algorithm algorithm) {
  return algorithm == radar::Algorithm::reference ? 1024 : 4096;
}

struct PatchFormation::Work {
  Work(const physics::RadarParameters& parameters, parallel::Executor executor, std::size_t points, LabelUse labels)
      : fidelity(parameters.fidelity),
        geometry_parameters(parameters.geometry),
        high_resolution(parameters.high_resolution),
        array(parameters),
        algorithm(make_algorithm(parameters)),
        sector_points(points),
        data(parameters.fidelity.map_size, labels) {
    if (data.labels.wanted() && parameters.fidelity.algorithm != radar::Algorithm::standard)
      labeller = std::make_unique<Standard>(parameters);
    inputs.executor = std::move(executor);
    for (std::size_t thread = 0; thread < inputs.executor.threads; ++thread) grounds.emplace_back(parameters);
  }

  void begin_map();
  void lay_grid();
  void begin_sector(std::size_t number);
  bool in_last_sector() const { return sector + 2 == data.sectors.size(); }
  void read_terrain();
  void draw_scene() { algorithm->draw_scene(inputs, data); }
  void cast_profiles() { algorithm->cast_profiles(inputs, data); }
  void draw_labels();
  void draw_map();
  void draw_video() { algorithm->draw_video(inputs, data); }

  radar::Fidelity fidelity;
  physics::GeometryParameters geometry_parameters;
  radar::HighResolutionConfiguration high_resolution;
  radar::SyntheticArray array;
  std::unique_ptr<Algorithm> algorithm;
  std::unique_ptr<Standard> labeller;  // computes the labels of maps by another algorithm; null: `algorithm` does
  PatchInputs inputs;
  PatchState state = PatchState::reset;
  int completed_stages = 0;
  std::size_t sector_points;
  std::size_t sector = 0;  // number of the sector that is being computed
  PatchData data;
  terrain::TerrainViewPointer posts;  // PatchTerrain::posts
  std::unique_ptr<GroundTexture> detail;
  std::vector<PolarGround> grounds;        // by thread
  std::vector<std::size_t> pending;        // by thread: samples over terrain that was not loaded
  std::vector<std::uint8_t> ground_begun;  // by thread: PolarGround::begin() has been called for this map
};

PatchFormation::PatchFormation(const physics::RadarParameters& parameters, parallel::Executor executor,
                               std::size_t sector_points, LabelUse labels)
    : work_(std::make_unique<Work>(parameters, std::move(executor), sector_points, labels)) {}
PatchFormation::~PatchFormation() = default;
PatchFormation::PatchFormation(PatchFormation&&) noexcept = default;
PatchFormation& PatchFormation::operator=(PatchFormation&&) noexcept = default;

PatchNeed PatchFormation::begin(const PatchOrder& order) {
  Work& work = *work_;
  work.inputs.order = order;
  work.inputs.environment = {};
  work.state = PatchState::database;
  work.completed_stages = 0;
  return patch_need(order, work.fidelity);
}

void PatchFormation::set_environment(const PatchEnvironment& environment) {
  YARS_REQUIRE(static_cast<int>(work_->state), ==, static_cast<int>(PatchState::database));
  work_->inputs.environment = environment;
  work_->begin_map();
  work_->state = PatchState::processing;
}

void PatchFormation::Work::begin_map() {
  const PatchOrder& order = inputs.order;
  // If the centre is a void, the map plane is at sea level.
  const double elevation_m = inputs.environment.window->elevation_m(order.centre);
  data.geometry.emplace(order, geometry_parameters, std::isnan(elevation_m) ? 0.0 : elevation_m);
  data.formation = radar::formation_time({geo::Length::metres(data.geometry->slant_range_m()), order.window,
                                          data.geometry->squint(order.ground_track), order.ground_speed, order.looks},
                                         array);
  data.tiles.clear();
  if (inputs.environment.scene)
    inputs.environment.scene->tiles_near(order.centre, 1.5 * order.window.metres(), data.tiles);
  lay_grid();
  pending.assign(inputs.executor.threads, 0);
  ground_begun.assign(inputs.executor.threads, 0);
  if (data.image.power.empty()) data.image = MapImage(data.image.size);  // take_result() has moved it out
  data.labels.begin(*data.geometry, data.grid, data.points);
  algorithm->begin(data);
  if (labeller) labeller->begin(data);
  begin_sector(0);
}

void PatchFormation::Work::begin_sector(std::size_t number) {
  constexpr int kOverlap = 1;  // strips on each side that a neighbour draws
  sector = number;
  data.grid.first_strip = std::max(data.sectors[number] - kOverlap, 0);
  data.grid.end_strip = std::min(data.sectors[number + 1] + kOverlap, data.grid.strips());
}

// Sets the polar grid of the window and its sectors, and resizes the arrays. If the fidelity says so, also smooths the
// ground below the grid and makes its texture.
void PatchFormation::Work::lay_grid() {
  const PolarGrid& grid = data.grid;
  posts = inputs.environment.window;
  terrain::TerrainViewPointer& ground = inputs.environment.window;
  const PolarMargins margins = polar_margins(*data.geometry, *posts, data.tiles, inputs.executor);
  data.grid = make_polar_grid(*data.geometry, data.image.size, algorithm->cells_per_pixel(), margins);
  if (fidelity.map_smooth_ground)
    ground = terrain::smooth_between_posts(posts, smoothing_parameters(*data.geometry, grid, fidelity, data.tiles));
  if (fidelity.map_detail && (!detail || !detail->fits(grid.spacing_m)))
    detail = std::make_unique<GroundTexture>(high_resolution.detail_contrast, grid.spacing_m);
  data.sectors = algorithm->uses_sectors() ? sectors_of(grid, sector_points) : std::vector<int>{0, data.grid.strips()};
  data.points = 0;
  for (std::size_t number = 0; number + 1 < data.sectors.size(); ++number) {
    begin_sector(number);
    data.points = std::max(data.points, grid.size());
  }
  data.surface.resize(data.points);
  data.crests = algorithm->uses_crests() ? crests_between_rows(grid, *posts, ground != posts) : CrestsBetweenRows{};
  if (data.crests.any()) data.crest_m.resize(data.points);
  data.horizon.resize(static_cast<std::size_t>(grid.columns));
}

void PatchFormation::Work::read_terrain() {
  const PatchTerrain terrain{inputs.environment.window.get(), inputs.environment.path.get(), data.crests, posts.get()};
  const GroundArrays arrays{data.surface.data(), data.horizon.data(), data.crests.any() ? data.crest_m.data() : nullptr,
                            data.labels.surface_labels()};
  parallel_for_strips(inputs.executor, data.grid, [&](int first, int last, std::size_t thread) {
    if (ground_begun[thread] == 0) grounds[thread].begin(*data.geometry, data.grid, *terrain.path);
    ground_begun[thread] = 1;
    pending[thread] += grounds[thread].fill(inputs.order, *data.geometry, data.grid, terrain, detail.get(),
                                            first * kStripColumns, last * kStripColumns, arrays);
  });
  algorithm->read_terrain(inputs, data);
}

// Labels of the sector. They follow the pixels, because point targets are hidden by the surface without scene where the
// algorithm draws none on it.
void PatchFormation::Work::draw_labels() {
  if (!data.labels.wanted()) return;
  if (labeller) {
    labeller->draw_scene(inputs, data);
    labeller->cast_profiles(inputs, data);
  }
  parallel_for_rows(inputs.executor, data.image, [&](int first, int last, std::size_t) {
    data.labels.draw(*data.geometry, data.grid, data.surface.data(), first, last);
  });
}

void PatchFormation::Work::draw_map() {
  algorithm->draw_pixels(inputs, data);
  draw_labels();
  if (!in_last_sector()) return;
  data.image.blind = false;
  algorithm->complete_map(inputs, data);
  const BlindZone zone(*data.geometry, inputs.order.ground_track, high_resolution.blind_zone_deg, data.image.size);
  if (!zone.may_reach_map()) return;  // starting the threads costs more than the test
  std::atomic<bool> blind{false};
  parallel_for_rows(inputs.executor, data.image, [&](int first, int last, std::size_t) {
    if (zone.blank(first, last, data.image)) blind.store(true, std::memory_order_relaxed);
  });
  data.image.blind = blind;
  data.labels.clear_blind(data.image);
}

void PatchFormation::advance() {
  Work& work = *work_;
  using Stage = void (Work::*)();
  constexpr std::array<Stage, kPatchStages.size()> kStages{&Work::read_terrain, &Work::draw_scene, &Work::cast_profiles,
                                                           &Work::draw_map, &Work::draw_video};
  if (work.state != PatchState::processing && work.state != PatchState::output) return;
  (work.*kStages[static_cast<std::size_t>(work.completed_stages)])();
  ++work.completed_stages;
  const bool drawn = work.completed_stages == static_cast<int>(kStages.size()) - 1;
  if (drawn && !work.in_last_sector()) {
    work.begin_sector(work.sector + 1);
    work.completed_stages = 0;
    return;
  }
  if (drawn) work.state = PatchState::output;
  if (work.completed_stages == static_cast<int>(kStages.size())) work.state = PatchState::done;
}

PatchState PatchFormation::state() const {
  return work_->state;
}
int PatchFormation::stages_done() const {
  return work_->completed_stages;
}
const std::vector<std::uint8_t>& PatchFormation::picture() const {
  return work_->data.picture;
}
const MapImage& PatchFormation::image() const {
  return work_->data.image;
}
const PixelLabels& PatchFormation::labels() const {
  return work_->data.labels.pixels();
}
PatchFormation::Result PatchFormation::take_result() {
  PatchData& data = work_->data;
  Result result{std::move(data.image), std::move(data.picture), data.labels.take()};
  data.image = MapImage(0);
  data.image.size = result.image.size;
  return result;
}
const PatchGeometry& PatchFormation::geometry() const {
  return *work_->data.geometry;
}
geo::Duration PatchFormation::formation() const {
  return work_->data.formation;
}
std::size_t PatchFormation::triangles() const {
  std::size_t sum = 0;
  for (const scene::Tile* tile : work_->data.tiles) sum += tile->triangles();
  return sum;
}
std::size_t PatchFormation::posts_pending() const {
  std::size_t sum = 0;
  for (const std::size_t count : work_->pending) sum += count;
  return sum;
}

}  // namespace yars::model::hrm
