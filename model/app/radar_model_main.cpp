// The program radar-model: reads the command line, opens the stores of terrain and scenes, starts the background
// workers and runs the tick loop.

#include "config/schema/load.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"
#include "model/app/radar_model_shell.hpp"
#include "radar/limits.hpp"
#include "radar/theatre.hpp"
#include "runtime/claims.hpp"
#include "runtime/program.hpp"

namespace {

using namespace yars;

struct ModelOptions {
  std::string terrain;
  std::string fidelity;        // name of a preset; empty: as configured
  std::optional<int> samples;  // nullopt: as configured
  bool standby = false;
};

error::Expected<radar::RadarConfiguration> configure(const runtime::ProgramOptions& options,
                                                     const ModelOptions& model_options) {
  auto configuration = config::load_program_configuration(options.config);
  if (!configuration) return configuration;
  if (!model_options.terrain.empty()) configuration->terrain.directory = model_options.terrain;
  if (!model_options.fidelity.empty()) configuration->fidelity = *radar::fidelity_preset(model_options.fidelity);
  if (model_options.samples) configuration->fidelity.samples = *model_options.samples;
  if (const int size = configuration->fidelity.map_size; size > static_cast<int>(databuffer::kMaxPatchPixels))
    return error::fail("mapSize of Fidelity",
                       "at most " + std::to_string(databuffer::kMaxPatchPixels) + " in a session", std::to_string(size),
                       "set mapSize; `yars patch --size` makes larger maps");
  if (configuration->fidelity.slant_range)
    return error::fail("slantRange of Fidelity", "false in a session, whose symbols and cursor are in ground range",
                       "true", "`yars scan` and Python make sweeps in slant range");
  return configuration;
}

struct Stores {
  radar::TheatreStores scans, maps;
};

// Patch maps have separate stores, so that the cells of a map do not evict the scan's cells from memory.
error::Expected<Stores> open_stores(const radar::RadarConfiguration& configuration) {
  return radar::guarded([&] {
    radar::TheatreFiles files(configuration.terrain, configuration.world.scenes);
    auto scans = files.open(model::scene::SceneUse::scatterers);
    return Stores{std::move(scans), files.open(model::scene::SceneUse::triangles)};
  });
}

struct Loaders {
  Loaders(Stores stores, const radar::RadarConfiguration& configuration, bool synchronous)
      : terrain(std::move(stores.scans.window), synchronous),
        scenes(std::move(stores.scans.scenes), synchronous),
        patches(configuration,
                {std::move(stores.maps.window), std::move(stores.maps.path), std::move(stores.maps.scenes)},
                synchronous) {}

  model::TerrainLoader terrain;
  model::SceneLoader scenes;
  model::PatchMaker patches;
};

// Runs the ticks of the role until a stop is requested. True: the role went to another host instead.
error::Expected<bool> run_as_holder(databuffer::Session& session, const runtime::ProgramOptions& options,
                                    const radar::RadarConfiguration& configuration, Loaders& loaders) {
  auto loop = runtime::TickLoop::create(session, databuffer::LockstepRole::radar_model, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  model::RadarModelShell shell(session, configuration, {loaders.terrain, loaders.scenes, loaders.patches});
  log::info("runs in session " + options.session + ", terrain " +
            (configuration.terrain.directory.empty() ? "built-in hills" : configuration.terrain.directory));
  while (const auto due = loop->wait()) {
    if (session.must_yield(databuffer::Role::radar_model)) return true;
    shell.step(*due, loop->late_ticks());
    loop->done(*due);
    if (due->skipped > 0)
      session.note(databuffer::NoteKind::late_tick, "radar-model skipped " + text::counted(due->skipped, "tick"));
  }
  if (auto outcome = loop->outcome(); !outcome) return tl::unexpected(outcome.error());
  return false;
}

error::Expected<void> run(const runtime::ProgramOptions& options, const ModelOptions& model_options) {
  auto configuration = configure(options, model_options);
  if (!configuration) return tl::unexpected(configuration.error());
  while (true) {
    auto stores = open_stores(*configuration);
    if (!stores) return tl::unexpected(stores.error());
    Loaders loaders(std::move(*stores), *configuration, !options.lockstep.empty());
    int waits = 0;
    std::optional<model::kernel::RadarKernel> kernel;
    const auto load_ahead = [&](const databuffer::Session& session) {
      constexpr int kWaitsBetween = 25;  // 0.25 s
      if (waits++ % kWaitsBetween != 0 || !options.lockstep.empty()) return;
      if (!kernel) kernel.emplace(*configuration);
      model::load_ahead(session, *kernel, loaders.terrain, loaders.scenes);
    };
    auto held = runtime::take_role(options.session, databuffer::Role::radar_model, "radar-model", model_options.standby,
                                   load_ahead);
    if (!held) return tl::unexpected(held.error());
    if (!*held) return {};
    const auto yielded = run_as_holder((*held)->session, options, *configuration, loaders);
    if (!yielded) return tl::unexpected(yielded.error());
    if (!*yielded) return {};
    (*held)->session.note(databuffer::NoteKind::restart, "radar-model yields to another host");
    if (!model_options.standby) return runtime::fail_yielded(databuffer::Role::radar_model);
  }
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine app("YARS radar model: antenna, real beam map and patch maps", "radar-model");
  runtime::ProgramOptions options;
  runtime::add_common_options(app, options, runtime::ProgramKind::role);
  ModelOptions model_options;
  app.option("--terrain", model_options.terrain, "folder of elevation cells: DTED, HGT, DED, packs, rasters")
      .value_name("DIR")
      .otherwise("the configuration's")
      .in_user_file();
  app.option("--fidelity", model_options.fidelity, "preset")
      .one_of({radar::fidelity_names().begin(), radar::fidelity_names().end()})
      .otherwise("the configuration's");
  app.option("--samples", model_options.samples, "samples of a sweep")
      .range(1, radar::kMaxSamples)
      .otherwise("the configuration's");
  runtime::add_standby_option(app, model_options.standby);
  return runtime::run_program(argc, argv, app, options, [&] { return run(options, model_options); });
}
