#include "model/scene/scene_store.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/scene/openflight_reader.hpp"
#include "model/scene/placed_view.hpp"
#include "model/terrain/open_terrain.hpp"

namespace yars::model::scene {

namespace {
constexpr double kIndexCell_deg = 0.25;
}

failure::Expected<std::unique_ptr<SceneStore>> SceneStore::open(const std::vector<radar::Scene>& scenes,
                                                                std::unique_ptr<terrain::TerrainStore> ground,
                                                                SceneStoreOptions options) {
  std::vector<std::string> problems;
  auto index = index_scenes(scenes, problems);
  if (!index) return tl::unexpected(index.error());
  auto store = std::unique_ptr<SceneStore>(new SceneStore(std::move(*index), std::move(ground), options));
  store->without_place_ = problems.size();
  store->problems_ = std::move(problems);
  return store;
}

SceneStore::SceneStore(std::vector<IndexedScene> index, std::unique_ptr<terrain::TerrainStore> ground,
                       SceneStoreOptions options)
    : index_(std::move(index)), ground_(std::move(ground)), options_(options), scenes_(index_.size()) {
  std::vector<Disc> discs;
  for (const IndexedScene& scene : index_) discs.push_back({scene.placement.place, scene.reach_m});
  places_ = GridIndex(discs, kIndexCell_deg);
  make_view();
}

SceneViewPointer SceneStore::prepare(const terrain::TerrainRegion& region) {
  ++prepares_;
  std::vector<GridIndex::Hit> hits;
  places_.find(region.centre, region.radius_m, hits);
  std::sort(hits.begin(), hits.end());
  bool changed = false;
  wanted_ = {hits.size() + without_place_, without_place_};
  for (const GridIndex::Hit& hit : hits) {
    scenes_[hit.disc].last_use = prepares_;
    if (!scenes_[hit.disc].placed && !scenes_[hit.disc].unreadable) changed |= load(hit.disc);
    if (scenes_[hit.disc].unreadable) ++wanted_.unreadable;
  }
  while (resident_bytes_ > options_.resident_limit_bytes && drop_longest_unused()) changed = true;
  if (changed) make_view();
  return view_;
}

bool SceneStore::load(std::size_t number) {
  Resident& resident = scenes_[number];
  const IndexedScene& scene = index_[number];
  NameFilter filter(scene.without);
  const auto model = read_openflight(scene.file, &filter);
  if (!model) {
    resident.unreadable = true;
    problems_.push_back(model.error().message() + "; the scene is left out");
    return false;
  }
  for (const std::string& warning : model->warnings) problems_.push_back(scene.file.string() + ": " + warning);
  const auto objects = static_cast<std::uint32_t>(model->objects.size());
  // A file that was changed meanwhile gets new numbers; its old ones stay empty.
  if (resident.objects != objects) {
    resident.first_object = static_cast<std::uint32_t>(objects_.size());
    resident.objects = objects;
    objects_.resize(objects_.size() + objects);
  }
  double reach_m = 0.0;
  for (const ModelVertex& vertex : model->vertices)
    reach_m = std::max(reach_m, std::hypot(static_cast<double>(vertex.place_m[0]) + model->base.x,
                                           static_cast<double>(vertex.place_m[1]) + model->base.y));
  if (reach_m > scene.reach_m + kTileSide_m)
    problems_.push_back(scene.file.string() + ": expected a scene within " +
                        std::to_string(static_cast<long>(scene.reach_m)) + " m of its origin, found one to " +
                        std::to_string(static_cast<long>(reach_m)) +
                        " m; it is shown only when its nearer part is looked at");
  const terrain::TerrainViewPointer ground = ground_->prepare({scene.placement.place, reach_m + kTileSide_m, 0});
  // Scatterers that the index does not know of would come and go with what else was looked at.
  auto placed = std::make_shared<PlacedScene>(place_model(*model, scene.placement, *ground, resident.first_object,
                                                          kinds_, options_.use, scene.reach_m + kTileSide_m));
  if (placed->objects.front().name.empty()) placed->objects.front().name = scene.file.stem().string();
  std::copy(placed->objects.begin(), placed->objects.end(), objects_.begin() + resident.first_object);
  resident_bytes_ += placed->bytes;
  resident.placed = std::move(placed);
  return true;
}

bool SceneStore::drop_longest_unused() {
  Resident* oldest = nullptr;
  for (Resident& resident : scenes_)
    if (resident.placed && resident.last_use != prepares_ &&
        (oldest == nullptr || resident.last_use < oldest->last_use))
      oldest = &resident;
  if (oldest == nullptr) return false;
  resident_bytes_ -= oldest->placed->bytes;
  oldest->placed.reset();
  return true;
}

void SceneStore::make_view() {
  std::vector<PlacedView::Part> parts;
  for (const Resident& resident : scenes_)
    if (resident.placed) parts.push_back({resident.placed, resident.first_object});
  view_ = std::make_shared<const PlacedView>(++generation_, std::move(parts), kinds_.kinds(), objects_);
}

std::vector<std::string> SceneStore::take_problems() {
  std::vector<std::string> problems = std::exchange(problems_, {});
  for (std::string& problem : ground_->take_problems()) problems.push_back(std::move(problem));
  return problems;
}

failure::Expected<std::unique_ptr<SceneStore>> open_scenes(const radar::RadarConfiguration& configuration,
                                                           SceneUse use) {
  if (configuration.world.scenes.empty()) return std::unique_ptr<SceneStore>();
  auto ground = terrain::open_terrain(configuration.terrain);
  if (!ground) return tl::unexpected(ground.error());
  SceneStoreOptions options;
  options.use = use;
  return SceneStore::open(configuration.world.scenes, std::move(*ground), options);
}

}  // namespace yars::model::scene
