#include "databuffer/json/session_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "databuffer/messages/derived_values.hpp"
#include "databuffer/runtime/receivers.hpp"
#include "databuffer/session/validated.hpp"
#include "lib/geo/quantity.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::databuffer {

namespace {

using nlohmann::ordered_json;
using text::text_of;

// JSON has no NaN, so an unknown value (NaN) becomes null.
ordered_json number_or_null(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

bool has(const RadarState& state, std::uint32_t flag) {
  return (state.flags & flag) != 0U;
}

void add_clock(ordered_json& object, const Session& session, const ModelStatus& model) {
  const auto clock = session.clock();
  object["sim_time"] = static_cast<double>(session.reached_sim_time_ns()) * 1e-9;
  object["epoch"] = clock.epoch;
  object["tick"] = model.tick;
  object["rate"] = clock.rate;
  object["running"] = clock.running != 0;
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

void add_ownship(ordered_json& object, const ModelStatus& model, std::int64_t now_ns) {
  object["antenna"] = {{"az_deg", model.antenna_azimuth_deg}, {"el_deg", model.antenna_elevation_deg}};
  // The ownship in use may be in no lane here: its source runs on the model's host, and another one reaches this host.
  if ((model.flags & kModelStale) != 0U) {
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
                       {"age_ms", static_cast<double>(now_ns - model.ownship_received_ns) * 1e-6}};
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
ordered_json caption_json(const Session& session) {
  const auto caption = read_valid(session.layout().caption);
  if (!caption || caption->step == 0 || !session.role_is_held(Role::tour)) return nullptr;
  ordered_json lines = ordered_json::array();
  for (const CaptionLine& line : caption->lines)
    if (line.text[0] != '\0') lines.push_back(text_of(line.text));
  return {{"title", text_of(caption->title)},
          {"step", caption->step},
          {"steps", caption->steps},
          {"waiting", caption->waiting != 0},
          {"lines", lines}};
}

void add_health(ordered_json& object, const Session& session, const ModelStatus& model) {
  const auto& layout = session.layout();
  object["sweeps"] = model.sweeps;
  object["lost"] = layout.note_counts[static_cast<std::size_t>(NoteKind::loss)].load();
  object["late_ticks"] = model.late_ticks;
  object["refused"] = layout.note_counts[static_cast<std::size_t>(NoteKind::refusal)].load();
  ordered_json processes = ordered_json::object();
  const std::int64_t now_ns = monotonic_ns();
  for (const auto& process : session.processes())
    processes[process.name] = {{"pid", process.pid},
                               {"heartbeat_ms", static_cast<double>(now_ns - process.heartbeat_ns) * 1e-6}};
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

nlohmann::ordered_json watch_object(const Session& session) {
  const auto& layout = session.layout();
  // A radar state or model status that fails validation is replaced by defaults.
  ModelStatus no_model{};
  no_model.map_timer_s = no_model.map_progress = std::nan("");
  no_model.flags = kModelStale;
  const RadarState state = read_valid(layout.radar_state).value_or(RadarState{});
  const ModelStatus model = read_valid(layout.model_status).value_or(no_model);
  ordered_json object;
  add_clock(object, session, model);
  add_radar_state(object, state);
  const auto advice = read_valid(layout.advice).value_or(PilotAdvice{});
  object["remedy"] = text_of(advice.remedy);
  object["events_applied"] = state.events_applied;
  const auto timer_s = map_timer_s(state, model);
  object["map_timer_s"] = timer_s ? ordered_json(*timer_s) : ordered_json(nullptr);
  object["map_progress"] = number_or_null(model.map_progress);
  Outputs no_outputs{};
  no_outputs.slant_range_m = std::nan("");
  object["ranging"] = ranging(read_valid(layout.outputs).value_or(no_outputs));
  add_ownship(object, model, session.reached_sim_time_ns());
  object["caption"] = caption_json(session);
  add_health(object, session, model);
  return object;
}

}  // namespace yars::databuffer
