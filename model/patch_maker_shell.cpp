#include "model/patch_maker_shell.hpp"

#include <utility>

namespace yars::model {

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

void PatchMaker::request(const kernel::MapUnderWay& map, const std::vector<rbm::MovingPoint>& traffic) {
  const Wanted wanted{map.order, map.id, map.start_tick, traffic};
  if (may_wait_) return make(wanted);
  {
    const std::scoped_lock lock(mutex_);
    wanted_ = wanted;
    superseded_ = true;
  }
  wake_.notify_one();
}

const PatchMaker::Picture* PatchMaker::finished(const kernel::MapUnderWay& map) {
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
