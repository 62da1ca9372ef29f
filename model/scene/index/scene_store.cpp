#include "model/scene/index/scene_store.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <future>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>

#include "lib/radar/world.hpp"
#include "lib/text/plain_text.hpp"
#include "model/scene/placement/geometry.hpp"
#include "model/scene/placement/tile_builder.hpp"
#include "model/terrain/store/directory_store.hpp"

namespace yars::model::scene {

namespace {

// [degrees] Side of a square of the index that finds scenes by position. Typical scenes are some kilometres wide.
constexpr double kSceneCell_deg = 0.25;

// Most threads that load scenes at once. Each has a whole file in memory.
constexpr std::size_t kMaxThreads = 8;

// job(0) to job(count - 1), each in a thread of its own; a system without threads runs them one after the other.
template <class Job>
auto at_once(std::size_t count, const Job& job) {
  using Result = std::invoke_result_t<Job, std::size_t>;
  std::vector<std::future<Result>> others;
  for (std::size_t i = 1; i < count; ++i) others.push_back(std::async(job, i));
  std::vector<Result> results;
  if (count > 0) results.push_back(job(0));
  for (std::future<Result>& other : others) results.push_back(other.get());
  return results;
}

using Hits = std::vector<GridIndex::Hit>;

// Buffer for the results of a query: slot 0 for scenes, slot 1 for tiles. Each thread reuses its two buffers, because a
// patch map makes hundreds of queries per second.
Hits& scratch(int slot) {
  thread_local std::array<Hits, 2> hits;
  hits[static_cast<std::size_t>(slot)].clear();
  return hits[static_cast<std::size_t>(slot)];
}

double distance_outside(double value, double min, double max) {
  return std::max({0.0, min - value, value - max});
}

// True if part of the tile's bounds is within `radius_m` of the position. `distance_m`: from the position to the tile's
// origin. `reach_m`: from the origin to the farthest corner of the bounds.
bool is_within(const Tile& tile, double reach_m, geo::GeoPoint position, double distance_m, double radius_m) {
  if (distance_m + reach_m <= radius_m) return true;
  const geo::PlanePoint at = geo::AzimuthalEquidistant(tile.origin).plane_from_geodetic(position);
  const Bounds& b = tile.bounds;
  return std::hypot(distance_outside(at.x_m, static_cast<double>(b.east_min_m), static_cast<double>(b.east_max_m)),
                    distance_outside(at.y_m, static_cast<double>(b.north_min_m), static_cast<double>(b.north_max_m))) <=
         radius_m;
}

}  // namespace

PlacedView::PlacedView(std::uint64_t generation, std::vector<std::shared_ptr<const PlacedScene>> scenes,
                       std::vector<SurfaceKind> kinds, std::vector<SceneObject> objects)
    : generation_(generation), scenes_(std::move(scenes)), kinds_(std::move(kinds)), objects_(std::move(objects)) {
  std::vector<Disc> discs;
  for (const auto& scene : scenes_) {
    // reach_m is the distance to the farthest corner of a triangle. The corners of a tile's bounds may lie farther out,
    // by a factor of up to the square root of 2.
    discs.push_back({scene->placement.position, 1.5 * scene->reach_m + kTileSide_m});
    bytes_ += scene->bytes;
    if (scene->scatterers) scatterers_.push_back(scene->scatterers.get());
  }
  position_index_ = GridIndex(discs, kSceneCell_deg);
  bytes_ +=
      position_index_.bytes() + objects_.capacity() * sizeof(SceneObject) + kinds_.capacity() * sizeof(SurfaceKind);
}

void PlacedView::tiles_near(geo::GeoPoint position, double radius_m, std::vector<const Tile*>& found) const {
  found.clear();
  Hits& scenes = scratch(0);
  position_index_.find(position, radius_m, scenes);
  std::sort(scenes.begin(), scenes.end());
  for (const GridIndex::Hit& scene : scenes) {
    const PlacedScene& placed = *scenes_[scene.disc];
    Hits& tiles = scratch(1);
    placed.tile_index.find(position, radius_m, tiles);
    std::sort(tiles.begin(), tiles.end());
    for (const GridIndex::Hit& tile : tiles)
      if (is_within(placed.tiles[tile.disc], placed.tile_reach_m[tile.disc], position, tile.distance_m, radius_m))
        found.push_back(&placed.tiles[tile.disc]);
  }
}

error::Expected<std::unique_ptr<SceneStore>> SceneStore::open(const std::vector<radar::Scene>& scenes,
                                                              std::unique_ptr<terrain::TerrainStore> ground,
                                                              SceneStoreOptions options) {
  std::vector<std::string> problems;
  auto index = index_scenes(scenes, problems);
  if (!index) return tl::unexpected(index.error());
  return std::make_unique<SceneStore>(SceneIndex{std::move(*index), std::move(problems)}, std::move(ground), options);
}

SceneStore::SceneStore(SceneIndex index, std::unique_ptr<terrain::TerrainStore> ground, SceneStoreOptions options)
    : index_(std::move(index.scenes)),
      ground_(std::move(ground)),
      options_(options),
      scenes_(index_.size()),
      not_indexed_(index.problems),
      problems_(std::move(index.problems)) {
  std::vector<Disc> discs;
  for (const IndexedScene& scene : index_) discs.push_back({scene.placement.position, scene.reach_m});
  position_index_ = GridIndex(discs, kSceneCell_deg);
  make_view();
}

namespace {

// Parts of a scene's file that its model leaves out, one sentence each. For an unreadable file it is one sentence.
std::vector<std::string> left_out_of(const IndexedScene& scene, const error::Expected<Model>& model) {
  if (!model) return {model.error().message() + "; the scene is left out"};
  std::vector<std::string> sentences;
  for (const std::string& sentence : model->left_out) sentences.push_back(scene.file.string() + ": " + sentence);
  return sentences;
}

// The same, then the warnings about the file.
std::vector<std::string> problems_of(const IndexedScene& scene, const error::Expected<Model>& model) {
  std::vector<std::string> sentences = left_out_of(scene, model);
  if (model)
    for (const std::string& warning : model->warnings) sentences.push_back(scene.file.string() + ": " + warning);
  return sentences;
}

}  // namespace

void SceneStore::check_files(const std::function<bool(std::vector<std::string>)>& report) const {
  std::uintmax_t read_bytes = 0;
  std::size_t unchecked = 0;
  for (const IndexedScene& scene : index_) {
    std::error_code code;
    const std::uintmax_t bytes = std::filesystem::file_size(scene.file, code);
    if (!code && (bytes > kMaxCheckedFileBytes || bytes > kMaxCheckedBytes - read_bytes)) {
      ++unchecked;
      continue;
    }
    if (!code) read_bytes += bytes;
    NameFilter filter(scene.without);
    if (!report(problems_of(scene, read_openflight(scene.file, &filter)))) return;
  }
  if (unchecked > 0)
    report({text::counted(unchecked, "scene file") +
            " too large to be checked before use: what is left out is said when a scene is read"});
}

std::vector<std::string> SceneStore::left_out() const {
  std::vector<std::string> sentences = not_indexed_;
  for (const Resident& scene : scenes_) sentences.insert(sentences.end(), scene.left_out.begin(), scene.left_out.end());
  return sentences;
}

SceneViewPointer SceneStore::prepare(const terrain::TerrainRegion& region) {
  ++prepares_;
  std::vector<GridIndex::Hit> hits;
  position_index_.find(region.centre, region.radius_m, hits);
  std::sort(hits.begin(), hits.end());
  std::vector<std::size_t> absent;
  for (const GridIndex::Hit& hit : hits) {
    scenes_[hit.disc].last_use = prepares_;
    if (!scenes_[hit.disc].placed && !scenes_[hit.disc].unreadable) absent.push_back(hit.disc);
  }
  bool changed = false;
  const std::size_t most = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMaxThreads);
  for (std::span<const std::size_t> rest = absent; !rest.empty(); rest = rest.subspan(std::min(most, rest.size())))
    changed |= load(rest.first(std::min(most, rest.size())));
  wanted_ = {hits.size() + not_indexed_.size(), not_indexed_.size()};
  for (const GridIndex::Hit& hit : hits)
    if (scenes_[hit.disc].unreadable) ++wanted_.unreadable;
  while (resident_bytes_ > options_.resident_limit_bytes && drop_longest_unused()) changed = true;
  if (changed) make_view();
  return view_;
}

// Files are read at once, and models are placed at once. Between these steps the scenes get their numbers of objects
// and kinds one after the other, so that equal calls give equal numbers.
bool SceneStore::load(std::span<const std::size_t> numbers) {
  auto models = at_once(numbers.size(), [&](std::size_t i) {
    NameFilter filter(index_[numbers[i]].without);
    return read_openflight(index_[numbers[i]].file, &filter);
  });
  std::vector<Loading> loads;
  loads.reserve(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (auto loading = begin_load(numbers[i], std::move(models[i]))) loads.push_back(std::move(*loading));
  const auto placed = at_once(loads.size(), [&](std::size_t i) {
    const Loading& one = loads[i];
    const IndexedScene& scene = index_[one.number];
    // Scatterers beyond this limit are left out. A region that overlaps the scene only beyond it does not load the
    // file. Without the limit, such a region would show these scatterers only if another region had loaded the file
    // before.
    const double max_reach_m = scene.reach_m + kTileSide_m;
    return std::make_shared<PlacedScene>(place_known_model(
        one.model, scene.placement, *one.ground, scenes_[one.number].first_object, kinds_, options_.use, max_reach_m));
  });
  for (std::size_t i = 0; i < loads.size(); ++i) end_load(loads[i].number, placed[i]);
  return !loads.empty();
}

// The numbers and the ground of a model. Nullopt: its file is unreadable.
std::optional<SceneStore::Loading> SceneStore::begin_load(std::size_t number, error::Expected<Model> model) {
  Resident& resident = scenes_[number];
  const IndexedScene& scene = index_[number];
  resident.left_out = left_out_of(scene, model);
  for (std::string& problem : problems_of(scene, model)) problems_.push_back(std::move(problem));
  if (!model) {
    resident.unreadable = true;
    return std::nullopt;
  }
  const auto objects = static_cast<std::uint32_t>(model->objects.size());
  // A scene that is loaded again reuses the numbers of its objects. If its file now has more objects than at any
  // earlier load, all its objects get new numbers, and the old numbers become unused.
  if (resident.objects < objects) {
    resident.first_object = static_cast<std::uint32_t>(objects_.size());
    resident.objects = objects;
    objects_.resize(objects_.size() + objects);
  }
  for (const SurfaceKind& kind : model->kinds) kinds_.number_of(kind);
  double reach_m2 = 0.0;
  for (const ModelVertex& vertex : model->vertices) {
    const double x_m = static_cast<double>(vertex.position_m[0]) + model->base.x;
    const double y_m = static_cast<double>(vertex.position_m[1]) + model->base.y;
    reach_m2 = std::max(reach_m2, x_m * x_m + y_m * y_m);
  }
  const double reach_m = std::sqrt(reach_m2);
  if (reach_m > scene.reach_m + kTileSide_m)
    problems_.push_back(scene.file.string() + ": expected a scene within " +
                        std::to_string(static_cast<long>(scene.reach_m)) + " m of its origin, found one that reaches " +
                        std::to_string(static_cast<long>(reach_m)) +
                        " m; a map that overlaps the scene only beyond the expected radius does not show it");
  auto ground = ground_->prepare({scene.placement.position, reach_m + kTileSide_m, 0});
  return Loading{number, std::move(*model), std::move(ground)};
}

void SceneStore::end_load(std::size_t number, std::shared_ptr<PlacedScene> placed) {
  Resident& resident = scenes_[number];
  if (placed->objects.front().name.empty()) placed->objects.front().name = index_[number].file.stem().string();
  std::fill_n(objects_.begin() + resident.first_object, resident.objects, SceneObject{});
  std::copy(placed->objects.begin(), placed->objects.end(), objects_.begin() + resident.first_object);
  resident_bytes_ += placed->bytes;
  resident.placed = std::move(placed);
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
  std::vector<std::shared_ptr<const PlacedScene>> placed;
  for (const Resident& resident : scenes_)
    if (resident.placed) placed.push_back(resident.placed);
  view_ = std::make_shared<const PlacedView>(++generation_, std::move(placed), kinds_.kinds(), objects_);
}

std::vector<std::string> SceneStore::take_problems() {
  std::vector<std::string> problems = std::exchange(problems_, {});
  for (std::string& problem : ground_->take_problems()) problems.push_back(std::move(problem));
  return problems;
}

error::Expected<SceneIndex> index_with_terrain(const std::vector<radar::Scene>& configured,
                                               const radar::TerrainConfiguration& terrain) {
  std::vector<radar::Scene> scenes = configured;
  const auto of_terrain = std::filesystem::path(terrain.directory) / kTerrainScenes;
  if (!terrain.directory.empty() && !scene_files_in(of_terrain).empty())
    scenes.push_back({.file = of_terrain.string()});
  SceneIndex index;
  auto indexed = index_scenes(scenes, index.problems);
  if (!indexed) return tl::unexpected(indexed.error());
  index.scenes = std::move(*indexed);
  return index;
}

error::Expected<std::unique_ptr<SceneStore>> open_scenes(SceneIndex index, const radar::TerrainConfiguration& terrain,
                                                         SceneUse use) {
  if (index.scenes.empty() && index.problems.empty()) return std::unique_ptr<SceneStore>();
  constexpr bool kMaterials = false;  // a scene stands on heights
  auto ground = terrain::open_terrain(terrain, kMaterials);
  if (!ground) return tl::unexpected(ground.error());
  SceneStoreOptions options;
  options.use = use;
  return std::make_unique<SceneStore>(std::move(index), std::move(*ground), options);
}

error::Expected<std::unique_ptr<SceneStore>> open_scenes(const std::vector<radar::Scene>& configured,
                                                         const radar::TerrainConfiguration& terrain, SceneUse use) {
  auto index = index_with_terrain(configured, terrain);
  if (!index) return tl::unexpected(index.error());
  return open_scenes(std::move(*index), terrain, use);
}

}  // namespace yars::model::scene
