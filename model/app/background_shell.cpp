#include "model/app/background_shell.hpp"

#include <utility>

#include "lib/geo/geodesy.hpp"

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

PatchMaker::PatchMaker(const radar::RadarConfiguration& configuration, PatchStores stores, bool may_wait)
    : process_(configuration, {}), stores_(std::move(stores)), may_wait_(may_wait) {
  if (!may_wait_) thread_ = std::thread([this] { serve(); });
}

PatchMaker::~PatchMaker() {
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void PatchMaker::request(const kernel::PendingMap& map, const std::vector<physics::MovingPoint>& traffic) {
  const Wanted wanted{map.order, map.id, map.start_tick, traffic};
  if (may_wait_) return make(wanted);
  {
    const std::scoped_lock lock(mutex_);
    wanted_ = wanted;
    superseded_ = true;
  }
  wake_.notify_one();
}

const PatchMaker::Picture* PatchMaker::finished(const kernel::PendingMap& map) {
  const std::scoped_lock lock(mutex_);
  if (done_) handed_ = std::exchange(done_, std::nullopt);
  const bool same = handed_ && handed_->id == map.id && handed_->start_tick == map.start_tick;
  return same ? &*handed_ : nullptr;
}

std::vector<std::string> PatchMaker::take_problems() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(problems_, {});
}

void PatchMaker::make(const Wanted& wanted) {
  const hrm::PatchNeed need = process_.begin(wanted.order);
  process_.give({stores_.window->prepare(need.window), stores_.path->prepare(need.path),
                 stores_.scenes ? stores_.scenes->prepare(need.window) : nullptr, wanted.traffic});
  std::vector<std::string> problems = stores_.window->take_problems();
  for (std::string& problem : stores_.path->take_problems()) problems.push_back(std::move(problem));
  if (stores_.scenes)
    for (std::string& problem : stores_.scenes->take_problems()) problems.push_back(std::move(problem));
  while (process_.state() != hrm::PatchState::done && !given_up()) process_.advance();
  const std::scoped_lock lock(mutex_);
  for (std::string& problem : problems) problems_.push_back(std::move(problem));
  if (process_.state() != hrm::PatchState::done) return;
  const hrm::PatchGeometry& geometry = process_.geometry();
  Picture picture;
  picture.id = wanted.id;
  picture.start_tick = wanted.start_tick;
  picture.size = static_cast<std::uint32_t>(process_.image().size);
  picture.elevation_msl_m = geometry.plane_msl_m();
  picture.up_deg = geometry.up().degrees();
  picture.distance_m = geometry.distance_m();
  picture.squint_deg = geometry.squint(wanted.order.ground_track).degrees();
  picture.blind = process_.image().blind;
  picture.ready = process_.posts_pending() == 0;
  picture.pixels = process_.picture();
  done_ = std::move(picture);
}

void PatchMaker::serve() {
  while (true) {
    Wanted wanted;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return ending_ || wanted_.has_value(); });
      if (ending_) return;
      wanted = *wanted_;
      wanted_.reset();
      superseded_ = false;
    }
    make(wanted);
  }
}

}  // namespace yars::model
