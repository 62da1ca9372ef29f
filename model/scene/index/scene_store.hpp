// Scene store: reads and places the files of a region and hands out views of them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lib/error/error.hpp"
#include "model/scene/index/scene_index.hpp"
#include "model/scene/placement/placed_scene.hpp"
#include "model/scene/placement/scene_view.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model::scene {

// The view that a store gives: placed scenes, found by their places, then tiles and objects within each.
class PlacedView final : public SceneView {
 public:
  struct Part {
    std::shared_ptr<const PlacedScene> scene;
    std::uint32_t first_object = 0;
  };

  PlacedView(std::uint64_t generation, std::vector<Part> parts, std::vector<SurfaceKind> kinds,
             std::vector<SceneObject> objects);

  std::uint64_t generation() const override { return generation_; }
  std::uint64_t resident_bytes() const override { return bytes_; }
  const std::vector<SurfaceKind>& kinds() const override { return kinds_; }
  const std::vector<SceneObject>& objects() const override { return objects_; }
  void tiles_near(geo::GeoPoint position, double radius_m, std::vector<const Tile*>& found) const override;
  void objects_near(geo::GeoPoint position, double radius_m, std::vector<std::uint32_t>& found) const override;
  std::span<const Scatterers* const> scatterers() const override { return scatterers_; }

 private:
  std::uint64_t generation_;
  std::vector<Part> parts_;
  GridIndex position_index_;
  std::vector<SurfaceKind> kinds_;
  std::vector<SceneObject> objects_;
  std::vector<const Scatterers*> scatterers_;
  std::uint64_t bytes_ = 0;
};

// Polygonal scenes of a configuration, read as far as they are wanted: prepare() reads and places the files whose reach
// comes into the region and keeps them; files elsewhere are not opened. Beyond the limit the longest unused go, never
// one that the region wants. Terrain comes from a store of its own, at its finest, so that heights never depend on what
// the radar looks at. Equal files and calls give equal views. A file that cannot be read is a problem once and is
// absent. Numbers of kinds and objects stay as they are from view to view. One thread at a time; views are read by any
// number.
struct SceneStoreOptions {
  std::size_t resident_limit_bytes = std::size_t{2} << 30;
  SceneUse use = SceneUse::triangles;
};

class SceneStore {
 public:
  // Errors: a file named by itself is missing, is no OpenFlight file or has no place.
  static error::Expected<std::unique_ptr<SceneStore>> open(const std::vector<radar::Scene>& scenes,
                                                           std::unique_ptr<terrain::TerrainStore> ground,
                                                           SceneStoreOptions options = {});

  // A view that holds every scene that reaches into the region (its detail is not asked). The same view, of the same
  // generation, while nothing has to change.
  SceneViewPointer prepare(const terrain::TerrainRegion& region);

  // What a person should know since the last call: unreadable files, odd ones. A sentence each.
  std::vector<std::string> take_problems();

  const std::vector<IndexedScene>& index() const { return index_; }
  // Of the files that the region last prepared wanted: how many, and how many of them cannot be read. A file that gave
  // no place when the folder was looked through may belong to any region.
  struct Wanted {
    std::size_t files = 0, unreadable = 0;
  };
  Wanted wanted() const { return wanted_; }

 private:
  struct Resident {
    std::shared_ptr<const PlacedScene> placed;
    std::uint64_t last_use = 0;
    bool unreadable = false;
    std::uint32_t first_object = 0;  // its range of objects_, kept when it is dropped
    std::uint32_t objects = 0;
  };

  SceneStore(std::vector<IndexedScene> index, std::unique_ptr<terrain::TerrainStore> ground, SceneStoreOptions options);
  bool load(std::size_t scene);
  bool drop_longest_unused();
  void make_view();

  std::vector<IndexedScene> index_;
  std::unique_ptr<terrain::TerrainStore> ground_;
  SceneStoreOptions options_;
  GridIndex position_index_;
  std::vector<Resident> scenes_;  // one for each of index_
  KindTable kinds_;
  std::vector<SceneObject> objects_;
  std::uint64_t resident_bytes_ = 0;
  std::uint64_t prepares_ = 0;
  std::size_t without_position_ = 0;
  Wanted wanted_;
  std::uint64_t generation_ = 0;
  SceneViewPointer view_;
  std::vector<std::string> problems_;
};

// The store that a configuration asks for; null when it names no scene.
error::Expected<std::unique_ptr<SceneStore>> open_scenes(const radar::RadarConfiguration& configuration,
                                                         SceneUse use = SceneUse::triangles);

}  // namespace yars::model::scene
