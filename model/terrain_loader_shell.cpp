#include "model/terrain_loader_shell.hpp"

#include <utility>

#include "lib/geo/geodesic.hpp"

namespace yars::model {

namespace {

// A request is wider than the need by this much [m]; the next one begins when half of it is flown, so that the
// view is whole while the next loads.
constexpr double kSlack_m = 20'000.0;

bool still_serves(const terrain::TerrainRegion& asked, const terrain::TerrainRegion& region) {
  if (region.detail != asked.detail) return false;
  if (region.radius_m > asked.radius_m || region.radius_m + 2.0 * kSlack_m < asked.radius_m) return false;
  const double moved_m = geo::geodesic_inverse(asked.centre, region.centre).distance.metres();
  return moved_m + region.radius_m + 0.5 * kSlack_m <= asked.radius_m;
}

}  // namespace

TerrainLoader::TerrainLoader(std::unique_ptr<terrain::TerrainStore> store, bool may_wait)
    : store_(std::move(store)), may_wait_(may_wait) {
  // An empty region gives an empty view at once: the kernel always has something to read.
  view_ = store_->prepare({});
  if (!may_wait_) thread_ = std::thread([this] { serve(); });
}

TerrainLoader::~TerrainLoader() {
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void TerrainLoader::request(const terrain::TerrainRegion& region) {
  if (asked_ && still_serves(*asked_, region)) return;
  asked_ = terrain::TerrainRegion{region.centre, region.radius_m + kSlack_m, region.detail, region.radius_m};
  if (may_wait_) {
    view_ = store_->prepare(*asked_);
    collect_problems();
    return;
  }
  {
    const std::scoped_lock lock(mutex_);
    wanted_ = asked_;
  }
  wake_.notify_one();
}

terrain::TerrainViewPointer TerrainLoader::view() const {
  const std::scoped_lock lock(mutex_);
  return view_;
}

std::vector<std::string> TerrainLoader::take_problems() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(problems_, {});
}

void TerrainLoader::collect_problems() {
  for (auto& problem : store_->take_problems()) problems_.push_back(std::move(problem));
}

void TerrainLoader::serve() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return ending_ || wanted_.has_value(); });
    if (ending_) return;
    const terrain::TerrainRegion region = *wanted_;
    wanted_.reset();
    lock.unlock();
    auto view = store_->prepare_in_steps(region, [this](const terrain::TerrainViewPointer& interim) {
      const std::scoped_lock hold(mutex_);
      view_ = interim;
      return !ending_ && !wanted_;
    });
    lock.lock();
    view_ = std::move(view);
    collect_problems();
  }
}

}  // namespace yars::model
