// `yars replay`: --events runs the kernel again over the ticks of a recording and compares every sweep; --print
// says what happened.
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "config/load.hpp"
#include "databuffer/program.hpp"
#include "databuffer/records/event_text.hpp"
#include "model/kernel/radar_kernel.hpp"
#include "model/terrain/open_terrain.hpp"
#include "tools/command.hpp"
#include "tools/tick_log.hpp"
#include "tools/watch_json.hpp"

namespace yars::tools {

namespace {

using databuffer::ModelTick;

struct ReplayOptions {
  std::string file;
  std::string terrain;
  bool events = false;
  bool print = false;
};

// Sweeps made here against sweeps recorded, by epoch and number of the sweep.
class Comparison {
 public:
  void made(const databuffer::Sweep& sweep) { settle(made_, recorded_, key(sweep.epoch, sweep.number), sweep.hash); }
  void recorded(const SweepMark& mark) {
    // FNV-1a over the hashes in their order: one number for a whole run.
    for (int byte = 0; byte < 8; ++byte) run_hash = (run_hash ^ (mark.hash >> (8 * byte) & 0xffU)) * 0x100000001b3ULL;
    // A sweep over posts that were still loading is not a function of the ticks.
    if ((mark.flags & databuffer::kSweepNotReady) != 0U)
      ++not_ready;
    else
      settle(recorded_, made_, key(mark.epoch, mark.number), mark.hash);
  }
  std::uint64_t run_hash = 0xcbf29ce484222325ULL;
  // Recorded sweeps that were not made here, and the other way round.
  std::uint64_t missing() const { return recorded_.size(); }
  std::uint64_t extra() const { return made_.size(); }

  std::uint64_t equal = 0, different = 0, not_ready = 0;

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;
  using Hashes = std::map<Key, std::uint64_t>;
  static Key key(std::uint32_t epoch, std::uint32_t number) { return {epoch, number}; }
  void settle(Hashes& own, Hashes& other, Key sweep, std::uint64_t hash) {
    const auto partner = other.find(sweep);
    if (partner == other.end()) {
      own[sweep] = hash;
      return;
    }
    ++(partner->second == hash ? equal : different);
    other.erase(partner);
  }
  Hashes made_, recorded_;
};

class Replay {
 public:
  Replay(const radar::RadarConfiguration& configuration, model::terrain::TerrainStore& store)
      : configuration_(&configuration), store_(&store), kernel_(configuration), view_(store.prepare({})) {}

  void start(const StartingPoint& point) {
    kernel_.resume(point.status);
    resumed_ = true;
  }

  void tick(const ModelTick& tick) {
    if ((tick.flags & databuffer::kTickRestart) != 0U && ticks > 0) restart();
    ++ticks;
    if (const auto need = kernel_.need(tick); need.video) view_ = store_->prepare(need.region);
    if (!kernel_.step(tick, *view_, sweep_)) return;
    ++sweeps;
    // The smear over earlier sweeps needs those from before the log began.
    constexpr std::uint64_t kSmearMemory = 2;
    if (!resumed_ || sweeps > kSmearMemory) comparison.made(sweep_);
  }

  std::uint64_t ticks = 0, sweeps = 0;
  Comparison comparison;

 private:
  // What the restarted process did: a new kernel that takes up the status of the old one.
  void restart() {
    databuffer::ModelStatus left{};
    kernel_.describe(*view_, left);
    kernel_ = model::kernel::RadarKernel(*configuration_);
    kernel_.resume(left);
  }

  const radar::RadarConfiguration* configuration_;
  model::terrain::TerrainStore* store_;
  model::kernel::RadarKernel kernel_;
  model::terrain::TerrainViewPointer view_;
  databuffer::Sweep sweep_{};
  bool resumed_ = false;
};

radar::RadarConfiguration configuration_of(const CommonOptions& common, const TickLogHeader& header,
                                           const ReplayOptions& options) {
  auto loaded = config::load_configuration(common.config.empty() ? header.configuration : common.config);
  if (!loaded) give_up(loaded.error());
  if (!header.terrain.empty()) loaded->radar.terrain.directory = header.terrain;
  if (!options.terrain.empty()) loaded->radar.terrain.directory = options.terrain;
  return std::move(loaded->radar);
}

void print_entries(TickLogReader& reader) {
  while (const auto entry = reader.next()) {
    if (databuffer::stop_requested()) return;
    nlohmann::ordered_json object;
    if (const auto* event = std::get_if<databuffer::AppliedEvent>(&*entry)) {
      object["tick"] = event->tick;
      object["event"] = databuffer::text_of(event->event);
      object["effective"] = event->effective != 0;
    } else if (const auto* change = std::get_if<StateChange>(&*entry)) {
      object["tick"] = change->state.tick;
      add_radar_state(object["state"], change->state);
    } else {
      continue;
    }
    std::printf("%s\n", object.dump().c_str());
  }
}

void replay(const CommonOptions& common, const ReplayOptions& options) {
  auto reader = TickLogReader::open(options.file);
  if (!reader) give_up(reader.error());
  if (options.print) {
    print_entries(*reader);
    return;
  }
  auto configuration = configuration_of(common, reader->header(), options);
  auto store = model::terrain::open_terrain(configuration.terrain);
  if (!store) give_up(store.error());
  std::optional<Replay> run;
  std::uint64_t events = 0, lost = 0;
  while (auto entry = reader->next()) {
    if (databuffer::stop_requested())
      give_up({options.file, "time to read it to its end", "a request to stop", "", false});
    if (const auto* tick = std::get_if<ModelTick>(&*entry)) {
      configuration.fidelity.samples = static_cast<int>(tick->samples);
      if (!run) run.emplace(configuration, **store);
      run->tick(*tick);
    } else if (const auto* mark = std::get_if<SweepMark>(&*entry)) {
      if (run) run->comparison.recorded(*mark);
    } else if (const auto* start = std::get_if<StartingPoint>(&*entry)) {
      if (!run) run.emplace(configuration, **store);
      run->start(*start);
    } else if (const auto* gap = std::get_if<Gap>(&*entry)) {
      lost += gap->ticks;
    } else if (std::holds_alternative<databuffer::AppliedEvent>(*entry)) {
      ++events;
    }
  }
  if (!run) give_up({options.file, "at least one tick", "none", "record while radar-model runs", false});
  const nlohmann::ordered_json object{{"ticks", run->ticks},
                                      {"events", events},
                                      {"sweeps", run->sweeps},
                                      {"equal", run->comparison.equal},
                                      {"different", run->comparison.different},
                                      {"missing", run->comparison.missing()},
                                      {"extra", run->comparison.extra()},
                                      {"not_ready", run->comparison.not_ready},
                                      {"run_hash", run->comparison.run_hash},
                                      {"ticks_lost", lost},
                                      {"cut_short", reader->cut_short()}};
  std::printf("%s\n", object.dump().c_str());
  if (run->comparison.different > 0)
    give_up({options.file, "the sweeps of the recording", std::to_string(run->comparison.different) + " different ones",
             lost > 0 ? std::to_string(lost) + " ticks are missing in the recording"
                      : "replay with the same terrain and configuration",
             false});
  if (run->comparison.equal == 0 && run->comparison.missing() > 0)
    give_up({options.file, "the sweeps of the recording", "none of them", "replay with the same configuration", false});
}

}  // namespace

void add_replay_command(CLI::App& app, const CommonOptions& common) {
  auto* command = app.add_subcommand("replay", "make the sweeps of a recording again and compare them");
  auto options = std::make_shared<ReplayOptions>();
  command->add_option("FILE", options->file, "recording made by yars record")->required();
  auto* events = command->add_flag("--events", options->events, "from the recorded ticks, offline");
  auto* print = command->add_flag("--print", options->print, "print the events and radar states, a JSON object a line");
  events->excludes(print);
  command->add_option("--terrain", options->terrain, "terrain directory (else the recording's)");
  command->callback([&common, options] {
    if (!options->events && !options->print)
      give_up(databuffer::usage_error("replay", "--events or --print", "neither"));
    replay(common, *options);
  });
}

}  // namespace yars::tools
