// The program gateway: joins the session of this computer to those of other computers.

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "config/schema/load.hpp"
#include "config/schema/slot_text.hpp"
#include "gateway/app/gateway_shell.hpp"
#include "gateway/checks/computer_check.hpp"
#include "gateway/checks/identity_check.hpp"
#include "lib/log/log.hpp"
#include "runtime/process.hpp"
#include "runtime/program.hpp"

namespace {

using namespace yars;

struct GatewayOptions {
  std::string network;
  std::string terrain;
};

// Hash of a configuration's values. The folders of terrain and scenes are left out: they may differ between computers.
std::uint64_t configuration_hash(radar::RadarConfiguration configuration) {
  configuration.terrain.directory.clear();
  for (radar::Scene& scene : configuration.world.scenes)
    scene.file = std::filesystem::path(scene.file).filename().string();
  return gateway::host_id(config::print_configuration(configuration));
}

// Hash of the names and sizes of the files in a folder of elevation cells; 0: no folder.
std::uint64_t terrain_hash(const std::string& folder) {
  std::vector<std::string> lines;
  std::error_code code;
  for (std::filesystem::recursive_directory_iterator entry(folder, code), end; !code && entry != end;
       entry.increment(code))
    if (entry->is_regular_file(code))
      lines.push_back(entry->path().lexically_relative(folder).string() + ' ' + std::to_string(entry->file_size(code)) +
                      '\n');
  std::ranges::sort(lines);
  std::string text;
  for (const std::string& line : lines) text += line;
  return text.empty() ? 0 : gateway::host_id(text);
}

std::uint64_t random_number() {
  std::random_device source;
  return std::uint64_t{source()} << 32 | source() | 1U;
}

// Number of the segment, made by the first gateway that joins it.
std::uint64_t segment_number(databuffer::Session& session) {
  auto& number = session.layout().network.segment;
  std::uint64_t none = 0;
  number.compare_exchange_strong(none, random_number());
  return number.load();
}

// Compares the settings with this computer and its identity. Leaves only the peers that can be asked. Output: those of
// other computers.
error::Expected<std::vector<std::string>> check(radar::NetworkSettings& settings) {
  auto computer = gateway::checks::check_computer(settings);
  if (!computer) return tl::unexpected(computer.error());
  for (const std::string& warning : computer->warnings) log::warning(warning);
  settings.peers = std::move(computer->known_peers);
  if (settings.security.empty()) return std::move(computer->other_peers);
  const auto warnings = gateway::checks::check_identity(settings.security, settings.name);
  if (!warnings) return tl::unexpected(warnings.error());
  for (const std::string& warning : *warnings) log::warning(warning);
  return std::move(computer->other_peers);
}

// What the gateway needs each time that it joins.
struct Joining {
  radar::NetworkSettings settings;
  std::vector<std::string> peers;  // addresses of other computers
  gateway::Identity identity;      // without what differs from time to time
  gateway::dds::RejoinLimit rejoins;
};

// Joins the session, until the program is to end. Output: true: join again, because a handshake was lost.
error::Expected<bool> join(const runtime::ProgramOptions& options, Joining& joining) {
  auto session = databuffer::Session::open(options.session, "gateway");
  if (!session) return tl::unexpected(session.error());
  const auto role = session->claim(databuffer::Role::gateway);
  if (!role) return tl::unexpected(error::usage_error(role.error()));
  auto link = gateway::dds::Link::open(joining.settings, options.session);
  if (!link) return tl::unexpected(link.error());
  gateway::Identity identity = joining.identity;
  identity.start = random_number();
  identity.segment = segment_number(*session);
  log::info("host " + identity.name + " joins session " + options.session + ", DDS domain " +
            std::to_string(joining.settings.domain) + (joining.settings.security.empty() ? "" : ", encrypted"));
  gateway::GatewayShell shell(*session, options.session, std::move(*link), joining.settings, std::move(identity));
  shell.set_asked(joining.peers);
  while (!runtime::stop_requested()) {
    shell.step();
    if (shell.lost_handshake().empty() || !joining.rejoins.take(databuffer::monotonic_ns())) continue;
    log::warning("the handshake with the gateway of " + shell.lost_handshake() +
                 " was lost, as on a bad line: joins again");
    shell.finish();
    return true;
  }
  runtime::end_in_order();
  shell.finish();
  return false;
}

error::Expected<void> run(const runtime::ProgramOptions& options, const GatewayOptions& gateway_options) {
  auto loaded = config::load_network(gateway_options.network, options.config);
  if (!loaded) return tl::unexpected(loaded.error());
  radar::NetworkSettings& settings = loaded->network;
  radar::RadarConfiguration& configuration = loaded->radar;
  if (settings.name.empty()) settings.name = gateway::checks::host_name();
  auto peers = check(settings);
  if (!peers) return tl::unexpected(peers.error());
  if (gateway_options.network.empty())
    log::info(loaded->source.empty() ? "no form Network: this computer alone, over the loopback interface"
                                     : "form Network of " + loaded->source);
  if (!gateway_options.terrain.empty()) configuration.terrain.directory = gateway_options.terrain;
  Joining joining{std::move(settings), std::move(*peers), {}, {}};
  joining.identity.name = joining.settings.name;
  joining.identity.priority = static_cast<std::uint32_t>(joining.settings.priority);
  joining.identity.configuration_hash = configuration_hash(configuration);
  joining.identity.terrain_hash = terrain_hash(configuration.terrain.directory);
  for (;;) {
    const auto again = join(options, joining);
    if (!again) return tl::unexpected(again.error());
    if (!*again) return {};
  }
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine app("YARS gateway: joins the session of this computer to those of other computers", "gateway");
  runtime::ProgramOptions options;
  runtime::add_common_options(app, options, runtime::ProgramKind::service);
  GatewayOptions gateway_options;
  app.option("--network", gateway_options.network, "GUF file with the form Network: peers, interfaces, domain")
      .value_name("FILE")
      .otherwise("that of the configuration, else this computer alone, over the loopback interface");
  app.option("--terrain", gateway_options.terrain, "folder of elevation cells, compared with that of other computers")
      .value_name("DIR")
      .otherwise("the configuration's");
  return runtime::run_program(argc, argv, app, options, [&] { return run(options, gateway_options); });
}
