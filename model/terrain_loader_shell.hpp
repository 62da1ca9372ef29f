// Keeps the terrain that the scan needs in memory. Live, on a thread of its own, in steps: each is seen as soon as it
// is there, and a newer request cuts the rest of an older one short. At once and whole when the caller may wait
// (lockstep, replay).
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "model/terrain/terrain_view.hpp"

namespace yars::model {

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

}  // namespace yars::model
