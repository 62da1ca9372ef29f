// Program state-machine: turns input events into the radar state.

#include "config/schema/load.hpp"
#include "databuffer/runtime/program.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"
#include "statemachine/app/state_machine_shell.hpp"

namespace {

using namespace yars;

error::Expected<void> run(const databuffer::ProgramOptions& options) {
  auto configuration = config::load_program_configuration(options.config);
  if (!configuration) return tl::unexpected(configuration.error());
  auto session = databuffer::Session::open(options.session, "state-machine");
  if (!session) return tl::unexpected(session.error());
  auto role = session->claim(databuffer::Role::state_machine);
  if (!role) return tl::unexpected(error::usage_error(role.error()));
  auto loop = databuffer::TickLoop::create(*session, databuffer::LockstepRole::state_machine, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  statemachine::StateMachineShell shell(*session, *configuration, loop->lockstep());
  log::info("runs in session " + options.session);
  while (const auto due = loop->wait()) {
    shell.step(*due);
    loop->done(*due);
    if (due->skipped > 0)
      session->note(databuffer::NoteKind::late_tick, "state-machine skipped " + text::counted(due->skipped, "tick"));
  }
  return loop->outcome();
}

}  // namespace

int main(int argc, char** argv) {
  databuffer::CommandLine app("YARS state machine: turns input events into the radar state", "state-machine");
  databuffer::ProgramOptions options;
  databuffer::add_common_options(app, options, true);
  return databuffer::run_program(argc, argv, app, options, [&options] { return run(options); });
}
