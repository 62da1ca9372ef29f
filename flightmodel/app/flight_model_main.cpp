// Program flight-model: publishes ownship (position and motion of the aircraft) and nav (readings of the navigators).
// Sources: a route, a fixed course, a recorded track, or an external program.

#include "flightmodel/app/flight_shell.hpp"
#include "lib/file/text_file.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"
#include "runtime/program.hpp"

namespace {

using namespace yars;

// Priority of a flight model's ownship lane. Of the lanes that deliver records, the radar uses the one of the highest
// priority. Other programs may choose a higher or lower priority.
constexpr std::uint32_t kPriority = 10;
// Priority of the ownship lane of a bridge: a source that receives the UDP packets of another program. While
// reports of the aircraft arrive, the radar follows the bridge; else it follows a flight model in the same session.
constexpr std::uint32_t kBridgePriority = 20;

template <class Shell>
error::Expected<void> fly(databuffer::Session& session, runtime::TickLoop& loop, Shell& shell) {
  while (const auto due = loop.wait()) {
    shell.step(*due);
    loop.done(*due);
    if (due->skipped > 0)
      session.note(databuffer::NoteKind::late_tick, "flight-model skipped " + text::counted(due->skipped, "tick"));
  }
  return loop.outcome();
}

// Replaces the name of an installed route by its path, unless the current folder has a file of that name.
std::string with_installed_route(const std::string& source_text) {
  const std::string prefix = "route:";
  return source_text.starts_with(prefix) ? prefix + file::installed_file(source_text.substr(prefix.size()))
                                         : source_text;
}

error::Expected<void> run_flight_model(const runtime::ProgramOptions& options, const std::string& source_text) {
  auto source = flightmodel::open_source(with_installed_route(source_text));
  if (!source) return tl::unexpected(source.error());
  auto session = databuffer::Session::open(options.session, "flight-model");
  if (!session) return tl::unexpected(session.error());
  auto lane = session->claim_ownship_lane(kPriority);
  if (!lane) return tl::unexpected(lane.error());
  auto loop = runtime::TickLoop::create(*session, databuffer::LockstepRole::flight_model, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  log::info("flies " + source->description + " in session " + options.session);
  flightmodel::FlightShell shell(*session, std::move(*source), lane->lane(), loop->lockstep());
  return fly(*session, *loop, shell);
}

error::Expected<void> run_bridge(const runtime::ProgramOptions& options, const std::string& source_text) {
  auto source = flightmodel::bridges::open_bridge(source_text);
  if (!source) return tl::unexpected(source.error());
  if (!options.lockstep.empty())
    return tl::unexpected(error::usage_error("--lockstep", "a source that flies by sim time: route, fixed or csv",
                                             source->name + ", which flies by its own clock"));
  // The socket is opened before the session, so that an error for a port in use leaves the session unchanged.
  auto socket = flightmodel::open_socket(*source);
  if (!socket) return tl::unexpected(socket.error());
  auto session = databuffer::Session::open(options.session, "flight-model");
  if (!session) return tl::unexpected(session.error());
  auto lane = session->claim_ownship_lane(kBridgePriority);
  if (!lane) return tl::unexpected(lane.error());
  auto loop = runtime::TickLoop::create(*session, databuffer::LockstepRole::flight_model, {});
  if (!loop) return tl::unexpected(loop.error());
  flightmodel::BridgeShell shell(*session, std::move(*source), std::move(*socket), lane->lane());
  return fly(*session, *loop, shell);
}

constexpr const char* kSources =
    "source of the aircraft's position:\n"
    "route:FILE  a route of waypoints\n"
    "fixed:LAT,LON,ALT_FT,HDG,KT  straight and level: feet above sea level, degrees true, knots over ground\n"
    "csv:FILE  a recorded track\n"
    "flightgear:[HOST:]PORT  FlightGear's native FDM by UDP\n"
    "jsbsim:[HOST:]PORT[,COLUMN,...]  JSBSim's text output by UDP\n"
    "xplane:HOST:PORT  X-Plane by UDP; X-Plane listens on port 49000\n"
    "dis:[HOST:]PORT[,SITE,APP,ENTITY]  a DIS entity, or the first air platform received\n"
    "(HOST in brackets: address to listen on, default 127.0.0.1)";

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine app("YARS flight model: position and motion of the aircraft", "flight-model");
  runtime::ProgramOptions options;
  std::string source;
  runtime::add_common_options(app, options, runtime::ProgramKind::role);
  app.option("--source", source, kSources).value_name("SOURCE").required();
  return runtime::run_program(argc, argv, app, options, [&] {
    return flightmodel::bridges::names_bridge(source) ? run_bridge(options, source) : run_flight_model(options, source);
  });
}
