#include "model/hrm/patch_process.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/failure/require.hpp"
#include "lib/radar/map_formation.hpp"
#include "model/hrm/develop.hpp"
#include "model/hrm/fan_array.hpp"
#include "model/hrm/profile_lanes.hpp"
#include "model/hrm/reference_patch.hpp"
#include "model/hrm/report_1996_patch.hpp"
#include "model/rbm/gas_path.hpp"
#include "model/reflectivity/decibels.hpp"

namespace yars::model::hrm {

namespace {
constexpr int kRowsAPiece = 32;  // of the map
}  // namespace

struct PatchProcess::Work {
  Work(const radar::RadarConfiguration& given, Crew hands)
      : configuration(given),
        crew(std::move(hands)),
        gas(configuration),
        movers(configuration),
        report_1996(configuration.fidelity.algorithm == radar::Algorithm::report_1996),
        image(configuration.fidelity.map_size),
        response(configuration.high_resolution.sidelobe_db,
                 static_cast<double>(radar::kCellsOfMap) / std::max(configuration.fidelity.map_size, 1)) {
    for (std::size_t thread = 0; thread < crew.threads; ++thread) {
      rasters.emplace_back(configuration);
      grounds.emplace_back(configuration);
    }
  }

  void lay_out();
  void clear_walls();
  void read_terrain();
  void draw_scene();
  void cast_profiles();
  void shade();
  void draw_map();
  void attenuate();
  void draw_video();
  double thermal_noise() const {
    return noise_gamma(configuration.high_resolution, geo::Length::metres(geometry->slant_range_m()), order.window);
  }
  // job(first strip, behind the last, thread).
  template <class Job>
  void share_strips(const Job& job) {
    constexpr int kStripsAPiece = 2;
    share_out(crew, grid.strips(), kStripsAPiece, job);
  }

  radar::RadarConfiguration configuration;
  Crew crew;
  rbm::GasPath gas;
  MapMovers movers;
  PatchOrder order;
  PatchDatabase database;
  PatchState state = PatchState::reset;
  int done = 0;
  std::optional<PatchGeometry> geometry;
  geo::Duration formation{};
  FanGrid grid;
  std::vector<const scene::Tile*> tiles;
  std::unique_ptr<Detail> detail;
  std::unique_ptr<ReferencePatch> reference;  // instead of what follows, where the fidelity asks for it
  std::vector<GroundFan> grounds;
  std::vector<SceneRaster> rasters;
  FanArray<SurfacePoint> surface;
  FanArray<WallPoint> walls;
  FanArray<float> cross_section_m2, horizon, arc;
  bool walls_left = false;  // of a map whose profiles are still to be cast
  std::vector<float> distance_m, inverse_m, above_m, level_m;
  std::vector<std::size_t> pending;
  std::vector<std::uint8_t> begun;  // by thread: it has its room for this map's ground
  bool report_1996;                 // the map is brightness, see report_1996_patch.hpp
  MapImage image;
  Response response;
  std::vector<std::uint8_t> picture;
};

PatchProcess::PatchProcess(const radar::RadarConfiguration& configuration, Crew crew)
    : work_(std::make_unique<Work>(configuration, std::move(crew))) {}
PatchProcess::~PatchProcess() = default;
PatchProcess::PatchProcess(PatchProcess&&) noexcept = default;
PatchProcess& PatchProcess::operator=(PatchProcess&&) noexcept = default;

PatchNeed PatchProcess::begin(const PatchOrder& order) {
  Work& work = *work_;
  work.order = order;
  work.database = {};
  work.state = PatchState::database;
  work.done = 0;
  return patch_need(order, work.configuration.fidelity.map_size);
}

void PatchProcess::give(const PatchDatabase& database) {
  YARS_REQUIRE(static_cast<int>(work_->state), ==, static_cast<int>(PatchState::database));
  work_->database = database;
  work_->lay_out();
  work_->state = PatchState::processing;
}

void PatchProcess::Work::lay_out() {
  const double elevation_m = database.window->elevation_m(order.centre);
  geometry.emplace(order, configuration.fidelity, std::isnan(elevation_m) ? 0.0 : elevation_m);
  formation = radar::formation_time({geo::Length::metres(geometry->slant_range_m()), order.window,
                                     geometry->squint(order.ground_track), order.ground_speed, order.looks},
                                    configuration);
  tiles.clear();
  if (database.scene) database.scene->tiles_near(order.centre, 1.5 * order.window.metres(), tiles);
  const FanMargins margins = fan_margins(*geometry, *database.window, tiles, crew);
  const bool exact = configuration.fidelity.algorithm == radar::Algorithm::reference;
  const int cells = exact ? std::max(kReferenceCells, configuration.fidelity.map_oversampling)
                          : configuration.fidelity.map_oversampling;
  grid = make_fan_grid(*geometry, image.size, cells, margins);
  reference.reset();
  if (exact) reference = std::make_unique<ReferencePatch>(configuration, *geometry, grid);
  if (configuration.fidelity.map_detail && (!detail || detail->pixel_m() != grid.spacing_m))
    detail = std::make_unique<Detail>(configuration.high_resolution.detail_contrast, grid.spacing_m);
  surface.resize(grid.size());
  if (!tiles.empty()) clear_walls();
  cross_section_m2.resize(grid.size());
  horizon.resize(static_cast<std::size_t>(grid.columns));
  distance_m.clear();
  inverse_m.clear();
  above_m.clear();
  level_m.clear();
  for (int row = 0; row < grid.rows; ++row) {
    distance_m.push_back(static_cast<float>(grid.distance_m(row)));
    inverse_m.push_back(static_cast<float>(1.0 / grid.distance_m(row)));
    above_m.push_back(static_cast<float>(geometry->above_plane_m(grid.distance_m(row))));
    level_m.push_back(static_cast<float>(geometry->above_level_m(grid.distance_m(row))));
  }
  arc.resize(static_cast<std::size_t>(grid.columns));
  for (int column = 0; column < grid.columns; ++column)
    arc.data()[column] = static_cast<float>(grid.width_m(column, 1.0));
  pending.assign(crew.threads, 0);
  begun.assign(crew.threads, 0);
}

// Who reads the walls clears them: it is done here for new room only, and after a map that was given up.
void PatchProcess::Work::clear_walls() {
  const std::size_t before = walls.size();
  walls.resize(grid.size());
  if (!walls_left && walls.size() == before) return;
  std::fill_n(walls.data(), walls.size(), WallPoint());
  walls_left = false;
}

void PatchProcess::Work::read_terrain() {
  share_strips([&](int first, int last, std::size_t thread) {
    if (begun[thread] == 0) grounds[thread].begin(*geometry, grid);
    begun[thread] = 1;
    pending[thread] +=
        grounds[thread].fill(order, *geometry, grid, {database.window.get(), database.path.get()}, detail.get(),
                             first * kStripColumns, last * kStripColumns, {surface.data(), horizon.data()});
  });
  if (reference) reference->read_terrain({database.window.get(), database.path.get()});
}

void PatchProcess::Work::draw_scene() {
  if (reference) {
    if (!tiles.empty()) reference->read_scene(*database.scene, tiles, surface.data());
    return;
  }
  if (tiles.empty()) return;
  walls_left = true;
  // Tiles on a border are drawn from both sides of it: few bands, and two a thread, so that one may help the other.
  const auto bands = static_cast<int>(crew.threads == 1 ? 1 : 2 * crew.threads);
  const std::vector<PlacedTile> placed = place_tiles(*geometry, grid, tiles, crew);
  const std::vector<int> begin = even_bands(grid, placed, bands);
  share_out(crew, bands, 1, [&](int first, int last, std::size_t thread) {
    for (auto band = static_cast<std::size_t>(first); band < static_cast<std::size_t>(last); ++band)
      rasters[thread].draw(*geometry, grid, *database.scene, placed, begin[band] * kStripColumns,
                           begin[band + 1] * kStripColumns, {surface.data(), walls.data()});
  });
}

// In place of the profiles and of all that follows them.
void PatchProcess::Work::shade() {
  share_strips([&](int first, int last, std::size_t) {
    shade_fan(*geometry, grid, {surface.data(), horizon.data()}, first * kStripColumns, last * kStripColumns,
              cross_section_m2.data());
  });
}

void PatchProcess::Work::cast_profiles() {
  if (report_1996) return shade();
  if (reference) return reference->accumulate(surface.data(), image);
  const std::size_t size = grid.strip_size();
  const double bounce_db = configuration.high_resolution.double_bounce_db;
  share_strips([&](int first, int last, std::size_t) {
    for (int number = first; number < last; ++number) {
      const auto at = static_cast<std::size_t>(number) * size;
      const auto column = static_cast<std::size_t>(number) * kStripColumns;
      std::fill_n(cross_section_m2.data() + at, size, 0.0F);
      lanes::Strip strip;
      strip.rows = grid.rows;
      strip.first_distance_m = static_cast<float>(grid.first_distance_m);
      strip.spacing_m = static_cast<float>(grid.spacing_m);
      strip.layover = configuration.fidelity.map_layover;
      strip.double_bounce =
          configuration.fidelity.map_double_bounce ? static_cast<float>(reflectivity::ratio(bounce_db)) : 0.0F;
      strip.distance_m = distance_m.data();
      strip.inverse_m = inverse_m.data();
      strip.above_m = above_m.data();
      strip.level_m = level_m.data();
      strip.arc = arc.data() + column;
      strip.horizon = horizon.data() + column;
      strip.surface = surface.data() + at;
      if (!tiles.empty()) strip.walls = walls.data() + at;
      strip.power = cross_section_m2.data() + at;
      lanes::cast_profile(strip);
    }
  });
  walls_left = false;
}

void PatchProcess::Work::draw_map() {
  if (report_1996) {
    share_out(crew, image.size, kRowsAPiece, [&](int first, int last, std::size_t) {
      draw_brightness(*geometry, grid, cross_section_m2.data(), first, last, image);
    });
    image.blind = false;
    return blank_blind_zone(*geometry, order.ground_track, configuration.high_resolution, image);
  }
  if (!reference)
    share_out(crew, image.size, kRowsAPiece, [&](int first, int last, std::size_t) {
      draw_fan(*geometry, grid, cross_section_m2.data(), first, last, image);
    });
  attenuate();
  image.blind = false;
  // What is below thermal noise or black cannot be seen.
  const radar::HighResolutionConfiguration& hrm = configuration.high_resolution;
  const double floor = std::max(thermal_noise(), reflectivity::ratio(hrm.brightest_gamma_db - hrm.dynamic_range_db));
  if (configuration.fidelity.map_response) response.apply(static_cast<float>(floor), crew, image);
  movers.draw(order, *geometry, formation, {*database.window, nullptr, true, database.traffic},
              {&grid, surface.data(), horizon.data()}, response, image);
  blank_blind_zone(*geometry, order.ground_track, configuration.high_resolution, image);
}

// What the gases of the air take, by distance over ground: a parabola through the nearest, the middle and the farthest,
// within 0.05 dB over the largest window.
void PatchProcess::Work::attenuate() {
  if (gas.none()) return;
  const double half_m = 0.5 * geometry->window_m();
  const double middle_m = geometry->distance_m();
  const double step_m = std::hypot(middle_m + half_m, half_m) - middle_m;
  const auto loss = [&](double along_m) {
    return gas.two_way_loss(geometry->earth(), geometry->altitude_m(), std::max(along_m, 1.0), geometry->plane_msl_m());
  };
  const double near = loss(middle_m - step_m), here = loss(middle_m), far = loss(middle_m + step_m);
  const auto constant = static_cast<float>(here);
  const auto slope = static_cast<float>(0.5 * (far - near));
  const auto bend = static_cast<float>(0.5 * (far + near) - here);
  const double pixel_m = geometry->window_m() / image.size;
  share_out(crew, image.size, kRowsAPiece, [&](int first, int last, std::size_t) {
    for (int row = first; row < last; ++row) {
      const auto ahead_m = static_cast<float>(middle_m + half_m - (row + 0.5) * pixel_m);
      float* const power = &image.power[image.at(0, row)];
      for (int column = 0; column < image.size; ++column) {
        const auto right_m = static_cast<float>((column + 0.5) * pixel_m - half_m);
        const float along_m = std::sqrt(ahead_m * ahead_m + right_m * right_m);
        const float share = (along_m - static_cast<float>(middle_m)) / static_cast<float>(step_m);
        power[column] *= constant + share * (slope + share * bend);
      }
    }
  });
}

void PatchProcess::Work::draw_video() {
  if (report_1996) return develop_brightness(configuration, image, order.map, picture);
  const double noise = thermal_noise();
  picture.resize(image.power.size());
  constexpr int kRowsOfSpeckle = 128;  // a piece: each begins with two rows of cells of its own
  share_out(crew, image.size, kRowsOfSpeckle, [&](int first, int last, std::size_t) {
    develop(configuration, image, {noise, order.looks, order.map}, first, last, picture);
  });
}

void PatchProcess::advance() {
  Work& work = *work_;
  using Stage = void (Work::*)();
  constexpr std::array<Stage, kPatchStages.size()> kStages{&Work::read_terrain, &Work::draw_scene, &Work::cast_profiles,
                                                           &Work::draw_map, &Work::draw_video};
  if (work.state != PatchState::processing && work.state != PatchState::output) return;
  (work.*kStages[static_cast<std::size_t>(work.done)])();
  ++work.done;
  if (work.done == static_cast<int>(kStages.size()) - 1) work.state = PatchState::output;
  if (work.done == static_cast<int>(kStages.size())) work.state = PatchState::done;
}

PatchState PatchProcess::state() const {
  return work_->state;
}
int PatchProcess::stages_done() const {
  return work_->done;
}
const std::vector<std::uint8_t>& PatchProcess::picture() const {
  return work_->picture;
}
const MapImage& PatchProcess::image() const {
  return work_->image;
}
const PatchGeometry& PatchProcess::geometry() const {
  return *work_->geometry;
}
geo::Duration PatchProcess::formation() const {
  return work_->formation;
}
std::size_t PatchProcess::triangles() const {
  std::size_t sum = 0;
  for (const scene::Tile* tile : work_->tiles) sum += tile->triangles();
  return sum;
}
std::size_t PatchProcess::posts_pending() const {
  std::size_t sum = 0;
  for (const std::size_t count : work_->pending) sum += count;
  return sum;
}

}  // namespace yars::model::hrm
