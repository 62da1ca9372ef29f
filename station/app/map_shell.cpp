#include "station/app/map_shell.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lib/geo/earth.hpp"
#include "lib/imageio/png.hpp"
#include "lib/log/log.hpp"
#include "model/terrain/sampling/terrain_view.hpp"

namespace yars::station {

namespace terrain = model::terrain;

MapShell::MapShell(std::unique_ptr<terrain::TerrainStore> store)
    : store_(std::move(store)), thread_([this] { serve(); }) {}

MapShell::~MapShell() {
  {
    const std::lock_guard guard(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

bool MapShell::request(const MapTile& tile, Answer answer) {
  std::shared_ptr<const std::string> png;
  {
    const std::lock_guard guard(mutex_);
    if (const auto found = kept_.find(tile); found != kept_.end()) {
      png = found->second;
    } else {
      if (waiting_.size() >= kMaxWaiting) return false;
      waiting_.push_back({tile, std::move(answer)});
    }
  }
  if (png)
    answer(png);
  else
    wake_.notify_one();
  return true;
}

void MapShell::serve() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_) return;
    // The newest request first: the user has moved the map since the older ones.
    const Request request = std::move(waiting_.back());
    waiting_.pop_back();
    std::shared_ptr<const std::string> png;
    if (const auto found = kept_.find(request.tile); found != kept_.end()) png = found->second;
    lock.unlock();
    if (!png) png = drawn(request.tile);
    request.answer(png);
    lock.lock();
    if (!kept_.emplace(request.tile, png).second) continue;
    order_.push_back(request.tile);
    if (order_.size() <= kKept) continue;
    kept_.erase(order_.front());
    order_.pop_front();
  }
}

std::shared_ptr<const std::string> MapShell::drawn(const MapTile& tile) {
  const terrain::MapFrame frame = frame_of(tile);
  const geo::GeoPoint centre{0.5 * (frame.south_deg + frame.north_deg), 0.5 * (frame.west_deg + frame.east_deg)};
  const double edge_m = (frame.north_deg - frame.south_deg) * geo::kMetresPerDegree;
  const terrain::TerrainRegion region{centre, 0.75 * edge_m, terrain::detail_for(edge_m / kTilePixels)};
  const terrain::TerrainViewPointer view = store_->prepare(region);
  for (const std::string& problem : store_->take_problems()) log::debug("map: " + problem);
  const imageio::Image image = terrain::map_of(*view, frame);
  std::vector<std::uint8_t> rgbx, png;
  rgbx.reserve(image.pixels.size() / 3 * 4);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    rgbx.insert(rgbx.end(), {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2], 0});
  imageio::encode_png({rgbx.data(), frame.width, frame.height, 4U * static_cast<std::size_t>(frame.width)}, png);
  return std::make_shared<const std::string>(png.begin(), png.end());
}

}  // namespace yars::station
