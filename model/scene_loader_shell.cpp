#include "model/scene_loader_shell.hpp"

#include <utility>

#include "lib/geo/geodesic.hpp"

namespace yars::model {

namespace {


bool covers(const terrain::TerrainRegion& wide, const terrain::TerrainRegion& region, double spare_m) {
  if (region.radius_m + spare_m > wide.radius_m) return false;
  const double moved_m = geo::geodesic_inverse(wide.centre, region.centre).distance.metres();
  return moved_m + region.radius_m + spare_m <= wide.radius_m;
}

}  // namespace

SceneLoader::SceneLoader(std::unique_ptr<scene::SceneStore> store, bool may_wait)
    : store_(std::move(store)), may_wait_(may_wait) {
  if (store_ && !may_wait_) thread_ = std::thread([this] { serve(); });
}

SceneLoader::~SceneLoader() {
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

SceneLoader::Held SceneLoader::request(const terrain::TerrainRegion& region) {
  if (!store_) return {};
  if (!asked_ || !covers(*asked_, region, 0.5 * kSlack_m)) {
    asked_ = terrain::TerrainRegion{region.centre, region.radius_m + kSlack_m, 0};
    if (may_wait_) {
      read(*asked_);
    } else {
      const std::scoped_lock lock(mutex_);
      wanted_ = asked_;
    }
    wake_.notify_one();
  }
  const std::scoped_lock lock(mutex_);
  return {view_, held_ && covers(*held_, region, 0.0)};
}

void SceneLoader::read(const terrain::TerrainRegion& region) {
  scene::SceneViewPointer view = store_->prepare(region);
  std::vector<std::string> problems = store_->take_problems();
  const std::scoped_lock lock(mutex_);
  view_ = std::move(view);
  held_ = region;
  for (std::string& problem : problems) problems_.push_back(std::move(problem));
}

std::vector<std::string> SceneLoader::take_problems() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(problems_, {});
}

void SceneLoader::serve() {
  while (true) {
    terrain::TerrainRegion region;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return ending_ || wanted_.has_value(); });
      if (ending_) return;
      region = *wanted_;
      wanted_.reset();
    }
    read(region);
  }
}

}  // namespace yars::model
