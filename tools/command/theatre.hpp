// Theatre: terrain and scenes in which scans and patch maps are computed, without a session. The stores stay open, so
// that later scans and maps find in memory what earlier ones have read. Inputs: folder of elevation cells, scene files;
// regions of scans and maps. Outputs: views of terrain and scene. Errors: the functions throw CommandFailed for files
// that cannot be opened, or a region whose files are all unreadable. Threads: one at a time. Any number of threads may
// read the views.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/radar/world.hpp"
#include "model/hrm/patch_data.hpp"
#include "model/kernel/offline_scan.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/terrain/sampling/terrain_view.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "tools/command/input_checks.hpp"

namespace yars::radar {
struct Fidelity;
struct TerrainConfiguration;
}  // namespace yars::radar

namespace yars::tools {

// Views for one scan.
struct ScanEnvironment {
  model::terrain::TerrainViewPointer terrain;
  model::scene::SceneViewPointer scene;  // null: none
};

class Theatre {
 public:
  // Opens the stores. `use`: triangles for maps, scatterers for scans. Scenes of the terrain's own folder are added.
  Theatre(const radar::TerrainConfiguration& terrain, const std::vector<radar::Scene>& scenes,
          model::scene::SceneUse use);

  // Reads what a scan or a map needs. `warn` takes the problems of files.
  ScanEnvironment prepare(const model::kernel::ScanRequest& request, const radar::Fidelity& fidelity, const Warn& warn);
  model::hrm::PatchEnvironment prepare(const model::hrm::PatchNeed& need, const Warn& warn);

  // What the regions so far lack of their files, one sentence each: files of the terrain's folder that are not used,
  // unreadable cells, and parts of scenes.
  std::vector<std::string> left_out() const;

  // Scenes about a position; null: none.
  model::scene::SceneViewPointer scenes_near(geo::GeoPoint position, double radius_m, const Warn& warn);
  // Terrain of the cells that contain a position, on an edge more than one, at their finest level.
  model::terrain::TerrainViewPointer terrain_at(geo::GeoPoint position, const Warn& warn);
  // Files of the folder; null: the built-in hills.
  const model::terrain::DirectoryIndex* index() const;

 private:
  std::string folder_;  // for messages
  // Two stores: the ground of a map needs finer terrain than the ground between aircraft and map.
  std::unique_ptr<model::terrain::TerrainStore> window_store_, path_store_;  // path: null for scans
  std::unique_ptr<model::scene::SceneStore> scenes_;                         // null: none
};

}  // namespace yars::tools
