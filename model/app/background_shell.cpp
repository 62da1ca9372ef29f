#include "model/app/background_shell.hpp"

#include <utility>

#include "lib/geo/geodesy.hpp"

namespace yars::model {

namespace {

// True if `wide` contains `region` and a margin around it.
bool covers(const terrain::TerrainRegion& wide, const terrain::TerrainRegion& region, double margin_m) {
  if (region.radius_m + margin_m > wide.radius_m) return false;
  const double moved_m = geo::geodesic_inverse(wide.centre, region.centre).distance.metres();
  return moved_m + region.radius_m + margin_m <= wide.radius_m;
}

// True if the requested region has the detail of `region` and contains it with half of the margin. The requested radius
// must also exceed that of `region` by two margins at most.
bool still_covers(const terrain::TerrainRegion& requested, const terrain::TerrainRegion& region, double margin_m) {
  return region.detail == requested.detail && region.radius_m + 2.0 * margin_m >= requested.radius_m &&
         covers(requested, region, 0.5 * margin_m);
}

}  // namespace

TerrainLoader::TerrainLoader(std::unique_ptr<terrain::TerrainStore> store, bool synchronous)
    : store_(std::move(store)), synchronous_(synchronous) {
  // An empty region gives an empty view at once, so view() is never null.
  view_ = store_->prepare({});
  collect_problems();
  if (!synchronous_) thread_ = std::thread([this] { serve(); });
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

void TerrainLoader::request(const terrain::TerrainRegion& region, double margin_m) {
  if (requested_ && still_covers(*requested_, region, margin_m)) return;
  requested_ = terrain::TerrainRegion{region.centre, region.radius_m + margin_m, region.detail, region.radius_m};
  if (synchronous_) {
    view_ = store_->prepare(*requested_);
    loaded_region_ = requested_;
    collect_problems();
    return;
  }
  {
    const std::scoped_lock lock(mutex_);
    pending_ = requested_;
  }
  wake_.notify_one();
}

bool TerrainLoader::has_loaded(const terrain::TerrainRegion& region) const {
  const std::scoped_lock lock(mutex_);
  return loaded_region_ && loaded_region_->detail == region.detail && covers(*loaded_region_, region, 0.0);
}

terrain::TerrainViewPointer TerrainLoader::view() const {
  const std::scoped_lock lock(mutex_);
  return view_;
}

std::vector<std::string> TerrainLoader::take_problems() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(problems_, {});
}

std::vector<std::string> TerrainLoader::take_notes() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(notes_, {});
}

void TerrainLoader::collect_problems() {
  for (auto& problem : store_->take_problems()) problems_.push_back(std::move(problem));
  for (auto& note : store_->take_notes()) notes_.push_back(std::move(note));
}

void TerrainLoader::serve() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return ending_ || pending_.has_value(); });
    if (ending_) return;
    const terrain::TerrainRegion region = *pending_;
    pending_.reset();
    lock.unlock();
    // A view before the last has the detail of the region if it has all cells within the scan's range.
    const terrain::TerrainRegion reach{region.centre, region.reach_m, region.detail};
    bool cancelled = false;
    auto view = store_->prepare_in_steps(region, [&](const terrain::TerrainViewPointer& interim) {
      const std::scoped_lock hold(mutex_);
      view_ = interim;
      loaded_region_ = interim->has_detail(region.detail) ? std::optional(reach) : std::nullopt;
      cancelled = ending_ || pending_;
      return !cancelled;
    });
    lock.lock();
    view_ = std::move(view);
    if (!cancelled) loaded_region_ = region;
    collect_problems();
  }
}

SceneLoader::SceneLoader(std::unique_ptr<scene::SceneStore> store, bool synchronous)
    : store_(std::move(store)), synchronous_(synchronous) {
  if (!store_) return;
  add_problems(store_->take_problems());
  if (synchronous_) {
    check_files();
    return;
  }
  thread_ = std::thread([this] { serve(); });
  check_thread_ = std::thread([this] { check_files(); });
}

SceneLoader::~SceneLoader() {
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
  thread_.join();
  check_thread_.join();
}

void SceneLoader::check_files() {
  store_->check_files([this](std::vector<std::string> problems) {
    const std::scoped_lock lock(mutex_);
    add_problems(std::move(problems));
    return !ending_;
  });
}

void SceneLoader::add_problems(std::vector<std::string> problems) {
  for (std::string& problem : problems)
    if (reported_.insert(problem).second) problems_.push_back(std::move(problem));
}

SceneLoader::LoadedScenes SceneLoader::request(const terrain::TerrainRegion& region, double margin_m) {
  if (!store_) return {};
  if (!requested_ || !covers(*requested_, region, 0.5 * margin_m)) {
    requested_ = terrain::TerrainRegion{region.centre, region.radius_m + margin_m, 0};
    if (synchronous_) {
      read(*requested_);
    } else {
      const std::scoped_lock lock(mutex_);
      pending_ = requested_;
    }
    wake_.notify_one();
  }
  const std::scoped_lock lock(mutex_);
  return {view_, loaded_region_ && covers(*loaded_region_, region, 0.0)};
}

void SceneLoader::read(const terrain::TerrainRegion& region) {
  scene::SceneViewPointer view = store_->prepare(region);
  std::vector<std::string> problems = store_->take_problems();
  const std::scoped_lock lock(mutex_);
  view_ = std::move(view);
  loaded_region_ = region;
  add_problems(std::move(problems));
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
      wake_.wait(lock, [this] { return ending_ || pending_.has_value(); });
      if (ending_) return;
      region = *pending_;
      pending_.reset();
    }
    read(region);
  }
}

PatchMaker::PatchMaker(const physics::RadarParameters& parameters, PatchStores stores, bool synchronous)
    : formation_(parameters, {}), stores_(std::move(stores)), synchronous_(synchronous) {
  if (!synchronous_) thread_ = std::thread([this] { serve(); });
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

void PatchMaker::request(const kernel::PendingMap& map, const Targets& targets) {
  const Job job{map.order, map.id, map.start_tick, targets};
  if (synchronous_) return make(job);
  {
    const std::scoped_lock lock(mutex_);
    pending_ = job;
    superseded_ = true;
  }
  wake_.notify_one();
}

const PatchMaker::Picture* PatchMaker::finished(const kernel::PendingMap& map) {
  const std::scoped_lock lock(mutex_);
  if (done_) delivered_ = std::exchange(done_, std::nullopt);
  const bool same = delivered_ && delivered_->id == map.id && delivered_->start_tick == map.start_tick;
  return same ? &*delivered_ : nullptr;
}

std::vector<std::string> PatchMaker::take_problems() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(problems_, {});
}

void PatchMaker::make(const Job& job) {
  const hrm::PatchNeed need = formation_.begin(job.order);
  formation_.set_environment({stores_.window->prepare(need.window), stores_.path->prepare(need.path),
                              stores_.scenes ? stores_.scenes->prepare(need.window) : nullptr, job.targets.traffic,
                              job.targets.movers});
  std::vector<std::string> problems = stores_.window->take_problems();
  for (std::string& problem : stores_.path->take_problems()) problems.push_back(std::move(problem));
  if (stores_.scenes)
    for (std::string& problem : stores_.scenes->take_problems()) problems.push_back(std::move(problem));
  while (formation_.state() != hrm::PatchState::done && !cancelled()) formation_.advance();
  const std::scoped_lock lock(mutex_);
  for (std::string& problem : problems) problems_.push_back(std::move(problem));
  if (formation_.state() != hrm::PatchState::done) return;
  const hrm::PatchGeometry& geometry = formation_.geometry();
  Picture picture;
  picture.id = job.id;
  picture.start_tick = job.start_tick;
  picture.size = static_cast<std::uint32_t>(formation_.image().size);
  picture.elevation_msl_m = geometry.plane_msl_m();
  picture.up_deg = geometry.up().degrees();
  picture.distance_m = geometry.distance_m();
  picture.squint_deg = geometry.squint(job.order.ground_track).degrees();
  picture.blind = formation_.image().blind;
  picture.ready = formation_.posts_pending() == 0;
  picture.pixels = formation_.picture();
  done_ = std::move(picture);
}

void PatchMaker::serve() {
  while (true) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return ending_ || pending_.has_value(); });
      if (ending_) return;
      job = *pending_;
      pending_.reset();
      superseded_ = false;
    }
    make(job);
  }
}

}  // namespace yars::model
