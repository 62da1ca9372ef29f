// Background workers of radar-model: terrain loader, scene loader, patch map maker.
// Inputs: terrain regions (each a circle and its detail), pending patch maps; stores that read files.
// Outputs: immutable terrain and scene views; pictures of patch maps; problems as text.
// Threads: a worker has a thread of its own, and requests return at once. A synchronous worker (lockstep, tests) has no
// thread, and requests block. All public functions are called from the thread of the tick loop.
// Errors: files that cannot be read are reported by take_problems().
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "model/hrm/patch_formation.hpp"
#include "model/kernel/map_schedule.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model {

// [m] Margin of a request beyond the needed region. The next request starts when the aircraft has moved by half of the
// margin, so the current view still covers the needed region while the next view loads. A smaller margin means more
// loads, a larger margin more memory.
inline constexpr double kLoadMargin_m = 20'000.0;
// [m] The same for a process that stands by and asks again every 0.25 s. The holder of the role needs the processor.
inline constexpr double kStandbyMargin_m = 1'000.0;

// Loads the terrain of the scan. A loader with a thread loads in steps; view() returns the result of the latest step. A
// newer request cancels the remaining steps of an older request.
class TerrainLoader {
 public:
  TerrainLoader(std::unique_ptr<terrain::TerrainStore> store, bool synchronous);
  ~TerrainLoader();
  TerrainLoader(const TerrainLoader&) = delete;
  TerrainLoader& operator=(const TerrainLoader&) = delete;

  // Requests a region with a margin, replacing the previous request. No effect while the previous request has the same
  // detail, still contains the region with half of the margin and is not much larger. A synchronous loader blocks until
  // the region is loaded.
  void request(const terrain::TerrainRegion& region, double margin_m = kLoadMargin_m);
  // True if view() has the region in its detail, as far as it can be loaded.
  bool has_loaded(const terrain::TerrainRegion& region) const;
  // Latest view; empty at first, never null.
  terrain::TerrainViewPointer view() const;
  // Problems with cells since the last call; each cell is named once. Then notes about how cells are taken.
  std::vector<std::string> take_problems();
  std::vector<std::string> take_notes();

 private:
  void serve();
  // Moves problems and notes from the store to problems_ and notes_. Called in the thread that calls prepare().
  void collect_problems();

  std::unique_ptr<terrain::TerrainStore> store_;
  bool synchronous_;
  mutable std::mutex mutex_;  // with a thread: guards pending_, view_, loaded_region_, problems_, notes_ and ending_
  std::condition_variable wake_;
  std::optional<terrain::TerrainRegion> pending_;
  std::optional<terrain::TerrainRegion> requested_;
  terrain::TerrainViewPointer view_;
  std::optional<terrain::TerrainRegion> loaded_region_;  // that view_ has in its detail
  std::vector<std::string> problems_, notes_;
  bool ending_ = false;
  std::thread thread_;
};

// Loads the scatterers of polygonal scenes within the region of the scan. Scenes outside the region do not change a
// sweep, so a view of a larger region is also valid.
class SceneLoader {
 public:
  // Without a store there are no scenes. The files of all scenes are checked at once (SceneStore::check_files()), in a
  // thread beside that which loads regions, so that neither waits for the other. A synchronous loader checks them here.
  SceneLoader(std::unique_ptr<scene::SceneStore> store, bool synchronous);
  ~SceneLoader();
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  struct LoadedScenes {
    scene::SceneViewPointer view;  // null: nothing is read yet, or there are no scenes
    bool complete = true;          // true if the view has all scenes that overlap the region, or there are no scenes
  };
  // Requests a region (its detail is ignored) with a margin and returns the scenes loaded so far.
  LoadedScenes request(const terrain::TerrainRegion& region, double margin_m = kLoadMargin_m);
  // Problems since the last call, each sentence once for this loader.
  std::vector<std::string> take_problems();

 private:
  void serve();
  void check_files();
  void read(const terrain::TerrainRegion& region);
  void add_problems(std::vector<std::string> problems);  // mutex_ is held

  std::unique_ptr<scene::SceneStore> store_;
  bool synchronous_;
  std::optional<terrain::TerrainRegion> requested_;
  std::mutex mutex_;  // guards the members below, except the threads
  std::condition_variable wake_;
  std::optional<terrain::TerrainRegion> pending_;
  std::optional<terrain::TerrainRegion> loaded_region_;  // region of view_
  scene::SceneViewPointer view_;
  std::vector<std::string> problems_;
  std::set<std::string> reported_;  // all that problems_ had
  bool ending_ = false;
  std::thread thread_, check_thread_;
};

struct PatchStores {
  std::unique_ptr<terrain::TerrainStore> window;  // terrain of the map's window
  std::unique_ptr<terrain::TerrainStore> path;    // terrain between aircraft and window
  std::unique_ptr<scene::SceneStore> scenes;      // null: no scenes
};

// Makes the pictures of patch maps: reads terrain and scenes, then computes the picture. It makes one map at a time. A
// newer request cancels an older request.
class PatchMaker {
 public:
  PatchMaker(const physics::RadarParameters& parameters, PatchStores stores, bool synchronous);
  ~PatchMaker();
  PatchMaker(const PatchMaker&) = delete;
  PatchMaker& operator=(const PatchMaker&) = delete;

  struct Picture {
    std::uint64_t id = 0;
    std::int64_t start_tick = 0;
    std::uint32_t size = 0;            // [pixels] edge of the picture
    double elevation_msl_m = 0.0;      // of the level plane onto which the ground is mapped
    double up_deg = 0.0;               // true bearing that points up in the picture
    double distance_m = 0.0;           // over ground, from the aircraft to the centre
    double squint_deg = 0.0;           // angle from the ground track to the centre, positive to the right
    bool blind = false;                // part of the picture is in the blind zone and blank
    bool ready = true;                 // false: some terrain was not loaded
    std::vector<std::uint8_t> pixels;  // video, size x size, row 0 at the far edge
  };

  // Moving targets at the start of a map's formation: those of the world, and the traffic.
  struct Targets {
    std::vector<physics::MovingPoint> movers{}, traffic{};
  };
  // Requests the picture of a map.
  void request(const kernel::PendingMap& map, const Targets& targets);
  // Picture of the map if the picture is complete, else null. Valid until the next finished().
  const Picture* finished(const kernel::PendingMap& map);
  std::vector<std::string> take_problems();

 private:
  struct Job {
    hrm::PatchOrder order;
    std::uint64_t id = 0;
    std::int64_t start_tick = 0;
    Targets targets{};
  };
  void serve();
  void make(const Job& job);
  bool cancelled() const { return ending_ || superseded_; }

  hrm::PatchFormation formation_;
  PatchStores stores_;
  bool synchronous_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Job> pending_;
  std::optional<Picture> done_;       // newest complete picture
  std::optional<Picture> delivered_;  // newest picture that finished() has taken from done_
  std::vector<std::string> problems_;
  std::atomic<bool> ending_{false};
  std::atomic<bool> superseded_{false};
  std::thread thread_;
};

}  // namespace yars::model
