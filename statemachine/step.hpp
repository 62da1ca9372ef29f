// Argument of the actions of the transition table, and helpers for flags, enums and messages of the radar state.
// Inputs: radar state, one event, inputs of the tick, configuration.
// Outputs: changes of the radar state; `refused` when the event cannot be carried out.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/mission.hpp"
#include "lib/radar/modes.hpp"
#include "lib/text/plain_text.hpp"

namespace yars::radar {
struct HeightRanges;
struct NavigationConfiguration;
struct RoutePoint;
struct ViewConfiguration;
struct WindowLimits;
}  // namespace yars::radar

namespace yars::statemachine {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();  // in a record: the value is unknown

// Number of map records in Inputs: the pilot's maps NEW, OLD and STORE, and the newest map of the radar model.
inline constexpr std::size_t kMaxMaps = 4;

// Inputs of one tick besides the events.
struct Inputs {
  std::int64_t tick = 0;
  std::int64_t sim_time_ns = 0;
  std::uint32_t epoch = 0;
  bool ownship_valid = false;
  bool recorder_present = false;
  bool recorder_writing = false;  // a recorder is present and reports that it writes
  bool recorder_failed = false;   // a recorder is present and has stopped at a problem such as a full disk
  databuffer::Ownship ownship{};
  databuffer::Nav nav{};
  double field_variation_deg = kUnknown;  // magnetic variation, east positive; NaN = no geomagnetic model
  // Aircraft's height above the ground below it, by the radar model; NaN = unknown. Used if the source of `ownship` has
  // no radar altimeter.
  double height_above_ground_m = kUnknown;
  databuffer::ModelStatus model{};
  // Records of the maps named by the state, and of the model's newest map, in any order; id 0 = empty slot.
  std::array<databuffer::PatchMap, kMaxMaps> maps{};
};

// Sections and values of a configuration that the state machine reads. The configuration, and the points of `route`,
// must outlive this object.
struct Parameters {
  // Converts from a structure that has all these members, such as radar::RadarConfiguration.
  template <class Configuration>
    requires requires(const Configuration& whole) { whole.height_ranges; }
  Parameters(const Configuration& whole)
      : ranges_nm(whole.ranges_nm),
        scan_widths_deg(whole.scan_widths_deg),
        windows_nm(whole.windows_nm),
        elevation_limit_deg(whole.antenna.elevation_limit_deg),
        start_elevation_deg(whole.antenna.start_elevation_deg),
        view(whole.view),
        map_limits(whole),
        navigation(whole.navigation),
        route(whole.route),
        seed(whole.seed),
        magnetic_variation_deg(whole.magnetic_variation_deg),
        window_limits(whole.window_limits),
        height_ranges(whole.height_ranges) {}

  const std::vector<double>& ranges_nm;        // [NM] selectable ranges, ascending
  const std::vector<double>& scan_widths_deg;  // [deg] whole widths of FULL, HALF, QTR
  const std::vector<double>& windows_nm;       // [NM] selectable windows (sides) of patch maps, ascending
  double elevation_limit_deg;                  // [deg] limit of the antenna elevation above and below the horizontal
  double start_elevation_deg;                  // [deg] antenna elevation at power-up, above the horizontal
  const radar::ViewConfiguration& view;
  radar::MapLimits map_limits;
  const radar::NavigationConfiguration& navigation;
  std::span<const radar::RoutePoint> route;  // sequence points; an instructor can change them
  std::uint64_t seed;                        // seed of all random numbers
  double magnetic_variation_deg;             // [deg] configured magnetic variation, east positive; NaN: unknown
  const radar::WindowLimits& window_limits;
  const radar::HeightRanges& height_ranges;
};

// Application of one event to the state.
struct Step {
  databuffer::RadarState& state;
  const databuffer::InputEvent& event;
  const Inputs& inputs;
  const Parameters& parameters;
  bool refused = false;  // the event cannot be carried out; the display shows the reason
};

inline bool has(const databuffer::RadarState& state, std::uint32_t flag) {
  return (state.flags & flag) != 0;
}

inline void set_flag(databuffer::RadarState& state, std::uint32_t flag, bool on) {
  state.flags = on ? state.flags | flag : state.flags & ~flag;
}

inline radar::Power power_of(const databuffer::RadarState& state) {
  return static_cast<radar::Power>(state.power);
}
inline radar::Master master_of(const databuffer::RadarState& state) {
  return static_cast<radar::Master>(state.master);
}
// The mode in which the radar works. While the main menu is shown, that mode continues.
inline radar::Mode running_mode(const databuffer::RadarState& state) {
  return static_cast<radar::Mode>(state.resume_mode);
}

// Compares bytes instead of values, because a NaN must equal itself. StateMachineShell compares in the same way.
inline bool same_bytes(const databuffer::RadarState& a, const databuffer::RadarState& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

// True ground position under the cursor; may be NaN without kCursorValid.
inline geo::GeoPoint cursor_of(const databuffer::RadarState& state) {
  return {state.cursor_latitude_deg, state.cursor_longitude_deg};
}

// Duration of a message: 600 ticks of 5 ms, 3 s. A shorter message is easily missed. A longer message delays the reason
// why re-mapping stopped, because that reason is shown only after the message.
// Source: docs/pilots_manual.md#messages
inline constexpr std::int64_t kMessageTicks = 600;

// Shows a message for kMessageTicks.
inline void show_message(databuffer::RadarState& state, const Inputs& inputs, std::string_view text) {
  text::put_text(state.message, text);
  state.message_until_tick = inputs.tick + kMessageTicks;
}

// Marks the event as refused and shows the reason.
inline void refuse(Step& step, std::string_view reason) {
  show_message(step.state, step.inputs, reason);
  step.refused = true;
}

// Refuses the event if the aircraft's position or the cursor's is unknown. Returns true if it is refused.
// Source: docs/pilots_manual.md#messages
inline bool refuses_without_cursor(Step& step) {
  if (!step.inputs.ownship_valid) {
    refuse(step, "NO OWNSHIP");
  } else if (!has(step.state, databuffer::kCursorValid)) {
    refuse(step, "NO CURSOR");
  }
  return step.refused;
}

}  // namespace yars::statemachine
