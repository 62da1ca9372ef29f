// `yars watch`: the state of a session as it changes.
#include <cmath>
#include <cstdio>
#include <ctime>

#include "databuffer/log.hpp"
#include "databuffer/program.hpp"
#include "databuffer/session.hpp"
#include "tools/command.hpp"
#include "tools/watch_json.hpp"

namespace yars::tools {

namespace {

constexpr std::int64_t kLook_ns = 20'000'000;        // [ns] between looks: a change is printed within it
constexpr std::int64_t kAtLeast_ns = 1'000'000'000;  // [ns] position and antenna are printed so often without a change

struct WatchOptions {
  bool json = false;
  bool once = false;
};

// Marks, cue and target, those that there are.
void print_designations(const nlohmann::ordered_json& object) {
  if (!object["marks"].empty()) std::printf("  MARKS %zu", object["marks"].size());
  const auto& cue = object["cue"];
  const auto degrees = [](const nlohmann::ordered_json& value) {
    return value.is_null() ? std::nan("") : value.get<double>();
  };
  if (!cue.is_null()) std::printf("  CUE %.4f %.4f", degrees(cue["lat"]), degrees(cue["lon"]));
  const auto& target = object["target"];
  if (target.is_null()) return;
  std::printf("  TGT %s", target["name"].get<std::string>().c_str());
  const auto& ranging = object["ranging"];
  if (!ranging.is_null())
    std::printf(" %.1f NM %03.0f true %.1f down", degrees(ranging["slant_range_nm"]),
                degrees(ranging["bearing_true_deg"]), degrees(ranging["depression_deg"]));
}

void print_line_for_people(const nlohmann::ordered_json& object) {
  const auto& own = object["ownship"];
  std::printf("%9.2f s  %-4s %-5s %5.1f NM %-4s GAIN %d %s%s%s", object["sim_time"].get<double>(),
              object["power"].get<std::string>().c_str(), object["mode"].get<std::string>().c_str(),
              object["range_nm"].get<double>(), object["scan"].get<std::string>().c_str(), object["gain"].get<int>(),
              object["freeze"].get<bool>() ? "FREEZE " : "", object["sniff"].get<bool>() ? "SNIFF " : "",
              object["message"].get<std::string>().c_str());
  if (!own.is_null())
    std::printf("  %.4f %.4f %.0f ft %.0f deg %.0f kt", own["lat"].get<double>(), own["lon"].get<double>(),
                own["alt_ft"].get<double>(), own["track_deg"].get<double>(), own["ground_speed_kt"].get<double>());
  print_designations(object);
  std::printf("  sweeps %llu\n", static_cast<unsigned long long>(object["sweeps"].get<std::uint64_t>()));
}

// False when nobody reads any more.
bool print(const nlohmann::ordered_json& object, bool json) {
  if (json)
    std::printf("%s\n", object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
  else
    print_line_for_people(object);
  return std::fflush(stdout) == 0;
}

void watch(const CommonOptions& common, const WatchOptions& options) {
  const auto session = databuffer::Session::open_read_only(common.session);
  if (!session) give_up(session.error());
  std::uint64_t seen = ~0ULL;
  std::int64_t printed_ns = 0;
  while (!databuffer::stop_requested()) {
    const std::uint64_t version = session->layout().radar_state.version();
    const std::int64_t now_ns = databuffer::monotonic_ns();
    if (version != seen || now_ns - printed_ns >= kAtLeast_ns) {
      seen = version;
      printed_ns = now_ns;
      if (!print(watch_object(*session), options.json)) return;
    }
    if (options.once) return;
    if (session->processes().empty()) {
      databuffer::log_info("session " + common.session + " has ended");
      return;
    }
    const timespec pause{0, kLook_ns};
    nanosleep(&pause, nullptr);
  }
}

}  // namespace

void add_watch_command(CLI::App& app, const CommonOptions& common) {
  auto* command = app.add_subcommand("watch", "the session's state as it changes, one line each");
  auto options = std::make_shared<WatchOptions>();
  command->add_flag("--json", options->json, "one JSON object a line");
  command->add_flag("--once", options->once, "print one line and end");
  command->callback([&common, options] { watch(common, *options); });
}

}  // namespace yars::tools
