#include "tools/command/theatre.hpp"

#include <algorithm>

#include "lib/radar/fidelity.hpp"
#include "model/kernel/tick_inputs.hpp"
#include "model/terrain/store/directory_store.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {

namespace {
std::unique_ptr<model::terrain::TerrainStore> open_store(const radar::TerrainConfiguration& terrain) {
  auto store = model::terrain::open_terrain(terrain);
  if (!store) throw_failure(store.error());
  return std::move(*store);
}
}  // namespace

Theatre::Theatre(const radar::TerrainConfiguration& terrain, const std::vector<radar::Scene>& scenes,
                 model::scene::SceneUse use)
    : folder_(terrain.directory), window_store_(open_store(terrain)) {
  if (use == model::scene::SceneUse::triangles) path_store_ = open_store(terrain);
  auto opened = model::scene::open_scenes(scenes, terrain, use);
  if (!opened) throw_failure(opened.error());
  scenes_ = std::move(*opened);
}

ScanEnvironment Theatre::prepare(const model::kernel::ScanRequest& request, const radar::Fidelity& fidelity,
                                 const Warn& warn) {
  const model::terrain::TerrainRegion region{request.pose.position, request.range.metres(),
                                             model::kernel::scan_detail(fidelity, request.range)};
  ScanEnvironment environment{window_store_->prepare(region), scenes_ ? scenes_->prepare(region) : nullptr};
  check_terrain_read(warn, folder_, *window_store_);
  if (scenes_) check_scenes_read(warn, *scenes_);
  return environment;
}

model::hrm::PatchEnvironment Theatre::prepare(const model::hrm::PatchNeed& need, const Warn& warn) {
  model::hrm::PatchEnvironment environment{window_store_->prepare(need.window), path_store_->prepare(need.path),
                                           scenes_ ? scenes_->prepare(need.window) : nullptr};
  if (scenes_) check_scenes_read(warn, *scenes_);
  check_terrain_read(warn, folder_, *window_store_, path_store_.get());
  return environment;
}

std::vector<std::string> Theatre::left_out() const {
  LeftOut all;
  for (const auto* store : {window_store_.get(), path_store_.get()})
    if (store != nullptr) all.add(*store);
  if (scenes_) all.add(*scenes_);
  return all.sentences();
}

model::scene::SceneViewPointer Theatre::scenes_near(geo::GeoPoint position, double radius_m, const Warn& warn) {
  if (!scenes_) return nullptr;
  auto view = scenes_->prepare({position, radius_m, 0});
  check_scenes_read(warn, *scenes_);
  return view;
}

const model::terrain::DirectoryIndex* Theatre::index() const {
  const auto* const files = dynamic_cast<const model::terrain::DirectoryTerrainStore*>(window_store_.get());
  return files == nullptr ? nullptr : &files->index();
}

model::terrain::TerrainViewPointer Theatre::terrain_at(geo::GeoPoint position, const Warn& warn) {
  auto view = window_store_->prepare({position, 0.0, 0});
  check_terrain_read(warn, folder_, *window_store_);
  return view;
}

}  // namespace yars::tools
