// Store of placed scenes: loads the files of a region on demand and returns immutable views.
// Inputs: scenes of a configuration; a terrain store that only this store uses; a region.
// Outputs: SceneView; problems, one sentence each.
// Errors: an unreadable file is reported once as a problem, and views omit it.
// Threads: one thread at a time uses a store; prepare() loads several scenes in threads of its own, which end with it.
//   Any number of threads may read its views.
// Determinism: equal files and calls give equal views.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/scene/index/scene_index.hpp"
#include "model/scene/openflight/reader.hpp"
#include "model/scene/placement/placed_scene.hpp"
#include "model/scene/placement/scene_view.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::radar {
struct TerrainConfiguration;
}  // namespace yars::radar

namespace yars::model::scene {

// View of placed scenes. A query finds the scenes near a position, then the tiles of each.
class PlacedView final : public SceneView {
 public:
  PlacedView(std::uint64_t generation, std::vector<std::shared_ptr<const PlacedScene>> scenes,
             std::vector<SurfaceKind> kinds, std::vector<SceneObject> objects);

  std::uint64_t generation() const override { return generation_; }
  std::uint64_t resident_bytes() const override { return bytes_; }
  const std::vector<SurfaceKind>& kinds() const override { return kinds_; }
  const std::vector<SceneObject>& objects() const override { return objects_; }
  void tiles_near(geo::GeoPoint position, double radius_m, std::vector<const Tile*>& found) const override;
  std::span<const Scatterers* const> scatterers() const override { return scatterers_; }

 private:
  std::uint64_t generation_;
  std::vector<std::shared_ptr<const PlacedScene>> scenes_;
  GridIndex position_index_;
  std::vector<SurfaceKind> kinds_;
  std::vector<SceneObject> objects_;
  std::vector<const Scatterers*> scatterers_;
  std::uint64_t bytes_ = 0;
};

// [bytes] Bounds of SceneStore::check_files(): about 1 s of one processor for a file, and 4 s in all. External files of
// a scene are not counted.
inline constexpr std::uintmax_t kMaxCheckedFileBytes = std::uintmax_t{64} << 20;
inline constexpr std::uintmax_t kMaxCheckedBytes = std::uintmax_t{256} << 20;

// Options of a SceneStore. `resident_limit_bytes` is a soft limit of memory: scenes that overlap the last prepared
// region always stay loaded.
struct SceneStoreOptions {
  std::size_t resident_limit_bytes = std::size_t{2} << 30;
  SceneUse use = SceneUse::triangles;
};

// Store of placed scenes. prepare() loads the scenes that overlap the region and opens no other scene file.
// Above the memory limit the store drops the least recently used scenes, but none that overlap the region.
// Terrain is sampled at its finest level, so heights do not depend on the region.
// An index of a kind or object means the same in later views. Only a file with more objects than at its earlier loads
// gets new object indices when it is loaded again.
class SceneStore {
 public:
  // Errors: a file named in the configuration is missing, is not OpenFlight or has no position; a name in
  // radar::Scene::without matches no part of such a file; a folder has no .flt file. An unusable file inside a folder
  // is a problem instead.
  static error::Expected<std::unique_ptr<SceneStore>> open(const std::vector<radar::Scene>& scenes,
                                                           std::unique_ptr<terrain::TerrainStore> ground,
                                                           SceneStoreOptions options = {});
  // The same for scenes that are indexed already.
  SceneStore(SceneIndex index, std::unique_ptr<terrain::TerrainStore> ground, SceneStoreOptions options = {});

  // Returns a view with every readable scene that overlaps the region. `region.detail` is ignored.
  // Returns the previous view if no scene was loaded or dropped.
  SceneViewPointer prepare(const terrain::TerrainRegion& region);

  // Returns the problems since the last call, one sentence each: unreadable files, what is left out of files, and
  // warnings about files.
  std::vector<std::string> take_problems();

  // Number of files whose scenes overlap the last prepared region, and how many of these files are unreadable.
  // A file that could not be indexed counts in both numbers in every region, because its position is unknown.
  struct Wanted {
    std::size_t files = 0, unreadable = 0;
  };
  const Wanted& wanted() const { return wanted_; }
  // Data left out of the views of all regions so far, one sentence each: files that cannot be indexed or read, and
  // parts of the others. A call does not clear the list, unlike take_problems().
  std::vector<std::string> left_out() const;

  // Reads the files of all scenes before any region needs them, and reports their problems, file by file in the order
  // of the index. `report` takes the sentences of one file, as take_problems() will have them, and may stop the check
  // by returning false. Bounds: a file above kMaxCheckedFileBytes, and what follows kMaxCheckedBytes in all, is not
  // read; the last sentence says how many files that are. One model at a time is in memory.
  // Threads: may run in one thread while another calls prepare(), because it uses only the index.
  void check_files(const std::function<bool(std::vector<std::string>)>& report) const;

 private:
  struct Resident {
    std::shared_ptr<const PlacedScene> placed;
    std::uint64_t last_use = 0;  // value of prepares_ when a region last overlapped the scene
    bool unreadable = false;
    std::vector<std::string> left_out;  // of the file; all of it if it is unreadable
    std::uint32_t first_object = 0;     // first index in objects_; kept when the scene is dropped
    std::uint32_t objects = 0;          // number of reserved indices: the maximum number of objects at any load
  };

  struct Loading {
    std::size_t number;
    Model model;
    terrain::TerrainViewPointer ground;
  };
  bool load(std::span<const std::size_t> numbers);
  std::optional<Loading> begin_load(std::size_t number, error::Expected<Model> model);
  void end_load(std::size_t number, std::shared_ptr<PlacedScene> placed);
  bool drop_longest_unused();
  void make_view();

  std::vector<IndexedScene> index_;
  std::unique_ptr<terrain::TerrainStore> ground_;
  SceneStoreOptions options_;
  GridIndex position_index_;
  std::vector<Resident> scenes_;  // parallel to index_
  KindTable kinds_;
  std::vector<SceneObject> objects_;
  std::uint64_t resident_bytes_ = 0;
  std::uint64_t prepares_ = 0;            // number of calls of prepare(), the clock of Resident::last_use
  std::vector<std::string> not_indexed_;  // problems of the files that could not be indexed, one each
  Wanted wanted_;
  std::uint64_t generation_ = 0;
  SceneViewPointer view_;
  std::vector<std::string> problems_;
};

// Folder of scenes inside a folder of terrain. Its .flt files belong to the terrain.
inline constexpr const char* kTerrainScenes = "scenes";

// Index of the configured scenes, and of those in the terrain's own folder of scenes. Errors: as index_scenes().
error::Expected<SceneIndex> index_with_terrain(const std::vector<radar::Scene>& configured,
                                               const radar::TerrainConfiguration& terrain);

// Opens a store of these scenes over configured terrain. Null if there is no scene.
error::Expected<std::unique_ptr<SceneStore>> open_scenes(SceneIndex index, const radar::TerrainConfiguration& terrain,
                                                         SceneUse use);
// Opens the store of configured scenes and of the terrain's own scenes.
error::Expected<std::unique_ptr<SceneStore>> open_scenes(const std::vector<radar::Scene>& configured,
                                                         const radar::TerrainConfiguration& terrain,
                                                         SceneUse use = SceneUse::triangles);

}  // namespace yars::model::scene
