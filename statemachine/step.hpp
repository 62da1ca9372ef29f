// What an action of the transition table works on: the state, its flags and message, and what surrounds it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

#include "databuffer/messages/input_event.hpp"
#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"
#include "lib/geo/geodesy.hpp"
#include "lib/radar/configuration.hpp"
#include "lib/radar/modes.hpp"

namespace yars::statemachine {

// NEW, OLD and STORE, and the one that the model has just completed.
inline constexpr std::size_t kMapsKnown = 4;

// What the machine sees in a tick besides the events.
struct Inputs {
  std::int64_t tick = 0;
  std::int64_t sim_time_ns = 0;
  std::uint32_t epoch = 0;
  bool ownship_valid = false;
  bool recorder_present = false;
  bool recorder_writing = false;  // it says so, and is present
  bool recorder_failed = false;   // it is present and has stopped: the disk takes no more
  databuffer::Ownship ownship{};
  databuffer::Nav nav{};
  double field_variation_deg = std::numeric_limits<double>::quiet_NaN();  // by a model of the earth's field; NaN = none
  // [m] over the terrain below, by the model: the radar altimeter of an aircraft whose source has none. NaN = unknown.
  double height_above_ground_m = std::numeric_limits<double>::quiet_NaN();
  databuffer::ModelStatus model{};
  // Records of the maps that the state names and of the model's newest, in any order; id 0 = an empty place.
  std::array<databuffer::PatchMap, kMapsKnown> maps{};
};

// One event on its way into the state.
struct Step {
  databuffer::RadarState& state;
  const databuffer::InputEvent& event;
  const Inputs& inputs;
  const radar::RadarConfiguration& configuration;
  bool refused = false;  // it cannot be done; the display says why
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
// The mode that runs, also under the main menu.
inline radar::Mode running_mode(const databuffer::RadarState& state) {
  return static_cast<radar::Mode>(state.resume_mode);
}

// The ground under the cursor.
inline geo::GeoPoint cursor_of(const databuffer::RadarState& state) {
  return {state.cursor_latitude_deg, state.cursor_longitude_deg};
}

// Into a field of a record: what is too long is cut, the last byte is zero.
template <std::size_t N>
void put_text(char (&field)[N], std::string_view text) {
  std::memset(field, 0, N);
  text.copy(field, N - 1);
}

// 3 s: long enough to read two words, short enough not to hide the next; a shorter one is missed in a scan of the
// panel.
inline constexpr std::int64_t kMessageTicks = 600;

// A word for the pilot that goes by itself.
inline void show_message(databuffer::RadarState& state, const Inputs& inputs, std::string_view text) {
  put_text(state.message, text);
  state.message_until_tick = inputs.tick + kMessageTicks;
}

// The event cannot be done, for this reason.
inline void refuse(Step& step, std::string_view reason) {
  show_message(step.state, step.inputs, reason);
  step.refused = true;
}

}  // namespace yars::statemachine
