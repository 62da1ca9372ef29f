#include "databuffer/records/validation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "databuffer/records/plain_text.hpp"
#include "lib/radar/modes.hpp"
#include "lib/radar/point_name.hpp"

namespace yars::databuffer {

namespace {

// [m/s] of one velocity component; above orbital speed a number is garbage, and squares of it spoil Doppler sums.
constexpr double kLargestSpeed = 10'000.0;
// [NM] of selected range and of the cursor's distance: half round the Earth.
constexpr double kLargestRange = 10'800.0;
// [m] MSL: below the deepest sea floor, above the highest mountain.
constexpr double kLowestGround = -12'000.0;
constexpr double kHighestGround = 10'000.0;

// [NM] edge of a map; the glass divides by it.
constexpr double kSmallestWindow = 0.01;
// [m] over ground from the aircraft to a patch map's centre: far beyond any radar's horizon.
constexpr double kFarthestPatch = 1'000'000.0;
// [s] that a map may have taken to form.
constexpr double kLongestFormation = 86'400.0;

// [m] of a navigator's error on one axis: further off than the antipode is no error of a navigator.
constexpr double kLargestError = 20'100'000.0;
// [ft] and [ft/s] that the instructor may put in: 100 NM, and the speed of sound.
constexpr double kLargestInjectedError = 600'000.0;
constexpr double kLargestInjectedDrift = 1'000.0;

// [s] into a recording: three centuries; no recording is longer.
constexpr double kLongestFlight = 1e10;

enum class Missing { refused, allowed };  // whether NaN stands for "none"

// Collects the first fault; a reader wants one line, not twenty.
class Inspection {
 public:
  void range(std::string_view field, double value, double least, double most, Missing missing = Missing::refused) {
    if (missing == Missing::allowed && std::isnan(value)) return;
    // Written so that NaN fails.
    if (!(value >= least && value <= most))
      fault(field, '[' + text_of_number(least) + ", " + text_of_number(most) + ']', text_of_number(value));
  }

  void latitude(std::string_view field, double value, Missing missing = Missing::refused) {
    range(field, value, -90.0, 90.0, missing);
  }
  void longitude(std::string_view field, double value, Missing missing = Missing::refused) {
    range(field, value, -180.0, 180.0, missing);
  }
  void speed(std::string_view field, double value) { range(field, value, -kLargestSpeed, kLargestSpeed); }

  void text(std::string_view field, std::span<const char> characters) {
    const auto end = std::ranges::find(characters, '\0');
    if (end == characters.end()) fault(field, "a zero at its end", "none");
    // A control character in a name could drive the terminal of whoever prints it.
    const auto printable = [](char character) { return character >= ' ' && character <= '~'; };
    if (!std::all_of(characters.begin(), end, printable)) fault(field, "printable ASCII", "something else");
  }

  void fault(std::string_view field, std::string_view expected, std::string_view found) {
    if (!refusal_)
      refusal_ = std::string(field) + ": expected " + std::string(expected) + ", found " + std::string(found);
  }

  Refusal result() { return std::move(refusal_); }

 private:
  Refusal refusal_;
};

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

void inspect_word(Inspection& inspection, const InputEvent& event, int least, int most) {
  inspection.range("argument", event.argument, least, most);
}

void inspect_sign(Inspection& inspection, const InputEvent& event) {
  if (event.argument != 1 && event.argument != -1)
    inspection.fault("argument", "+1 or -1", std::to_string(event.argument));
}

void inspect_radar_mode(Inspection& inspection, const InputEvent& event) {
  constexpr std::array kCommanded{radar::Mode::rbm, radar::Mode::hrm, radar::Mode::beacon, radar::Mode::pvu};
  const auto matches = [&event](radar::Mode mode) { return event.argument == static_cast<int>(mode); };
  if (std::ranges::none_of(kCommanded, matches))
    inspection.fault("argument", "RBM 0, HRM 1, BCN 3 or PVU 4", std::to_string(event.argument));
}

void inspect_injected(Inspection& inspection, const InputEvent& event, double most) {
  inspect_word(inspection, event, 0, 1);
  inspection.range("x", event.x, -most, most);
  inspection.range("y", event.y, -most, most);
}

void inspect_name(Inspection& inspection, const InputEvent& event) {
  inspection.text("text", event.text);
  const auto end = std::ranges::find(event.text, '\0');
  if (!radar::point_name({event.text, static_cast<std::size_t>(end - event.text)}))
    inspection.fault("text", "a sequence point like 2, 2., 2.1, 2.01", "another name");
}

}  // namespace

Refusal why_refused(const Ownship& ownship) {
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

Refusal why_refused(const Nav& nav) {
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
  inspect_map(inspection, state);
  inspect_designations(inspection, state);
  inspection.text("sequence_point", state.sequence_point);
  inspection.text("message", state.message);
  for (const auto& legend : state.legends) inspection.text("legends", legend);
  const auto drawn = std::min<std::size_t>(state.points_drawn, radar::kMaxPointsDrawn);
  for (const DrawnPoint& point : std::span(state.points).first(drawn)) inspect_point(inspection, point);
  return inspection.result();
}

Refusal why_refused(const InputEvent& event) {
  Inspection inspection;
  switch (static_cast<EventKind>(event.kind)) {
    case EventKind::push_button:
      inspect_word(inspection, event, 1, radar::kBezelButtons);
      break;
    case EventKind::tdc:
      inspection.range("x", event.x, -1.0, 1.0);
      inspection.range("y", event.y, -1.0, 1.0);
      break;
    case EventKind::elevation:
      inspection.range("x", event.x, -60.0, 60.0);
      break;
    case EventKind::elevation_step:
      // Whole travel of the antenna; zero steps are no event.
      inspect_word(inspection, event, -240, 240);
      if (event.argument == 0) inspection.fault("argument", "a step up or down", "0");
      break;
    case EventKind::acquisition:
    case EventKind::contrast:
      inspect_sign(inspection, event);
      break;
    case EventKind::master_mode:
    case EventKind::power:
      inspect_word(inspection, event, 0, 2);
      break;
    case EventKind::radar_mode:
      inspect_radar_mode(inspection, event);
      break;
    case EventKind::navigator:
      inspect_word(inspection, event, -1, 1);
      break;
    case EventKind::altimeter:
      inspect_word(inspection, event, 0, 1);
      break;
    case EventKind::sequence_point:
      inspect_name(inspection, event);
      break;
    case EventKind::navigator_error:
      inspect_injected(inspection, event, kLargestInjectedError);
      break;
    case EventKind::navigator_drift:
      inspect_injected(inspection, event, kLargestInjectedDrift);
      break;
    case EventKind::tdc_press:
    case EventKind::tdc_release:
    case EventKind::coolie_up:
    case EventKind::freeze:
      break;
    case EventKind::none:
    default:
      inspection.fault("kind", "1..18", std::to_string(event.kind));
  }
  return inspection.result();
}

Refusal why_refused(const ClockState& clock) {
  Inspection inspection;
  inspection.range("rate", clock.rate, 0.0, 10.0);
  inspection.range("running", clock.running, 0, 1);
  if (clock.base_sim_ns < 0) inspection.fault("base_sim_ns", "0 or more", std::to_string(clock.base_sim_ns));
  if (clock.base_monotonic_ns < 0)
    inspection.fault("base_monotonic_ns", "0 or more", std::to_string(clock.base_monotonic_ns));
  // Without a latitude nothing was repositioned, whatever the other fields hold.
  if (std::isnan(clock.reposition_latitude_deg)) return inspection.result();
  inspection.latitude("reposition_latitude_deg", clock.reposition_latitude_deg);
  inspection.longitude("reposition_longitude_deg", clock.reposition_longitude_deg);
  inspection.range("reposition_altitude_m", clock.reposition_altitude_m, -1'000.0, 200'000.0);
  inspection.range("reposition_heading_deg", clock.reposition_heading_deg, 0.0, 360.0);
  return inspection.result();
}

Refusal why_refused(const RecorderStatus& status) {
  Inspection inspection;
  inspection.range("writing", status.writing, 0, 1);
  inspection.text("problem", status.problem);
  return inspection.result();
}

Refusal why_refused(const PatchMap& map) {
  Inspection inspection;
  inspection.range("size", map.size, 1, kMostPatchPixels);
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

}  // namespace yars::databuffer
