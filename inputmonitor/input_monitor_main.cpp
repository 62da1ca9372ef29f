// input-monitor: a keyboard or a script becomes input events.
#include "databuffer/log.hpp"
#include "databuffer/program.hpp"
#include "inputmonitor/input_monitor_shell.hpp"
#include "inputmonitor/source_choice.hpp"

namespace {

using namespace yars;

failure::Expected<void> run(const databuffer::ProgramOptions& options, const std::string& source_text) {
  const auto choice = inputmonitor::parse_source(source_text);
  if (!choice) return tl::unexpected(choice.error());
  auto source = inputmonitor::open_source(*choice, options.session);
  if (!source) return tl::unexpected(source.error());
  auto session = databuffer::Session::open(options.session, "input-monitor");
  if (!session) return tl::unexpected(session.error());
  auto lane = session->claim_input_lane("input-monitor");
  if (!lane) return tl::unexpected(lane.error());
  auto loop = databuffer::TickLoop::create(*session, databuffer::LockstepRole::input_monitor, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  databuffer::log_info("reads " + (*source)->description());
  inputmonitor::InputMonitorShell shell(*session, std::move(*source), lane->lane());
  shell.run(*loop);
  return loop->outcome();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("YARS input monitor: keys and scripts become events", "input-monitor");
  databuffer::ProgramOptions options;
  std::string source = "auto";
  databuffer::add_common_options(app, options, true);
  app.add_option("--source", source, "window, terminal, script:FILE or auto (default)");
  return databuffer::run_program(argc, argv, app, options, [&] { return run(options, source); });
}
