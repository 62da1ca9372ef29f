// State machine as one pure step: state and inputs in, next state and outputs out.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "databuffer/messages/model_records.hpp"
#include "databuffer/messages/pictures.hpp"
#include "databuffer/messages/radar_state.hpp"
#include "databuffer/messages/world_state.hpp"
#include "lib/radar/configuration.hpp"
#include "statemachine/step.hpp"

namespace yars::statemachine {

// What the state machine tells sensors, weapons and the head-up display.

// Ranging and steering are NaN without a designated target or without a valid ownship.
databuffer::Outputs outputs_of(const databuffer::RadarState& state, const Surroundings& surroundings);

// The state machine as one pure step: state and inputs in, next state out.

// NEW, OLD and STORE, and the one that the model has just completed.
inline constexpr std::size_t kMapsKnown = 4;

// What the machine sees in a tick besides the events.
struct Surroundings {
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

// A session's first state: power off.
databuffer::RadarState initial_state(const radar::RadarConfiguration& configuration);

// What an event came to.
enum class Effect : std::uint32_t {
  none = databuffer::kEventDead,        // dead here, or everything stands so already
  done = databuffer::kEventDone,        // it changed something
  refused = databuffer::kEventRefused,  // it cannot be done, and the display says why
};

// Applies one event.
Effect apply(databuffer::RadarState& state, const databuffer::InputEvent& event, const Surroundings& surroundings,
             const radar::RadarConfiguration& configuration);

// What passes with time, once a tick after the events: cursor slew, messages that end, the points drawn, legends.
void advance(databuffer::RadarState& state, const Surroundings& surroundings,
             const radar::RadarConfiguration& configuration);

}  // namespace yars::statemachine
