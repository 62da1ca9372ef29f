// The program radar-model: reads the command line, opens the stores of terrain and scenes, starts the background
// workers and runs the tick loop.

#include "config/schema/load.hpp"
#include "databuffer/runtime/program.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"
#include "model/app/radar_model_shell.hpp"
#include "model/terrain/store/directory_store.hpp"

namespace {

using namespace yars;

struct ModelOptions {
  std::string terrain;
  std::optional<int> samples;  // nullopt: as configured
};

error::Expected<radar::RadarConfiguration> configure(const databuffer::ProgramOptions& options,
                                                     const ModelOptions& model_options) {
  auto configuration = config::load_program_configuration(options.config);
  if (!configuration) return configuration;
  if (!model_options.terrain.empty()) configuration->terrain.directory = model_options.terrain;
  if (model_options.samples) configuration->fidelity.samples = *model_options.samples;
  return configuration;
}

// Patch maps have separate stores, so that the cells of a map do not evict the scan's cells from memory.
error::Expected<model::PatchStores> open_patch_stores(const radar::RadarConfiguration& configuration) {
  auto window = model::terrain::open_terrain(configuration.terrain);
  if (!window) return tl::unexpected(window.error());
  auto path = model::terrain::open_terrain(configuration.terrain);
  if (!path) return tl::unexpected(path.error());
  auto scenes = model::scene::open_scenes(configuration.world.scenes, configuration.terrain);
  if (!scenes) return tl::unexpected(scenes.error());
  return model::PatchStores{std::move(*window), std::move(*path), std::move(*scenes)};
}

error::Expected<void> run(const databuffer::ProgramOptions& options, const ModelOptions& model_options) {
  auto configuration = configure(options, model_options);
  if (!configuration) return tl::unexpected(configuration.error());
  auto store = model::terrain::open_terrain(configuration->terrain);
  if (!store) return tl::unexpected(store.error());
  auto patch_stores = open_patch_stores(*configuration);
  if (!patch_stores) return tl::unexpected(patch_stores.error());
  auto scenes = model::scene::open_scenes(configuration->world.scenes, configuration->terrain,
                                          model::scene::SceneUse::scatterers);
  if (!scenes) return tl::unexpected(scenes.error());
  auto session = databuffer::Session::open(options.session, "radar-model");
  if (!session) return tl::unexpected(session.error());
  auto role = session->claim(databuffer::Role::radar_model);
  if (!role) return tl::unexpected(error::usage_error(role.error()));
  auto loop = databuffer::TickLoop::create(*session, databuffer::LockstepRole::radar_model, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  model::TerrainLoader terrain(std::move(*store), loop->lockstep());
  model::SceneLoader scene_loader(std::move(*scenes), loop->lockstep());
  model::PatchMaker patches(*configuration, std::move(*patch_stores), loop->lockstep());
  model::RadarModelShell shell(*session, *configuration, {terrain, scene_loader, patches});
  log::info("runs in session " + options.session + ", terrain " +
            (configuration->terrain.directory.empty() ? "built-in hills" : configuration->terrain.directory));
  while (const auto due = loop->wait()) {
    shell.step(*due, loop->late_ticks());
    loop->done(*due);
    if (due->skipped > 0)
      session->note(databuffer::NoteKind::late_tick, "radar-model skipped " + text::counted(due->skipped, "tick"));
  }
  return loop->outcome();
}

}  // namespace

int main(int argc, char** argv) {
  databuffer::CommandLine app("YARS radar model: antenna, real beam map and patch maps", "radar-model");
  databuffer::ProgramOptions options;
  databuffer::add_common_options(app, options, true);
  ModelOptions model_options;
  app.option("--terrain", model_options.terrain, "folder of elevation cells: DTED, HGT, DED, packs, rasters")
      .value_name("DIR")
      .otherwise("the configuration's")
      .in_user_file();
  app.option("--samples", model_options.samples, "samples of a sweep")
      .range(1, radar::kMaxSamples)
      .otherwise("the configuration's");
  return databuffer::run_program(argc, argv, app, options, [&] { return run(options, model_options); });
}
