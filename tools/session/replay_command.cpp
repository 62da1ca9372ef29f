// `yars replay`: plays a recording into a session, for a radar-display. --events instead runs the kernel over the
// recorded ticks and compares each sweep with the recorded one. --print prints events, radar states, worlds, and id,
// size and hash of patch maps as JSON.

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "databuffer/json/status_json.hpp"
#include "databuffer/messages/input_event.hpp"
#include "lib/log/log.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/text/plain_text.hpp"
#include "radar/limits.hpp"
#include "radar/recording/branch.hpp"
#include "radar/recording/recording_io.hpp"
#include "radar/recording/replay.hpp"
#include "runtime/process.hpp"
#include "runtime/program.hpp"
#include "tools/command/command.hpp"
#include "tools/session/hand_over.hpp"
#include "tools/session/play_recording.hpp"
#include "world/world_json.hpp"

namespace yars::tools {

namespace {

using databuffer::ModelTick;

struct ReplayOptions {
  std::string file;
  std::string terrain;
  bool events = false;
  bool print = false;
  bool hand_over = false;
  std::string awaited = HandOverOptions().roles;
  bool json = false;          // the result of playing; --events and --print always print JSON
  bool has_own_file = false;  // --config names the configuration, in place of the recording
  double rate = 1.0;
  std::optional<double> seek_s;
};

// Configuration, terrain and scenes with which the kernel runs.
struct World {
  radar::RadarConfiguration configuration;
  std::unique_ptr<model::terrain::TerrainStore> store;
  std::unique_ptr<model::scene::SceneStore> scenes;
};

World open_world(const CommonOptions& common, const recording::RecordingHeader& header, const ReplayOptions& options) {
  ConfigurationOptions recorded;
  recorded.terrain = options.terrain.empty() ? header.terrain : options.terrain;
  World world{read_configuration(options.has_own_file ? common.config : header.configuration, recorded), nullptr,
              nullptr};
  auto stores = radar::guarded([&] {
    radar::TheatreFiles files(world.configuration.terrain, world.configuration.world.scenes);
    return files.open(model::scene::SceneUse::scatterers);
  });
  if (!stores) throw_failure(stores.error());
  world.store = std::move(stores->window);
  world.scenes = std::move(stores->scenes);
  return world;
}

// Warns of the files that the kernel could not read, or not read whole. Returns what it lacks of them.
LeftOut report_problems(const World& world) {
  const Warn warn = warn_as("yars replay");
  LeftOut left_out;
  for (const std::string& problem : world.store->take_problems()) warn(problem);
  for (const std::string& note : world.store->take_notes()) warn(note);
  left_out.add(*world.store);
  if (!world.scenes) return left_out;
  for (const std::string& problem : world.scenes->take_problems()) warn(problem);
  left_out.add(*world.scenes);
  return left_out;
}

std::string text_of_ticks(const recording::IndexEntry& block) {
  return std::to_string(block.first_tick) +
         (block.last_tick > block.first_tick ? " to " + std::to_string(block.last_tick) : "");
}

// Ends the command with an error that lists the missing ticks if the file has damaged blocks. Else warns if the file
// was cut short.
void report_missing(const recording::RecordingReader& reader, const std::string& file) {
  constexpr std::size_t kMaxListed = 20;
  const auto& missing = reader.missing();
  if (missing.empty()) {
    if (reader.cut_short()) log::warning(file + ": cut short; it was read to its last whole block");
    return;
  }
  std::string ticks;
  for (std::size_t i = 0; i < std::min(missing.size(), kMaxListed); ++i)
    ticks += (i == 0 ? "" : ", ") + text_of_ticks(missing[i]);
  if (missing.size() > kMaxListed) ticks += ", and more";
  throw_failure({file, "undamaged blocks", text::counted(missing.size(), "damaged block") + "; missing ticks: " + ticks,
                 "the rest was read"});
}

void print_entries(recording::RecordingReader& reader) {
  while (const auto entry = reader.next()) {
    if (runtime::stop_requested()) return;
    nlohmann::ordered_json object;
    if (const auto* event = std::get_if<databuffer::AppliedEvent>(&*entry)) {
      object["tick"] = event->tick;
      object["event"] = databuffer::text_of(event->event);
      object["effective"] = event->effective != databuffer::kEventDead;
    } else if (const auto* change = std::get_if<recording::StateChange>(&*entry)) {
      object["tick"] = change->state.tick;
      databuffer::add_radar_state(object["state"], change->state);
    } else if (const auto* patch = std::get_if<recording::Patch>(&*entry)) {
      object["tick"] = patch->map.end_tick;
      object["patch"] = {{"id", patch->map.id}, {"size", patch->map.size}, {"hash", patch->map.hash}};
    } else if (const auto* world = std::get_if<databuffer::WorldState>(&*entry)) {
      object["tick"] = world->tick;
      object["world"] = world::world_json(*world, world->tick * radar::kTickNanoseconds);
    } else {
      continue;
    }
    print_json(object);
  }
}

error::Error no_ticks(const std::string& file) {
  return {file, "at least one tick", "none", "record while radar-model runs"};
}

// World of a player that computes the sweeps. Empty for a recording with video. `world` keeps what the result refers
// to.
std::optional<recording::PlayerWorld> player_world(const CommonOptions& common,
                                                   const recording::RecordingReader& reader,
                                                   const ReplayOptions& options, std::optional<World>& world) {
  if (recording::Player::has_video(reader)) return std::nullopt;
  world = open_world(common, reader.header(), options);
  return recording::PlayerWorld{std::make_shared<radar::RadarConfiguration>(world->configuration), world->store.get(),
                                world->scenes.get()};
}

void play(const CommonOptions& common, recording::RecordingReader& reader, const ReplayOptions& options,
          const std::string& session) {
  if (!recording::Player::has_ticks(reader)) throw_failure(no_ticks(options.file));
  std::optional<World> world;
  if (auto played = play_recording(reader, player_world(common, reader, options, world),
                                   {options.file, session, options.rate, options.seek_s, options.json});
      !played)
    throw_failure(played.error());
  const LeftOut left_out = world ? report_problems(*world) : LeftOut();
  report_missing(reader, options.file);
  fail_if_left_out(left_out.sentences());
}

void hand_over_to_live_roles(const CommonOptions& common, recording::RecordingReader& reader,
                             const ReplayOptions& options) {
  const auto tick = recording::tick_at(reader, *options.seek_s, options.file, "--seek");
  if (!tick) throw_failure(tick.error());
  const auto point = recording::find_branch_point(reader, *tick, options.file);
  if (!point) throw_failure(point.error());
  std::optional<World> world;
  const auto open = [&] { return player_world(common, reader, options, world); };
  if (auto done = hand_over(reader, *point, open, {common.session, options.awaited, !options.json}); !done)
    throw_failure(done.error());
  if (world) report_problems(*world);  // the live set has read the files, too, and goes on
  if (options.json)
    print_json({{"file", options.file},
                {"session", common.session},
                {"tick", point->tick},
                {"at_s", static_cast<double>(point->tick) * radar::kTickSeconds}});
}

// Runs the kernel again over the items of a recording. After a damaged block it buffers the items until the next model
// status, from which the kernel can resume. Then it runs the buffered items after the tick of the status, and all
// buffered traffic and worlds. A starting point also ends the buffering; the buffered items are then dropped.
class KernelRerun {
 public:
  explicit KernelRerun(World& world) : world_(world) {}

  void take(const recording::RecordingItem& item) {
    if (const auto* gap = std::get_if<recording::Gap>(&item)) lost_ += gap->ticks;
    if (std::holds_alternative<databuffer::AppliedEvent>(item)) ++events_;
    if (const auto* start = std::get_if<recording::StartingPoint>(&item)) begin(*start);
    const auto* report = std::get_if<recording::StatusReport>(&item);
    if (awaits_status_ && report != nullptr) return resume(report->status);
    if (awaits_status_)
      pending_.push_back(item);
    else
      run(item);
  }
  void pass_over_damage() {
    awaits_status_ = true;
    pending_.clear();
  }

  bool has_run() const { return run_.has_value(); }
  const recording::Replay& replay() const { return *run_; }
  std::uint64_t lost() const { return lost_; }
  nlohmann::ordered_json result(const recording::RecordingReader& reader) const;

 private:
  recording::Replay& kernel() {
    if (!run_) run_.emplace(world_.configuration, *world_.store, world_.scenes.get());
    return *run_;
  }
  void begin(const recording::StartingPoint& start) {
    if (kernel().ticks() > 0 && !awaits_status_) ++pauses_;
    kernel().start(start);
    awaits_status_ = false;
    pending_.clear();
  }
  void resume(const databuffer::ModelStatus& status) {
    const auto buffered = std::exchange(pending_, {});
    begin({status});
    for (const auto& item : buffered) {
      const auto tick = std::visit([](const auto& record) { return recording::tick_of(record); }, item);
      const bool done = tick && *tick <= status.tick;
      const bool stays =
          std::holds_alternative<databuffer::Traffic>(item) || std::holds_alternative<databuffer::WorldState>(item);
      if (!done || stays) run(item);
    }
  }
  void run(const recording::RecordingItem& item) {
    if (const auto* tick = std::get_if<ModelTick>(&item)) {
      world_.configuration.fidelity.samples = static_cast<int>(tick->samples);
      kernel().tick(*tick);
    } else if (const auto* traffic = std::get_if<databuffer::Traffic>(&item)) {
      kernel().traffic(*traffic);
    } else if (const auto* state = std::get_if<databuffer::WorldState>(&item)) {
      kernel().world(*state);
    } else if (const auto* digest = std::get_if<recording::SweepDigest>(&item)) {
      if (run_) run_->recorded(*digest);
    } else if (const auto* sweep = std::get_if<databuffer::Sweep>(&item)) {
      if (run_) run_->recorded(recording::digest_of(*sweep));
    }
  }

  World& world_;
  std::optional<recording::Replay> run_;
  bool awaits_status_ = false;
  std::vector<recording::RecordingItem> pending_;
  std::uint64_t events_ = 0, lost_ = 0, pauses_ = 0;
};

nlohmann::ordered_json KernelRerun::result(const recording::RecordingReader& reader) const {
  nlohmann::ordered_json missing = nlohmann::ordered_json::array();
  for (const auto& block : reader.missing()) missing.push_back({block.first_tick, block.last_tick});
  const auto& comparison = run_->comparison();
  return {{"ticks", run_->ticks()},
          {"events", events_},
          {"sweeps", run_->sweeps()},
          {"equal", comparison.equal()},
          {"different", comparison.different()},
          {"missing", comparison.missing()},
          {"extra", comparison.extra()},
          {"not_ready", comparison.not_ready()},
          {"run_hash", comparison.run_hash()},
          {"ticks_lost", lost_},
          {"pauses", pauses_},
          {"cut_short", reader.cut_short()},
          {"missing_ticks", missing}};
}

std::string cause_of_difference(const KernelRerun& run, const recording::RecordingReader& reader) {
  if (run.lost() > 0) return "the recording lacks " + text::counted(run.lost(), "tick");
  if (reader.cut_short()) return "the file has no valid index, so parts of it may be missing";
  return "replay with the same terrain and configuration";
}

void compare(const CommonOptions& common, recording::RecordingReader& reader, const ReplayOptions& options) {
  if (auto same = recording::check_model(reader.header(), options.file); !same) throw_failure(same.error());
  World world = open_world(common, reader.header(), options);
  KernelRerun run(world);
  while (auto entry = reader.next()) {
    if (runtime::stop_requested())
      throw_failure({options.file, "the whole recording to be read", "a request to stop", ""});
    if (reader.take_damage_flag()) run.pass_over_damage();
    run.take(*entry);
  }
  if (!run.has_run()) {
    report_missing(reader, options.file);
    throw_failure(no_ticks(options.file));
  }
  const LeftOut left_out = report_problems(world);
  nlohmann::ordered_json result = run.result(reader);
  result["left_out"] = left_out.sentences();
  print_json(result);
  std::fflush(stdout);
  const auto& comparison = run.replay().comparison();
  if (comparison.different() > 0)
    throw_failure({options.file, "the sweeps of the recording",
                   text::counted(comparison.different(), "different sweep"), cause_of_difference(run, reader)});
  if (comparison.equal() == 0 && comparison.missing() > 0)
    throw_failure({options.file, "the sweeps of the recording", "none of these sweeps",
                   "replay with the same configuration; a recording shorter than a scan may have no sweep of its own"});
  report_missing(reader, options.file);
  fail_if_left_out(left_out.sentences());
}

}  // namespace

void add_replay_command(runtime::Command app, const CommonOptions& common) {
  runtime::Command command = app.subcommand(
      "replay",
      "play a recording into its own session (--session, else 'replay'), for a radar-display in that session");
  auto options = std::make_shared<ReplayOptions>();
  command.option("FILE", options->file, "recording made by yars record").value_name("FILE").required();
  runtime::Option events =
      command.flag("--events", options->events,
                   "compute the sweeps from the recorded ticks, offline, and compare them with the recorded sweeps");
  runtime::Option print = command.flag("--print", options->print,
                                       "print events, radar states, worlds and patch maps, one JSON object per line");
  events.excludes(print);
  runtime::Option rate = command.option("--rate", options->rate, "rate relative to real time; 0 freezes the picture");
  rate.range(0.0, 10.0).excludes(events).excludes(print);
  runtime::Option seek = command.option("--seek", options->seek_s, "[s] sim time at which to begin");
  seek.range(0.0, databuffer::kLatestSimTime_s)
      .excludes(events)
      .excludes(print)
      .otherwise("the begin of the recording");
  runtime::Option hand_over = command.flag("--hand-over", options->hand_over,
                                           "hand the second of --seek over to a live set, which goes on from there; "
                                           "--fly-out of the start script does it all");
  hand_over.needs(seek).excludes(events).excludes(print);
  command.option("--await", options->awaited, "roles that --hand-over awaits before it runs the clock")
      .value_name("ROLES")
      .needs(hand_over);
  // The user's file does not set this one: a recording is replayed over its own terrain.
  command.option("--terrain", options->terrain, "folder of elevation cells")
      .value_name("DIR")
      .otherwise("the recording's");
  add_json_flag(command, options->json);
  const runtime::Option session = app.find("--session"), config = app.find("--config");
  command.callback([&common, options, session, config] {
    options->has_own_file = config.is_given();
    const bool named = session.is_given();
    auto reader = recording::RecordingReader::open(options->file);
    if (!reader) throw_failure(reader.error());
    if (options->events) return compare(common, *reader, *options);
    if (options->hand_over) return hand_over_to_live_roles(common, *reader, *options);
    // Ignores YARS_SESSION, because the session that it names may be live.
    if (!options->print) return play(common, *reader, *options, named ? common.session : "replay");
    print_entries(*reader);
    report_missing(*reader, options->file);
  });
}

}  // namespace yars::tools
