// Makes the pictures of patch maps: terrain and scenes are read, and the picture is computed, on a thread of its own
// while live, at once when the caller may wait (lockstep). One map at a time; a newer one replaces it.
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
#include "model/hrm/patch_process.hpp"
#include "model/kernel/map_schedule.hpp"
#include "model/scene/scene_store.hpp"
#include "model/terrain/terrain_view.hpp"

namespace yars::model {

struct PatchStores {
  std::unique_ptr<terrain::TerrainStore> window;
  std::unique_ptr<terrain::TerrainStore> path;
  std::unique_ptr<scene::SceneStore> scenes;  // null: none
};

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
  void request(const kernel::MapUnderWay& map, const std::vector<rbm::MovingPoint>& traffic);
  // The picture of this map, once it is done.
  const Picture* finished(const kernel::MapUnderWay& map);
  std::vector<std::string> take_problems();

 private:
  struct Wanted {
    hrm::PatchOrder order;
    std::uint64_t id = 0;
    std::int64_t start_tick = 0;
    std::vector<rbm::MovingPoint> traffic{};
  };
  void serve();
  void make(const Wanted& wanted);
  bool given_up() const { return ending_ || superseded_; }

  hrm::PatchProcess process_;
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
