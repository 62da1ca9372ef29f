#include "tools/session/play_recording.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/session.hpp"
#include "databuffer/session/session_changes.hpp"
#include "lib/log/log.hpp"
#include "lib/radar/modes.hpp"
#include "radar/recording/replay.hpp"
#include "runtime/process.hpp"
#include "tools/command/command.hpp"

namespace yars::tools {

namespace {

using databuffer::ClockState;
using databuffer::Session;

// Sweeps are published in bursts, and a pause follows each burst. So a display that reads the ring of 1,024 sweeps 60
// times per second loses no sweep.
constexpr std::size_t kSweepsPerBurst = 400;
constexpr long kReaderPause_ns = 30'000'000;  // 30 ms, almost two polls of a display

void pause_for_readers() {
  const timespec pause{0, kReaderPause_ns};
  nanosleep(&pause, nullptr);
}

}  // namespace

ReplaySession::ReplaySession(Session machine, Session model) : machine_(std::move(machine)), model_(std::move(model)) {}

error::Expected<ReplaySession> ReplaySession::create(const std::string& name) {
  auto machine = Session::open(name, databuffer::name_of(databuffer::Role::state_machine));
  if (!machine) return tl::unexpected(machine.error());
  auto model = Session::open(name, databuffer::name_of(databuffer::Role::radar_model));
  if (!model) return tl::unexpected(model.error());
  if (std::as_const(*machine).layout().lockstep.enabled.load() != 0)
    return error::fail("session " + name, "a live session", "a lockstep session", "name a live session with --session");
  ReplaySession session(std::move(*machine), std::move(*model));
  auto machine_role = session.machine_.claim(databuffer::Role::state_machine);
  if (!machine_role) return tl::unexpected(error::usage_error(machine_role.error()));
  auto model_role = session.model_.claim(databuffer::Role::radar_model);
  if (!model_role) return tl::unexpected(error::usage_error(model_role.error()));
  auto lane = session.model_.claim_ownship_lane(0);
  if (!lane) return tl::unexpected(lane.error());
  session.machine_role_ = std::move(*machine_role);
  session.model_role_ = std::move(*model_role);
  session.lane_ = std::move(*lane);
  return session;
}

error::Expected<void> ReplaySession::set_clock(std::int64_t tick, const double* rate) {
  constexpr std::int64_t kLatestTick = databuffer::kLatestClockBase_ns / radar::kTickNanoseconds;
  if (tick < 0 || tick > kLatestTick)
    return error::fail("the recording", "ticks of 0 to " + std::to_string(kLatestTick), std::to_string(tick),
                       "the recording is damaged at this tick; begin at another time with --seek");
  return machine_.change_clock([&](const ClockState& clock) {
    ClockState next = clock;
    next.base_monotonic_ns = databuffer::monotonic_ns();
    next.base_sim_ns = tick * radar::kTickNanoseconds;
    if (rate != nullptr) {
      next.rate = *rate;
      next.running = 1;
    }
    next.epoch = epoch_ = clock.epoch + 1;
    next.reposition_latitude_deg = std::numeric_limits<double>::quiet_NaN();
    return next;
  });
}

error::Expected<void> ReplaySession::jump_to(std::int64_t tick) {
  return set_clock(tick, nullptr);
}

error::Expected<void> ReplaySession::start(std::int64_t tick, double rate) {
  return set_clock(tick, &rate);
}

error::Expected<void> ReplaySession::hold(std::int64_t tick, std::uint32_t epoch, const databuffer::Ownship& ownship) {
  epoch_ = epoch;
  return machine_.change_clock([&](const ClockState& clock) {
    ClockState next = clock;
    next.base_monotonic_ns = databuffer::monotonic_ns();
    next.base_sim_ns = tick * radar::kTickNanoseconds;
    next.rate = 1.0;
    next.running = 0;
    next.epoch = epoch;
    databuffer::begin_at_aircraft(next, ownship, databuffer::ground_track_of(ownship));
    return next;
  });
}

error::Expected<void> ReplaySession::release_clock() {
  return machine_.change_clock([](const ClockState& clock) {
    ClockState next = clock;
    next.base_monotonic_ns = databuffer::monotonic_ns();
    next.running = 1;
    return next;
  });
}

void ReplaySession::release_roles() {
  lane_ = {};
  model_role_ = {};
  machine_role_ = {};
}

std::int64_t ReplaySession::tick() const {
  return machine_.sim_time_ns() / radar::kTickNanoseconds;
}

bool ReplaySession::was_reset() {
  const std::uint32_t epoch = machine_.clock().epoch;
  return std::exchange(epoch_, epoch) != epoch;
}

void ReplaySession::publish_key_frame(const recording::Played& played) {
  if (!played.state) machine_.layout().radar_state.clear();
  if (!played.outputs) machine_.layout().outputs.clear();
  if (!played.status) model_.layout().model_status.clear();
  publish(played);
}

// Publishes maps before the state that names them, and sweeps before the status that counts them.
void ReplaySession::publish(const recording::Played& played) {
  if (played.state)
    maps_named_ = {played.state->map_newest, played.state->map_old, played.state->map_stored, played.state->map_shown};
  if (played.world) model_.layout().world_latched.publish(*played.world);
  publish_maps(played);
  publish_sweeps(played);
  if (played.status) publish_status(*played.status);
  if (played.outputs) {
    databuffer::Outputs outputs = *played.outputs;
    outputs.epoch = epoch_;
    machine_.layout().outputs.publish(outputs);
  }
  if (played.traffic) model_.layout().traffic.publish(*played.traffic);
  if (played.state) {
    databuffer::RadarState state = *played.state;
    state.epoch = epoch_;
    machine_.layout().radar_state.publish(state);
  }
}

void ReplaySession::want_world(databuffer::WorldState world) {
  world.tick = 0;
  machine_.layout().world.publish(world);
}

void ReplaySession::publish_maps(const recording::Played& played) {
  databuffer::PatchMap existing{};
  for (const recording::Patch& patch : played.maps) {
    if (databuffer::read_patch(std::as_const(model_).layout(), patch.map.id, existing)) continue;
    if (!databuffer::publish_patch(model_.layout(), patch.map, patch.pixels, maps_named_))
      model_.note(databuffer::NoteKind::loss, "no free slot for patch map " + std::to_string(patch.map.id));
  }
}

void ReplaySession::publish_sweeps(const recording::Played& played) {
  std::size_t published = 0;
  auto& ring = model_.layout().sweeps;
  for (databuffer::Sweep sweep : played.sweeps) {
    sweep.epoch = epoch_;
    ring.publish(sweep);
    // A ring that is not full yet loses nothing.
    if (++published % kSweepsPerBurst == 0 && ring.oldest() > 0) pause_for_readers();
  }
}

void ReplaySession::publish_status(databuffer::ModelStatus status) {
  status.epoch = status.ownship.epoch = status.nav.epoch = epoch_;
  const auto lane = static_cast<std::size_t>(lane_.lane());
  model_.layout().ownship[lane].publish(status.ownship);
  model_.layout().nav[lane].publish(status.nav);
  model_.layout().model_status.publish(status);
}

void ReplaySession::heartbeat() {
  machine_.heartbeat();
  machine_.restore_clock();
  model_.heartbeat();
}

// Discards all input events. Full lanes would make senders report a dead state-machine.
void ReplaySession::drop_events() {
  databuffer::InputEvent event{};
  for (std::size_t lane = 0; lane < databuffer::kInputLanes; ++lane)
    while (machine_.layout().input.pop(lane, event)) {
    }
}

namespace {

constexpr long kPlayInterval_ns = 5'000'000;  // 5 ms, one tick at rate 1

double seconds_of(std::int64_t tick) {
  return static_cast<double>(tick) * radar::kTickSeconds;
}

std::string text_of_seconds(std::int64_t tick) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", seconds_of(tick));
  return text;
}

// Tick at which the replay begins: the time of --seek, else the tick that was recorded first. Error: the time of --seek
// is outside the recording.
error::Expected<std::int64_t> first_tick(const recording::RecordingReader& reader, const PlayOptions& options) {
  if (!options.seek_s) return reader.blocks().front().first_tick;
  return recording::tick_at(reader, *options.seek_s, options.file, "--seek");
}

error::Expected<void> seek(ReplaySession& session, recording::Player& player, std::int64_t tick) {
  const recording::Played played = player.seek(tick);
  if (auto jumped = session.jump_to(tick); !jumped) return jumped;
  session.publish_key_frame(played);
  return {};
}

// One poll: plays up to the session's tick, or seeks after a reset. At a cut (see recording::Player) sets the clock to
// the tick at which the recording continues. Returns false when the recording has ended.
error::Expected<bool> poll(ReplaySession& session, recording::Player& player, std::int64_t begin) {
  session.heartbeat();
  session.drop_events();
  if (session.was_reset()) {
    if (auto sought = seek(session, player, std::max(session.tick(), begin)); !sought)
      return tl::unexpected(sought.error());
    return true;
  }
  const std::int64_t now = session.tick();
  const recording::Played played = player.play_to(now);
  session.publish(played);
  if (played.cut_to_tick) {
    log::info("after " + text_of_seconds(player.tick()) + " s the recording continues at " +
              text_of_seconds(*played.cut_to_tick) + " s");
    if (auto jumped = session.jump_to(*played.cut_to_tick); !jumped) return tl::unexpected(jumped.error());
    return true;
  }
  // After the last item the replay continues until the clock has passed the item's tick. So the last picture stays
  // while the clock is frozen.
  return !played.ended || now <= player.tick();
}

}  // namespace

error::Expected<void> play_recording(recording::RecordingReader& reader, std::optional<recording::PlayerWorld> world,
                                     const PlayOptions& options) {
  if (std::isnan(options.rate)) return tl::unexpected(error::usage_error("--rate", "0 to 10", "not a number"));
  const auto begin = first_tick(reader, options);
  if (!begin) return tl::unexpected(begin.error());
  auto session = ReplaySession::create(options.session);
  if (!session) return tl::unexpected(session.error());
  recording::Player player(reader, std::move(world));
  const recording::Played key_frame = player.seek(*begin);
  if (auto started = session->start(*begin, options.rate); !started) return started;
  session->publish_key_frame(key_frame);
  log::info("plays " + options.file + " in session " + options.session + " from " + text_of_seconds(*begin) + " s");
  while (!runtime::stop_requested()) {
    const auto more = poll(*session, player, reader.blocks().front().first_tick);
    if (!more) return tl::unexpected(more.error());
    if (!*more) break;
    const timespec pause{0, kPlayInterval_ns};
    nanosleep(&pause, nullptr);
  }
  if (options.json)
    print_json({{"file", options.file},
                {"session", options.session},
                {"from_s", seconds_of(*begin)},
                {"to_s", seconds_of(player.tick())},
                {"different_sweeps", player.different()}});
  else
    std::printf("%s: played from %s to %s s of sim time\n", options.file.c_str(), text_of_seconds(*begin).c_str(),
                text_of_seconds(player.tick()).c_str());
  if (player.different() > 0)
    log::warning(std::to_string(player.different()) +
                 " sweeps differ from the recorded sweeps; replay with the same terrain and configuration");
  return {};
}

}  // namespace yars::tools
