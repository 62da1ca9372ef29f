// `yars status`: a session's health for people, as JSON, or the segment's layout.
#include <cstdio>
#include <string>
#include <vector>

#include "databuffer/layout_json.hpp"
#include "databuffer/session.hpp"
#include "tools/command.hpp"
#include "tools/process_load.hpp"
#include "tools/status_json.hpp"
#include "tools/status_text.hpp"

namespace yars::tools {

namespace {

using nlohmann::ordered_json;

struct StatusOptions {
  bool json = false;
  bool layout = false;
};

// Nobody to ask: the verdict is the same word as of a session that is there.
[[noreturn]] void print_nothing_runs(const failure::Error& error) {
  std::printf("NOTHING RUNS: %s\n", error.found.c_str());
  give_up(error);
}

// For scripts: 0 OK, 1 nothing runs, 3 degraded.
void leave_with(const ordered_json& health) {
  constexpr int kExitDegraded = 3;
  std::fflush(stdout);
  if (health["state"] == "DEGRADED") throw CommandFailed{"", kExitDegraded};
  if (health["state"] != "OK") throw CommandFailed{"", 1};
}

void status(const CommonOptions& common, const StatusOptions& options) {
  if (options.layout) {
    std::printf("%s\n", databuffer::layout_json().c_str());
    return;
  }
  const auto session = databuffer::Session::open_read_only(common.session);
  if (!session && !options.json) print_nothing_runs(session.error());
  if (!session) give_up(session.error());
  const auto object = status_json(*session, common.session);
  if (options.json) {
    std::printf("%s\n", object.dump(2, ' ', false, ordered_json::error_handler_t::replace).c_str());
    return leave_with(object["health"]);
  }
  std::vector<int> pids;
  for (const auto& process : session->processes()) pids.push_back(process.pid);
  print_status(object, measure_loads(pids));
  leave_with(object["health"]);
}

}  // namespace

void add_status_command(CLI::App& app, const CommonOptions& common) {
  auto* command = app.add_subcommand("status", "health of a session");
  auto options = std::make_shared<StatusOptions>();
  command->add_flag("--json", options->json, "as JSON");
  command->add_flag("--layout", options->layout, "offsets of every record in the segment, as JSON; needs no session");
  command->callback([&common, options] { status(common, *options); });
}

}  // namespace yars::tools
