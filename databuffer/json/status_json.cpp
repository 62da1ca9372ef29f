#include "databuffer/json/status_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <variant>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/session/receivers.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

namespace {

using nlohmann::ordered_json;
using text::text_of;

template <class Value>
ordered_json value_or_null(const std::optional<Value>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

// JSON has no NaN, so an unknown value (NaN) becomes null.
ordered_json number_or_null(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

bool has(const RadarState& state, std::uint32_t flag) {
  return (state.flags & flag) != 0U;
}

void add_clock(ordered_json& object, const Watch& watch) {
  object["sim_time"] = static_cast<double>(watch.sim_time_ns) * 1e-9;
  object["epoch"] = watch.clock.epoch;
  object["tick"] = watch.model.tick;
  object["rate"] = watch.clock.rate;
  object["running"] = watch.clock.running != 0;
}

void add_switches(ordered_json& object, const RadarState& state) {
  object["power"] = radar::name_of(static_cast<radar::Power>(state.power));
  object["mode"] = radar::name_of(static_cast<radar::Mode>(state.mode));
  object["master"] = radar::name_of(static_cast<radar::Master>(state.master));
  object["range_nm"] = state.range_nm;
  object["scan"] = radar::name_of(static_cast<radar::ScanWidth>(state.scan));
  object["gain"] = state.gain;
  object["brightness"] = state.brightness;
  object["contrast"] = state.contrast;
  object["declutter"] = has(state, kDeclutter);
  object["freeze"] = has(state, kFreeze);
  object["sniff"] = has(state, kSniff);
  object["ipvu"] = has(state, kIpvu);
  object["vtr"] = has(state, kVtr);
  object["set"] = has(state, kSet);
  object["menu"] = has(state, kMenu);
}

// The north from which bearing and heading of the display count: magnetic, or true while no variation is known.
const char* north_of(const RadarState& state) {
  return has(state, kVariationKnown) ? "magnetic" : "true";
}

void add_cursor(ordered_json& object, const RadarState& state) {
  object["cursor_function"] = radar::name_of(static_cast<radar::CursorFunction>(state.cursor_function));
  if (!has(state, kCursorValid)) {
    object["cursor"] = nullptr;
    return;
  }
  object["cursor"] = {{"bearing_deg", number_or_null(state.cursor_bearing_deg)},
                      {"north", north_of(state)},
                      {"range_nm", number_or_null(state.cursor_range_nm)},
                      {"lat", number_or_null(state.cursor_believed_latitude_deg)},
                      {"lon", number_or_null(state.cursor_believed_longitude_deg)},
                      {"elevation_ft", number_or_null(state.cursor_elevation_m / geo::kMetresPerFoot)}};
}

ordered_json recall_word(const RadarState& state) {
  switch (static_cast<radar::Recall>(state.recall)) {
    case radar::Recall::newest:
      return "NEW";
    case radar::Recall::old:
      return "OLD";
    case radar::Recall::store:
      return "STORE";
    default:
      return nullptr;
  }
}

void add_map(ordered_json& object, const RadarState& state) {
  object["window_nm"] = state.window_nm > 0.0 ? ordered_json(state.window_nm) : ordered_json(nullptr);
  object["multi_look"] = has(state, kMultiLook2) ? "ML2" : "ML1";
  object["stabilizing"] = has(state, kProgressive) ? "PROG" : "STAB";
  object["recall"] = recall_word(state);
  object["message"] = text_of(state.message);
}

// Result of the cursor function UPDT: distance from the displayed selected point to the cursor; null while there is
// none. Unit as on the display: feet up to 3000 ft, NM beyond. `valid` false: the display shows INV instead.
ordered_json update_error(const RadarState& state) {
  if (!has(state, kUpdateShown)) return nullptr;
  const auto distance = geo::Length::metres(std::hypot(state.update_north_m, state.update_east_m));
  const bool far = distance.feet() > kUpdateErrorInFeet;
  const bool ages = state.update_seconds >= 0;
  return {{"value", far ? distance.nautical_miles() : distance.feet()},
          {"unit", far ? "NM" : "ft"},
          {"valid", !has(state, kUpdateInvalid)},
          {"seconds", ages ? ordered_json(state.update_seconds) : ordered_json(nullptr)}};
}

// Pattern steering line (PSL): the heading on which the target is approached; null if there is none. `heading_deg`
// counts from the north that `north` names.
ordered_json steering_line(const RadarState& state) {
  const auto heading = geo::Bearing::degrees(state.steering_line_deg - state.magnetic_variation_deg);
  const auto object = [&](const char* word) {
    return ordered_json{{"heading_deg", heading.degrees()}, {"north", north_of(state)}, {"state", word}};
  };
  switch (static_cast<SteeringLine>(state.steering_line)) {
    case SteeringLine::line_of_sight:
      return object("LOS");
    case SteeringLine::slewing:
      return object("SLEW");
    case SteeringLine::fixed:
      return object("FIXED");
    case SteeringLine::none:
      break;
  }
  return nullptr;
}

void add_navigation(ordered_json& object, const RadarState& state) {
  object["channel"] = state.channel;
  object["band"] = std::string(1, static_cast<char>('A' + state.band));
  object["sequence_point"] = text_of(state.sequence_point);
  ordered_json drawn = ordered_json::array();
  for (int i = 0; i < state.points_drawn && i < radar::kMaxPointsDrawn; ++i)
    drawn.push_back(text_of(state.points[i].name));
  object["points_drawn"] = drawn;
  object["nav_source"] = radar::name_of(static_cast<radar::Navigator>(state.navigator));
  object["update_error"] = update_error(state);
  object["psl"] = steering_line(state);
}

// A stored position: elevation MSL; latitude and longitude in the coordinates of the navigator then in use, which
// contain its error.
ordered_json position_json(double latitude_deg, double longitude_deg, double elevation_m) {
  return {{"lat", number_or_null(latitude_deg)},
          {"lon", number_or_null(longitude_deg)},
          {"elevation_ft", number_or_null(elevation_m / geo::kMetresPerFoot)}};
}

// Positions stored by the cursor functions CUE, TGT and MARK.
void add_designations(ordered_json& object, const RadarState& state) {
  ordered_json marks = ordered_json::array();
  for (const Mark& mark : std::span(state.marks).first(std::min<std::size_t>(state.mark_count, kMarks))) {
    ordered_json entry = position_json(mark.latitude_deg, mark.longitude_deg, mark.elevation_m);
    entry["sim_time"] = static_cast<double>(mark.sim_time_ns) * 1e-9;
    marks.push_back(entry);
  }
  object["marks"] = marks;
  object["cue"] = nullptr;
  if (state.cue_count > 0) {
    object["cue"] = position_json(state.cue_latitude_deg, state.cue_longitude_deg, state.cue_elevation_m);
    object["cue"]["count"] = state.cue_count;
  }
  object["target"] = nullptr;
  if (has(state, kTargetDesignated)) {
    object["target"] = position_json(state.target_latitude_deg, state.target_longitude_deg, state.target_elevation_m);
    object["target"]["name"] = text_of(state.target_name);
  }
}

// From the aircraft to the designated target: slant range, true bearing, depression below the horizontal. Null without
// a target.
ordered_json ranging(const Outputs& outputs) {
  if (!std::isfinite(outputs.slant_range_m)) return nullptr;
  return {{"slant_range_nm", outputs.slant_range_m / geo::kMetresPerNauticalMile},
          {"bearing_true_deg", number_or_null(outputs.bearing_deg)},
          {"depression_deg", number_or_null(outputs.depression_deg)}};
}

void add_ownship(ordered_json& object, const Watch& watch) {
  const ModelStatus& model = watch.model;
  object["antenna"] = {{"az_deg", model.antenna_azimuth_deg}, {"el_deg", model.antenna_elevation_deg}};
  // The ownship in use may be in no lane here: its source runs on the model's host, and another one reaches this host.
  if (!watch.has_ownship()) {
    object["ownship"] = nullptr;
    return;
  }
  const auto& own = model.ownship;
  const double speed_mps = std::hypot(own.velocity_north_mps, own.velocity_east_mps);
  object["ownship"] = {{"lat", own.latitude_deg},
                       {"lon", own.longitude_deg},
                       {"alt_ft", own.altitude_msl_m / geo::kMetresPerFoot},
                       {"heading_deg", own.heading_deg},
                       {"track_deg", ground_track_of(own).degrees()},
                       {"ground_speed_kt", geo::Speed::metres_per_second(speed_mps).knots()},
                       {"height_above_ground_ft", number_or_null(model.height_above_ground_m / geo::kMetresPerFoot)},
                       {"source", name_of_source(own, model.ownship_lane)},
                       {"age_ms", static_cast<double>(watch.sim_time_ns - model.ownship_received_ns) * 1e-6}};
}

void add_legends(ordered_json& object, const RadarState& state) {
  ordered_json legends = ordered_json::object();
  ordered_json boxed = ordered_json::array();
  for (int button = 1; button <= radar::kBezelButtons; ++button) {
    if (state.legends[button][0] != '\0') legends[std::to_string(button)] = text_of(state.legends[button]);
    if ((state.boxed & (1U << button)) != 0U) boxed.push_back(button);
  }
  object["legends"] = legends;
  object["boxed"] = boxed;
}

// Caption of the tour that runs; null without one.
ordered_json caption_json(const std::optional<Caption>& caption) {
  if (!caption) return nullptr;
  ordered_json lines = ordered_json::array();
  for (const CaptionLine& line : caption->lines)
    if (line.text[0] != '\0') lines.push_back(text_of(line.text));
  return {{"title", text_of(caption->title)},
          {"step", caption->step},
          {"steps", caption->steps},
          {"waiting", caption->waiting != 0},
          {"lines", lines}};
}

void add_counts(ordered_json& object, const Watch& watch) {
  object["sweeps"] = watch.model.sweeps;
  object["lost"] = watch.lost;
  object["late_ticks"] = watch.model.late_ticks;
  object["refused"] = watch.refused;
  ordered_json processes = ordered_json::object();
  for (const auto& process : watch.processes)
    processes[process.name] = {{"pid", process.pid},
                               {"heartbeat_ms", static_cast<double>(watch.monotonic_ns - process.heartbeat_ns) * 1e-6}};
  object["processes"] = processes;
}

}  // namespace

void add_radar_state(ordered_json& object, const RadarState& state) {
  add_switches(object, state);
  add_cursor(object, state);
  add_map(object, state);
  add_navigation(object, state);
  add_designations(object, state);
  add_legends(object, state);
}

ordered_json watch_json(const Watch& watch) {
  ordered_json object;
  add_clock(object, watch);
  add_radar_state(object, watch.radar);
  object["remedy"] = text_of(watch.advice.remedy);
  object["events_applied"] = watch.radar.events_applied;
  object["map_timer_s"] = value_or_null(watch.map_timer_s);
  object["map_progress"] = number_or_null(watch.model.map_progress);
  object["ranging"] = ranging(watch.outputs);
  add_ownship(object, watch);
  object["caption"] = caption_json(watch.caption);
  add_counts(object, watch);
  return object;
}

namespace {

ordered_json role_json(const RoleStatus& role) {
  return {{"name", role.name},
          {"pid", role.pid},
          {"heartbeat_ms", value_or_null(role.heartbeat_ms)},
          {"hangs", role.hangs},
          {"host", value_or_null(role.host)},
          {"restarts", role.restarts},
          {"restarts_last_minute", role.restarts_last_minute}};
}

ordered_json host_json(const HostSummary& host) {
  return {{"name", host.name},
          {"version", host.version},
          {"self", host.self},
          {"present", host.present},
          {"left", host.left},
          {"silent_s", value_or_null(host.silent_s)},
          {"owns_clock", host.owns_clock},
          {"priority", host.priority},
          {"offset_ms", value_or_null(host.offset_ms)},
          {"offset_error_ms", value_or_null(host.offset_error_ms)},
          {"latency_ms", host.latency_ms},
          {"received", host.received},
          {"lost", host.lost},
          {"refused", host.refused},
          {"repeated", host.repeated},
          {"roles", host.roles},
          {"differences", host.differences}};
}

ordered_json network_json(const std::optional<NetworkSummary>& network) {
  if (!network) return nullptr;
  ordered_json hosts = ordered_json::array(), topics = ordered_json::array();
  for (const HostSummary& host : network->hosts) hosts.push_back(host_json(host));
  for (const TopicSummary& topic : network->topics)
    topics.push_back({{"name", topic.name},
                      {"sent", topic.sent},
                      {"sent_bytes", topic.sent_bytes},
                      {"received", topic.received},
                      {"received_bytes", topic.received_bytes}});
  return {{"joined", network->joined},
          {"domain", network->domain},
          {"secured", network->secured},
          {"load", network->load},
          {"takeovers", network->takeovers},
          {"conflicts", network->conflicts},
          {"age_ms", network->age_ms},
          {"hosts", hosts},
          {"topics", topics}};
}

ordered_json value_json(const ShownField& field) {
  return std::visit(
      [](const auto& value) -> ordered_json {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
          return number_or_null(value);
        else if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>)
          return value.empty() ? ordered_json(nullptr) : ordered_json(value);
        else
          return value;
      },
      field.value);
}

void add_records(ordered_json& object, const std::vector<ShownRecord>& records) {
  for (const ShownRecord& record : records) {
    ordered_json fields;  // null without any
    for (const ShownField& field : record.fields) fields[std::string(field.name)] = value_json(field);
    object[std::string(record.name)] = fields;
  }
}

ordered_json frames_json(const std::optional<FrameStatus>& frames) {
  if (!frames) return nullptr;
  return {{"publisher", frames->publisher == 0 ? ordered_json(nullptr) : ordered_json(frames->publisher)},
          {"newest", frames->newest.id},
          {"width", frames->newest.width},
          {"height", frames->newest.height}};
}

ordered_json lanes_json(const std::vector<LaneStatus>& lanes) {
  ordered_json list = ordered_json::array();
  for (const LaneStatus& lane : lanes)
    list.push_back(
        {{"lane", lane.lane}, {"source", lane.source}, {"priority", lane.priority}, {"records", lane.records}});
  return list;
}

ordered_json notes_json(const Status& status) {
  ordered_json notes = ordered_json::array();
  for (const Note& note : status.notes)
    notes.push_back({{"sim_time", static_cast<double>(note.sim_time_ns) * 1e-9},
                     {"age_s", static_cast<double>(status.watch.monotonic_ns - note.monotonic_ns) * 1e-9},
                     {"process", text_of(note.process)},
                     {"pid", note.pid},
                     {"kind", note_name(note.kind)},
                     {"text", text_of(note.text)}});
  return notes;
}

ordered_json lag_json(const std::vector<RoleLag>& lags) {
  ordered_json object = ordered_json::object();
  for (const RoleLag& lag : lags)
    object[std::string(lag.role)] = {{"skipped", lag.skipped}, {"share", lag.share}, {"seconds", lag.seconds}};
  return object;
}

}  // namespace

ordered_json status_json(const Status& status) {
  const ModelStatus& model = status.watch.model;
  const Note* const refusal = status.newest_refusal();
  ordered_json object;
  object["session"] = status.session;
  object["watch"] = watch_json(status.watch);
  object["model"] = {{"fidelity", text_of(model.fidelity)},
                     {"load", model.load},
                     {"scan", model.scan},
                     {"terrain_bytes", model.terrain_bytes},
                     {"posts_pending", model.posts_pending}};
  add_records(object, status.records);
  object["glass_frames"] = frames_json(status.frames);
  object["traffic"] = status.traffic
                          ? ordered_json{{"holder", status.traffic->pid}, {"entities", status.traffic->entities}}
                          : ordered_json(nullptr);
  object["ownship_lanes"] = lanes_json(status.ownship_lanes);
  ordered_json counts = ordered_json::object();
  for (std::uint32_t kind = 0; kind < kNoteKinds; ++kind) counts[note_name(kind)] = status.note_counts[kind];
  object["note_counts"] = counts;
  object["notes_folded"] = status.notes_folded;
  object["notes"] = notes_json(status);
  object["named"] = status.named;
  object["network"] = network_json(status.network);
  object["roles"] = ordered_json::array();
  for (const RoleStatus& role : status.roles) object["roles"].push_back(role_json(role));
  object["input"] = {{"sources", status.input_sources}, {"missing", status.input_missing}};
  object["refusals"] = {{"last_10_s", status.refusals_last_10_s},
                        {"newest", refusal == nullptr ? ordered_json(nullptr) : ordered_json(text_of(refusal->text))}};
  object["frames_failing"] = status.frames_failing;
  object["clock_problem"] = value_or_null(status.clock_problem);
  object["lag"] = lag_json(status.lags);
  object["health"] = {{"state", name_of(status.health.verdict)}, {"reasons", status.health.reasons}};
  return object;
}

}  // namespace yars::databuffer
