#include "radar/recording/replay.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/radar/configuration.hpp"
#include "model/rbm/beam.hpp"
#include "world/world_values.hpp"

namespace yars::recording {

namespace {
constexpr std::uint64_t kFnvPrime = 0x100000001b3ULL;
}  // namespace

void Comparison::replayed(const databuffer::Sweep& sweep) {
  match(replayed_, recorded_, {sweep.epoch, sweep.number}, sweep.hash);
}

void Comparison::recorded(const SweepDigest& digest) {
  for (int byte = 0; byte < 8; ++byte) run_hash_ = (run_hash_ ^ (digest.hash >> (8 * byte) & 0xffU)) * kFnvPrime;
  // A sweep over terrain that was still loading is not compared, because its hash depends on how much was loaded.
  if ((digest.flags & databuffer::kSweepNotReady) != 0U)
    ++not_ready_;
  else
    match(recorded_, replayed_, {digest.epoch, digest.number}, digest.hash);
}

// Compares the hash with the counterpart in `other`. Without a counterpart, keeps the hash in `own` until one arrives.
void Comparison::match(Hashes& own, Hashes& other, Key sweep, std::uint64_t hash) {
  const auto [first, end] = other.equal_range(sweep);
  if (first == end) {
    own.emplace(sweep, hash);
    return;
  }
  const auto partner = std::find_if(first, end, [hash](const auto& candidate) { return candidate.second == hash; });
  ++(partner != end ? equal_ : different_);
  other.erase(partner != end ? partner : first);
}

namespace {
constexpr int kSmearMemory = 2;  // [sweeps] at the start whose azimuth smear uses power from before it

bool has_sub_beams(const radar::RadarConfiguration& configuration) {
  return configuration.fidelity.automatic || configuration.fidelity.sub_beams > 1;
}

geo::Bearing middle_of(const databuffer::Sweep& sweep) {
  const geo::Bearing left = geo::Bearing::degrees(sweep.azimuth_left_deg);
  return left + 0.5 * (geo::Bearing::degrees(sweep.azimuth_right_deg) - left);
}
}  // namespace

Replay::Replay(const radar::RadarConfiguration& configuration, model::terrain::TerrainStore& store,
               model::scene::SceneStore* scenes)
    : configuration_(&configuration),
      store_(&store),
      kernel_(configuration),
      view_(store.prepare({})),
      scenes_(scenes),
      world_(configuration.world) {}

void Replay::begin_kernel(const databuffer::ModelStatus& status) {
  if (!std::exchange(kernel_is_new_, false)) kernel_ = model::kernel::RadarKernel(*configuration_);
  kernel_.use_world(world_);
  kernel_.resume(status);
}

void Replay::world(const databuffer::WorldState& world) {
  world_ = configuration_->world;
  if ((world.flags & databuffer::kWorldConfigured) == 0U) world::apply(world, world_);
  kernel_.use_world(world_);
}

void Replay::start(const StartingPoint& point) {
  begin_kernel(point.status);
  last_ = before_last_ = point.status;
  smeared_sweeps_ = kSmearMemory;
  old_rays_ = has_sub_beams(*configuration_);
  begin_.reset();
}

// True if a sweep has nothing from before the start. Rays from before it are left until a pass begins, or until the
// beam has moved by its width and has only rays that it has reached since.
bool Replay::is_whole(const databuffer::Sweep& sweep) {
  if (!begin_) begin_ = middle_of(sweep);
  const double moved_deg = std::abs((middle_of(sweep) - *begin_).degrees());
  const bool passed = moved_deg > model::rbm::kSubBeamsWidth * configuration_->antenna.azimuth_beamwidth_deg;
  if (passed || (sweep.flags & databuffer::kSweepScanStart) != 0U) old_rays_ = false;
  if (old_rays_) return false;
  if (smeared_sweeps_ == 0) return true;
  --smeared_sweeps_;
  return false;
}

const databuffer::Sweep* Replay::tick(const databuffer::ModelTick& tick) {
  if ((tick.flags & databuffer::kTickRestart) != 0U && ticks_ > 0) restart(tick.resumed_tick);
  before_last_ = last_;
  ++ticks_;
  kernel_is_new_ = false;
  if (const auto need = kernel_.need(tick); need.ground) {
    view_ = store_->prepare(need.region);
    if (scenes_ != nullptr) scene_view_ = scenes_->prepare(need.region);
  }
  const bool finished = kernel_.step(tick, {*view_, scene_view_.get(), true, traffic_}, sweep_);
  kernel_.describe(*view_, last_);
  if (!finished) return nullptr;
  ++sweeps_;
  if (!is_whole(sweep_)) return nullptr;
  comparison_.replayed(sweep_);
  return &sweep_;
}

// Repeats a restart of the model: a new kernel resumes from the last status of the old process. Normally this is the
// status of the last tick. If the process was killed between that tick and its status, it is the status of the tick
// before.
void Replay::restart(std::int64_t resumed_tick) {
  const databuffer::ModelStatus& resumed = before_last_.tick == resumed_tick ? before_last_ : last_;
  begin_kernel(resumed);
}

namespace {

using databuffer::ModelStatus;
using databuffer::ModelTick;
using databuffer::WorldState;

constexpr double kMaxJump_ticks = 2'000.0;  // 10 s; a larger jump between consecutive ticks is a cut

template <class T>
bool has(const IndexEntry& block) {
  return (block.kinds >> kKindOf<T>.number & 1U) != 0;
}

template <class T>
bool any_has(const RecordingReader& reader) {
  return std::ranges::any_of(reader.blocks(), has<T>);
}

// Tick of a ModelTick or StartingPoint. nullopt for other items, which are played together with the item before them.
// Their own tick is not used, because it may belong to the epoch that has just ended.
std::optional<std::int64_t> time_of(const RecordingItem& item) {
  if (const auto* tick = std::get_if<ModelTick>(&item)) return tick->tick;
  if (const auto* start = std::get_if<StartingPoint>(&item)) return start->status.tick;
  return std::nullopt;
}

void add(std::deque<databuffer::Sweep>& sweeps, const databuffer::Sweep& sweep) {
  if ((sweep.flags & databuffer::kSweepBlank) == 0) sweeps.push_back(sweep);
}

}  // namespace

bool Player::has_video(const RecordingReader& reader) {
  return any_has<databuffer::Sweep>(reader);
}
bool Player::has_ticks(const RecordingReader& reader) {
  return any_has<ModelTick>(reader);
}

Player::Player(RecordingReader& reader, std::optional<PlayerWorld> world)
    : reader_(&reader), world_(std::move(world)) {}

std::uint64_t Player::different() const {
  return kernel_ ? kernel_->comparison().different() : 0;
}

bool Player::look_ahead() {
  if (!ahead_) ahead_ = reader_->next();
  if (reader_->take_damage_flag()) pass_over_damage();
  return ahead_.has_value();
}

// True if there is a cut before the next item.
bool Player::is_cut() const {
  if (!started_) return false;
  if (std::holds_alternative<StartingPoint>(*ahead_)) return true;
  const auto* tick = std::get_if<ModelTick>(&*ahead_);
  if (tick == nullptr) return false;
  // In double precision, because the difference of two damaged ticks may overflow an int64.
  const double jump = std::abs(static_cast<double>(tick->tick) - static_cast<double>(tick_));
  return tick->epoch != epoch_ || jump > kMaxJump_ticks;
}

bool Player::is_due(std::int64_t tick) const {
  return time_of(*ahead_).value_or(tick) <= tick;
}

Played Player::play_to(std::int64_t tick) {
  Played played;
  while (look_ahead()) {
    if (is_cut() && !cut_reported_) {
      cut_reported_ = true;
      played.cut_to_tick = time_of(*ahead_);
      break;
    }
    if (!is_due(tick)) break;
    take(played);
  }
  played.ended = !ahead_;
  return played;
}

Played Player::seek(std::int64_t tick) {
  return seek(tick, kPictureSweeps);
}

Played Player::seek(std::int64_t tick, std::uint32_t least_sweeps) {
  const std::size_t block = reader_->block_of(tick);
  const std::size_t begin = picture_begin(block, tick, least_sweeps);
  reader_->seek_block(begin);
  ahead_.reset();
  started_ = cut_reported_ = false;
  kernel_.reset();
  newest_tick_.reset();
  status_.reset();
  Played played;
  if (const auto change = reader_->last_before<StateChange>()) played.state = change->state;
  played.outputs = reader_->last_before<databuffer::Outputs>();
  if (const auto report = reader_->last_before<StatusReport>()) {
    take_status(report->status, played);
  }
  if (const auto traffic = reader_->last_before<databuffer::Traffic>()) use(*traffic);
  if ((played.world = reader_->last_before<databuffer::WorldState>())) use(*played.world);
  // The kernel cannot resume from the last status before the block, because the ticks between that status and the
  // block are not played. It waits for the first status in the block.
  awaits_status_ = world_.has_value() && begin > 0;
  pending_.clear();
  while (look_ahead() && is_due(tick)) {
    if (is_cut()) played.sweeps.clear();
    take(played);
    if (played.sweeps.size() > kMaxSeekSweeps) played.sweeps.pop_front();
  }
  played.maps.clear();
  find_maps(block, played);
  played.ended = !ahead_;
  return played;
}

Played Player::picture(const BranchPoint& point) {
  Played played = seek(point.tick, 0);
  Played picture;
  picture.sweeps = std::move(played.sweeps);
  std::erase_if(picture.sweeps, [&](const databuffer::Sweep& sweep) {
    return sweep.epoch != point.epoch || sweep.tick > point.tick || sweep.scan + 1 < point.status.scan;
  });
  picture.state = point.state;
  find_maps(reader_->block_of(point.tick), picture);
  picture.state.reset();
  return picture;
}

void Player::take(Played& played) {
  const RecordingItem item = std::move(*ahead_);
  ahead_.reset();
  cut_reported_ = false;
  if (const auto* tick = std::get_if<ModelTick>(&item)) {
    take_tick(*tick, played);
  } else if (const auto* report = std::get_if<StatusReport>(&item)) {
    take_status(report->status, played);
    if (awaits_status_) start_late(report->status, played);
  } else if (const auto* start = std::get_if<StartingPoint>(&item)) {
    started_ = true;
    tick_ = start->status.tick;
    epoch_ = start->status.epoch;
    take_status(start->status, played);
    awaits_status_ = false;
    start_kernel(start->status);
  } else if (const auto* change = std::get_if<StateChange>(&item)) {
    played.state = change->state;
  } else if (const auto* outputs = std::get_if<databuffer::Outputs>(&item)) {
    played.outputs = *outputs;
  } else if (const auto* sweep = std::get_if<databuffer::Sweep>(&item)) {
    add(played.sweeps, *sweep);
  } else if (const auto* digest = std::get_if<SweepDigest>(&item)) {
    if (kernel_) kernel_->recorded(*digest);
  } else if (std::holds_alternative<databuffer::Traffic>(item) || std::holds_alternative<WorldState>(item)) {
    if (const auto* world = std::get_if<WorldState>(&item)) played.world = *world;
    if (awaits_status_)
      pending_.push_back(item);
    else
      use_targets(item);
  } else if (const auto* patch = std::get_if<Patch>(&item)) {
    played.maps.push_back(*patch);
  }
}

void Player::take_tick(const ModelTick& tick, Played& played) {
  started_ = true;
  tick_ = tick.tick;
  epoch_ = tick.epoch;
  newest_tick_ = tick;
  // The status is recorded at most ten times a second. In between, the ownship of each tick updates the aircraft's
  // position.
  if (status_) {
    status_->ownship = tick.ownship;
    played.status = status_;
  }
  if (awaits_status_)
    pending_.emplace_back(tick);
  else
    run_kernel(tick, played);
}

void Player::run_kernel(const ModelTick& tick, Played& played) {
  if (!world_) return;
  const bool restart = (tick.flags & databuffer::kTickRestart) != 0;
  if (tick.tick <= kernel_from_tick_ && tick.epoch == kernel_from_epoch_ && !restart) return;
  kernel_from_tick_ = -1;
  world_->configuration->fidelity.samples = static_cast<int>(tick.samples);
  if (const databuffer::Sweep* sweep = kernel().tick(tick)) add(played.sweeps, *sweep);
}

void Player::take_status(const ModelStatus& status, Played& played) {
  status_ = status;
  const bool older = newest_tick_ && newest_tick_->epoch == status.epoch && newest_tick_->tick > status.tick;
  if (older) status_->ownship = newest_tick_->ownship;
  played.status = status_;
}

void Player::start_kernel(const ModelStatus& status) {
  if (!world_) return;
  kernel().start({status});
  kernel_from_tick_ = status.tick;
  kernel_from_epoch_ = status.epoch;
}

Replay& Player::kernel() {
  if (!kernel_) kernel_.emplace(*world_->configuration, *world_->store, world_->scenes);
  return *kernel_;
}

void Player::use(const databuffer::Traffic& traffic) {
  if (world_) kernel().traffic(traffic);
}

void Player::use(const databuffer::WorldState& world) {
  if (world_) kernel().world(world);
}

// Traffic or a world; other items have no effect.
void Player::use_targets(const RecordingItem& item) {
  if (const auto* traffic = std::get_if<databuffer::Traffic>(&item)) use(*traffic);
  if (const auto* world = std::get_if<WorldState>(&item)) use(*world);
}

// Ticks are missing, so the kernel resumes from the next status.
void Player::pass_over_damage() {
  awaits_status_ = world_.has_value();
  pending_.clear();
}

// Resumes the kernel and runs the pending ticks that are newer than the status. Such ticks exist, because the recorder
// may write a tick before the status of an earlier tick.
void Player::start_late(const ModelStatus& status, Played& played) {
  awaits_status_ = false;
  start_kernel(status);
  for (const RecordingItem& item : std::exchange(pending_, {})) {
    use_targets(item);
    const auto* tick = std::get_if<ModelTick>(&item);
    if (tick != nullptr && tick->epoch == status.epoch && tick->tick > status.tick) run_kernel(*tick, played);
  }
}

// Newest status of the block up to the tick, else the last status before the block.
std::optional<ModelStatus> Player::status_at(std::size_t block, std::int64_t tick) {
  std::optional<ModelStatus> status;
  if (auto items = reader_->items_of(block)) {
    while (const auto item = items->next()) {
      if (time_of(*item).value_or(tick) > tick) break;
      if (const auto* report = std::get_if<StatusReport>(&*item)) status = report->status;
    }
  }
  if (status) return status;
  reader_->seek_block(block);
  if (const auto report = reader_->last_before<StatusReport>()) return report->status;
  return std::nullopt;
}

// Number of the block from which to play, so that the picture is complete at the tick. `block`: the tick's block.
std::size_t Player::picture_begin(std::size_t block, std::int64_t tick, std::uint32_t least_sweeps) {
  const auto at = status_at(block, tick);
  const auto& blocks = reader_->blocks();
  const auto begins_enough_before = [&](std::size_t candidate) {
    reader_->seek_block(candidate);
    const auto before = reader_->last_before<StatusReport>();
    if (!at || !before || before->status.epoch != at->epoch) return true;
    return before->status.scan + 2 <= at->scan && before->status.sweep + least_sweeps <= at->sweep;
  };
  std::size_t early_enough = block;
  while (early_enough > 0 && !has<StartingPoint>(blocks[early_enough])) --early_enough;
  // Binary search, because a picture that stood frozen for hours may begin many blocks earlier. The compared numbers of
  // scans and sweeps increase within an epoch.
  for (std::size_t too_late = block + 1; too_late - early_enough > 1;) {
    const std::size_t middle = early_enough + (too_late - early_enough) / 2;
    (begins_enough_before(middle) ? early_enough : too_late) = middle;
  }
  return early_enough;
}

// Reads the maps that the state names, which may be much older than the block. The index shows which blocks have maps.
void Player::find_maps(std::size_t block, Played& played) {
  if (!played.state) return;
  const databuffer::RadarState& state = *played.state;
  std::vector<std::uint64_t> wanted{state.map_newest, state.map_old, state.map_stored, state.map_shown};
  std::ranges::sort(wanted);
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  std::erase(wanted, 0U);
  const auto& blocks = reader_->blocks();
  for (std::size_t i = std::min(block + 1, blocks.size()); i-- > 0 && !wanted.empty();) {
    if (!has<Patch>(blocks[i])) continue;
    auto items = reader_->items_of(i);
    while (items) {
      const auto item = items->next();
      if (!item) break;
      const auto* patch = std::get_if<Patch>(&*item);
      if (patch == nullptr || std::erase(wanted, patch->map.id) == 0) continue;
      played.maps.push_back(*patch);
    }
  }
}

}  // namespace yars::recording
