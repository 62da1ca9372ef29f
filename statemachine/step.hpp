// What an action of the transition table works on, and how it asks for the state's flags.
#pragma once

#include "lib/radar/modes.hpp"
#include "statemachine/machine.hpp"

namespace yars::statemachine {

// One event on its way into the state.
struct Step {
  databuffer::RadarState& state;
  const databuffer::InputEvent& event;
  const Surroundings& surroundings;
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

}  // namespace yars::statemachine
