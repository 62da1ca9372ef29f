// Main program of the `yars` command. The callback of the selected subcommand runs during app.parse().
// Exit codes: docs/commands.md#exit-codes.

#include "radar/limits.hpp"
#include "runtime/process.hpp"
#include "runtime/program.hpp"
#include "tools/command/command.hpp"

namespace {

using namespace yars;

void add_commands(runtime::Command app, const tools::CommonOptions& common) {
  tools::add_scan_command(app, common);
  tools::add_patch_command(app, common);
  tools::add_trade_command(app, common);
  tools::add_terrain_command(app, common);
  tools::add_scene_command(app, common);
  tools::add_dataset_command(app);
  tools::add_config_command(app, common);
  tools::add_sim_command(app, common);
  tools::add_world_command(app, common);
  tools::add_inject_command(app, common);
  tools::add_note_command(app, common);
  tools::add_status_command(app, common);
  tools::add_watch_command(app, common);
  tools::add_record_command(app, common);
  tools::add_recordings_command(app);
  tools::add_replay_command(app, common);
}

int end_with(const tools::CommandFailed& failed) {
  if (!failed.message.empty()) runtime::print_failure("yars", failed.message);
  return failed.code;
}

int run(int argc, char** argv) {
  runtime::CommandLine app("YARS: an open air-to-ground radar simulation", "yars");
  app.require_subcommand();
  app.accept_options_after_subcommands();
  runtime::ProgramOptions options;
  runtime::add_common_options(app, options, runtime::ProgramKind::command);
  tools::CommonOptions common;
  app.before_callbacks([&] {
    if (auto error = runtime::begin_program("yars", options)) tools::throw_failure(*error);
    // These subcommands do not poll the stop flag that the signal handler sets. The default signal action ends them.
    for (const auto* command : {"scan", "patch", "trade", "terrain", "scene", "dataset", "config", "recordings"})
      if (app.has_subcommand(command)) runtime::restore_default_signal_actions();
    common.session = options.session;
    common.config = options.config;
  });
  add_commands(app, common);
  app.add_help_command();
  try {
    return app.parse(argc, argv).value_or(0);
  } catch (const radar::Failure& failure) {
    return end_with(tools::failure_of(failure.error));
  } catch (const tools::CommandFailed& failed) {
    return end_with(failed);
  } catch (const std::exception& problem) {
    runtime::print_failure("yars", runtime::message_of(problem));
    return runtime::kExitFailure;
  }
}

}  // namespace

int main(int argc, char** argv) {
  runtime::sanitize_terminal_output();
  return runtime::exit_code_after_output("yars", run(argc, argv));
}
