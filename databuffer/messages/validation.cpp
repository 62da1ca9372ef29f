#include "databuffer/messages/validation.hpp"

#include <algorithm>
#include <span>

#include "databuffer/messages/inspection.hpp"
#include "lib/radar/modes.hpp"

namespace yars::databuffer {

namespace {

// [m] of a navigator's error on one axis: further off than the antipode is no error of a navigator.
constexpr double kLargestError = 20'100'000.0;

void inspect_point(Inspection& inspection, const DrawnPoint& point) {
  inspection.latitude("points.latitude_deg", point.latitude_deg);
  inspection.longitude("points.longitude_deg", point.longitude_deg);
  inspection.range("points.elevation_m", point.elevation_m, kLowestGround, kHighestGround, Missing::allowed);
  inspection.text("points.name", point.name);
  inspection.range("points.kind", point.kind, 0, 4);
  inspection.range("points.selected", point.selected, 0, 1);
}

void inspect_cursor(Inspection& inspection, const RadarState& state) {
  // Without a cursor its fields mean nothing, but nobody may trip over them either.
  const Missing missing = (state.flags & kCursorValid) != 0U ? Missing::refused : Missing::allowed;
  inspection.latitude("cursor_latitude_deg", state.cursor_latitude_deg, missing);
  inspection.longitude("cursor_longitude_deg", state.cursor_longitude_deg, missing);
  inspection.range("cursor_elevation_m", state.cursor_elevation_m, kLowestGround, kHighestGround, Missing::allowed);
  inspection.range("cursor_bearing_deg", state.cursor_bearing_deg, 0.0, 360.0, missing);
  inspection.range("cursor_range_nm", state.cursor_range_nm, 0.0, kLargestRange, missing);
}

void inspect_navigator(Inspection& inspection, std::string_view name, const NavigatorError& error) {
  inspection.range(name, error.north_m, -kLargestError, kLargestError);
  inspection.range(name, error.east_m, -kLargestError, kLargestError);
  inspection.speed(name, error.velocity_north_mps);
  inspection.speed(name, error.velocity_east_mps);
  inspection.speed(name, error.velocity_down_mps);
}

// A place on the ground whose height may be unknown.
void inspect_ground(Inspection& inspection, std::string_view name, double latitude_deg, double longitude_deg,
                    double elevation_m) {
  inspection.latitude(name, latitude_deg);
  inspection.longitude(name, longitude_deg);
  inspection.range(name, elevation_m, kLowestGround, kHighestGround, Missing::allowed);
}

// What the cursor functions have left: updates, cue, target, marks.
void inspect_designations(Inspection& inspection, const RadarState& state) {
  const Missing missing = (state.flags & kCursorValid) != 0U ? Missing::refused : Missing::allowed;
  inspection.latitude("cursor_believed_latitude_deg", state.cursor_believed_latitude_deg, missing);
  inspection.longitude("cursor_believed_longitude_deg", state.cursor_believed_longitude_deg, missing);
  inspect_navigator(inspection, "mission", state.mission);
  inspect_navigator(inspection, "ins", state.ins);
  inspection.range("update_north_m", state.update_north_m, -kLargestError, kLargestError);
  inspection.range("update_east_m", state.update_east_m, -kLargestError, kLargestError);
  inspect_ground(inspection, "target", state.target_latitude_deg, state.target_longitude_deg, state.target_elevation_m);
  inspection.text("target_name", state.target_name);
  inspection.range("steering_line_deg", state.steering_line_deg, 0.0, 360.0);
  inspection.range("steering_line", state.steering_line, 0, 3);
  inspect_ground(inspection, "cue", state.cue_latitude_deg, state.cue_longitude_deg, state.cue_elevation_m);
  inspection.speed("velocity_along_mps", state.velocity_along_mps);
  inspection.speed("velocity_across_mps", state.velocity_across_mps);
  inspection.speed("velocity_vertical_mps", state.velocity_vertical_mps);
  inspection.latitude("asked_latitude_deg", state.asked_latitude_deg);
  inspection.longitude("asked_longitude_deg", state.asked_longitude_deg);
  inspection.range("magnetic_variation_deg", state.magnetic_variation_deg, -180.0, 180.0);
  inspection.range("mark_count", state.mark_count, 0, kMarks);
  const auto count = std::min<std::size_t>(state.mark_count, kMarks);
  for (const Mark& mark : std::span(state.marks).first(count))
    inspect_ground(inspection, "marks", mark.latitude_deg, mark.longitude_deg, mark.elevation_m);
}

void inspect_map(Inspection& inspection, const RadarState& state) {
  inspection.latitude("map_latitude_deg", state.map_latitude_deg);
  inspection.longitude("map_longitude_deg", state.map_longitude_deg);
  inspection.range("map_window_nm", state.map_window_nm, 0.0, kLargestRange);
  inspection.picture_id("map_newest", state.map_newest);
  inspection.picture_id("map_old", state.map_old);
  inspection.picture_id("map_stored", state.map_stored);
  inspection.picture_id("map_shown", state.map_shown);
}

// Differences of two are taken: far from the ends of their type.
void inspect_ticks(Inspection& inspection, const RadarState& state) {
  constexpr double kLatest = 0x1p53;
  const auto tick = [&inspection](std::string_view name, std::int64_t value) {
    inspection.range(name, static_cast<double>(value), -1.0, kLatest);
  };
  tick("tick", state.tick);
  tick("message_until_tick", state.message_until_tick);
  tick("asked_tick", state.asked_tick);
  tick("cursor_moved_tick", state.cursor_moved_tick);
  tick("velocity_updated_tick", state.velocity_updated_tick);
  tick("velocity_shown_until_tick", state.velocity_shown_until_tick);
}

void inspect_switches(Inspection& inspection, const RadarState& state) {
  inspection.range("power", state.power, 0, 2);
  inspection.range("mode", state.mode, 0, 7);
  inspection.range("master", state.master, 0, 2);
  inspection.range("resume_mode", state.resume_mode, 0, 7);
  inspection.range("ground_mode", state.ground_mode, 0, 7);
  inspection.range("scan", state.scan, 0, 2);
  inspection.range("gain", state.gain, 0, 3);
  inspection.range("brightness", state.brightness, 0, 15);
  inspection.range("contrast", state.contrast, 0, 15);
  inspection.range("cursor_function", state.cursor_function, 0, 4);
  inspection.range("navigator", state.navigator, 0, 1);
  inspection.range("channel", state.channel, 1, 8);
  inspection.range("band", state.band, 0, 4);
  inspection.range("points_drawn", state.points_drawn, 0, radar::kMaxPointsDrawn);
  inspection.range("recall", state.recall, 0, 3);
}

}  // namespace

Refusal validate(const RadarState& state) {
  Inspection inspection;
  inspection.range("range_nm", state.range_nm, 0.0, kLargestRange);
  inspection.range("scan_width_deg", state.scan_width_deg, 0.0, 360.0);
  inspection.range("antenna_elevation_deg", state.antenna_elevation_deg, -60.0, 60.0);
  inspection.range("tdc_x", state.tdc_x, -1.0, 1.0);
  inspection.range("tdc_y", state.tdc_y, -1.0, 1.0);
  inspection.range("window_nm", state.window_nm, 0.0, kLargestRange);
  inspection.latitude("frame_latitude_deg", state.frame_latitude_deg);
  inspection.longitude("frame_longitude_deg", state.frame_longitude_deg);
  inspection.range("frame_track_deg", state.frame_track_deg, 0.0, 360.0);
  inspect_cursor(inspection, state);
  inspect_switches(inspection, state);
  inspect_ticks(inspection, state);
  inspect_map(inspection, state);
  inspect_designations(inspection, state);
  inspection.text("sequence_point", state.sequence_point);
  inspection.text("message", state.message);
  for (const auto& legend : state.legends) inspection.text("legends", legend);
  const auto drawn = std::min<std::size_t>(state.points_drawn, radar::kMaxPointsDrawn);
  for (const DrawnPoint& point : std::span(state.points).first(drawn)) inspect_point(inspection, point);
  return inspection.result();
}

namespace {

// [NM] edge of a map; the glass divides by it.
constexpr double kSmallestWindow = 0.01;
// [m] over ground from the aircraft to a patch map's centre: far beyond any radar's horizon.
constexpr double kFarthestPatch = 1'000'000.0;
// [s] that a map may have taken to form.
constexpr double kLongestFormation = 86'400.0;
// [s] into a recording: three centuries; no recording is longer.
constexpr double kLongestFlight = 1e10;
// [m] and [m²] of what a ship or a vehicle returns: no mast is higher, no ship returns more.
constexpr double kTallestEntity = 1'000.0;
constexpr double kLargestEcho = 1e7;

}  // namespace

Refusal validate(const Ownship& ownship) {
  Inspection inspection;
  inspection.latitude("latitude_deg", ownship.latitude_deg);
  inspection.longitude("longitude_deg", ownship.longitude_deg);
  inspection.range("altitude_msl_m", ownship.altitude_msl_m, -1'000.0, 200'000.0);
  inspection.range("heading_deg", ownship.heading_deg, 0.0, 360.0);
  inspection.range("pitch_deg", ownship.pitch_deg, -90.0, 90.0);
  inspection.range("roll_deg", ownship.roll_deg, -180.0, 180.0);
  inspection.speed("velocity_north_mps", ownship.velocity_north_mps);
  inspection.speed("velocity_east_mps", ownship.velocity_east_mps);
  inspection.speed("velocity_down_mps", ownship.velocity_down_mps);
  inspection.range("radar_altitude_m", ownship.radar_altitude_m, 0.0, 200'000.0, Missing::allowed);
  inspection.range("flight_time_s", ownship.flight_time_s, 0.0, kLongestFlight);
  inspection.text("source", ownship.source);
  return inspection.result();
}

Refusal validate(const Nav& nav) {
  Inspection inspection;
  inspection.latitude("mission_latitude_deg", nav.mission_latitude_deg);
  inspection.longitude("mission_longitude_deg", nav.mission_longitude_deg);
  inspection.latitude("ins_latitude_deg", nav.ins_latitude_deg);
  inspection.longitude("ins_longitude_deg", nav.ins_longitude_deg);
  inspection.speed("velocity_north_mps", nav.velocity_north_mps);
  inspection.speed("velocity_east_mps", nav.velocity_east_mps);
  inspection.speed("velocity_down_mps", nav.velocity_down_mps);
  inspection.range("magnetic_variation_deg", nav.magnetic_variation_deg, -180.0, 180.0, Missing::allowed);
  return inspection.result();
}

Refusal validate(const ClockState& clock) {
  Inspection inspection;
  inspection.range("rate", clock.rate, 0.0, 10.0);
  inspection.range("running", clock.running, 0, 1);
  const auto base = [&inspection](std::string_view field, std::int64_t value_ns) {
    if (value_ns < 0 || value_ns > kLatestClockBase_ns)
      inspection.fault(field, "0 to " + std::to_string(kLatestClockBase_ns) + " ns", std::to_string(value_ns));
  };
  base("base_sim_ns", clock.base_sim_ns);
  base("base_monotonic_ns", clock.base_monotonic_ns);
  // Without a latitude nothing was repositioned, whatever the other fields hold.
  if (std::isnan(clock.reposition_latitude_deg)) return inspection.result();
  inspection.latitude("reposition_latitude_deg", clock.reposition_latitude_deg);
  inspection.longitude("reposition_longitude_deg", clock.reposition_longitude_deg);
  inspection.range("reposition_altitude_m", clock.reposition_altitude_m, -1'000.0, 200'000.0);
  inspection.range("reposition_heading_deg", clock.reposition_heading_deg, 0.0, 360.0);
  return inspection.result();
}

Refusal validate(const RecorderStatus& status) {
  Inspection inspection;
  inspection.range("writing", status.writing, 0, 1);
  inspection.text("problem", status.problem);
  return inspection.result();
}

Refusal validate(const PatchMap& map) {
  Inspection inspection;
  inspection.picture_id("id", map.id);
  inspection.range("size", map.size, 1, kMaxPatchPixels);
  inspection.latitude("latitude_deg", map.latitude_deg);
  inspection.longitude("longitude_deg", map.longitude_deg);
  inspection.range("elevation_msl_m", map.elevation_msl_m, kLowestGround, kHighestGround);
  inspection.range("up_deg", map.up_deg, 0.0, 360.0);
  inspection.range("window_nm", map.window_nm, kSmallestWindow, kLargestRange);
  inspection.latitude("apex_latitude_deg", map.apex_latitude_deg);
  inspection.longitude("apex_longitude_deg", map.apex_longitude_deg);
  inspection.range("apex_altitude_msl_m", map.apex_altitude_msl_m, -1'000.0, 200'000.0);
  inspection.range("distance_m", map.distance_m, 0.0, kFarthestPatch);
  inspection.range("squint_deg", map.squint_deg, -180.0, 180.0);
  inspection.range("resolution_m", map.resolution_m, 0.0, kFarthestPatch);
  inspection.range("formation_s", map.formation_s, 0.0, kLongestFormation);
  inspection.text("fidelity", map.fidelity);
  return inspection.result();
}

Refusal validate(const Traffic& traffic) {
  Inspection inspection;
  inspection.range("count", traffic.count, 0, kMaxTraffic);
  const auto count = std::min<std::size_t>(traffic.count, kMaxTraffic);
  for (const TrafficEntity& entity : std::span(traffic.entities).first(count)) {
    inspection.latitude("entities.latitude_deg", entity.latitude_deg);
    inspection.longitude("entities.longitude_deg", entity.longitude_deg);
    inspection.speed("entities.velocity_north_mps", entity.velocity_north_mps);
    inspection.speed("entities.velocity_east_mps", entity.velocity_east_mps);
    inspection.range("entities.height_m", entity.height_m, 0.0, kTallestEntity);
    inspection.range("entities.cross_section_m2", entity.cross_section_m2, 0.0, kLargestEcho);
  }
  return inspection.result();
}

Refusal validate(const GlassFrame& frame) {
  Inspection inspection;
  inspection.picture_id("id", frame.id);
  inspection.range("width", frame.width, 1, kMaxFramePixels);
  inspection.range("height", frame.height, 1, kMaxFramePixels);
  return inspection.result();
}

Refusal validate(const Outputs& outputs) {
  Inspection inspection;
  inspection.text("target_name", outputs.target_name);
  inspection.range("mark_count", outputs.mark_count, 0, kMarks);
  const auto count = std::min<std::size_t>(outputs.mark_count, kMarks);
  for (const Mark& mark : std::span(outputs.marks).first(count)) {
    inspection.latitude("marks.latitude_deg", mark.latitude_deg);
    inspection.longitude("marks.longitude_deg", mark.longitude_deg);
  }
  inspection.range("steering", outputs.steering, 0, static_cast<int>(SteeringCommand::bank));
  return inspection.result();
}

namespace {

constexpr double kHighest = 200'000.0;                // [m] of an aircraft
constexpr double kFarthest = 1852.0 * kLargestRange;  // [m]
constexpr double kLatest_ns = 0x1p62;                 // [ns] 146 years of sim time: sums of two still fit
constexpr double kLatestTick = kLatest_ns / radar::kTickNanoseconds;
constexpr double kLongestTimer = 1e6;      // [s]
constexpr double kFastestScan = 10'000.0;  // [deg/s]
constexpr int kPhases = 4;                 // antenna::Phase, the last
constexpr int kModes = 7;                  // radar::Mode, the last
constexpr int kFullGain = 3;

void inspect_surroundings(Inspection& inspection, const ModelStatus& status) {
  const auto unknown = Missing::allowed;
  inspection.range("antenna_azimuth_deg", status.antenna_azimuth_deg, -180.0, 180.0, unknown);
  inspection.range("antenna_elevation_deg", status.antenna_elevation_deg, -90.0, 90.0, unknown);
  inspection.range("height_above_ground_m", status.height_above_ground_m, -kHighest, kHighest - kLowestGround, unknown);
  inspection.range("ground_elevation_m", status.ground_elevation_m, kLowestGround, kHighestGround, unknown);
  inspection.range("cursor_ground_elevation_m", status.cursor_ground_elevation_m, kLowestGround, kHighestGround,
                   unknown);
}

void inspect_scan(Inspection& inspection, const ModelStatus& status) {
  inspection.range("scan_centre_deg", status.scan_centre_deg, -360.0, 360.0);
  inspection.range("scan_width_deg", status.scan_width_deg, 0.0, 360.0);
  inspection.range("scan_range_m", status.scan_range_m, 0.0, kFarthest);
  inspection.range("scan_offset_deg", status.scan_offset_deg, -360.0, 360.0);
  inspection.range("scan_rate_dps", status.scan_rate_dps, 0.0, kFastestScan);
  inspection.range("scan_direction", status.scan_direction, -1, 1);
  inspection.range("antenna_phase", status.antenna_phase, 0, kPhases);
  inspection.range("mode", status.mode, 0, kModes);
}

void inspect_map_under_way(Inspection& inspection, const ModelStatus& status) {
  inspection.range("map_timer_s", status.map_timer_s, 0.0, kLongestTimer, Missing::allowed);
  inspection.range("map_progress", status.map_progress, 0.0, 1.0, Missing::allowed);
  inspection.latitude("map_latitude_deg", status.map_latitude_deg);
  inspection.longitude("map_longitude_deg", status.map_longitude_deg);
  inspection.range("map_up_deg", status.map_up_deg, 0.0, 360.0);
  inspection.range("map_window_nm", status.map_window_nm, 0.0, kLargestRange);
  inspection.range("mappable", status.mappable, 0, 1);
  inspection.picture_id("map_newest", status.map_newest);
}

void inspect_measured(Inspection& inspection, const ModelStatus& status) {
  inspection.speed("velocity_north_mps", status.velocity_north_mps);
  inspection.speed("velocity_east_mps", status.velocity_east_mps);
  inspection.speed("velocity_down_mps", status.velocity_down_mps);
  inspection.range("velocity_due_tick", static_cast<double>(status.velocity_due_tick), -1.0, kLatestTick);
}

}  // namespace

Refusal validate(const ModelStatus& status) {
  Inspection inspection;
  inspection.range("tick", static_cast<double>(status.tick), 0.0, kLatestTick);
  inspection.range("sim_time_ns", static_cast<double>(status.sim_time_ns), 0.0, kLatest_ns);
  inspection.range("ownship_received_ns", static_cast<double>(status.ownship_received_ns), 0.0, kLatest_ns);
  inspection.range("load", status.load, 0.0, kLongestTimer);
  inspect_surroundings(inspection, status);
  inspect_scan(inspection, status);
  inspect_map_under_way(inspection, status);
  inspect_measured(inspection, status);
  inspection.latitude("answered_latitude_deg", status.answered_latitude_deg);
  inspection.longitude("answered_longitude_deg", status.answered_longitude_deg);
  inspection.range("answered_elevation_m", status.answered_elevation_m, kLowestGround, kHighestGround,
                   Missing::allowed);
  inspection.text("why_not", status.why_not);
  inspection.text("map_stopped", status.map_stopped);
  inspection.text("fidelity", status.fidelity);
  if (const auto refusal = validate(status.ownship)) return "ownship: " + *refusal;
  if (const auto refusal = validate(status.nav)) return "nav: " + *refusal;
  return inspection.result();
}

Refusal validate(const Sweep& sweep) {
  Inspection inspection;
  inspection.range("tick", static_cast<double>(sweep.tick), 0.0, kLatestTick);
  inspection.range("sim_time_ns", static_cast<double>(sweep.sim_time_ns), 0.0, kLatest_ns);
  inspection.latitude("apex_latitude_deg", sweep.apex_latitude_deg);
  inspection.longitude("apex_longitude_deg", sweep.apex_longitude_deg);
  inspection.range("apex_altitude_msl_m", sweep.apex_altitude_msl_m, -1'000.0, kHighest);
  inspection.range("azimuth_left_deg", sweep.azimuth_left_deg, 0.0, 360.0);
  inspection.range("azimuth_right_deg", sweep.azimuth_right_deg, 0.0, 360.0);
  inspection.range("ground_track_deg", sweep.ground_track_deg, 0.0, 360.0);
  inspection.range("elevation_deg", sweep.elevation_deg, -90.0, 90.0);
  inspection.range("range_m", sweep.range_m, 0.0, kFarthest);
  inspection.range("samples", sweep.samples, 0, radar::kMaxSamples);
  inspection.range("mode", sweep.mode, 0, kModes);
  inspection.range("gain", sweep.gain, 0, kFullGain);
  inspection.range("direction", sweep.direction, 0, 1);
  return inspection.result();
}

Refusal validate(const ModelTick& tick) {
  Inspection inspection;
  inspection.range("tick", static_cast<double>(tick.tick), 0.0, kLatestTick);
  inspection.range("sim_time_ns", static_cast<double>(tick.sim_time_ns), 0.0, kLatest_ns);
  inspection.range("resumed_tick", static_cast<double>(tick.resumed_tick), -1.0, kLatestTick);
  inspection.range("samples", tick.samples, 0, radar::kMaxSamples);
  inspection.range("command.range_nm", tick.command.range_nm, 0.0, kLargestRange);
  inspection.range("command.scan_width_deg", tick.command.scan_width_deg, 0.0, 360.0);
  inspection.range("command.antenna_elevation_deg", tick.command.antenna_elevation_deg, -90.0, 90.0);
  inspection.range("command.mode", tick.command.mode, 0, kModes);
  inspection.text("fidelity", tick.fidelity);
  if (const auto refusal = validate(tick.ownship)) return "ownship: " + *refusal;
  return inspection.result();
}

}  // namespace yars::databuffer
