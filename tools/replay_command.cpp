// `yars replay`: plays a recording into a session for a glass; --events runs the kernel again over its ticks and
// compares every sweep; --print says what happened.
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "config/load.hpp"
#include "databuffer/log.hpp"
#include "databuffer/program.hpp"
#include "databuffer/records/event_text.hpp"
#include "model/terrain/open_terrain.hpp"
#include "tools/command.hpp"
#include "tools/play_recording.hpp"
#include "tools/recording/recording_reader.hpp"
#include "tools/recording/replay.hpp"
#include "tools/watch_json.hpp"

namespace yars::tools {

namespace {

using databuffer::ModelTick;

struct ReplayOptions {
  std::string file;
  std::string terrain;
  bool events = false;
  bool print = false;
  double rate = 1.0;
  std::optional<double> seek_s;
};

// What the kernel makes sweeps of.
struct World {
  radar::RadarConfiguration configuration;
  std::unique_ptr<model::terrain::TerrainStore> store;
  std::unique_ptr<model::scene::SceneStore> scenes;
};

radar::RadarConfiguration configuration_of(const CommonOptions& common, const recording::RecordingHeader& header,
                                           const ReplayOptions& options) {
  auto loaded = config::load_configuration(common.config.empty() ? header.configuration : common.config);
  if (!loaded) give_up(loaded.error());
  if (!header.terrain.empty()) loaded->radar.terrain.directory = header.terrain;
  if (!options.terrain.empty()) loaded->radar.terrain.directory = options.terrain;
  return std::move(loaded->radar);
}

World open_world(const CommonOptions& common, const recording::RecordingHeader& header, const ReplayOptions& options) {
  World world{configuration_of(common, header, options), nullptr, nullptr};
  auto store = model::terrain::open_terrain(world.configuration.terrain);
  if (!store) give_up(store.error());
  auto scenes = model::scene::open_scenes(world.configuration, model::scene::SceneUse::scatterers);
  if (!scenes) give_up(scenes.error());
  world.store = std::move(*store);
  world.scenes = std::move(*scenes);
  return world;
}

// Where it ends early; what was read stands.
void warn_if_cut_short(const recording::RecordingReader& reader, const std::string& file) {
  if (reader.damage())
    databuffer::log_warning(reader.damage()->message());
  else if (reader.cut_short())
    databuffer::log_warning(file + ": cut short; it was read to its last whole block");
}

void print_entries(recording::RecordingReader& reader) {
  while (const auto entry = reader.next()) {
    if (databuffer::stop_requested()) return;
    nlohmann::ordered_json object;
    if (const auto* event = std::get_if<databuffer::AppliedEvent>(&*entry)) {
      object["tick"] = event->tick;
      object["event"] = databuffer::text_of(event->event);
      object["effective"] = event->effective != 0;
    } else if (const auto* change = std::get_if<recording::StateChange>(&*entry)) {
      object["tick"] = change->state.tick;
      add_radar_state(object["state"], change->state);
    } else if (const auto* patch = std::get_if<recording::Patch>(&*entry)) {
      object["tick"] = patch->map.end_tick;
      object["patch"] = {{"id", patch->map.id}, {"size", patch->map.size}, {"hash", patch->map.hash}};
    } else {
      continue;
    }
    std::printf("%s\n", object.dump().c_str());
  }
}

failure::Error no_ticks(const std::string& file) {
  return {file, "at least one tick", "none", "record while radar-model runs", false};
}

void play(const CommonOptions& common, recording::RecordingReader& reader, const ReplayOptions& options,
          const std::string& session) {
  if (!recording::Player::has_ticks(reader)) give_up(no_ticks(options.file));
  std::optional<World> world;
  std::optional<recording::PlayerWorld> seen;
  if (!recording::Player::has_video(reader)) {
    world = open_world(common, reader.header(), options);
    seen = recording::PlayerWorld{world->configuration, world->store.get(), world->scenes.get()};
  }
  if (auto played = play_recording(reader, std::move(seen), {options.file, session, options.rate, options.seek_s});
      !played)
    give_up(played.error());
  warn_if_cut_short(reader, options.file);
}

void compare(const CommonOptions& common, recording::RecordingReader& reader, const ReplayOptions& options) {
  World world = open_world(common, reader.header(), options);
  std::optional<recording::Replay> run;
  std::uint64_t events = 0, lost = 0, pauses = 0;
  while (auto entry = reader.next()) {
    if (databuffer::stop_requested())
      give_up({options.file, "time to read it to its end", "a request to stop", "", false});
    if (const auto* tick = std::get_if<ModelTick>(&*entry)) {
      world.configuration.fidelity.samples = static_cast<int>(tick->samples);
      if (!run) run.emplace(world.configuration, *world.store, world.scenes.get());
      run->tick(*tick);
    } else if (const auto* traffic = std::get_if<databuffer::Traffic>(&*entry)) {
      if (!run) run.emplace(world.configuration, *world.store, world.scenes.get());
      run->traffic(*traffic);
    } else if (const auto* mark = std::get_if<recording::SweepMark>(&*entry)) {
      if (run) run->recorded(*mark);
    } else if (const auto* sweep = std::get_if<databuffer::Sweep>(&*entry)) {
      if (run) run->recorded(recording::mark_of(*sweep));
    } else if (const auto* start = std::get_if<recording::StartingPoint>(&*entry)) {
      if (!run) run.emplace(world.configuration, *world.store, world.scenes.get());
      if (run->ticks() > 0) ++pauses;
      run->start(*start);
    } else if (const auto* gap = std::get_if<recording::Gap>(&*entry)) {
      lost += gap->ticks;
    } else if (std::holds_alternative<databuffer::AppliedEvent>(*entry)) {
      ++events;
    }
  }
  warn_if_cut_short(reader, options.file);
  if (!run) give_up(no_ticks(options.file));
  const nlohmann::ordered_json object{{"ticks", run->ticks()},
                                      {"events", events},
                                      {"sweeps", run->sweeps()},
                                      {"equal", run->comparison().equal()},
                                      {"different", run->comparison().different()},
                                      {"missing", run->comparison().missing()},
                                      {"extra", run->comparison().extra()},
                                      {"not_ready", run->comparison().not_ready()},
                                      {"run_hash", run->comparison().run_hash()},
                                      {"ticks_lost", lost},
                                      {"pauses", pauses},
                                      {"cut_short", reader.cut_short()}};
  std::printf("%s\n", object.dump().c_str());
  if (run->comparison().different() > 0)
    give_up({options.file, "the sweeps of the recording",
             std::to_string(run->comparison().different()) + " different ones",
             lost > 0 ? std::to_string(lost) + " ticks are missing in the recording"
                      : "replay with the same terrain and configuration",
             false});
  if (run->comparison().equal() == 0 && run->comparison().missing() > 0)
    give_up({options.file, "the sweeps of the recording", "none of them", "replay with the same configuration", false});
}

}  // namespace

void add_replay_command(CLI::App& app, const CommonOptions& common) {
  auto* command = app.add_subcommand(
      "replay", "play a recording into a session of its own (--session, else 'replay'), for a radar-display there");
  auto options = std::make_shared<ReplayOptions>();
  command->add_option("FILE", options->file, "recording made by yars record")->required();
  auto* events =
      command->add_flag("--events", options->events, "make the sweeps again from the ticks, offline, and compare them");
  auto* print =
      command->add_flag("--print", options->print, "print events, radar states and patch maps, a JSON object a line");
  events->excludes(print);
  auto* rate = command->add_option("--rate", options->rate, "times real time, 0 to 10 (else 1); 0 holds the picture");
  rate->check(CLI::Range(0.0, 10.0))->excludes(events)->excludes(print);
  auto* seek = command->add_option("--seek", options->seek_s, "sim time in s to begin at (else the recording's begin)");
  seek->check(CLI::Range(0.0, 1e9))->excludes(events)->excludes(print);
  command->add_option("--terrain", options->terrain, "terrain directory (else the recording's)");
  const auto* session = app.get_option("--session");
  command->callback([&common, options, session] {
    const bool named = session->count() > 0;
    auto reader = recording::RecordingReader::open(options->file);
    if (!reader) give_up(reader.error());
    if (options->events) return compare(common, *reader, *options);
    // Never into the session that the environment names: that is where people fly.
    if (!options->print) return play(common, *reader, *options, named ? common.session : "replay");
    print_entries(*reader);
    warn_if_cut_short(*reader, options->file);
  });
}

}  // namespace yars::tools
