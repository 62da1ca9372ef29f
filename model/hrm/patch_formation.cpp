#include "model/hrm/patch_formation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "lib/error/error.hpp"
#include "lib/memory/line_vector.hpp"
#include "lib/radar/mapping.hpp"
#include "model/hrm/map_image.hpp"
#include "model/hrm/profile_simd.hpp"
#include "model/hrm/reference_patch.hpp"
#include "model/hrm/report_1996_patch.hpp"
#include "model/physics/atmosphere.hpp"
#include "model/physics/reflectivity.hpp"

namespace yars::model::hrm {

// Array on the polar grid. It grows only, and resizing discards its contents. Each row of a strip has its own cache
// line.
template <class Number>
class PolarArray {
 public:
  void resize(std::size_t size) {
    if (size <= numbers_.size()) return;
    numbers_ = {};  // first, so that old and new array do not coexist
    numbers_.resize(size);
  }
  Number* data() { return numbers_.data(); }
  const Number* data() const { return numbers_.data(); }
  std::size_t size() const { return numbers_.size(); }

 private:
  memory::CacheAlignedVector<Number> numbers_;
};

namespace {
constexpr int kRowsPerTask = 32;  // rows of the map
}  // namespace

struct PatchFormation::Work {
  Work(const radar::RadarConfiguration& given, parallel::Executor given_executor)
      : configuration(given),
        executor(std::move(given_executor)),
        gas(configuration),
        movers(configuration),
        report_1996(configuration.fidelity.algorithm == radar::Algorithm::report_1996),
        image(configuration.fidelity.map_size),
        response(configuration.high_resolution.sidelobe_db,
                 static_cast<double>(radar::kMapCells) / std::max(configuration.fidelity.map_size, 1)) {
    for (std::size_t thread = 0; thread < executor.threads; ++thread) {
      rasters.emplace_back(configuration);
      grounds.emplace_back(configuration);
    }
  }

  void prepare_map();
  void clear_walls();
  void read_terrain();
  void draw_scene();
  void cast_profiles();
  void shade();
  void draw_map();
  void fit_gas_rows();
  void draw_video();
  double thermal_noise() const {
    return noise_gamma(configuration.high_resolution, geo::Length::metres(geometry->slant_range_m()), order.window);
  }
  // job(first strip, end of strips, thread).
  template <class Job>
  void parallel_for_strips(const Job& job) {
    constexpr int kStripsPerTask = 2;
    parallel::parallel_for(executor, grid.strips(), kStripsPerTask, job);
  }

  radar::RadarConfiguration configuration;
  parallel::Executor executor;
  physics::GasPath gas;
  MapMovers movers;
  PatchOrder order;
  PatchEnvironment environment;
  PatchState state = PatchState::reset;
  int completed_stages = 0;
  std::optional<PatchGeometry> geometry;
  geo::Duration formation{};
  PolarGrid grid;
  std::vector<const scene::Tile*> tiles;
  std::unique_ptr<Detail> detail;
  std::unique_ptr<ReferencePatch> reference;  // only for the algorithm `reference`
  std::vector<PolarGround> grounds;
  std::vector<SceneRaster> rasters;
  PolarArray<SurfacePoint> surface;
  PolarArray<WallPoint> walls;
  PolarArray<float> cross_section_m2, horizon, arc, crest_m;
  CrestsBetweenRows crests;  // crest_m is used if any() is true
  bool walls_dirty = false;  // a scene has been drawn, and profiles have not yet been cast
  std::vector<float> distance_m, inverse_m, above_plane_m, above_level_m;
  std::vector<simd::GasRow> gas_rows;  // empty: no attenuation by gases
  std::vector<std::size_t> pending;
  std::vector<std::uint8_t> ground_begun;  // by thread: PolarGround::begin() has been called for this map
  bool report_1996;                        // the image holds brightness, see report_1996_patch.hpp
  MapImage image;
  Response response;
  std::vector<std::uint8_t> picture;
};

PatchFormation::PatchFormation(const radar::RadarConfiguration& configuration, parallel::Executor executor)
    : work_(std::make_unique<Work>(configuration, std::move(executor))) {}
PatchFormation::~PatchFormation() = default;
PatchFormation::PatchFormation(PatchFormation&&) noexcept = default;
PatchFormation& PatchFormation::operator=(PatchFormation&&) noexcept = default;

PatchNeed PatchFormation::begin(const PatchOrder& order) {
  Work& work = *work_;
  work.order = order;
  work.environment = {};
  work.state = PatchState::database;
  work.completed_stages = 0;
  return patch_need(order, work.configuration.fidelity);
}

void PatchFormation::give(const PatchEnvironment& environment) {
  YARS_REQUIRE(static_cast<int>(work_->state), ==, static_cast<int>(PatchState::database));
  work_->environment = environment;
  work_->prepare_map();
  work_->state = PatchState::processing;
}

void PatchFormation::Work::prepare_map() {
  const double elevation_m = environment.window->elevation_m(order.centre);
  geometry.emplace(order, configuration.fidelity, std::isnan(elevation_m) ? 0.0 : elevation_m);
  formation = radar::formation_time({geo::Length::metres(geometry->slant_range_m()), order.window,
                                     geometry->squint(order.ground_track), order.ground_speed, order.looks},
                                    configuration);
  tiles.clear();
  if (environment.scene) environment.scene->tiles_near(order.centre, 1.5 * order.window.metres(), tiles);
  const PolarMargins margins = polar_margins(*geometry, *environment.window, tiles, executor);
  const bool exact = configuration.fidelity.algorithm == radar::Algorithm::reference;
  const int cells = exact ? std::max(kReferenceCells, configuration.fidelity.map_oversampling)
                          : configuration.fidelity.map_oversampling;
  grid = make_polar_grid(*geometry, image.size, cells, margins);
  const terrain::TerrainViewPointer facets = environment.window;
  if (configuration.fidelity.map_smooth_ground)
    environment.window =
        terrain::smooth_between_posts(environment.window, smooth_order(*geometry, grid, configuration.fidelity, tiles));
  reference.reset();
  if (exact) reference = std::make_unique<ReferencePatch>(configuration, *geometry, grid);
  if (configuration.fidelity.map_detail && (!detail || detail->pixel_m() != grid.spacing_m))
    detail = std::make_unique<Detail>(configuration.high_resolution.detail_contrast, grid.spacing_m);
  surface.resize(grid.size());
  if (!tiles.empty()) clear_walls();
  crests = report_1996 ? CrestsBetweenRows{} : crests_between_rows(grid, *facets, environment.window != facets);
  if (crests.any()) crest_m.resize(grid.size());
  cross_section_m2.resize(grid.size());
  horizon.resize(static_cast<std::size_t>(grid.columns));
  distance_m.clear();
  inverse_m.clear();
  above_plane_m.clear();
  above_level_m.clear();
  for (int row = 0; row < grid.rows; ++row) {
    distance_m.push_back(static_cast<float>(grid.distance_m(row)));
    inverse_m.push_back(static_cast<float>(1.0 / grid.distance_m(row)));
    above_plane_m.push_back(static_cast<float>(geometry->above_plane_m(grid.distance_m(row))));
    above_level_m.push_back(static_cast<float>(geometry->above_level_m(grid.distance_m(row))));
  }
  fit_gas_rows();
  arc.resize(static_cast<std::size_t>(grid.columns));
  for (int column = 0; column < grid.columns; ++column)
    arc.data()[column] = static_cast<float>(grid.width_m(column, 1.0));
  pending.assign(executor.threads, 0);
  ground_begun.assign(executor.threads, 0);
}

// Casting profiles resets the walls. This clears new arrays, and walls left by an abandoned map.
void PatchFormation::Work::clear_walls() {
  const std::size_t before = walls.size();
  walls.resize(grid.size());
  if (!walls_dirty && walls.size() == before) return;
  std::fill_n(walls.data(), walls.size(), WallPoint());
  walls_dirty = false;
}

void PatchFormation::Work::read_terrain() {
  parallel_for_strips([&](int first, int last, std::size_t thread) {
    if (ground_begun[thread] == 0) grounds[thread].begin(*geometry, grid, *environment.path);
    ground_begun[thread] = 1;
    pending[thread] +=
        grounds[thread].fill(order, *geometry, grid, {environment.window.get(), environment.path.get(), crests},
                             detail.get(), first * kStripColumns, last * kStripColumns,
                             {surface.data(), horizon.data(), crests.any() ? crest_m.data() : nullptr});
  });
  if (reference) reference->read_terrain({environment.window.get(), environment.path.get()});
}

void PatchFormation::Work::draw_scene() {
  if (reference) {
    if (!tiles.empty()) reference->read_scene(*environment.scene, tiles, surface.data());
    return;
  }
  if (tiles.empty()) return;
  walls_dirty = true;
  // Tiles that cross bands are drawn in each band, so bands are few. Two a thread balance the load.
  const auto bands = static_cast<int>(executor.threads == 1 ? 1 : 2 * executor.threads);
  const std::vector<PlacedTile> placed = place_tiles(*geometry, grid, tiles, executor);
  const std::vector<int> begin = even_bands(grid, placed, bands);
  parallel::parallel_for(executor, bands, 1, [&](int first, int last, std::size_t thread) {
    for (auto band = static_cast<std::size_t>(first); band < static_cast<std::size_t>(last); ++band)
      rasters[thread].draw(*geometry, grid, *environment.scene, placed, begin[band] * kStripColumns,
                           begin[band + 1] * kStripColumns, {surface.data(), walls.data()});
  });
}

// Preset `1996`: replaces the profiles.
void PatchFormation::Work::shade() {
  parallel_for_strips([&](int first, int last, std::size_t) {
    shade_polar_grid(*geometry, grid, {surface.data(), horizon.data()}, first * kStripColumns, last * kStripColumns,
                     cross_section_m2.data());
  });
}

void PatchFormation::Work::cast_profiles() {
  if (report_1996) return shade();
  if (reference) return reference->accumulate(surface.data(), image);
  const std::size_t size = grid.strip_size();
  const double bounce_db = configuration.high_resolution.double_bounce_db;
  parallel_for_strips([&](int first, int last, std::size_t) {
    for (int number = first; number < last; ++number) {
      const auto at = static_cast<std::size_t>(number) * size;
      const auto column = static_cast<std::size_t>(number) * kStripColumns;
      std::fill_n(cross_section_m2.data() + at, size, 0.0F);
      simd::Strip strip;
      strip.rows = grid.rows;
      strip.first_distance_m = static_cast<float>(grid.first_distance_m);
      strip.spacing_m = static_cast<float>(grid.spacing_m);
      strip.layover = configuration.fidelity.map_layover;
      strip.double_bounce =
          configuration.fidelity.map_double_bounce ? static_cast<float>(physics::ratio(bounce_db)) : 0.0F;
      strip.distance_m = distance_m.data();
      strip.inverse_m = inverse_m.data();
      strip.above_plane_m = above_plane_m.data();
      strip.above_level_m = above_level_m.data();
      if (!gas_rows.empty()) strip.gas = gas_rows.data();
      strip.arc = arc.data() + column;
      strip.horizon = horizon.data() + column;
      strip.surface = surface.data() + at;
      if (crests.any()) strip.crest_m = crest_m.data() + at;
      if (!tiles.empty()) strip.walls = walls.data() + at;
      strip.power = cross_section_m2.data() + at;
      simd::cast_profile(strip);
    }
  });
  walls_dirty = false;
}

void PatchFormation::Work::draw_map() {
  if (report_1996) {
    parallel::parallel_for(executor, image.size, kRowsPerTask, [&](int first, int last, std::size_t) {
      draw_brightness(*geometry, grid, cross_section_m2.data(), first, last, image);
    });
    image.blind = false;
    return blank_blind_zone(*geometry, order.ground_track, configuration.high_resolution, image);
  }
  if (!reference)
    parallel::parallel_for(executor, image.size, kRowsPerTask, [&](int first, int last, std::size_t) {
      draw_polar_grid(*geometry, grid, cross_section_m2.data(), first, last, image);
    });
  image.blind = false;
  // Power below thermal noise and black level is invisible.
  const radar::HighResolutionConfiguration& hrm = configuration.high_resolution;
  const double floor = std::max(thermal_noise(), physics::ratio(hrm.brightest_gamma_db - hrm.dynamic_range_db));
  if (configuration.fidelity.map_response) response.apply(static_cast<float>(floor), executor, image);
  movers.draw(order, *geometry, formation, {*environment.window, nullptr, true, environment.traffic},
              {&grid, surface.data(), crests.any() ? crest_m.data() : nullptr, horizon.data()}, response, image);
  blank_blind_zone(*geometry, order.ground_track, configuration.high_resolution, image);
}

// Fits the transmission by a parabola in height at nine distances, exact at three heights, and interpolates to rows.
void PatchFormation::Work::fit_gas_rows() {
  gas_rows.clear();
  if (gas.none()) return;
  constexpr int kKnots = 9;
  constexpr std::array<double, 3> kHeights_m{0.0, 2000.0, 5000.0};
  constexpr double kLowest_m = -500.0, kHighest_m = 6000.0;  // [m MSL] the fit is within 0.1 dB between them
  const double plane_m = geometry->plane_msl_m();
  std::array<simd::GasRow, kKnots> knots{};
  for (int knot = 0; knot < kKnots; ++knot) {
    const double along_m = std::max(grid.distance_m((grid.rows - 1.0) * knot / (kKnots - 1)), 1.0);
    const auto loss = [&](std::size_t height) {
      return gas.two_way_loss(geometry->earth(), geometry->altitude_m(), along_m, kHeights_m[height]);
    };
    const double low = loss(0), first = (loss(1) - low) / kHeights_m[1], second = (loss(2) - low) / kHeights_m[2];
    const double bend = (second - first) / (kHeights_m[2] - kHeights_m[1]);
    const double slope = first - bend * kHeights_m[1];
    knots[static_cast<std::size_t>(knot)] = {
        static_cast<float>(low + plane_m * (slope + plane_m * bend)), static_cast<float>(slope + 2.0 * plane_m * bend),
        static_cast<float>(bend), static_cast<float>(kLowest_m - plane_m), static_cast<float>(kHighest_m - plane_m)};
  }
  for (int row = 0; row < grid.rows; ++row) {
    const float knot_position = static_cast<float>(row) * (kKnots - 1) / static_cast<float>(std::max(grid.rows - 1, 1));
    const auto near = static_cast<std::size_t>(std::min(static_cast<int>(knot_position), kKnots - 2));
    const float share = knot_position - static_cast<float>(near);
    const simd::GasRow &one = knots[near], &two = knots[near + 1];
    gas_rows.push_back({one.constant + share * (two.constant - one.constant),
                        one.slope + share * (two.slope - one.slope), one.bend + share * (two.bend - one.bend),
                        one.lowest_m, one.highest_m});
  }
}

void PatchFormation::Work::draw_video() {
  if (report_1996) return form_brightness_video(configuration, image, order.map, picture);
  const double noise = thermal_noise();
  picture.resize(image.power.size());
  constexpr int kSpeckleRowsPerTask = 128;  // Rows of a task. Fewer cost more: each task draws two rows of cells anew.
  parallel::parallel_for(executor, image.size, kSpeckleRowsPerTask, [&](int first, int last, std::size_t) {
    form_video(configuration, image, {noise, order.looks, order.map}, first, last, picture);
  });
}

void PatchFormation::advance() {
  Work& work = *work_;
  using Stage = void (Work::*)();
  constexpr std::array<Stage, kPatchStages.size()> kStages{&Work::read_terrain, &Work::draw_scene, &Work::cast_profiles,
                                                           &Work::draw_map, &Work::draw_video};
  if (work.state != PatchState::processing && work.state != PatchState::output) return;
  (work.*kStages[static_cast<std::size_t>(work.completed_stages)])();
  ++work.completed_stages;
  if (work.completed_stages == static_cast<int>(kStages.size()) - 1) work.state = PatchState::output;
  if (work.completed_stages == static_cast<int>(kStages.size())) work.state = PatchState::done;
}

PatchState PatchFormation::state() const {
  return work_->state;
}
int PatchFormation::stages_done() const {
  return work_->completed_stages;
}
const std::vector<std::uint8_t>& PatchFormation::picture() const {
  return work_->picture;
}
const MapImage& PatchFormation::image() const {
  return work_->image;
}
const PatchGeometry& PatchFormation::geometry() const {
  return *work_->geometry;
}
geo::Duration PatchFormation::formation() const {
  return work_->formation;
}
std::size_t PatchFormation::triangles() const {
  std::size_t sum = 0;
  for (const scene::Tile* tile : work_->tiles) sum += tile->triangles();
  return sum;
}
std::size_t PatchFormation::posts_pending() const {
  std::size_t sum = 0;
  for (const std::size_t count : work_->pending) sum += count;
  return sum;
}

}  // namespace yars::model::hrm
