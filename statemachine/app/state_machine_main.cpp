// Program state-machine: turns input events into the radar state.

#include "config/schema/load.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"
#include "runtime/claims.hpp"
#include "runtime/program.hpp"
#include "statemachine/app/state_machine_shell.hpp"

namespace {

using namespace yars;

// Runs the ticks of the role until a stop is requested. True: the role went to another host instead.
error::Expected<bool> run_as_holder(databuffer::Session& session, const runtime::ProgramOptions& options,
                                    const radar::RadarConfiguration& configuration) {
  auto loop = runtime::TickLoop::create(session, databuffer::LockstepRole::state_machine, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  statemachine::StateMachineShell shell(session, configuration, loop->lockstep());
  log::info("runs in session " + options.session);
  while (const auto due = loop->wait()) {
    if (session.must_yield(databuffer::Role::state_machine)) return true;
    shell.step(*due);
    loop->done(*due);
    if (due->skipped > 0)
      session.note(databuffer::NoteKind::late_tick, "state-machine skipped " + text::counted(due->skipped, "tick"));
  }
  if (auto outcome = loop->outcome(); !outcome) return tl::unexpected(outcome.error());
  return false;
}

error::Expected<void> run(const runtime::ProgramOptions& options, bool standby) {
  auto configuration = config::load_program_configuration(options.config);
  if (!configuration) return tl::unexpected(configuration.error());
  while (true) {
    auto held = runtime::take_role(options.session, databuffer::Role::state_machine, "state-machine", standby);
    if (!held) return tl::unexpected(held.error());
    if (!*held) return {};
    const auto yielded = run_as_holder((*held)->session, options, *configuration);
    if (!yielded) return tl::unexpected(yielded.error());
    if (!*yielded) return {};
    (*held)->session.note(databuffer::NoteKind::restart, "state-machine yields to another host");
    if (!standby) return runtime::fail_yielded(databuffer::Role::state_machine);
  }
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine app("YARS state machine: turns input events into the radar state", "state-machine");
  runtime::ProgramOptions options;
  runtime::add_common_options(app, options, runtime::ProgramKind::role);
  bool standby = false;
  runtime::add_standby_option(app, standby);
  return runtime::run_program(argc, argv, app, options, [&] { return run(options, standby); });
}
