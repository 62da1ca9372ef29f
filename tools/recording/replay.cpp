#include "tools/recording/replay.hpp"

namespace yars::tools::recording {

namespace {
constexpr std::uint64_t kSmearMemory = 2;  // sweeps: the smear of the first ones needs those from before the log began
}  // namespace

Replay::Replay(const radar::RadarConfiguration& configuration, model::terrain::TerrainStore& store,
               model::scene::SceneStore* scenes)
    : configuration_(&configuration),
      store_(&store),
      kernel_(configuration),
      view_(store.prepare({})),
      scenes_(scenes) {}

void Replay::start(const StartingPoint& point) {
  kernel_ = model::kernel::RadarKernel(*configuration_);
  kernel_.resume(point.status);
  last_ = before_last_ = point.status;
  smeared_ = kSmearMemory;
}

const databuffer::Sweep* Replay::tick(const databuffer::ModelTick& tick) {
  if ((tick.flags & databuffer::kTickRestart) != 0U && ticks_ > 0) restart(tick.resumed_tick);
  before_last_ = last_;
  ++ticks_;
  if (const auto need = kernel_.need(tick); need.ground) {
    view_ = store_->prepare(need.region);
    if (scenes_ != nullptr) scene_view_ = scenes_->prepare(need.region);
  }
  const bool finished = kernel_.step(tick, {*view_, scene_view_.get(), true, traffic_}, sweep_);
  kernel_.describe(*view_, last_);
  if (!finished) return nullptr;
  ++sweeps_;
  if (smeared_ > 0) {
    --smeared_;
    return nullptr;
  }
  comparison_.made(sweep_);
  return &sweep_;
}

// What the restarted process did: a new kernel that takes up the status of the old one. That is the last tick's, or the
// one's before if the old process was killed between publishing its last tick and its status.
void Replay::restart(std::int64_t resumed_tick) {
  const databuffer::ModelStatus& left = before_last_.tick == resumed_tick ? before_last_ : last_;
  kernel_ = model::kernel::RadarKernel(*configuration_);
  kernel_.resume(left);
}

}  // namespace yars::tools::recording
