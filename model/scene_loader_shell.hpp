// Keeps what the scan sees of polygonal scenes in memory: live on a thread of its own, whole at once when the caller
// may wait (lockstep). Scenes beyond what was asked for change no sweep, so all that counts is whether those within are
// there.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "model/scene/scene_store.hpp"

namespace yars::model {

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

}  // namespace yars::model
