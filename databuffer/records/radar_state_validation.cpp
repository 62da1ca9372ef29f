#include "databuffer/records/radar_state_validation.hpp"

#include <algorithm>
#include <span>

#include "databuffer/records/inspection.hpp"
#include "lib/radar/limits.hpp"

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

Refusal why_refused(const RadarState& state) {
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

}  // namespace yars::databuffer
