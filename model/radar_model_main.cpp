// radar-model: antenna and real beam map; sweeps out.
#include "databuffer/log.hpp"
#include "databuffer/program.hpp"
#include "model/radar_model_shell.hpp"
#include "model/terrain/open_terrain.hpp"

namespace {

using namespace yars;

struct ModelOptions {
  std::string terrain;
  int samples = 0;
};

failure::Expected<radar::RadarConfiguration> configure(const databuffer::ProgramOptions& options,
                                                       const ModelOptions& model_options) {
  auto configuration = databuffer::load_program_configuration(options);
  if (!configuration) return configuration;
  if (!model_options.terrain.empty()) configuration->terrain.directory = model_options.terrain;
  if (model_options.samples != 0) configuration->fidelity.samples = model_options.samples;
  return configuration;
}

failure::Expected<void> run(const databuffer::ProgramOptions& options, const ModelOptions& model_options) {
  auto configuration = configure(options, model_options);
  if (!configuration) return tl::unexpected(configuration.error());
  auto store = model::terrain::open_terrain(configuration->terrain);
  if (!store) return tl::unexpected(store.error());
  auto session = databuffer::Session::open(options.session, "radar-model");
  if (!session) return tl::unexpected(session.error());
  auto role = session->claim(databuffer::Role::radar_model);
  if (!role) return tl::unexpected(databuffer::usage_error(role.error()));
  auto loop = databuffer::TickLoop::create(*session, databuffer::LockstepRole::radar_model, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  model::TerrainLoader terrain(std::move(*store), loop->lockstep());
  model::RadarModelShell shell(*session, *configuration, terrain);
  databuffer::log_info(
      "runs in session " + options.session + ", terrain " +
      (configuration->terrain.directory.empty() ? "built-in hills" : configuration->terrain.directory));
  while (const auto due = loop->wait()) {
    shell.step(*due, loop->late_ticks());
    loop->done(*due);
    if (due->skipped > 0)
      session->note(databuffer::NoteKind::late_tick, "radar-model skipped " + std::to_string(due->skipped));
  }
  return loop->outcome();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("YARS radar model: antenna and real beam map", "radar-model");
  databuffer::ProgramOptions options;
  databuffer::add_common_options(app, options, true);
  ModelOptions model_options;
  app.add_option("--terrain", model_options.terrain, "directory of DTED or HGT cells (else the configuration's)");
  app.add_option("--samples", model_options.samples, "samples a sweep (else the configuration's)")
      ->check(CLI::Range(1, radar::kMaxSamples));
  return databuffer::run_program(argc, argv, app, options, [&] { return run(options, model_options); });
}
