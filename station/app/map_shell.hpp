// Draws tiles of the instructor's map in a thread of its own, so that frames of the display do not wait for terrain.
// Inputs: the terrain of the configuration; requests of tiles. Outputs: tiles as PNG.
// Errors: problems of the terrain are logged at level debug only, because radar-model reports them. Ground without a
//   file is drawn as sea or as absent, as the configuration counts it.
// Limits: kMaxWaiting requests wait; more are refused. The newest kKept tiles are kept.
// Threads: request() is called from one thread; the answers come in the map's own thread.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "station/map_tile.hpp"

namespace yars::model::terrain {
class TerrainStore;
}  // namespace yars::model::terrain

namespace yars::station {

class MapShell {
 public:
  using Answer = std::function<void(std::shared_ptr<const std::string> png)>;

  explicit MapShell(std::unique_ptr<model::terrain::TerrainStore> store);
  ~MapShell();
  MapShell(const MapShell&) = delete;
  MapShell& operator=(const MapShell&) = delete;

  // Calls `answer` in another thread, or at once for a tile that is kept. False: too many requests wait.
  bool request(const MapTile& tile, Answer answer);

 private:
  static constexpr std::size_t kMaxWaiting = 512, kKept = 256;
  void serve();
  std::shared_ptr<const std::string> drawn(const MapTile& tile);

  struct Request {
    MapTile tile;
    Answer answer;
  };
  std::unique_ptr<model::terrain::TerrainStore> store_;
  std::mutex mutex_;  // guards the members below, except thread_
  std::condition_variable wake_;
  std::deque<Request> waiting_;
  std::map<MapTile, std::shared_ptr<const std::string>> kept_;
  std::deque<MapTile> order_;  // of kept_, the oldest first
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace yars::station
