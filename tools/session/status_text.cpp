#include "tools/session/status_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/session/receivers.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::tools {

namespace {

using databuffer::FrameStatus;
using databuffer::HostSummary;
using databuffer::LaneStatus;
using databuffer::NetworkSummary;
using databuffer::RoleStatus;
using databuffer::Status;
using databuffer::TrafficSource;

constexpr std::size_t kNotesShown = 10;  // the newest notes that the text shows; --json has all

// Text that other programs wrote, without characters that could control the terminal.
std::string shown(std::string_view given) {
  std::string words(given);
  std::replace_if(words.begin(), words.end(), [](char letter) { return letter < ' ' || letter > '~'; }, '?');
  return words;
}

// For %llu.
unsigned long long number(std::uint64_t value) {
  return value;
}

template <class Texts>
std::string joined(const Texts& texts, const char* between) {
  std::string all;
  for (const auto& one : texts) all += (all.empty() ? "" : between) + shown(one);
  return all;
}

double ground_speed_kt(const databuffer::Ownship& own) {
  return geo::Speed::metres_per_second(std::hypot(own.velocity_north_mps, own.velocity_east_mps)).knots();
}

std::string age_text(double seconds) {
  std::array<char, 32> buffer;
  if (seconds < 1.0)
    std::snprintf(buffer.data(), buffer.size(), "%.0f ms", 1000.0 * seconds);
  else if (seconds < 120.0)
    std::snprintf(buffer.data(), buffer.size(), "%.1f s", seconds);
  else if (seconds < 7200.0)
    std::snprintf(buffer.data(), buffer.size(), "%.0f min", seconds / 60.0);
  else
    std::snprintf(buffer.data(), buffer.size(), "%.1f h", seconds / 3600.0);
  return buffer.data();
}

std::string load_text(double fraction) {
  std::array<char, 32> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%.1f %%", 100.0 * fraction);
  return buffer.data();
}

void print_verdict(const Status& status) {
  const bool is_frozen = status.watch.clock.running == 0;
  std::string reasons = joined(status.health.reasons, "; ");
  if (reasons.empty()) reasons = is_frozen ? "the set runs, its sim time is frozen: yars sim run" : "the set runs";
  std::printf("%s: %s\n", std::string(databuffer::name_of(status.health.verdict)).c_str(), reasons.c_str());
  std::printf("session %s: sim time %.1f s, %s, rate %g, epoch %u\n", shown(status.session).c_str(),
              static_cast<double>(status.watch.sim_time_ns) * 1e-9, is_frozen ? "frozen" : "running",
              status.watch.clock.rate, status.watch.clock.epoch);
}

// [ms] with the unit that suits.
std::string interval_text(double interval_ms) {
  std::array<char, 32> buffer;
  if (std::abs(interval_ms) < 1.0)
    std::snprintf(buffer.data(), buffer.size(), "%.0f us", 1000.0 * interval_ms);
  else if (std::abs(interval_ms) < 1000.0)
    std::snprintf(buffer.data(), buffer.size(), "%.1f ms", interval_ms);
  else
    std::snprintf(buffer.data(), buffer.size(), "%.3f s", interval_ms / 1000.0);
  return buffer.data();
}

// Pid 0 and no heartbeat stand for a role of another host that this host's gateway does not keep.
void print_roles(const Status& status, const std::map<int, double>& loads) {
  const auto& network = status.network;
  const auto self = network && !network->hosts.empty() ? std::optional(network->hosts.front().name) : std::nullopt;
  std::printf("  %-20s %8s %10s %8s %9s\n", "role", "pid", "heartbeat", "load", "restarts");
  for (const RoleStatus& role : status.roles) {
    const bool is_remote = role.host && role.host != self;
    const auto load = is_remote ? loads.end() : loads.find(role.pid);
    const std::string beat = role.pid == 0 ? "none" : age_text(role.heartbeat_ms.value_or(0.0) / 1000.0);
    std::printf("  %-20s %8s %10s %8s %9llu%s%s\n", shown(role.name).c_str(),
                role.pid == 0 ? "-" : std::to_string(role.pid).c_str(), beat.c_str(),
                load == loads.end() ? "-" : load_text(load->second).c_str(), number(role.restarts),
                role.hangs ? "  hangs" : "", is_remote ? ("  on " + shown(*role.host)).c_str() : "");
  }
}

void print_host(const HostSummary& host) {
  std::string more = joined(host.roles, ", ");
  const auto add = [&more](const std::string& words) { more += (more.empty() ? "" : "; ") + words; };
  if (host.owns_clock) add("sets the clock");
  if (!host.differences.empty()) add(joined(host.differences, ", "));
  const std::string heard =
      host.present ? "yes" : (host.left ? "left " : "silent ") + age_text(host.silent_s.value_or(0.0));
  const bool is_measured = !host.self && host.offset_ms;
  std::printf("  %-20s %-14s %14s %10s %10s %8llu %8llu %9llu  %s\n",
              (shown(host.name) + (host.self ? " *" : "")).c_str(), host.self ? "this host" : heard.c_str(),
              is_measured ? interval_text(*host.offset_ms).c_str()
              : host.self ? "-"
                          : "unknown",
              is_measured ? interval_text(host.offset_error_ms.value_or(0.0)).c_str() : "-",
              host.self ? "-" : interval_text(host.latency_ms).c_str(), number(host.lost), number(host.refused),
              number(host.repeated), more.c_str());
}

void print_network(const std::optional<NetworkSummary>& network) {
  if (!network) return;
  std::printf("hosts:\n  %-20s %-14s %14s %10s %10s %8s %8s %9s  %s\n", "name", "heard", "offset", "error", "latency",
              "lost", "refused", "repeated", "roles");
  for (const HostSummary& host : network->hosts) print_host(host);
  std::printf("gateway: DDS domain %u, %s, %s of a core, %s, %s\n", network->domain,
              network->secured ? "encrypted" : "not encrypted", load_text(network->load).c_str(),
              text::counted(network->takeovers, "takeover").c_str(),
              text::counted(network->conflicts, "conflict").c_str());
}

void print_ownship(const Status& status) {
  const auto& model = status.watch.model;
  const auto& own = model.ownship;
  if (!status.watch.has_ownship())
    std::printf("ownship: none\n");
  else
    std::printf("ownship: %s, %.4f %.4f, %.0f ft MSL, track %.0f deg, %.0f kt, %s old\n",
                shown(databuffer::name_of_source(own, model.ownship_lane)).c_str(), own.latitude_deg, own.longitude_deg,
                own.altitude_msl_m / geo::kMetresPerFoot, databuffer::ground_track_of(own).degrees(),
                ground_speed_kt(own),
                age_text(static_cast<double>(status.watch.sim_time_ns - model.ownship_received_ns) * 1e-9).c_str());
  for (const LaneStatus& lane : status.ownship_lanes)
    std::printf("  lane %zu: %s, priority %u, %s so far\n", lane.lane, shown(lane.source).c_str(), lane.priority,
                text::counted(lane.records, "record").c_str());
}

// What the display says, each with its remedy. Power OFF shows NO STATE MACHINE alone.
void print_display_words(const Status& status) {
  const auto say = [](const std::string& words, const std::string& remedy) {
    std::printf("display says: %s%s%s\n", words.c_str(), remedy.empty() ? "" : "; ", remedy.c_str());
  };
  const bool state_machine = status.runs("state-machine"), model = status.runs("radar-model");
  if (!state_machine) say("NO STATE MACHINE", databuffer::kRemedyNoStateMachine);
  if (static_cast<radar::Power>(status.watch.radar.power) == radar::Power::off) return;
  if (!model) say("NO MODEL", databuffer::kRemedyNoModel);
  if (model && !status.watch.has_ownship()) say("NO OWNSHIP", databuffer::kRemedyNoOwnship);
  const std::string message = shown(text::text_of(status.watch.radar.message));
  if (state_machine && !message.empty() && message != "NO OWNSHIP")
    say(message, shown(text::text_of(status.watch.advice.remedy)));
}

void print_radar(const Status& status) {
  const auto& state = status.watch.radar;
  const auto& model = status.watch.model;
  const std::string fidelity = shown(text::text_of(model.fidelity));
  std::printf("radar: %s %s, %.1f NM, fidelity %s, kernel %s of a core, %s, terrain %.1f MB\n",
              std::string(radar::name_of(static_cast<radar::Power>(state.power))).c_str(),
              std::string(radar::name_of(static_cast<radar::Mode>(state.mode))).c_str(), state.range_nm,
              fidelity.empty() ? "unknown" : fidelity.c_str(), load_text(model.load).c_str(),
              text::counted(model.sweeps, "sweep").c_str(), static_cast<double>(model.terrain_bytes) / 1e6);
  print_display_words(status);
}

// "writing", "not writing", "wind speed 5 m/s", "20.1 MB"; empty: no value.
std::string words_of(const databuffer::ShownField& field) {
  std::string stem(field.stem);
  std::ranges::replace(stem, '_', ' ');
  return std::visit(
      [&](const auto& value) -> std::string {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, bool>) {
          return (value ? "" : "not ") + stem;
        } else if constexpr (std::is_same_v<Value, std::string>) {
          return shown(value);
        } else {
          const bool is_size = field.unit == "bytes";
          if (std::isnan(static_cast<double>(value))) return {};
          std::array<char, 32> buffer;
          std::snprintf(buffer.data(), buffer.size(),
                        is_size                         ? "%.1f MB"
                        : std::is_same_v<Value, double> ? "%g"
                                                        : "%.0f",
                        static_cast<double>(value) * (is_size ? 1e-6 : 1.0));
          if (is_size) return buffer.data();
          return stem + ' ' + buffer.data() + (field.unit.empty() ? "" : " ") + std::string(field.unit);
        }
      },
      field.value);
}

void print_records(const std::vector<databuffer::ShownRecord>& records) {
  for (const auto& record : records) {
    std::string words;
    for (const auto& field : record.fields)
      if (const std::string more = words_of(field); !more.empty()) words += (words.empty() ? "" : ", ") + more;
    if (!record.fields.empty()) std::printf("%s: %s\n", std::string(record.name).c_str(), words.c_str());
  }
}

void print_frames(const std::optional<FrameStatus>& frames) {
  if (!frames) return;
  std::printf(
      "frames of the display: %s, newest %llu, %u x %u pixels\n",
      frames->publisher == 0 ? "nobody publishes" : ("pid " + std::to_string(frames->publisher) + " publishes").c_str(),
      number(frames->newest.id), frames->newest.width, frames->newest.height);
}

void print_tour(const std::optional<databuffer::Caption>& caption) {
  if (!caption) return;
  std::string words;
  for (const auto& line : caption->lines)
    if (line.text[0] != '\0') words += (words.empty() ? "" : " ") + shown(text::text_of(line.text));
  std::printf("tour: step %u of %u%s: %s\n", caption->step, caption->steps,
              caption->waiting != 0 ? ", waits for the pilot (key n goes on)" : "", words.c_str());
}

void print_traffic(const std::optional<TrafficSource>& traffic) {
  if (!traffic) return;
  std::printf("traffic: pid %d reports %s\n", traffic->pid,
              text::counted(traffic->entities, "ship or vehicle", "ships and vehicles").c_str());
}

void print_notes(const Status& status) {
  std::printf("flight recorder:");
  for (std::uint32_t kind = 0; kind < status.note_counts.size(); ++kind)
    std::printf("%s%s %llu", kind == 0 ? " " : ", ", databuffer::note_name(kind), number(status.note_counts[kind]));
  if (status.notes_folded > 0)
    std::printf("; %llu repeated notes are counted, not listed", number(status.notes_folded));
  std::printf("\n");
  const auto& notes = status.notes;
  for (std::size_t i = notes.size() > kNotesShown ? notes.size() - kNotesShown : 0; i < notes.size(); ++i)
    std::printf("  %7s ago  %-14s %-11s %s\n",
                age_text(static_cast<double>(status.watch.monotonic_ns - notes[i].monotonic_ns) * 1e-9).c_str(),
                shown(text::text_of(notes[i].process)).c_str(), databuffer::note_name(notes[i].kind),
                shown(text::text_of(notes[i].text)).c_str());
}

}  // namespace

void print_status(const Status& status, const std::map<int, double>& loads) {
  print_verdict(status);
  print_roles(status, loads);
  print_network(status.network);
  print_ownship(status);
  print_radar(status);
  print_records(status.records);
  print_frames(status.frames);
  print_traffic(status.traffic);
  print_tour(status.watch.caption);
  print_notes(status);
}

namespace {

// Prints marks, cue and target, if they exist.
void print_designations(const databuffer::RadarState& state, const databuffer::Outputs& outputs) {
  if (state.mark_count > 0) std::printf("  MARKS %d", state.mark_count);
  if (state.cue_count > 0) std::printf("  CUE %.4f %.4f", state.cue_latitude_deg, state.cue_longitude_deg);
  if ((state.flags & databuffer::kTargetDesignated) == 0U) return;
  std::printf("  TGT %s", shown(text::text_of(state.target_name)).c_str());
  if (std::isfinite(outputs.slant_range_m))
    std::printf(" %.1f NM %03.0f true %.1f down", outputs.slant_range_m / geo::kMetresPerNauticalMile,
                outputs.bearing_deg, outputs.depression_deg);
}

// The message with its remedy: "BLIND ZONE (turn 5 deg or more left)".
std::string message_text(const databuffer::Watch& watch) {
  const std::string message = shown(text::text_of(watch.radar.message));
  const std::string remedy = shown(text::text_of(watch.advice.remedy));
  return message.empty() || remedy.empty() ? message : message + " (" + remedy + ")";
}

}  // namespace

void print_watch(const databuffer::Watch& watch) {
  const auto& state = watch.radar;
  const auto& own = watch.model.ownship;
  const auto flag = [&](std::uint32_t bit, const char* word) { return (state.flags & bit) != 0U ? word : ""; };
  std::printf("%9.2f s  %-4s %-5s %5.1f NM %-4s GAIN %d %s%s%s", static_cast<double>(watch.sim_time_ns) * 1e-9,
              std::string(radar::name_of(static_cast<radar::Power>(state.power))).c_str(),
              std::string(radar::name_of(static_cast<radar::Mode>(state.mode))).c_str(), state.range_nm,
              std::string(radar::name_of(static_cast<radar::ScanWidth>(state.scan))).c_str(), state.gain,
              flag(databuffer::kFreeze, "FREEZE "), flag(databuffer::kSniff, "SNIFF "), message_text(watch).c_str());
  if (watch.has_ownship())
    std::printf("  %.4f %.4f %.0f ft MSL track %.0f deg %.0f kt", own.latitude_deg, own.longitude_deg,
                own.altitude_msl_m / geo::kMetresPerFoot, databuffer::ground_track_of(own).degrees(),
                ground_speed_kt(own));
  print_designations(state, watch.outputs);
  std::printf("  sweeps %llu\n", number(watch.model.sweeps));
}

}  // namespace yars::tools
