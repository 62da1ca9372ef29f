// Theatre: terrain and scenes in which scans and patch maps are computed, without a session. The stores stay open, so
// that later scans and maps find in memory what earlier ones have read. TheatreFiles opens the stores, also for
// programs with a session, which read in steps and in own threads. Ground under the samples of the middle ray of each
// sweep of a scan, lit or in shadow. Inputs: folder of elevation cells, scene files; regions of scans and maps;
// positions of a scan's sweeps. Outputs: views of terrain and scene; a RaySample for each sample of each sweep. Units:
// as suffixes of names say; positions are WGS84.
// Errors: the functions throw Failure for files that cannot be opened, or a region whose files are all unreadable.
// Threads: one call at a time. Any number of threads may read the views.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lib/geo/geodesy.hpp"
#include "lib/parallel/thread_pool.hpp"
#include "lib/radar/configuration.hpp"
#include "model/hrm/algorithm.hpp"
#include "model/kernel/offline_scan.hpp"
#include "model/kernel/sweep_chain.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/terrain/sampling/terrain_view.hpp"
#include "model/terrain/store/cell_files.hpp"
#include "yars/call.hpp"

namespace yars::radar {

// Takes a warning: one sentence.
using Warn = std::function<void(const std::string&)>;

// The function `warn` of a call, or a function that does nothing if the call has none.
inline Warn warn_of(const Call& call) {
  return call.warn ? call.warn : [](const std::string&) {};
}

// Warn of each problem of reading; check_terrain_read() also warns of notes. Call them after prepare() of the stores.
// A last warning has the number of unreadable files in the region of the last prepare(). If all files of the region are
// unreadable, they throw Failure.
// `folder`: terrain folder, for messages. `path_store`: optional second store of the same folder, for the ground
// between aircraft and map. Its problems are warnings, and its unreadable files are not counted.
void check_terrain_read(const Warn& warn, const std::string& folder, model::terrain::TerrainStore& store,
                        model::terrain::TerrainStore* path_store = nullptr);
void check_scenes_read(const Warn& warn, model::scene::SceneStore& scenes);

// Data that the stores left out of all regions so far: one sentence each, in the order of the calls, without repeats.
class LeftOut {
 public:
  void add(const model::terrain::TerrainStore& store);
  void add(const model::scene::SceneStore& scenes);
  const std::vector<std::string>& sentences() const { return sentences_; }

 private:
  void add(const std::vector<std::string>& sentences);
  std::vector<std::string> sentences_;
};

// Views for one scan.
struct ScanEnvironment {
  model::terrain::TerrainViewPointer terrain;
  model::scene::SceneViewPointer scene;  // null: none
};

// Stores of one use.
struct TheatreStores {
  std::unique_ptr<model::terrain::TerrainStore> window;  // terrain of scans, or of the window of a map
  // Terrain between aircraft and window, which is coarser than that of the window; null for scans.
  std::unique_ptr<model::terrain::TerrainStore> path;
  std::unique_ptr<model::scene::SceneStore> scenes;  // null: none
};

// Terrain and scenes of a configuration, and scenes of the terrain's own folder.
class TheatreFiles {
 public:
  TheatreFiles(TerrainConfiguration terrain, std::vector<Scene> scenes)
      : terrain_(std::move(terrain)), configured_(std::move(scenes)) {}

  std::unique_ptr<model::terrain::TerrainStore> open_terrain() const;
  // Indexed at the first call.
  const model::scene::SceneIndex& scenes();
  // `use`: triangles for maps, scatterers for scans. The terrain is opened first, then the scenes.
  TheatreStores open(model::scene::SceneUse use);

 private:
  TerrainConfiguration terrain_;
  std::vector<Scene> configured_;
  std::optional<model::scene::SceneIndex> scenes_;
};

class Theatre {
 public:
  // Opens the stores (TheatreFiles).
  Theatre(const TerrainConfiguration& terrain, const std::vector<radar::Scene>& scenes, model::scene::SceneUse use);

  // Reads what a scan or a map needs. Problems of files are passed to `warn`.
  ScanEnvironment prepare(const model::kernel::ScanRequest& request, const Fidelity& fidelity, const Warn& warn);
  model::hrm::PatchEnvironment prepare(const model::hrm::PatchNeed& need, const Warn& warn);

  // Data left out of all regions so far, one sentence each: files of the terrain's folder that are not used, unreadable
  // cells, and parts of scenes.
  std::vector<std::string> left_out() const;

  // Scenes within `radius_m` of a position; null: no scenes are configured.
  model::scene::SceneViewPointer scenes_near(geo::GeoPoint position, double radius_m, const Warn& warn);
  // Finest terrain of the cell that contains a position. A position on an edge is in several cells.
  model::terrain::TerrainViewPointer terrain_at(geo::GeoPoint position, const Warn& warn);
  // Files of the folder; null: the built-in hills.
  const model::terrain::DirectoryIndex* index() const;

 private:
  std::string folder_;  // for messages
  TheatreStores stores_;
};

struct RadarConfiguration;

// Fraction of full scale, far below noise: a smaller power counts as none.
inline constexpr float kMinScanPower = 1e-8F;

// One sample of the middle ray of a sweep: position on the exact geodesic, ground, lit or in shadow. The configured
// algorithm computes `lit`. Beam, smears and number of rays do not change `lit`.
struct RaySample {
  double distance_m = 0.0;         // [m] ground range; NaN: no ground at the sample's slant range
  geo::GeoPoint position;          // the aircraft's position where distance_m is NaN
  model::terrain::Surface ground;  // void where distance_m is NaN
  bool lit = false;                // false: in shadow, void or not loaded
  bool laid_over = false;          // samples of slant range: other lit ground has the same slant range
  // True: power above kMinScanPower, seen with a beam nearly 180 deg wide in elevation. Rain also gives power to
  // samples in shadow.
  bool returns = false;
};

// Samples of all sweeps: sweep after sweep, from near to far. Calls `goes_on` between sweeps; if it returns false,
// throws parallel::Stopped.
std::vector<RaySample> ray_samples(const RadarConfiguration& configuration,
                                   std::span<const model::kernel::SweepHeader> positions,
                                   const model::terrain::TerrainView& terrain, const parallel::GoesOn& goes_on = {});

}  // namespace yars::radar
