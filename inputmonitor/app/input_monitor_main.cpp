// Program input-monitor: turns keys, scripts and cockpit hardware into input events.

#include "config/schema/devices.hpp"
#include "config/schema/load.hpp"
#include "inputmonitor/app/input_monitor_shell.hpp"
#include "inputmonitor/source_choice.hpp"
#include "lib/log/log.hpp"
#include "runtime/program.hpp"

namespace {

using namespace yars;
using error::Expected;

// Device maps, which assign events to the controls of devices: the built-in maps, then those of the configuration. The
// last map that fits a device applies.
Expected<inputmonitor::DeviceMaps> device_maps(const runtime::ProgramOptions& options) {
  auto built_in = config::load_configuration_text(config::shipped_devices_text(), "config/devices.guf");
  if (!built_in) return tl::unexpected(built_in.error());
  const auto configured = config::load_program_configuration(options.config);
  if (!configured) return tl::unexpected(configured.error());
  std::vector<radar::Device> maps = std::move(built_in->radar.devices);
  maps.insert(maps.end(), configured->devices.begin(), configured->devices.end());
  return std::make_shared<const std::vector<radar::Device>>(std::move(maps));
}

Expected<std::unique_ptr<inputmonitor::EventSource>> open_sources(const runtime::ProgramOptions& options,
                                                                  const std::vector<std::string>& texts) {
  std::vector<inputmonitor::SourceChoice> choices;
  for (const std::string& text : texts) {
    const auto choice = inputmonitor::parse_source(text);
    if (!choice) return tl::unexpected(choice.error());
    choices.push_back(*choice);
  }
  auto maps = device_maps(options);
  if (!maps) return tl::unexpected(maps.error());
  inputmonitor::SourceContext context;
  context.session = options.session;
  context.maps = std::move(*maps);
  return inputmonitor::open_sources(choices, context);
}

Expected<void> run(const runtime::ProgramOptions& options, const std::vector<std::string>& source_texts) {
  auto source = open_sources(options, source_texts);
  if (!source) return tl::unexpected(source.error());
  auto session = databuffer::Session::open(options.session, "input-monitor");
  if (!session) return tl::unexpected(session.error());
  auto lane = session->claim_input_lane("input-monitor");
  if (!lane) return tl::unexpected(lane.error());
  std::optional<databuffer::Claim> tour;
  if ((*source)->has_captions()) {
    auto claim = session->claim(databuffer::Role::tour);
    if (!claim) return tl::unexpected(error::usage_error(claim.error()));
    tour = std::move(*claim);
  }
  auto loop = runtime::TickLoop::create(*session, databuffer::LockstepRole::input_monitor, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  log::info("reads " + (*source)->description());
  inputmonitor::InputMonitorShell shell(*session, std::move(*source), lane->lane());
  shell.run(*loop);
  return loop->outcome();
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine app("YARS input monitor: keys, scripts and cockpit hardware become events", "input-monitor");
  runtime::ProgramOptions options;
  std::vector<std::string> sources{"auto"};
  std::string learn_path;
  std::string map_file;
  runtime::add_common_options(app, options, runtime::ProgramKind::role);
  app.option("--source", sources,
             "window, terminal, script:FILE, tour:FILE[,pilot], evdev:PATH[,MAP] or auto; repeatable")
      .value_name("SOURCE")
      .repeatable()
      .otherwise("auto");
  runtime::Option learn =
      app.option("--learn", learn_path,
                 "path of a device: asks for one control after the other and makes a device map; needs no session");
  learn.value_name("FILE").otherwise("events are sent");
  app.option("--out", map_file, "file for the map of --learn")
      .value_name("FILE")
      .needs(learn)
      .otherwise("standard output");
  return runtime::run_program(argc, argv, app, options, [&] {
    return learn_path.empty() ? run(options, sources)
                              : inputmonitor::learn_device(learn_path, map_file, options.session);
  });
}
