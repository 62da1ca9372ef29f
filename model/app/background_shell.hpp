// Background threads of the radar model: terrain loader, scene loader, patch maker.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "lib/radar/configuration.hpp"
#include "model/hrm/patch_formation.hpp"
#include "model/kernel/map_schedule.hpp"
#include "model/scene/index/scene_store.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::model {

// Keeps the terrain that the scan needs in memory. Live, on a thread of its own, in steps: each is seen as soon as it
// is there, and a newer request cuts the rest of an older one short. At once and whole when the caller may wait
// (lockstep, replay).
class TerrainLoader {
 public:
  TerrainLoader(std::unique_ptr<terrain::TerrainStore> store, bool may_wait);
  ~TerrainLoader();
  TerrainLoader(const TerrainLoader&) = delete;
  TerrainLoader& operator=(const TerrainLoader&) = delete;

  // Asks for a region in place of the one asked for before. Waits for it if the loader may.
  void request(const terrain::TerrainRegion& region);
  // The latest view; an empty one at first, never null.
  terrain::TerrainViewPointer view() const;
  // What went wrong with cells since the last call; each cell is named once.
  std::vector<std::string> take_problems();

 private:
  void serve();
  void collect_problems();  // the store's, by the thread that called prepare()

  std::unique_ptr<terrain::TerrainStore> store_;
  bool may_wait_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<terrain::TerrainRegion> wanted_;
  std::optional<terrain::TerrainRegion> asked_;
  terrain::TerrainViewPointer view_;
  std::vector<std::string> problems_;
  bool ending_ = false;
  std::thread thread_;
};

// Keeps what the scan sees of polygonal scenes in memory: live on a thread of its own, whole at once when the caller
// may wait (lockstep). Scenes beyond what was asked for change no sweep, so all that counts is whether those within are
// there.
class SceneLoader {
 public:
  // Without a store there are no scenes.
  SceneLoader(std::unique_ptr<scene::SceneStore> store, bool may_wait);
  ~SceneLoader();
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  struct Held {
    scene::SceneViewPointer view;  // null: nothing read yet, or no scenes at all
    bool whole = true;             // all that reaches into the region is in it
  };
  // Asks for a region, its detail aside; what is there of it.
  Held request(const terrain::TerrainRegion& region);
  // What went wrong with files since the last call.
  std::vector<std::string> take_problems();

 private:
  void serve();
  void read(const terrain::TerrainRegion& region);

  std::unique_ptr<scene::SceneStore> store_;
  bool may_wait_;
  std::optional<terrain::TerrainRegion> asked_;
  std::mutex mutex_;  // of what follows
  std::condition_variable wake_;
  std::optional<terrain::TerrainRegion> wanted_;
  std::optional<terrain::TerrainRegion> held_;  // that the view is whole for
  scene::SceneViewPointer view_;
  std::vector<std::string> problems_;
  bool ending_ = false;
  std::thread thread_;
};

struct PatchStores {
  std::unique_ptr<terrain::TerrainStore> window;
  std::unique_ptr<terrain::TerrainStore> path;
  std::unique_ptr<scene::SceneStore> scenes;  // null: none
};

// Makes the pictures of patch maps: terrain and scenes are read, and the picture is computed, on a thread of its own
// while live, at once when the caller may wait (lockstep). One map at a time; a newer one replaces it.
class PatchMaker {
 public:
  PatchMaker(const radar::RadarConfiguration& configuration, PatchStores stores, bool may_wait);
  ~PatchMaker();
  PatchMaker(const PatchMaker&) = delete;
  PatchMaker& operator=(const PatchMaker&) = delete;

  struct Picture {
    std::uint64_t id = 0;
    std::int64_t start_tick = 0;
    std::uint32_t size = 0;
    double elevation_msl_m = 0.0;  // of the map plane
    double up_deg = 0.0;
    double distance_m = 0.0;
    double squint_deg = 0.0;
    bool blind = false;
    bool ready = true;  // false: some terrain was not there
    std::vector<std::uint8_t> pixels;
  };

  // `traffic`: as it is when the map begins.
  void request(const kernel::PendingMap& map, const std::vector<physics::MovingPoint>& traffic);
  // The picture of this map, once it is done.
  const Picture* finished(const kernel::PendingMap& map);
  std::vector<std::string> take_problems();

 private:
  struct Wanted {
    hrm::PatchOrder order;
    std::uint64_t id = 0;
    std::int64_t start_tick = 0;
    std::vector<physics::MovingPoint> traffic{};
  };
  void serve();
  void make(const Wanted& wanted);
  bool given_up() const { return ending_ || superseded_; }

  hrm::PatchFormation process_;
  PatchStores stores_;
  bool may_wait_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Wanted> wanted_;
  std::optional<Picture> done_;    // the newest
  std::optional<Picture> handed_;  // what finished() has shown
  std::vector<std::string> problems_;
  std::atomic<bool> ending_{false};
  std::atomic<bool> superseded_{false};
  std::thread thread_;
};

}  // namespace yars::model
