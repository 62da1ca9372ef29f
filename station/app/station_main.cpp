// The program yars-station: serves the radar's display to browsers.

#include <cstdio>
#include <filesystem>
#include <string>

#include "databuffer/runtime/process.hpp"
#include "databuffer/runtime/program.hpp"
#include "databuffer/session/session.hpp"
#include "lib/file/file_search.hpp"
#include "station/app/feed_shell.hpp"
#include "station/app/server_shell.hpp"

namespace {

using namespace yars;

struct StationOptions {
  int port = 8096;
  std::string pages;
};

error::Expected<void> run(const databuffer::ProgramOptions& options, const StationOptions& station_options) {
  auto session = databuffer::Session::open(options.session, "station");
  if (!session) return tl::unexpected(session.error());
  auto feed = station::StationFeed::create(*session);
  if (!feed) return tl::unexpected(feed.error());
  std::filesystem::path pages = station_options.pages;
  if (pages.empty()) pages = file::installed_folder("station");
  auto server = station::Server::listen(*feed, pages, static_cast<std::uint16_t>(station_options.port));
  if (!server) return tl::unexpected(server.error());
  std::printf("http://127.0.0.1:%d/display.html\n", server->port());
  std::fflush(stdout);
  while (!databuffer::stop_requested()) {
    session->heartbeat();
    server->step();
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  databuffer::CommandLine app("YARS station: serves the display to browsers on this computer", "yars-station");
  databuffer::ProgramOptions options;
  databuffer::add_common_options(app, options, databuffer::ProgramKind::service);
  StationOptions station_options;
  app.option("--port", station_options.port, "port at 127.0.0.1; 0: any free one").range(0, 65535);
  app.option("--pages", station_options.pages, "folder of the pages").value_name("DIR").otherwise("the installed ones");
  return databuffer::run_program(argc, argv, app, options, [&] { return run(options, station_options); });
}
