// flight-model: flies a route, a fixed course or a recorded track and publishes ownship and nav.
#include "databuffer/flight_shell.hpp"
#include "databuffer/log.hpp"
#include "databuffer/program.hpp"

namespace {

using namespace yars;

constexpr std::uint32_t kPriority = 10;  // of our own models; a bridge or a user's program may go above or below

failure::Expected<void> run(const databuffer::ProgramOptions& options, const std::string& source_text) {
  auto source = databuffer::flight::open_source(source_text);
  if (!source) return tl::unexpected(source.error());
  auto session = databuffer::Session::open(options.session, "flight-model");
  if (!session) return tl::unexpected(session.error());
  auto lane = session->claim_ownship_lane(kPriority);
  if (!lane) return tl::unexpected(lane.error());
  auto loop = databuffer::TickLoop::create(*session, databuffer::LockstepRole::flight_model, options.lockstep);
  if (!loop) return tl::unexpected(loop.error());
  databuffer::log_info("flies " + source->description + " in session " + options.session);
  databuffer::FlightShell shell(*session, std::move(*source), lane->lane(), loop->lockstep());
  while (const auto due = loop->wait()) {
    shell.step(*due);
    loop->done(*due);
    if (due->skipped > 0)
      session->note(databuffer::NoteKind::late_tick, "flight-model skipped " + std::to_string(due->skipped));
  }
  return loop->outcome();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("YARS flight model: where the aircraft is", "flight-model");
  databuffer::ProgramOptions options;
  std::string source;
  databuffer::add_common_options(app, options, true);
  app.add_option("--source", source, "route:FILE, fixed:LAT,LON,ALT_FT,HDG,KT or csv:FILE")->required();
  return databuffer::run_program(argc, argv, app, options, [&] { return run(options, source); });
}
