#include <chrono>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "databuffer/json/status_json.hpp"
#include "databuffer/session/layout_json.hpp"
#include "databuffer/session/session.hpp"
#include "lib/log/log.hpp"
#include "runtime/process.hpp"
#include "runtime/processor_load.hpp"
#include "runtime/program.hpp"
#include "tools/command/command.hpp"
#include "tools/session/status_text.hpp"

namespace yars::tools {

// `yars status`: prints a session's health as text or JSON, or the segment's layout.

namespace {

constexpr std::chrono::milliseconds kLoadWindow{100};  // duration of the load measurement

struct StatusOptions {
  bool json = false;
  bool layout = false;
};

// Reports that the session cannot be opened, usually because it does not exist, and ends the command.
[[noreturn]] void print_nothing_runs(const error::Error& error) {
  std::printf("NOTHING RUNS: %s\n", error.found.c_str());
  throw_failure(error);
}

// Sets the exit code: 0 OK, 3 degraded, 1 otherwise. Throws CommandFailed unless OK.
void exit_by_health(const databuffer::Health& health) {
  constexpr int kExitDegraded = 3;
  std::fflush(stdout);
  if (health.verdict == databuffer::Verdict::degraded) throw CommandFailed{"", kExitDegraded};
  if (health.verdict != databuffer::Verdict::ok) throw CommandFailed{"", 1};
}

void status(const CommonOptions& common, const StatusOptions& options) {
  if (options.layout) {
    std::printf("%s\n", databuffer::layout_json().c_str());
    return;
  }
  const auto session = databuffer::Session::open_read_only(common.session);
  if (!session && !options.json) print_nothing_runs(session.error());
  if (!session) throw_failure(session.error());
  const databuffer::Status found = databuffer::status_of(*session, common.session);
  if (options.json) {
    print_json(databuffer::status_json(found), JsonLines::many);
    return exit_by_health(found.health);
  }
  std::vector<int> pids;
  for (const auto& process : session->processes()) pids.push_back(process.pid);
  runtime::LoadMeter meter;
  meter.loads(pids);
  std::this_thread::sleep_for(kLoadWindow);
  print_status(found, meter.loads(pids));
  exit_by_health(found.health);
}

}  // namespace

void add_status_command(runtime::Command app, const CommonOptions& common) {
  runtime::Command command = app.subcommand("status", "health of a session and of the hosts that share it");
  auto options = std::make_shared<StatusOptions>();
  add_json_flag(command, options->json);
  command.flag("--layout", options->layout, "offsets of every record in the segment, as JSON; needs no session");
  command.callback([&common, options] { status(common, *options); });
}

// `yars watch`: prints the state of a session on each change of the radar state, at least once a second.

namespace {

constexpr std::int64_t kWatchInterval_ns = 20'000'000;  // 20 ms: maximum delay of a printed change
constexpr std::int64_t kMaxInterval_ns =
    1'000'000'000;  // 1 s: maximum time between lines; position and sweeps change without a new radar state

struct WatchOptions {
  bool json = false;
  bool once = false;
};

// Returns false when standard output is closed.
bool print(const databuffer::Watch& watch, bool json) {
  if (json)
    print_json(databuffer::watch_json(watch));
  else
    print_watch(watch);
  return std::fflush(stdout) == 0;
}

void watch(const CommonOptions& common, const WatchOptions& options) {
  const auto session = databuffer::Session::open_read_only(common.session);
  if (!session) throw_failure(session.error());
  std::uint64_t printed_version = ~0ULL;
  std::int64_t printed_ns = 0;
  while (!runtime::stop_requested()) {
    const std::uint64_t version = session->layout().radar_state.version();
    const std::int64_t now_ns = databuffer::monotonic_ns();
    if (version != printed_version || now_ns - printed_ns >= kMaxInterval_ns) {
      printed_version = version;
      printed_ns = now_ns;
      if (!print(databuffer::watch_of(*session), options.json)) return;
    }
    if (options.once) return;
    if (session->processes().empty()) {
      log::info("session " + common.session + " has ended");
      return;
    }
    const timespec pause{0, kWatchInterval_ns};
    nanosleep(&pause, nullptr);
  }
}

}  // namespace

void add_watch_command(runtime::Command app, const CommonOptions& common) {
  runtime::Command command =
      app.subcommand("watch", "print the session's state: one line per change, at least one per second");
  auto options = std::make_shared<WatchOptions>();
  add_json_flag(command, options->json, "print one JSON object a line in place of text");
  command.flag("--once", options->once, "print one line and end");
  command.callback([&common, options] { watch(common, *options); });
}

}  // namespace yars::tools
