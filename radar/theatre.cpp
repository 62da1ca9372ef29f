#include "radar/theatre.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "lib/radar/configuration.hpp"
#include "lib/radar/fidelity.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/physics/ray.hpp"
#include "model/physics/sweep_geometry.hpp"
#include "model/rbm/algorithm.hpp"
#include "model/rbm/beam.hpp"
#include "model/rbm/slant_axis.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "radar/limits.hpp"

namespace yars::radar {

std::unique_ptr<model::terrain::TerrainStore> TheatreFiles::open_terrain() const {
  auto store = model::terrain::open_terrain(terrain_);
  if (!store) fail(store.error());
  return std::move(*store);
}

const model::scene::SceneIndex& TheatreFiles::scenes() {
  if (scenes_) return *scenes_;
  auto index = model::scene::index_with_terrain(configured_, terrain_);
  if (!index) fail(index.error());
  return scenes_.emplace(std::move(*index));
}

TheatreStores TheatreFiles::open(model::scene::SceneUse use) {
  TheatreStores stores{open_terrain(), use == model::scene::SceneUse::triangles ? open_terrain() : nullptr, nullptr};
  auto opened = model::scene::open_scenes(scenes(), terrain_, use);
  if (!opened) fail(opened.error());
  stores.scenes = std::move(*opened);
  return stores;
}

Theatre::Theatre(const TerrainConfiguration& terrain, const std::vector<Scene>& scenes, model::scene::SceneUse use)
    : folder_(terrain.directory), stores_(TheatreFiles(terrain, scenes).open(use)) {}

ScanEnvironment Theatre::prepare(const model::kernel::ScanRequest& request, const Fidelity& fidelity,
                                 const Warn& warn) {
  const model::terrain::TerrainRegion region{request.pose.position, request.range.metres(),
                                             model::kernel::scan_detail(fidelity, request.range)};
  ScanEnvironment environment{stores_.window->prepare(region),
                              stores_.scenes ? stores_.scenes->prepare(region) : nullptr};
  check_terrain_read(warn, folder_, *stores_.window);
  if (stores_.scenes) check_scenes_read(warn, *stores_.scenes);
  return environment;
}

model::hrm::PatchEnvironment Theatre::prepare(const model::hrm::PatchNeed& need, const Warn& warn) {
  model::hrm::PatchEnvironment environment{stores_.window->prepare(need.window), stores_.path->prepare(need.path),
                                           stores_.scenes ? stores_.scenes->prepare(need.window) : nullptr};
  if (stores_.scenes) check_scenes_read(warn, *stores_.scenes);
  check_terrain_read(warn, folder_, *stores_.window, stores_.path.get());
  return environment;
}

std::vector<std::string> Theatre::left_out() const {
  LeftOut all;
  for (const auto* store : {stores_.window.get(), stores_.path.get()})
    if (store != nullptr) all.add(*store);
  if (stores_.scenes) all.add(*stores_.scenes);
  return all.sentences();
}

model::scene::SceneViewPointer Theatre::scenes_near(geo::GeoPoint position, double radius_m, const Warn& warn) {
  if (!stores_.scenes) return nullptr;
  auto view = stores_.scenes->prepare({position, radius_m, 0});
  check_scenes_read(warn, *stores_.scenes);
  return view;
}

const model::terrain::DirectoryIndex* Theatre::index() const {
  const auto* const files = dynamic_cast<const model::terrain::DirectoryTerrainStore*>(stores_.window.get());
  return files == nullptr ? nullptr : &files->index();
}

model::terrain::TerrainViewPointer Theatre::terrain_at(geo::GeoPoint position, const Warn& warn) {
  auto view = stores_.window->prepare({position, 0.0, 0});
  check_terrain_read(warn, folder_, *stores_.window);
  return view;
}

namespace {

// Warns of the number of unreadable files. Throws Failure if all are unreadable. `things`: what the files are, in the
// plural. `first`: the first problem of reading.
void check_unreadable(const Warn& warn, const std::string& subject, const char* things, std::size_t total,
                      std::size_t unreadable, const std::string& first) {
  if (unreadable == 0) return;
  const std::string count = std::to_string(unreadable) + " of " + std::to_string(total);
  if (unreadable == total)
    fail({subject, std::string(things) + " that can be read", "none: " + count + " cannot",
          (first.empty() ? "" : "because of " + first + "; ") + "repair or replace the files"});
  warn(count + ' ' + things + " cannot be read; the picture is made without them");
}

}  // namespace

void check_terrain_read(const Warn& warn, const std::string& folder, model::terrain::TerrainStore& store,
                        model::terrain::TerrainStore* path_store) {
  std::set<std::string> warned;
  std::string first;
  const auto warn_once = [&](const std::vector<std::string>& sentences) {
    for (const std::string& sentence : sentences)
      if (warned.insert(sentence).second) warn(sentence);
  };
  for (model::terrain::TerrainStore* const one : {&store, path_store}) {
    if (one == nullptr) continue;
    const std::vector<std::string> problems = one->take_problems();
    if (first.empty() && !problems.empty()) first = problems.front();
    warn_once(problems);
    warn_once(one->take_notes());
  }
  for (model::terrain::TerrainStore* const one : {path_store, &store})
    if (auto* const files = dynamic_cast<model::terrain::DirectoryTerrainStore*>(one)) files->report_again();
  const auto* const directory = dynamic_cast<const model::terrain::DirectoryTerrainStore*>(&store);
  if (directory == nullptr) return;  // the built-in hills have no files
  const model::terrain::RegionCells& cells = directory->region_cells();
  check_unreadable(warn, folder, "cells of the region", cells.files, cells.unreadable, first);
}

void check_scenes_read(const Warn& warn, model::scene::SceneStore& scenes) {
  const std::vector<std::string> problems = scenes.take_problems();
  for (const std::string& problem : problems) warn(problem);
  check_unreadable(warn, "scene", "scenes of the region", scenes.wanted().files, scenes.wanted().unreadable,
                   problems.empty() ? "" : problems.front());
}

void LeftOut::add(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences)
    if (std::ranges::find(sentences_, sentence) == sentences_.end()) sentences_.push_back(sentence);
}

void LeftOut::add(const model::terrain::TerrainStore& store) {
  if (const auto* const files = dynamic_cast<const model::terrain::DirectoryTerrainStore*>(&store))
    add(files->left_out());
}

void LeftOut::add(const model::scene::SceneStore& scenes) {
  add(scenes.left_out());
}

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

// Replaces distances and masks of samples of ground range by those of samples of slant range.
void show_slant_ranges(const RadarConfiguration& configuration, const SweepGeometry& geometry,
                       const model::terrain::TerrainView& terrain, std::vector<double>& distance_m,
                       std::vector<std::uint8_t>& lit, std::vector<std::uint8_t>& laid_over) {
  const geo::GeodesicRay ray(geometry.apex, geometry.azimuth);
  std::vector<double> height_m(distance_m.size());
  std::transform(distance_m.begin(), distance_m.end(), height_m.begin(), [&](double distance) {
    return terrain.surface_at(ray.position(geo::Length::metres(distance)), configuration.fidelity.interpolation)
        .elevation_m;
  });
  const auto earth = model::physics::effective_earth(configuration, geometry);
  const auto shown = model::rbm::shown_at_slant_ranges(geometry, earth, distance_m, height_m, lit);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    distance_m[i] = shown[i].distance_m;
    lit[i] = shown[i].lit ? 1 : 0;
    laid_over[i] = shown[i].laid_over ? 1 : 0;
  }
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
  std::vector<std::uint8_t> lit(count), laid_over(count);
  std::vector<RaySample> samples;
  samples.reserve(positions.size() * count);
  for (std::size_t sweep = 0; sweep < positions.size(); ++sweep) {
    parallel::check(goes_on);
    SweepGeometry geometry = model::kernel::geometry_of(positions[sweep]);
    geometry.elevation = geo::Angle();
    algorithm->measure(geometry, terrain, power);
    algorithm->lit(lit);
    model::physics::sample_distances(geometry.range, distance_m);
    const geo::GeodesicRay ray(geometry.apex, geometry.azimuth);
    if (configuration.fidelity.slant_range)
      show_slant_ranges(configuration, geometry, terrain, distance_m, lit, laid_over);
    for (std::size_t i = 0; i < count; ++i) {
      samples.push_back(sample_at(configuration, ray, distance_m[i], terrain));
      samples.back().lit = lit[i] != 0;
      samples.back().laid_over = laid_over[i] != 0;
      samples.back().returns = power[i] > kMinScanPower;
    }
  }
  return samples;
}

}  // namespace yars::radar
