// The program yars-station: serves the radar's display and the instructor's page to browsers.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "config/schema/load.hpp"
#include "flightmodel/route_flight.hpp"
#include "lib/file/output_file.hpp"
#include "lib/file/text_file.hpp"
#include "lib/log/log.hpp"
#include "lib/text/plain_text.hpp"
#include "radar/limits.hpp"
#include "radar/theatre.hpp"
#include "runtime/process.hpp"
#include "runtime/program.hpp"
#include "station/app/server_shell.hpp"
#include "station/instructor_map.hpp"

namespace {

using namespace yars;

struct StationOptions {
  int port = 8096;
  std::string pages, start_script, terrain, source, recordings = "recordings";
  std::string listen = "127.0.0.1", names, tokens, certificate, key;
  bool without_tls = false, without_tokens = false, behind_proxy = false;
};

// 128 random bits in hexadecimal digits.
std::string random_token() {
  std::random_device source;
  std::string token;
  for (int word = 0; word < 4; ++word) {
    char digits[9];
    std::snprintf(digits, sizeof digits, "%08x", source());
    token += digits;
  }
  return token;
}

// A file with secrets is for its owner, and for a group that has been given it; tokens for their owner alone.
error::Expected<void> check_secret(const std::string& file, unsigned others) {
  std::error_code problem;
  const auto mode = static_cast<unsigned>(std::filesystem::status(file, problem).permissions());
  if (problem || (mode & others) == 0) return {};
  char digits[8];
  std::snprintf(digits, sizeof digits, "%04o", mode & 0777U);
  return error::fail(file, "a file that other users cannot read", "mode " + std::string(digits), "chmod 600 " + file);
}

error::Expected<void> read_tokens(const std::string& file, station::AccessRules& access) {
  if (auto secret = check_secret(file, 077); !secret) return secret;
  const auto text = file::read_text_file(file);
  if (!text) return tl::unexpected(text.error());
  for (const text::NumberedLine& line : text::numbered_lines(*text)) {
    const auto words = text::words_of(line.text);
    const bool is_token = words.size() == 2 && words[1].size() >= 16;
    if (is_token && words[0] == "instructor") access.instructor_token = words[1];
    if (is_token && words[0] == "viewer") access.viewer_token = words[1];
  }
  if (!access.instructor_token.empty() && !access.viewer_token.empty()) return {};
  return error::fail(file, "a line `instructor TOKEN` and a line `viewer TOKEN`, of 16 characters or more", "none",
                     "remove the file: a new one is made");
}

// Tokens of the file; a file that is not there is made, so that a station that starts again has the same. Without a
// file they hold as long as this process.
error::Expected<void> use_tokens(const std::string& file, station::AccessRules& access) {
  std::error_code ignored;
  if (!file.empty() && std::filesystem::exists(file, ignored)) return read_tokens(file, access);
  access.instructor_token = random_token();
  access.viewer_token = random_token();
  if (file.empty()) return {};
  auto fresh = file::NewFile::create(file);  // for its owner alone, by the umask of run_program()
  if (!fresh) return tl::unexpected(fresh.error());
  fresh->write("instructor " + access.instructor_token + "\nviewer " + access.viewer_token + "\n");
  return fresh->finish();
}

std::vector<std::string_view> names_of(const StationOptions& options) {
  return options.names.empty() ? std::vector<std::string_view>() : text::fields_of(options.names, ',');
}

bool is_loopback(const std::string& address) {
  return address.starts_with("127.") || address == "::1";
}

error::Expected<void> check_access(const StationOptions& options) {
  if (options.certificate.empty() != options.key.empty())
    return tl::unexpected(error::usage_error("--certificate", "--key with it", "one of both"));
  if (options.without_tokens && !options.tokens.empty())
    return tl::unexpected(error::usage_error("--without-tokens", "no --tokens with it", "both"));
  for (const std::string_view name : names_of(options))
    if (!station::is_host_name(name))
      return tl::unexpected(error::usage_error("--names", "names of a computer with commas between, as radar.example",
                                               "'" + std::string(name) + "'"));
  if (is_loopback(options.listen)) return {};
  if (options.without_tokens)
    return tl::unexpected(error::usage_error("--listen " + options.listen,
                                             "tokens, because others can reach the station", "--without-tokens"));
  if (options.certificate.empty() && !options.without_tls)
    return tl::unexpected(error::usage_error(
        "--listen " + options.listen,
        "--certificate and --key with it, or --without-tls: everybody on the way reads the tokens", "none"));
  return {};
}

error::Expected<std::vector<geo::GeoPoint>> waypoints_of(const std::string& source) {
  constexpr std::string_view kBegin = "route:";
  std::vector<geo::GeoPoint> points;
  if (!source.starts_with(kBegin)) return points;
  const std::string file = source.substr(kBegin.size());
  const auto text = file::read_text_file(file);
  if (!text) return tl::unexpected(text.error());
  const auto route = flightmodel::parse_route(*text, file);
  if (!route) return tl::unexpected(route.error());
  for (const flightmodel::Waypoint& waypoint : route->waypoints) points.push_back(waypoint.point);
  if (route->loop) points.push_back(points.front());
  return points;
}

// Names of the files of scenes, with blanks, and their positions.
std::vector<station::Place> places_of(const model::scene::SceneIndex& scenes) {
  std::vector<station::Place> places;
  for (const std::string& problem : scenes.problems) log::warning(problem);
  for (const model::scene::IndexedScene& scene : scenes.scenes) {
    std::string name = scene.file.stem().string();
    std::ranges::replace(name, '_', ' ');
    places.push_back({std::move(name), scene.placement.position});
  }
  return places;
}

error::Expected<station::ServerSettings> settings_of(const runtime::ProgramOptions& options,
                                                     const StationOptions& station_options,
                                                     const radar::RadarConfiguration& configuration,
                                                     radar::TheatreFiles& files) {
  station::ServerSettings settings;
  settings.pages = station_options.pages;
  if (settings.pages.empty()) settings.pages = file::installed_folder("station");
  settings.address = station_options.listen;
  settings.access.port = static_cast<std::uint16_t>(station_options.port);
  settings.access.behind_proxy = station_options.behind_proxy;
  for (const std::string_view name : names_of(station_options))
    settings.access.names.push_back(station::lower_case(name));
  if (!station_options.without_tokens)
    if (auto used = use_tokens(station_options.tokens, settings.access); !used) return tl::unexpected(used.error());
  settings.certificate = station_options.certificate;
  settings.key = station_options.key;
  if (!settings.key.empty())
    if (auto secret = check_secret(settings.key, 007); !secret) return tl::unexpected(secret.error());
  const std::filesystem::path programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  settings.sets = {options.session,
                   programs,
                   std::filesystem::absolute(station_options.recordings),
                   options.config,
                   station_options.terrain,
                   station_options.start_script};
  const auto route = waypoints_of(station_options.source);
  if (!route) return tl::unexpected(route.error());
  const auto places = radar::guarded([&] { return places_of(files.scenes()); });
  if (!places) return tl::unexpected(places.error());
  settings.theatre = station::theatre_json(configuration, *places, *route)
                         .dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  return settings;
}

// The name or address in the printed addresses. All addresses of this computer: its first name, else loopback.
std::string printed_host(const station::ServerSettings& settings) {
  if (settings.address == "0.0.0.0" || settings.address == "::")
    return settings.access.names.empty() ? "127.0.0.1" : settings.access.names.front();
  return settings.address.find(':') == std::string::npos ? settings.address : '[' + settings.address + ']';
}

void print_addresses(const station::ServerSettings& settings, std::uint16_t port) {
  const std::string begin =
      (settings.certificate.empty() ? "http://" : "https://") + printed_host(settings) + ':' + std::to_string(port);
  const auto with = [](const std::string& token) { return token.empty() ? token : "?token=" + token; };
  std::printf("%s/display.html%s\n", begin.c_str(), with(settings.access.viewer_token).c_str());
  std::printf("%s/instructor.html%s\n", begin.c_str(), with(settings.access.instructor_token).c_str());
  std::fflush(stdout);
}

error::Expected<void> run(const runtime::ProgramOptions& options, const StationOptions& station_options) {
  if (auto good = check_access(station_options); !good) return good;
  auto configuration = config::load_program_configuration(options.config);
  if (!configuration) return tl::unexpected(configuration.error());
  if (!station_options.terrain.empty()) configuration->terrain.directory = station_options.terrain;
  radar::TheatreFiles files(configuration->terrain, configuration->world.scenes);
  auto terrain = radar::guarded([&] { return files.open_terrain(); });
  if (!terrain) return tl::unexpected(terrain.error());
  const auto settings = settings_of(options, station_options, *configuration, files);
  if (!settings) return tl::unexpected(settings.error());
  auto server = station::Server::listen(*settings, std::move(*terrain));
  if (!server) return tl::unexpected(server.error());
  print_addresses(*settings, server->port());
  while (!runtime::stop_requested()) server->step();
  runtime::end_in_order();
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine app("YARS station: serves the display and the instructor's page to browsers", "yars-station");
  runtime::ProgramOptions options;
  runtime::add_common_options(app, options, runtime::ProgramKind::service);
  StationOptions station_options;
  app.option("--port", station_options.port, "port to listen at; 0: any free one").range(0, 65535);
  app.option("--listen", station_options.listen, "address to listen at; 0.0.0.0: all").value_name("ADDRESS");
  app.option("--names", station_options.names,
             "names of this computer in the addresses of the pages, with commas between")
      .value_name("NAMES")
      .otherwise("none");
  app.option("--tokens", station_options.tokens,
             "file with the tokens of instructors and viewers; made if it is not there")
      .value_name("FILE")
      .otherwise("new ones at each start");
  app.flag("--without-tokens", station_options.without_tokens,
           "everybody who reaches the station is an instructor; at loopback only: every user of this computer");
  app.flag("--behind-proxy", station_options.behind_proxy,
           "believe X-Forwarded-Host, -Proto and -For; only where a proxy sets them");
  app.option("--certificate", station_options.certificate, "TLS certificate in PEM")
      .value_name("FILE")
      .otherwise("no TLS");
  app.option("--key", station_options.key, "private key of the certificate, in PEM")
      .value_name("FILE")
      .otherwise("no TLS");
  app.flag("--without-tls", station_options.without_tls, "listen beyond this computer without a certificate");
  app.option("--pages", station_options.pages, "folder of the pages").value_name("DIR").otherwise("the installed ones");
  app.option("--start-script", station_options.start_script, "script that starts a set which flies out of a recording")
      .value_name("FILE")
      .otherwise("that of the installation");
  app.option("--terrain", station_options.terrain, "folder of elevation cells, for the map")
      .value_name("DIR")
      .otherwise("the configuration's")
      .in_user_file();
  app.option("--source", station_options.source, "source of the flight; the map shows the waypoints of route:FILE")
      .value_name("SOURCE")
      .otherwise("no waypoints");
  app.option("--recordings", station_options.recordings, "folder of recordings").value_name("DIR");
  return runtime::run_program(argc, argv, app, options, [&] { return run(options, station_options); });
}
