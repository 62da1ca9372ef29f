// Observer of one host's segment, for tests over several hosts. Reads commands from standard input, one a line, and
// answers each with one JSON object.
// Commands: `state` what the segment shows now; `press NUMBER` puts an event with this number into an input lane of the
//   observer; `applied` numbers of the observers' events that were applied since the last call; `maps` patch maps with
//   the hash that they state and the one of their pixels; `ships NUMBER` takes the role traffic and reports ships;
//   `verdict` faults of all records so far (fault_injection::Watch).
// Units: times [ms]; sim time [ns].
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/session/picture_pool.hpp"
#include "databuffer/session/receivers.hpp"
#include "databuffer/session/session.hpp"
#include "databuffer/session/session_changes.hpp"
#include "runtime/process.hpp"
#include "tests/endtoend/fault_injection/watch.hpp"

namespace {

using namespace yars;
using nlohmann::json;

constexpr std::string_view kSource = "observer";

class Observer {
 public:
  explicit Observer(databuffer::Session session) : session_(std::move(session)) {
    applied_cursor_ = layout().applied_events.next();
  }

  json answer(const std::string& command) {
    session_.heartbeat();
    const auto space = command.find(' ');
    const std::string word = command.substr(0, space);
    if (word == "state") return state();
    if (word == "applied") return applied();
    if (word == "maps") return maps();
    if (word == "ships" && space != std::string::npos) return ships(command.substr(space + 1));
    if (word == "press" && space != std::string::npos) return press(command.substr(space + 1));
    return {{"error", "expected state, press NUMBER, applied, maps, ships NUMBER or verdict, found " + command}};
  }

 private:
  const databuffer::SessionLayout& layout() const { return session_.layout(); }

  json state() {
    const auto clock = session_.clock();
    const std::int64_t now_ns = session_.sim_time_ns();
    json result{{"epoch", clock.epoch},
                {"running", clock.running},
                {"rate", clock.rate},
                {"sim_ns", now_ns},
                {"monotonic_ns", databuffer::monotonic_ns()},
                {"sweeps", layout().sweeps.next()},
                {"ticks", layout().model_ticks.next()},
                {"machine", holder(databuffer::Role::state_machine)},
                {"model", holder(databuffer::Role::radar_model)}};
    if (const auto status = databuffer::read_valid(layout().model_status)) {
      result["model_tick"] = status->tick;
      result["model_epoch"] = status->epoch;
      result["model_sweeps"] = status->sweeps;
      result["scan"] = status->scan;
      result["stale"] = (status->flags & databuffer::kModelStale) != 0;
      result["model_age_ms"] = static_cast<double>(now_ns - status->sim_time_ns) * 1e-6;
    }
    if (const auto outputs = databuffer::read_valid(layout().outputs)) result["machine_tick"] = outputs->tick;
    if (const auto traffic = databuffer::read_valid(layout().traffic)) result["ships"] = traffic->count;
    result["ships_latched"] = layout().traffic_latched.next();
    if (const auto world = databuffer::world_in_effect(layout())) result["world"] = describe(*world);
    if (const auto world = databuffer::newest_world(layout())) result["world_newest"] = describe(*world);
    if (const auto network = databuffer::read_valid(layout().network_status)) result["network"] = describe(*network);
    return result;
  }

  static std::uint32_t number_in(const std::string& text) {
    std::uint32_t number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
  }

  // "none"; "here": a process of this host holds the role; "remote": the gateway holds it for another host.
  const char* holder(databuffer::Role role) const {
    const std::int32_t pid = session_.role_holder(role);
    if (pid == 0) return "none";
    return pid == session_.role_holder(databuffer::Role::gateway) ? "remote" : "here";
  }

  static json describe(const databuffer::NetworkStatus& network) {
    json hosts = json::object();
    for (std::uint32_t i = 0; i < network.host_count; ++i) {
      const auto& host = network.hosts[i];
      hosts[host.name] = {{"flags", host.flags},      {"roles", host.held_roles}, {"offset_ns", host.offset_ns},
                          {"lost", host.lost},        {"refused", host.refused},  {"error_ns", host.offset_error_ns},
                          {"repeated", host.repeated}};
    }
    return {{"joined", network.joined},
            {"load", network.load},
            {"hosts", hosts},
            {"takeovers", network.takeovers},
            {"conflicts", network.conflicts}};
  }

  static json describe(const databuffer::WorldState& world) {
    json rain = json::array();
    for (std::uint32_t i = 0; i < world.rain_count; ++i) rain.push_back(world.rain[i].id);
    return {{"edit", world.edit}, {"rain", rain}, {"configured", (world.flags & databuffer::kWorldConfigured) != 0U}};
  }

  // The number is what the driver looks for. The deflection tells the event from those of other programs.
  static double deflection_of(std::uint32_t number) { return 0.001 * (number % 1000); }

  json press(const std::string& text) {
    const std::uint32_t number = number_in(text);
    if (!lane_) {
      auto claim = session_.claim_input_lane(kSource);
      if (!claim) return {{"error", claim.error().message()}};
      lane_.emplace(std::move(*claim));
    }
    databuffer::InputEvent event{};
    event.session_time_ns = session_.sim_time_ns();
    event.monotonic_ns = databuffer::monotonic_ns();
    event.kind = static_cast<std::uint16_t>(databuffer::EventKind::tdc);
    event.number = number;
    event.x = deflection_of(number);
    return {{"pushed", session_.layout().input.push(static_cast<std::size_t>(lane_->lane()), event)}};
  }

  json applied() {
    json numbers = json::array();
    databuffer::AppliedEvent event{};
    std::uint64_t lost = 0;
    while (true) {
      const auto read = layout().applied_events.read(applied_cursor_, event);
      lost += read.lost;
      if (!read.delivered) break;
      const bool is_ours = event.event.kind == static_cast<std::uint16_t>(databuffer::EventKind::tdc) &&
                           event.event.number != 0 && event.event.x == deflection_of(event.event.number);
      const double latency_ms = 1e-6 * static_cast<double>(event.monotonic_ns - event.event.monotonic_ns);
      if (is_ours)
        numbers.push_back({event.event.number, latency_ms, event.tick, static_cast<std::int32_t>(event.lane)});
    }
    return {{"applied", numbers}, {"lost", lost}};
  }

  // Maps by id: hash of the record, hash of what is there.
  json maps() const {
    json result = json::object();
    databuffer::PatchMap map{};
    std::vector<std::uint8_t> pixels;
    for (const auto& slot : layout().patches) {
      const std::uint64_t id = slot.id.load();
      if (id != 0 && databuffer::read_patch(layout(), id, map, pixels))
        result[std::to_string(id)] = {map.hash, databuffer::map_hash(map, pixels)};
    }
    return result;
  }

  json ships(const std::string& text) {
    if (!traffic_) {
      auto claim = session_.claim(databuffer::Role::traffic);
      if (!claim) return {{"error", claim.error().message()}};
      traffic_.emplace(std::move(*claim));
    }
    databuffer::Traffic traffic{};
    traffic.count = std::min<std::uint32_t>(number_in(text), std::size(traffic.entities));
    traffic.epoch = session_.clock().epoch;
    for (std::uint32_t i = 0; i < traffic.count; ++i)
      traffic.entities[i] = {37.5 + 0.05 * i, -122.8, 5.0, 8.0, 10.0, 1e6, i + 1, 0};
    session_.layout().traffic.publish(traffic);
    return {{"ships", traffic.count}};
  }

  databuffer::Session session_;
  std::optional<databuffer::Claim> lane_;
  std::optional<databuffer::Claim> traffic_;
  std::uint64_t applied_cursor_ = 0;
};

json verdict_of(const endtoend::fault_injection::Watch& watch) {
  const auto verdict = watch.verdict();
  return {{"records", verdict.records},     {"torn", verdict.torn},   {"out_of_range", verdict.out_of_range},
          {"time_back", verdict.time_back}, {"first", verdict.first}, {"sweeps", watch.sweeps()}};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: observer SESSION\n");
    return 2;
  }
  auto session = databuffer::Session::open(argv[1], kSource);
  if (!session) {
    std::fprintf(stderr, "%s\n", session.error().message().c_str());
    return 1;
  }
  const endtoend::fault_injection::Watch watch(argv[1]);
  Observer observer(std::move(*session));
  std::string line;
  while (std::getline(std::cin, line))
    std::cout << (line == "verdict" ? verdict_of(watch) : observer.answer(line)).dump() << std::endl;
  return 0;
}
